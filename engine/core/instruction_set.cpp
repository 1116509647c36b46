#include "engine/core/instruction_set.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

#include "engine/core/errors.h"

namespace dem {
namespace {

constexpr std::array all{InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512};

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

std::string_view name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::sse2:
      break;
  }
  return "sse2";
}

std::optional<InstructionSet> set_of(std::string_view name) {
  const auto found = std::ranges::find(all, name, name_of);
  return found == all.end() ? std::nullopt : std::optional(*found);
}

bool processor_has(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl");
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2");
    case InstructionSet::sse2:
      break;
  }
  return true;
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> here;
  std::ranges::copy_if(all, std::back_inserter(here), processor_has);
  const char* const wanted = std::getenv("DEM_SIMD");
  if (!wanted) return here;
  const auto set = set_of(wanted);
  if (set && processor_has(*set)) return {*set};
  std::vector<std::string_view> names;
  std::ranges::transform(here, std::back_inserter(names), name_of);
  throw InputError(fmt::format("DEM_SIMD is '{}', which this processor does not have", wanted),
                   fmt::format("it has {}", fmt::join(names, ", ")));
}

InstructionSet fastest_set(const std::function<void(InstructionSet)>& work, int rounds) {
  const std::vector<InstructionSet> sets = instruction_sets();
  if (sets.size() == 1) return sets.front();
  std::vector<double> shortest(sets.size(), std::numeric_limits<double>::infinity());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < sets.size(); ++k) {
      const double start = thread_seconds();
      work(sets[k]);
      shortest[k] = std::min(shortest[k], thread_seconds() - start);
    }
  }
  std::size_t best = sets.size() - 1;
  for (std::size_t k = best; k-- > 0;) {
    if (shortest[k] < shortest[best]) best = k;
  }
  return sets[best];
}

}  // namespace dem
