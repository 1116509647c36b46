#pragma once
// Colours, lines and markers, and the facts that go into a file with a picture.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace render {

struct Colour {
  double red = 0, green = 0, blue = 0;  ///< 0 ... 1
};

enum class Line { none, solid, dash, dot, dash_dot, long_dash, dash_dot_dot, short_dash };
enum class Marker { none, circle, square, diamond, triangle, cross };
enum class Pattern { none, rising, falling };  ///< hatching of a filled shape

/// Colours of lines and bars, by index; seven, then from the start. Any two are 15 apart (CIEDE2000) for readers with and
/// without red or green cones, each has a contrast of 3 with white. In grey, lines and markers tell them apart.
Colour palette(std::size_t index);
/// Fills of an ordered series, from light to dark, as far apart in grey as `count` allows; four
/// are 15 apart (CIEDE2000).
Colour ordered(std::size_t index, std::size_t count);
/// The line that goes with it, as many as there are colours.
Line line_style(std::size_t index);
Marker marker_style(std::size_t index);

/// Stable facts written into PNG text chunks and SVG metadata: {"Scenario", hash}, {"Figure", id}, {"Engine", version}.
/// SVG also takes {"Title", ...} and {"Description", ...} for its <title> and <desc>.
using Provenance = std::vector<std::pair<std::string, std::string>>;

}  // namespace render
