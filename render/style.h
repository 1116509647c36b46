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

enum class Line { none, solid, dash, dot, dash_dot };
enum class Marker { none, circle, square, diamond, triangle, cross };

/// Colours that stay apart for colour-blind readers and in grey print (Okabe & Ito 2008), by index.
Colour palette(std::size_t index);

/// Stable facts written into PNG text chunks and SVG metadata: {"Scenario", hash}, {"Figure", id}, {"Engine", version}.
/// SVG also takes {"Title", ...} and {"Description", ...} for its <title> and <desc>.
using Provenance = std::vector<std::pair<std::string, std::string>>;

}  // namespace render
