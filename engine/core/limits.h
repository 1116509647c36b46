#pragma once
// What the system grants this process.
#include <string>

namespace dem {

/// "at most 280 MiB are allowed here (ulimit -v)"; empty where memory has no limit.
std::string memory_limit();

}  // namespace dem
