#pragma once
// Content keys: SHA-256, so that a kept result belongs to exactly one input.
#include <string>
#include <string_view>

namespace dem {

/// SHA-256 of `text` as 64 lower-case hexadecimal digits (FIPS 180-4).
std::string sha256(std::string_view text);

}  // namespace dem
