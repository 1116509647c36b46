#pragma once
// The paper that a chart is drawn on: filled shapes, lines and text in pixels at 100 dpi, x right, y down, recorded in
// order. One recording becomes vector SVG (svg.cpp) and pixels (pixels.cpp). No VTK here.
#include <string>
#include <variant>
#include <vector>

#include "render/style.h"

namespace render {

struct Vec2 {
  double x = 0, y = 0;
};

struct Rect {
  double left = 0, top = 0, right = 0, bottom = 0;
  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return bottom - top; }
  [[nodiscard]] Vec2 middle() const { return {(left + right) / 2, (top + bottom) / 2}; }
  [[nodiscard]] Rect grown(double by) const { return {left - by, top - by, right + by, bottom + by}; }
  [[nodiscard]] bool holds(const Rect& r) const {
    return left <= r.left && top <= r.top && right >= r.right && bottom >= r.bottom;
  }
};

struct Stroke {
  Colour colour;
  double width = 1;
  Line line = Line::solid;
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 12;  ///< px
  Anchor anchor = Anchor::start;
  Colour colour{0.1, 0.1, 0.1};
  bool bold = false;
  bool upward = false;  ///< turned to be read from below to above
};

/// Filled shape. `lower` empty: the convex polygon `edge`; else the band between the lines `edge` and `lower`, which
/// have the same x.
struct Fill {
  std::vector<Vec2> edge, lower;
  Colour colour;
  double opacity = 1;
};

struct Path {
  std::vector<Vec2> points;
  Stroke stroke;
};

/// One run of text of one size, at its base line.
struct Run {
  Vec2 at;
  std::string text;
  TextStyle style;
  bool index = false;  ///< an index or exponent, smaller than the text that it belongs to
};

class Paper {
 public:
  using Item = std::variant<Fill, Path, Run>;

  Paper(int width, int height) : width_(width), height_(height) {}

  void polygon(std::vector<Vec2> convex, const Colour& colour, double opacity = 1);
  void rectangle(const Rect& rect, const Colour& colour, double opacity = 1);
  void band(std::vector<Vec2> upper, std::vector<Vec2> lower, const Colour& colour, double opacity);
  void line(std::vector<Vec2> points, const Stroke& stroke);
  void frame(const Rect& rect, const Stroke& stroke);
  /// Lines of a pattern across a rectangle, `gap` apart.
  void hatch(const Rect& rect, Pattern pattern, double gap, const Stroke& stroke);
  /// Hollow: an outline filled with white.
  void marker(Marker marker, const Vec2& at, double size, const Colour& colour, bool hollow = false);
  /// `at` is on the base line. Understands _{...} and ^{...} for text set lower or higher in a smaller size.
  void text(const std::string& text, const Vec2& at, const TextStyle& style);

  /// Another paper's items, moved.
  void append(const Paper& other, const Vec2& by);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const std::vector<Item>& items() const { return items_; }

 private:
  int width_, height_;
  std::vector<Item> items_;
};

/// The pieces of a line inside `window` (Liang & Barsky 1984). Points that are not finite break the line.
std::vector<std::vector<Vec2>> clip(const std::vector<Vec2>& line, const Rect& window);

/// Width of text in px, with its _{...} and ^{...}.
double text_width(const std::string& text, double size, bool bold = false);

/// DejaVu Sans: heights as shares of the size.
constexpr double cap_height = 0.729, descent = 0.236;

/// A complete SVG document; the facts go into <title>, <desc> and <metadata>.
std::string to_svg(const Paper& paper, const Provenance& facts);

}  // namespace render
