#pragma once
// Abbreviations of reports, spelled out once on a page.
#include <string>
#include <string_view>
#include <vector>

namespace reports {

struct Abbreviation {
  std::string_view symbol, meaning;  ///< "UCS", "uniaxial compressive strength"
};

/// Those that stand in a text as words of their own, in a fixed order.
std::vector<Abbreviation> abbreviations_in(std::string_view text);

}  // namespace reports
