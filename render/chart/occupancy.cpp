#include "render/chart/occupancy.h"

#include <algorithm>
#include <cmath>

namespace render {

Occupancy::Occupancy(int width, int height)
    : columns_(static_cast<int>(width / cell) + 1),
      rows_(static_cast<int>(height / cell) + 1),
      weight_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0) {}

void Occupancy::add_at(double x, double y, double weight) {
  const int column = static_cast<int>(std::floor(x / cell)), row = static_cast<int>(std::floor(y / cell));
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return;
  float& at =
      weight_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)];
  at = std::max(at, static_cast<float>(weight));
}

void Occupancy::add_line(const std::vector<Vec2>& line, double weight) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 &a = line[i], &b = line[i + 1];
    const int steps = 1 + static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / (cell / 2));
    for (int k = 0; k <= steps; ++k) add_at(a.x + (b.x - a.x) * k / steps, a.y + (b.y - a.y) * k / steps, weight);
  }
}

void Occupancy::add(const Rect& rect, double weight) {
  for (double y = rect.top; y <= rect.bottom + cell; y += cell)
    for (double x = rect.left; x <= rect.right + cell; x += cell)
      add_at(std::min(x, rect.right), std::min(y, rect.bottom), weight);
}

double Occupancy::taken(const Rect& rect) const {
  const int left = std::max(0, static_cast<int>(std::floor(rect.left / cell)));
  const int right = std::min(columns_ - 1, static_cast<int>(std::floor(rect.right / cell)));
  const int top = std::max(0, static_cast<int>(std::floor(rect.top / cell)));
  const int bottom = std::min(rows_ - 1, static_cast<int>(std::floor(rect.bottom / cell)));
  double sum = 0;
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column)
      sum += weight_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(column)];
  return sum;
}

}  // namespace render
