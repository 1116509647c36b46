#pragma once
// A scenario as it is printed: no line is longer than its column, and what is copied off the paper still works.
#include <string>
#include <string_view>

namespace reports {

/// TOML with the values of `text`, its lines broken where a column of `width` characters asks for it: comments go on behind
/// a "#", lists after a comma, texts of keys as """ with a backslash at each line's end. What TOML cannot break stays long.
[[nodiscard]] std::string listing(std::string_view text, std::size_t width);

}  // namespace reports
