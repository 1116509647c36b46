#pragma once
// summary.json (stable: no clock, no path of this machine) and run.json (what varies between runs).
#include <string>
#include <vector>

#include "reports/output/drawing.h"
#include "reports/published/published.h"
#include "reports/options.h"

namespace reports {

/// {"scenario", "scale", "cases", "comparisons", "checks", "figures"}: the structure is described in docs and tests.
/// Names with dots nest; results that are not finite are left out.
std::string summary_json(const StudyResult& study, const Comparisons& comparisons,
                         const std::vector<DrawnFigure>& figures);

std::string run_json(const RunFacts& facts);

}  // namespace reports
