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

// "2 of 5 missed, 1 undecided"; "" where all or the only one say the same. `judged`: some are; else the word before says it.
std::string counts_text(const Tally& counts, bool judged) {
  const int all = counts.numbers();
  std::vector<std::string> parts;
  for (const auto& [number, word] : {std::pair{counts.missed, "missed"},
                                     {counts.undecided, "undecided"},
                                     {judged ? counts.not_judged : 0, "not judged"},
                                     {counts.not_computed, "not computed"}}) {
    if (number == 0 || all < 2 || (!judged && number == all)) continue;
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
  Tally counts;  // the verdicts of the table: what is not judged there is not judged here
  bool elsewhere = false;
  for (const Comparison& row : comparisons.rows) {
    if (row.role == Role::sensitivity || std::ranges::find(figure.rows, row.id) == figure.rows.end()) continue;
    const bool other = row.scale != "any" && row.scale != scale;
    if (other && row.kind == "value" && row.computed && !row.deviation) continue;  // not compared at this scale
    elsewhere = elsewhere || other;
    counts.add(Role::number, row.verdict);
  }
  const bool judged = counts.met + counts.missed + counts.undecided > 0;
  if (!judged && counts.not_judged == 0 && figure.agreement) counts = {};  // its own measure says more
  if (judged) {
    figure.agreement = counts.missed > 0                            ? Agreement::disagrees
                       : counts.undecided + counts.not_computed > 0 ? Agreement::undecided
                                                                    : Agreement::agrees;
  } else if (counts.numbers() > 0) {
    figure.agreement.reset();
    figure.standing = counts.not_judged > 0 ? "Not judged" : "Not compared";
  }
  if (figure.agreement) figure.standing = std::string(word_of(*figure.agreement));
  if (figure.standing.empty()) return;
  // What ours is found to be by a measure of its own, it is at this scale: where it is not as published, that is said.
  const bool smaller = !comparisons.scale.empty() && comparisons.scale != scale;
  const bool here = counts.numbers() > 0 ? elsewhere && !judged : smaller && figure.agreement == Agreement::disagrees;
  if (here) figure.standing += " at " + scale + " scale";
  const std::string said = counts_text(counts, judged);
  figure.standing += said.empty() ? "." : " (" + said + ").";
}

}  // namespace reports
