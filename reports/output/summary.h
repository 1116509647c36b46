#pragma once
// summary.json (stable: no clock, no path of this machine) and run.json (what varies between runs).
#include <string>
#include <vector>

#include "reports/drawn.h"
#include "reports/options.h"
#include "reports/published/published.h"

namespace reports {

/// Raised when keys or units change.
inline constexpr int summary_format = 4;

/// {"format", "scenario", "scale", "provenance", "quantities", "cases", "verdicts", "comparisons", "checks", "figures"}, as assets/summary.schema.json
/// describes it. Results have the ids of their quantities; those with dots nest; results that are not finite are left out.
std::string summary_json(const StudyResult& study, const Comparisons& comparisons,
                         const std::vector<DrawnFigure>& figures, const std::string& engine_version);

std::string run_json(const RunFacts& facts);

}  // namespace reports
