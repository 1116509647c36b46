#include "engine/core/limits.h"

#include <sys/resource.h>

namespace dem {

std::string memory_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  return "at most " + std::to_string(limit.rlim_cur >> 20) + " MiB are allowed here (ulimit -v)";
}

}  // namespace dem
