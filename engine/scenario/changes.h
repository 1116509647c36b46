#pragma once
// Which part of a content key changed, in words.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scenario/scenario.h"

namespace dem {

/// The lines of a content that differ, quantities in their declared unit: "mineral[2].cohesion: 292 MPa -> 300 MPa",
/// "seed: 1 -> 2", "b: (none) -> \"x\"". Empty when they are the same, in any order.
std::vector<std::string> changed_lines(std::string_view before, std::string_view now, std::span<const Key> keys);

/// Why a record of content `before` does not serve `now`: the first few of them in one line. "" when they are the same.
std::string changes(std::string_view before, std::string_view now, std::span<const Key> keys);

}  // namespace dem
