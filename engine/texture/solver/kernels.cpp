#include "engine/texture/solver/kernels.h"

#include "engine/core/instruction_set.h"

namespace dem::texture {
namespace sse2 {
extern const Kernels table;
}
namespace avx2 {
extern const Kernels table;
}
namespace avx512 {
extern const Kernels table;
}
namespace wide {  // the eight-lane source on the baseline instruction set: for tests on any processor
extern const Kernels table;
}

const Kernels& kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return avx512::table;
    case InstructionSet::avx2:
      return avx2::table;
    case InstructionSet::sse2:
      break;
  }
  return sse2::table;
}

const Kernels& kernels() { return kernels(widest_set()); }

const Kernels* kernels(std::string_view name) {
  if (name == wide::table.name) return &wide::table;
  const auto set = set_of(name);
  return set && processor_has(*set) ? &kernels(*set) : nullptr;
}

}  // namespace dem::texture
