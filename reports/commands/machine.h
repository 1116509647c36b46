#pragma once
// What the program has to know about the machine that it runs on.
#include <cstdint>
#include <string>

namespace cli {

std::string host_name();       ///< "" when the system does not tell
std::uint64_t memory_bytes();  ///< of the whole machine

}  // namespace cli
