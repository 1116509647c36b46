#include "engine/texture/solver/kernels.h"

#include <cstdlib>
#include <cstring>
#include <initializer_list>

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

const Kernels* kernels(const char* name) {
  const auto is = [name](const Kernels& set) { return std::strcmp(name, set.name) == 0; };
  if (is(sse2::table)) return &sse2::table;
  if (is(wide::table)) return &wide::table;
  if (is(avx2::table) && __builtin_cpu_supports("avx2")) return &avx2::table;
  if (is(avx512::table) && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    return &avx512::table;
  }
  return nullptr;
}

const Kernels& kernels() {
  if (const char* wanted = std::getenv("DEM_SIMD")) {
    if (const Kernels* set = kernels(wanted)) return *set;
  }
  for (const char* name : {"avx512", "avx2"}) {
    if (const Kernels* set = kernels(name)) return *set;
  }
  return sse2::table;
}

}  // namespace dem::texture
