#include "reports/published/standing.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/text.h"

namespace reports {
namespace {

std::string_view word_of(Agreement agreement) {
  switch (agreement) {
    case Agreement::agrees:
      return "Agrees";
    case Agreement::disagrees:
      return "Disagrees";
    case Agreement::undecided:
      break;
  }
  return "Undecided";
}

// "2 of 5 missed, 1 undecided"; "" where all or the only one say the same.
std::string counts_text(const Tally& counts) {
  const int all = counts.numbers();
  std::vector<std::string> parts;
  for (const auto& [number, word] :
       {std::pair{counts.missed, "missed"}, {counts.undecided, "undecided"}, {counts.not_computed, "not computed"}}) {
    if (number == 0 || all < 2) continue;
    parts.push_back(number == all   ? (all == 2 ? "both " : fmt::format("all {} ", all)) + word
                    : parts.empty() ? fmt::format("{} of {} {}", number, all, word)
                                    : fmt::format("{} {}", number, word));
  }
  return joined(parts, ", ");
}

}  // namespace

void set_standing(DrawnFigure& figure, const Comparisons& comparisons, const std::string& scale) {
  if (figure.statement.empty()) {
    figure.agreement.reset();
    return;
  }
  Tally counts;
  bool elsewhere = false;
  for (const Comparison& row : comparisons.rows) {
    if (row.role == Role::sensitivity || std::ranges::find(figure.rows, row.id) == figure.rows.end()) continue;
    const bool other = row.scale != "any" && row.scale != scale;
    if (other && row.kind == "value" && row.computed && !row.deviation) continue;  // not compared at this scale
    elsewhere = elsewhere || other;
    counts.add(Role::number, row.computed ? row.outcome : Verdict::not_computed);
  }
  if (counts.numbers() == counts.not_computed && figure.agreement) counts = {};  // its own measure says more
  if (counts.numbers() > 0) {
    figure.agreement = counts.missed > 0                            ? Agreement::disagrees
                       : counts.undecided + counts.not_computed > 0 ? Agreement::undecided
                                                                    : Agreement::agrees;
  }
  if (!figure.agreement) return;
  figure.standing = std::string(word_of(*figure.agreement));
  // What ours is found to be by a measure of its own, it is at this scale: where it is not as published, that is said.
  const bool smaller = !comparisons.scale.empty() && comparisons.scale != scale;
  const bool here = counts.numbers() > 0 ? elsewhere : smaller && *figure.agreement == Agreement::disagrees;
  if (here) figure.standing += " at " + scale + " scale";
  const std::string said = counts_text(counts);
  figure.standing += said.empty() ? "." : " (" + said + ").";
}

}  // namespace reports
