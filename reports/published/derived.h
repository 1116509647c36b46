#pragma once
// What published numbers are compared with beyond the results of records: fits through several cases, and what is read off
// the tables of one.
#include <optional>
#include <string_view>

#include "engine/analysis/fits.h"
#include "reports/figure.h"

namespace reports {

/// A fitted value of the study by name: "peak.m", "damage.s", "initiation.axial_stiffness.slope" (engine/analysis/envelopes.h),
/// of one mineral alone or of the rock ("" for `mineral`). Nothing where too few cases have run.
std::optional<analysis::Estimate> fitted_value(const StudyResult& study, std::string_view name,
                                               std::string_view mineral);

/// "crack_angle": mean angle of cracks to the axis of loading (degrees); "stress_after_peak": stress over peak at one strain
/// after it for all cases of the study. Throws std::out_of_range when the record lacks the table, std::invalid_argument for
/// another name.
double derived_value(const StudyResult& study, const dem::Record& record, std::string_view name);

}  // namespace reports
