#pragma once
// How far the stress has fallen at one and the same strain after the peak: what figures draw and verdicts compare.
#include <vector>

#include "reports/figures/parts.h"

namespace reports {

/// Strain from the peak to the end of the test that is followed least far beyond its peak (%); infinite without a test.
double common_reach(const std::vector<SeriesCase>& cases);

/// Stress over the peak at a strain after it (%): the mean over the tenth of that strain before. NaN where a test ends
/// before.
Measure stress_after_peak(double reach);

}  // namespace reports
