// The table of models: a model is one entry here.
#include "engine/lattice/model.h"
#include "engine/model/model.h"
#include "engine/sheet/model.h"
#include "engine/texture/model.h"

namespace dem {

std::span<const Model> models() {
  static const std::vector<Model> table = {texture::model(), lattice::model(), sheet::model()};
  return table;
}

}  // namespace dem
