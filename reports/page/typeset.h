#pragma once
// The finished page set in type, so that no part of it has to care.
#include <string>
#include <string_view>

namespace reports {

/// HTML whose text has indices as indices ("σ_ci", "σci", "σ₃", "R_{min}"), no-break spaces between a number and its unit and
/// between a name and its number ("Fig. 14c", "AR 1", "p = 0.03"), degrees at their number, and real apostrophes. Ids of
/// cases (class "id") may break after an underscore. Code, styles and attributes stay as they are.
[[nodiscard]] std::string typeset(std::string_view html);

/// The same for one text between tags, already escaped.
[[nodiscard]] std::string typeset_text(std::string_view text);

}  // namespace reports
