#include "render/scene/culling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace render {
namespace {

/// The picture in square cells; each knows a depth at which nothing behind it can be seen.
class Grid {
 public:
  Grid(double cell, int width, int height)
      : cell_(cell),
        left_(-width / 2.0),
        bottom_(-height / 2.0),
        columns_(1 + static_cast<int>(width / cell)),
        rows_(1 + static_cast<int>(height / cell)),
        depth_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
               -std::numeric_limits<float>::max()) {}

  /// Calls visit(depth of the cell, squared distances of its nearest and farthest point from the centre) for the cells
  /// that a sphere's disc may touch; stops when visit returns false.
  template <class Visit>
  void cells(const ViewSphere& s, Visit visit) {
    const int first_column = index(s.centre[0] - s.radius - left_, columns_);
    const int last_column = index(s.centre[0] + s.radius - left_, columns_);
    const int first_row = index(s.centre[1] - s.radius - bottom_, rows_);
    const int last_row = index(s.centre[1] + s.radius - bottom_, rows_);
    for (int row = first_row; row <= last_row; ++row)
      for (int column = first_column; column <= last_column; ++column) {
        const auto [near_x, far_x] = reach(s.centre[0], left_ + column * cell_);
        const auto [near_y, far_y] = reach(s.centre[1], bottom_ + row * cell_);
        if (!visit(depth_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column)],
                   near_x * near_x + near_y * near_y, far_x * far_x + far_y * far_y))
          return;
      }
  }

 private:
  double cell_, left_, bottom_;
  int columns_, rows_;
  std::vector<float> depth_;

  [[nodiscard]] int index(double distance, int count) const {
    return static_cast<int>(std::clamp(std::floor(distance / cell_), 0.0, count - 1.0));
  }
  /// Nearest and farthest distance between x and the cell from `low` on.
  [[nodiscard]] std::pair<double, double> reach(double x, double low) const {
    const double high = low + cell_;
    return {std::max({0.0, low - x, x - high}), std::max(std::abs(x - low), std::abs(x - high))};
  }
};

}  // namespace

std::vector<bool> seen(const std::vector<ViewSphere>& spheres, int width, int height) {
  std::vector<bool> result(spheres.size(), true);
  double mean = 0;
  for (const auto& s : spheres) mean += s.radius / static_cast<double>(std::max<std::size_t>(1, spheres.size()));
  Grid grid(std::clamp(mean / 4, 0.5, 16.0), width, height);
  constexpr double slack = 0.01;  // px: rounding of the graphics pipeline
  for (const auto& s : spheres)
    if (s.hiding_radius > slack)
      grid.cells(s, [&](float& depth, double, double far) {
        const double inner = s.hiding_radius - slack, square = s.radius * s.radius - far;
        if (far >= inner * inner) return true;
        const double surface = std::min(s.top, s.centre[2] + std::sqrt(std::max(0.0, square)));
        depth = std::max(depth, static_cast<float>(surface - slack));
        return true;
      });
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto& s = spheres[i];
    bool hidden = true;
    grid.cells(s, [&](const float& depth, double near, double) {
      const double square = s.radius * s.radius - near;
      hidden = square <= 0 || depth > std::min(s.top, s.centre[2] + std::sqrt(square));
      return hidden;
    });
    result[i] = !hidden;
  }
  return result;
}

}  // namespace render
