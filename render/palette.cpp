#include <array>

#include "render/style.h"

namespace render {

Colour palette(std::size_t index) {
  // Hues of Okabe & Ito 2008, moved apart and darkened for thin lines on white paper.
  static constexpr std::array<Colour, 7> colours{{{0.000, 0.412, 0.725},    // blue
                                                  {0.882, 0.431, 0.106},    // orange
                                                  {0.047, 0.620, 0.451},    // bluish green
                                                  {0.596, 0.255, 0.427},    // plum
                                                  {0.000, 0.000, 0.000},    // black
                                                  {0.341, 0.592, 0.824},    // sky blue
                                                  {0.443, 0.341, 0.000}}};  // olive
  return colours[index % colours.size()];
}

Colour ordered(std::size_t index, std::size_t count) {
  constexpr Colour light{0.863, 0.933, 0.980}, dark{0.016, 0.078, 0.180};
  const double share = count < 2 ? 0.5 : static_cast<double>(index) / static_cast<double>(count - 1);
  const auto mix = [&](double Colour::*part) { return light.*part + share * (dark.*part - light.*part); };
  return {mix(&Colour::red), mix(&Colour::green), mix(&Colour::blue)};
}

Line line_style(std::size_t index) {
  static constexpr std::array lines{Line::solid,     Line::dash,         Line::dash_dot,  Line::dot,
                                    Line::long_dash, Line::dash_dot_dot, Line::short_dash};
  return lines[index % lines.size()];
}

Marker marker_style(std::size_t index) {
  static constexpr std::array markers{Marker::circle, Marker::square, Marker::triangle, Marker::diamond, Marker::cross};
  return markers[index % markers.size()];
}

}  // namespace render
