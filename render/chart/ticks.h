#pragma once
// Value axes: range, ticks at round numbers, labels without noise.
#include <string>
#include <vector>

#include "render/chart/chart.h"

namespace render {

struct Tick {
  double value = 0;
  std::string label;  ///< "" for minor ticks
  bool major = true;
};

/// A value axis ready to draw.
struct Scale {
  double low = 0, high = 1;
  bool logarithmic = false;
  std::vector<Tick> ticks;
  std::string multiplier;                          ///< "×10⁻³" when labels are written in that unit; "" otherwise
  [[nodiscard]] double share(double value) const;  ///< 0 at low ... 1 at high; NaN where a log axis has no place
};

/// The values that an axis must show.
struct Range {
  double low = 0, high = 0;
  bool any = false;
  void take(double value);  ///< values that are not finite are left out
};

/// `wanted`: about how many major ticks fit. `tight`: the range ends with the data instead of a round number.
Scale make_scale(const Axis& axis, const Range& data, int wanted, bool tight);

/// A number with `digits` decimals and a proper minus sign; never "-0".
std::string plain_number(double value, int digits);
/// The digits that a text begins with in groups of three, apart by narrow no-break spaces, from five digits on.
std::string with_thousands(std::string text);

/// "10⁻³"
std::string power_of_ten(int exponent);

}  // namespace render
