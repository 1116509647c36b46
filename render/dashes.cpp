#include "render/dashes.h"

#include <algorithm>
#include <cmath>

namespace render {

std::vector<double> dash_pattern(Line line) {
  switch (line) {
    case Line::dash:
      return {5, 3};
    case Line::dot:
      return {1.2, 2};
    case Line::dash_dot:
      return {6, 2.2, 1.2, 2.2};
    case Line::long_dash:
      return {11, 3};
    case Line::dash_dot_dot:
      return {6, 2, 1.2, 2, 1.2, 2};
    case Line::short_dash:
      return {2.6, 1.6};
    case Line::none:
    case Line::solid:
      break;
  }
  return {};
}

std::vector<DashPiece> dashes(const std::vector<std::array<double, 2>>& points, Line line, double width) {
  std::vector<DashPiece> pieces;
  if (line == Line::none) return pieces;
  std::vector<double> pattern = dash_pattern(line);
  for (double& length : pattern) length *= std::max(width, 1.0);
  std::size_t phase = 0;
  double left = pattern.empty() ? 0 : pattern[0];
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double length = std::hypot(points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1]);
    if (pattern.empty()) {
      pieces.push_back({i, 0, 1});
      continue;
    }
    if (!(length > 0)) continue;
    for (double at = 0; at < length;) {
      const double to = std::min(length, at + left);
      if (phase % 2 == 0) pieces.push_back({i, at / length, to / length});
      left -= to - at;
      at = to;
      if (left <= 1e-9) {
        phase = (phase + 1) % pattern.size();
        left = pattern[phase];
      }
    }
  }
  return pieces;
}

}  // namespace render
