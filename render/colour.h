#pragma once
// How far apart readers see two colours: CIELAB and CIEDE2000 (Sharma, Wu & Dalal 2005), sight without the red or the
// green cones (Machado, Oliveira & Fernandes 2009, severity 1), contrast on screen (WCAG 2.1). Colours are sRGB.
#include <array>

#include "render/style.h"

namespace render {

struct Lab {
  double lightness = 0, a = 0, b = 0;  ///< D65 white; lightness 0 ... 100
};

enum class Sight { normal, no_red, no_green };
inline constexpr std::array sights{Sight::normal, Sight::no_red, Sight::no_green};

Colour as_seen(const Colour& colour, Sight sight);

Lab lab(const Colour& colour);

/// CIEDE2000; 1 is just seen by a trained eye with the colours side by side.
double difference(const Lab& a, const Lab& b);
/// The smallest over all sights.
double difference(const Colour& a, const Colour& b);

/// Relative luminance, 0 ... 1, and the contrast of two colours, 1 ... 21.
double luminance(const Colour& colour);
double contrast(const Colour& a, const Colour& b);

}  // namespace render
