#pragma once
// The one rule by which our results are judged beside published ones, and how verdicts are counted: the page, summary.json,
// the last words of a run and --strict ask here. In words: docs/use/reading-a-report.md.
//
// A value has a tolerance. Its 95 % interval (of a fit, or of the mean of three or more seeds) is compared with the band that the
// tolerance makes round the published value: inside is met, outside is missed, across an end of the band is undecided.
// Without an interval (one or two seeds, as many points as unknowns) the value alone is compared: the tolerance is there for its scatter.
// A trend is the slope of a straight line. Cases of one seed share their packing: each seed gives one slope, and the interval
// is that of three seeds or more. A trend and a difference (one result against another) have no tolerance. Their interval must
// leave out zero; it decides by its side. Without an interval they are undecided, but where nothing is left to chance: then
// the sign decides.
// At another scale than that of the published number nothing is judged.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/analysis/fits.h"

namespace reports {

enum class Verdict {
  met,
  missed,
  undecided,     ///< what is known of ours cannot tell
  not_judged,    ///< made at another scale than the published number's
  not_computed,  ///< ours has no value
};
std::string_view verdict_word(Verdict verdict);  ///< "met", "not judged"

/// What a row of the table stands for. Only `number` is counted as met or missed.
enum class Role {
  number,       ///< a published number or trend
  fitted,       ///< a choice of the program was fitted to it
  theory,       ///< a formula compared with a formula
  stated,       ///< published in words; the limits are this program's
  derived,      ///< computed here from published numbers; the paper does not print it
  follows,      ///< follows from other rows
  sensitivity,  ///< another reading or variant of the row above it
};
std::string_view role_word(Role role);  ///< "number", "fitted", "theory", "stated", ...

/// The values that are near enough to a published one.
struct Band {
  double low = 0, high = 0;
};

/// `interval` as far as there is one: Estimate::has_interval().
Verdict judge_value(double ours, const std::optional<dem::analysis::Estimate>& interval, const Band& band);

/// Of a slope or a difference that is published as positive (`sign` 1) or negative (-1). `by_chance`: repeating the case with
/// another seed would change it.
Verdict judge_sign(const dem::analysis::Estimate& ours, int sign, bool by_chance);

/// How many rows have which verdict. Rows that are not of role `number` are counted by role alone.
struct Tally {
  int met = 0, missed = 0, undecided = 0, not_judged = 0, not_computed = 0;
  int fitted = 0, theory = 0, stated = 0, derived = 0, follows = 0;
  /// Of `stated`; the rest is not judged at this scale.
  int stated_met = 0, stated_missed = 0, stated_undecided = 0, stated_not_computed = 0;
  int fitted_not_computed = 0, theory_not_computed = 0, derived_not_computed = 0, follows_not_computed = 0;
  int trends = 0;  ///< of those that count
  /// met to not_computed
  [[nodiscard]] int numbers() const { return met + missed + undecided + not_judged + not_computed; }
  void add(Role role, Verdict verdict, bool is_trend = false);
};

/// "Of 23 published numbers and trends 12 are met, 5 missed and 6 undecided. ..."; `scale`: of the published numbers.
std::string tally_text(const Tally& counts, std::string_view scale);

}  // namespace reports
