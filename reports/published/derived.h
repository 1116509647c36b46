#pragma once
// What published numbers are compared with beyond the results of records: fits through several cases, and what is read off
// the tables of one.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "engine/analysis/fits.h"
#include "reports/figure.h"

namespace reports {

/// A fitted value of the study by name: "peak.m", "damage.s", "initiation.axial_stiffness.slope" (engine/analysis/envelopes.h),
/// of one mineral alone or of the rock ("" for `mineral`). Nothing where too few cases have run.
std::optional<analysis::Estimate> fitted_value(const StudyResult& study, std::string_view name,
                                               std::string_view mineral);

/// By name; `which` is the term's member of that name, null where it has none.
///   granite: "crack_angle" (mean angle of cracks to the axis of loading, degrees), "stress_after_peak" (stress over peak at one
///            strain after it for all cases of the study), "cracks" (which: {"place": "inter", "mode": "tension", "minerals",
///            "without", "pair", "after", "until", "by": "number" | "contacts" | "area" | "exposure"}; engine/analysis/cracking.h),
///            "lateral_strain" (which: {"at": 0.1}, axial strain; both in %)
///   lattice: "pieces", "first_at_boundary", "opened_below_theory", "fall_before_a1", "fall_before_peak", "straightness_to_a1",
///            "elastic_left", "kinetic_left", "breaking_after_sliding" (engine/analysis/breaking.h)
/// Throws std::out_of_range when the record lacks a table, result or moment, std::invalid_argument for another name.
double derived_value(const StudyResult& study, const dem::Record& record, std::string_view name,
                     const nlohmann::json& which);

}  // namespace reports
