#pragma once
// Long curves with no more points than can be seen.
#include <vector>

#include "render/paper/paper.h"

namespace render {

/// A line that looks the same at this size (px): in very long ones, runs of points within one pixel column are reduced
/// to their first, lowest, highest and last; then points nearer than `tolerance` to the line of their neighbours are
/// left out (Douglas & Peucker 1973).
std::vector<Vec2> simplified(const std::vector<Vec2>& line, double tolerance = 0.1);

}  // namespace render
