#pragma once
// Terms of published numbers: what of a study a number is compared with.
//   {"test": "compression", "aspect_ratio": 2, "of": "compressive_strength"}   a result, by the parameters of its case; those
//                                                 that are not named have the scenario's own values; in the shown unit
//   {"test": ..., "derived": "crack_angle"}       read off the case's tables, with a member "which" where it
//                                                 needs one (reports/published/derived.h)
//   {"fit": "peak.m", "mineral": "quartz"}        fitted through several cases
//   {"sum": [TERM, ...]}  {"mean": [TERM, ...]}  {"largest": [TERM, ...]}  {"least": [TERM, ...]}  {"constant": 0}
//   {"difference": [TERM, TERM]}  {"quotient": [TERM, TERM]}  {"distance": [TERM, TERM]}: the difference without its sign
//   {"furthest": "contact_share.*", "apart": [TERM, TERM]}: the largest distance of any member of the family; the terms name
//                                                 cases without "of"
//   {"effect": ["cohesion", ...], "on": TERM}    relative change of the term when a parameter is raised (sweep.raised), without
//                                                 its sign; of several parameters, each raised alone, the sum
//   "times": 100 scales any of them.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/analysis/fits.h"
#include "reports/figure.h"

namespace reports {

/// Why a term has no value: said in the table instead of a number.
struct NotComputed {
  std::string why;
};

/// Evaluates the terms of one study.
class Terms {
 public:
  /// What a term gives whose case the study does not have: nothing, or what another case has, which is for numbers that do not
  /// depend on it.
  enum class Lacking { not_computed, taken_from_any };
  explicit Terms(const StudyResult& study, Lacking lacking = Lacking::not_computed);

  /// Whether the study has every case that a term needs, run or not, at a place of the swept parameters.
  [[nodiscard]] bool has_cases(const nlohmann::json& term, const dem::Parameters& at = {}) const;

  /// The value for every seed, the first one's first. A seed that lacks a case of the term is left out, but for the first.
  /// Throws NotComputed; nlohmann::json::exception or std::out_of_range for a term that means nothing.
  [[nodiscard]] std::vector<double> values(const nlohmann::json& term, const dem::Parameters& at = {}) const;

  /// The same with the seed of each; without seeds one value, at 0.
  [[nodiscard]] std::vector<std::pair<double, double>> by_seed(const nlohmann::json& term,
                                                               const dem::Parameters& at = {}) const;

  /// Whether the value grows with the specimen, by what its results are declared to be (dem::Quantity::of_size). The quotient
  /// of two that do does not.
  [[nodiscard]] bool of_size(const nlohmann::json& term) const;

  /// Whether the cases of the study have seeds: another one would give another value.
  [[nodiscard]] bool by_chance() const { return !seeds_.empty(); }

  /// The fit of a term {"fit": ...}.
  [[nodiscard]] analysis::Estimate fitted(const nlohmann::json& term) const;

 private:
  [[nodiscard]] double value(const nlohmann::json& term, const dem::Parameters& at, std::optional<double> seed) const;
  [[nodiscard]] double furthest(const nlohmann::json& term, const dem::Parameters& at,
                                std::optional<double> seed) const;
  [[nodiscard]] const CaseResult& case_of(const nlohmann::json& term, const dem::Parameters& at,
                                          std::optional<double> seed) const;
  [[nodiscard]] std::vector<const CaseResult*> cases(const nlohmann::json& term, const dem::Parameters& at) const;
  [[nodiscard]] dem::Parameters named(const nlohmann::json& term, const dem::Parameters& at) const;

  const StudyResult& study_;
  Lacking lacking_;
  analysis::Usual usual_;
  std::vector<double> seeds_;  ///< of the study, in report order
};

/// The ids of all results that a term asks for, each with the test that it names ("" without).
std::vector<std::pair<std::string, std::string>> results_of(const nlohmann::json& term);

}  // namespace reports
