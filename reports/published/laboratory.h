#pragma once
// What the user's laboratory measured (the keys [measured] and [mineral.measured]) beside ours: what published numbers are to
// the papers, these are to the user. Ours is the mean over seeds, judged as published numbers are (verdict.h), with the band
// that the laboratory states for tolerance, at any scale.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/analysis/fits.h"
#include "reports/figure.h"
#include "reports/published/verdict.h"

namespace reports {

struct LaboratoryRow {
  LaboratoryNumber number;
  std::optional<analysis::Estimate> ours;  ///< none: no case of the study gives it
  std::size_t seeds = 0;                   ///< that its mean is of; 0 of a fit
  Verdict verdict = Verdict::not_computed;
};

/// Those that the scenario states, the rock's first.
std::vector<LaboratoryNumber> laboratory_numbers(const StudyResult& study);

/// Beside what the cases of the study give.
std::vector<LaboratoryRow> beside_laboratory(const StudyResult& study);

/// "within its uncertainty", "outside", "undecided", "no uncertainty stated", "not tested".
std::string_view laboratory_word(Verdict verdict);

/// "210 ± 8 MPa", "200 to 228 MPa".
std::string laboratory_text(const LaboratoryNumber& number, bool with_unit = true);
/// "Peak stress at σ₃ 20 MPa", "Young’s modulus of quartz".
std::string laboratory_name(const LaboratoryNumber& number);

/// "Of 6 values measured in the laboratory 3 are within their uncertainty, 2 outside and 1 undecided."
/// `scale`: named where the specimen is too small to judge the rock by.
std::string laboratory_tally(const std::vector<LaboratoryRow>& rows, const std::string& scale = {});
/// Whether the scale of a study is one of those that try a rock out: what it says is no verdict on the rock.
bool is_small(const dem::Scenario& scenario);
/// "Where they come from: ...", by the scenario's key; "" where it does not say.
std::string laboratory_source(const dem::Scenario& scenario);

}  // namespace reports
