#pragma once
// Dash patterns along a line on the screen.
#include <array>
#include <cstddef>
#include <vector>

#include "render/style.h"

namespace render {

/// Lengths of ink, gap, ink, gap ... in units of the line's width; empty for solid lines.
std::vector<double> dash_pattern(Line line);

/// A drawn piece of segment `segment` of a line, from and to as fractions of the segment.
struct DashPiece {
  std::size_t segment = 0;
  double from = 0, to = 1;
};

/// The drawn pieces of a line through `points` (px).
std::vector<DashPiece> dashes(const std::vector<std::array<double, 2>>& points, Line line, double width);

}  // namespace render
