#include "engine/analysis/statistics.h"

#include <cmath>
#include <limits>

namespace dem::analysis {

Spread spread(std::span<const double> values) {
  Spread found{.mean = 0, .deviation = 0, .count = 0};
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    found.mean += v;
    ++found.count;
  }
  if (found.count == 0) {
    found.mean = std::numeric_limits<double>::quiet_NaN();
    return found;
  }
  found.mean /= static_cast<double>(found.count);
  double squares = 0;
  for (const double v : values) {
    if (std::isfinite(v)) squares += (v - found.mean) * (v - found.mean);
  }
  if (found.count > 1) found.deviation = std::sqrt(squares / static_cast<double>(found.count - 1));
  return found;
}

}  // namespace dem::analysis
