#include "engine/model/model.h"

#include <algorithm>

#include "engine/scenario/suggest.h"

namespace dem {

const Model& find_model(std::span<const Model> models, std::string_view name) {
  const auto at = std::ranges::find(models, name, &Model::name);
  if (at != models.end()) return *at;
  std::vector<std::string> names;
  for (const Model& known : models) names.emplace_back(known.name);
  throw InputError("unknown model '" + std::string(name) + "'", advice(name, names, "the models are"));
}

}  // namespace dem
