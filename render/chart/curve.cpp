#include "render/chart/curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace render {
namespace {

std::vector<Vec2> by_columns(const std::vector<Vec2>& line) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < line.size();) {
    const double column = std::floor(line[i].x);
    std::size_t end = i, low = i, high = i;
    for (; end < line.size() && std::floor(line[end].x) == column; ++end) {
      if (line[end].y < line[low].y) low = end;
      if (line[end].y > line[high].y) high = end;
    }
    const std::size_t last = end - 1;
    std::size_t picked[4] = {i, std::min(low, high), std::max(low, high), last};
    for (std::size_t k = 0; k < 4; ++k)
      if (k == 0 || picked[k] != picked[k - 1]) kept.push_back(line[picked[k]]);
    i = end;
  }
  return kept;
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

}  // namespace

std::vector<Vec2> simplified(const std::vector<Vec2>& line, double tolerance) {
  constexpr std::size_t long_line = 4000;
  const std::vector<Vec2> points = line.size() > long_line ? by_columns(line) : line;
  if (points.size() < 3) return points;
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double worst = tolerance;
    std::size_t split = 0;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double d = distance(points[i], points[from], points[to]);
      if (d > worst) {
        worst = d;
        split = i;
      }
    }
    if (split == 0) continue;
    keep[split] = true;
    open.emplace_back(from, split);
    open.emplace_back(split, to);
  }
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (keep[i]) kept.push_back(points[i]);
  return kept;
}

}  // namespace render
