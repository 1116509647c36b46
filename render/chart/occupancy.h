#pragma once
// Which parts of a chart are taken, so that labels and legends find free places.
#include <cstdint>
#include <vector>

#include "render/paper/paper.h"

namespace render {

class Occupancy {
 public:
  Occupancy(int width, int height);
  void add_line(const std::vector<Vec2>& line, double weight = 1);
  void add(const Rect& rect, double weight = 1);
  /// Weighted taken area inside `rect`, in cells.
  [[nodiscard]] double taken(const Rect& rect) const;

 private:
  static constexpr double cell = 3;  // px
  int columns_, rows_;
  std::vector<float> weight_;
  void add_at(double x, double y, double weight);
};

}  // namespace render
