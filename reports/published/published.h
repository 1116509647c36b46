#pragma once
// Published numbers (assets/papers/PAPER/published.json) beside ours. A file:
//   {"numbers": [{"id", "topics": ["aspect_ratio"], "source": "Section 4.1", "quantity", "unit", "statement", "kind", ...}],
//    "quoted": [{"id", "source", "quantity", "unit", "published"}, ...]}
// kind "value":   "published": 206.8 or [55, 60] (a range), "tolerance": {"relative": 0.1} or {"absolute": 0.03}, "of": TERM
//      "trend":   "published": "rises" | "falls", "over": {"aspect_ratio": [1, 2, 3]}, "of": TERM; steps that the scenario has
//                 no cases for are left out; "published_values": [...] are shown beside ours; "resolution": 0.08 leaves a
//                 smaller relative change over all steps undecided, because half the loading rate makes as much
//      "greater": "of": TERM, "than": TERM: ours must be greater, as published; "resolution" leaves two undecided that are
//                 less apart than this share of the larger
// TERM: see reports/published/terms.h. Which numbers concern a scenario: those with a topic of its key `published`; without
// that key every number whose cases the scenario has.
// Where a scenario repeats its cases with other seeds, values are means. How they are judged: reports/published/verdict.h.
// A number has one entry and one verdict. What is not counted, or counted apart, is declared:
//   "readings": [{"id", "reading": "seeds × 0.675", "of": TERM}]  rows under the entry's, where the scenario has their cases; of
//                          kind "greater" with a "than" of their own where they need one
//   "follows": ["id", ...]   follows from those rows
//   "fitted": "why"          a choice of the program was fitted to it
//   "theory": "why"          a formula beside a formula
//   "stated": "mainly"       the paper has these words and no number: they stand under "Published", and `published` with its
//                            tolerance is how this program reads them; may stand beside "fitted", for a limit that was set
//                            when ours was known
//   "derived": "206.8 / 9.8" computed here from what the paper prints; may stand beside "follows" or "theory"
// What is stated or derived is no published number: figures do not draw it.
// "scale": "high" if the number belongs to another scale than its paper's (it is shown at that one only), "any" if the scale
// does not matter. "of_loading": true: a value that hangs on the rate of loading, which is not compared at other scales than
// its own. "optional": true leaves the number out where the scenario has not the case. "quoted" are numbers of the
// paper that figures show and nothing of ours is compared with.
// "unchecked": [{"source", "statement", "why"}] are statements about results that no number can be put beside; the page of the
// paper in docs/papers lists them.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/analysis/fits.h"
#include "reports/figure.h"
#include "reports/published/verdict.h"

namespace reports {

/// A number, a range, or a word ("falls").
using Amount = std::variant<double, std::pair<double, double>, std::string>;

struct Comparison {
  std::string id, source, quantity, unit, statement, kind;
  Role role = Role::number;
  std::string why;              ///< of a fitted row or one of theory: see above
  std::vector<std::string> of;  ///< rows that it follows from, or the one that it is another reading of
  std::string reading;          ///< of a row of role sensitivity
  std::string stated;           ///< the paper's words, where it has no number
  std::string derived;          ///< from what the published number was computed here
  std::string scale;            ///< of the published number; "any"
  Amount published;
  std::optional<Amount> computed;
  std::optional<double> deviation;  ///< relative, or absolute in `unit`; from the nearer end of a range
  std::optional<double> tolerance;
  bool relative = false;  ///< deviation and tolerance are fractions of the published value
  Verdict verdict = Verdict::not_computed;
  Verdict outcome = Verdict::not_computed;  ///< what the verdict would be if the scale were the published one
  /// Ours with its interval, where it has one: a value, a slope, a difference.
  std::optional<analysis::Estimate> estimate;
  std::optional<double> p_value;  ///< of a trend's slope
  std::string published_detail;   ///< the published values that make a trend: "206.8 → 201.3 → 198.4"
  std::string detail;             ///< what trends are made of, or why nothing could be computed
};

struct Comparisons {
  std::string paper;             ///< "Zhao et al. 2021"; several joined
  std::string scale;             ///< at which the published numbers belong
  std::vector<Comparison> rows;  ///< other readings stand behind the row that they belong to

  [[nodiscard]] Tally tally() const;
};

/// All numbers that concern the scenario of the study. A case that failed, was left out or lacks the result gives
/// not_computed. Throws dem::EnvironmentError naming the file and entry that cannot be understood.
Comparisons compare(const StudyResult& study, const std::filesystem::path& papers);

/// Every value and range that the papers of the study's model state, compared in this scenario or not, in the order of the
/// files; nothing for another rock. Throws as compare().
std::vector<PublishedNumber> published_numbers(const StudyResult& study, const std::filesystem::path& papers);

}  // namespace reports
