#pragma once
// Directions of cracks as drawings as wide as the page, one alone as wide as a column: equal-area nets with contoured
// density, and roses of strike.
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/directions.h"
#include "reports/figure.h"

namespace reports::texture {

/// One net: the density of its poles as contours; of fewer than ten, the poles as dots.
struct Net {
  std::string label;               ///< above it: "AR 2"
  std::vector<std::string> words;  ///< lines below it
  analysis::Poles poles;
  std::optional<analysis::Maximum> maximum{};  ///< of ten poles or more: its plane is drawn
};
/// Nets beside each other with one key. `largest`: the density that the greys must reach, so that drawings of one figure share
/// their levels; 0: the largest of these.
std::string nets_drawing(const std::vector<Net>& nets, double largest = 0);

/// One rose: shares by strike, 0 to 180 degrees from x, drawn over the whole circle. The area of a sector is its share.
struct Rose {
  std::string label;
  std::vector<std::string> words;
  std::vector<double> share;
};
std::string roses_drawing(const std::vector<Rose>& roses);

}  // namespace reports::texture
