#pragma once
// How far the stress has fallen at one and the same strain after the peak: what figures draw and verdicts compare.
#include <vector>

#include "engine/analysis/series.h"

namespace dem::analysis {

/// Strain from the peak to the end of the test that is followed least far beyond its peak (%); infinite without a test.
double common_reach(std::span<const Point> points);

/// Stress over the peak at a strain after it (%): the mean over the tenth of that strain before. NaN where a test ends
/// before.
ValueOf stress_after_peak(double reach);

}  // namespace dem::analysis
