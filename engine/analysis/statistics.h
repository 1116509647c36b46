#pragma once
// Means and scatter.
#include <cstddef>
#include <span>

namespace dem::analysis {

/// Of the finite values among some: NaN where there is none.
struct Spread {
  double mean = 0;
  double deviation = 0;  ///< standard deviation of a sample (n - 1); 0 for one value
  std::size_t count = 0;
};
Spread spread(std::span<const double> values);

}  // namespace dem::analysis
