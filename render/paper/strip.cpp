#include "render/paper/strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "render/scene/shapes.h"

namespace render {
namespace {

constexpr Colour ink{0.12, 0.12, 0.12};
constexpr double text = 11.6, strip_height = 46, axes_width = 52;

/// An axis that runs along the eye: a ring, with a point where it comes towards it, with a cross where it goes away.
void along_the_eye(Paper& paper, const Vec2& at, bool towards) {
  constexpr double radius = 4.5;
  paper.marker(Marker::circle, at, 2 * radius, ink, true);
  if (towards)
    paper.marker(Marker::circle, at, 3.4, ink);
  else
    paper.marker(Marker::cross, at, 1.2 * radius, ink);
}

/// A label that would lie on an arrow goes to its side.
Vec2 beside(const Vec2& label, const Vec2& from, const Vec2& end) {
  constexpr double room = 8;
  const double length = std::hypot(end.x - from.x, end.y - from.y);
  if (length < 1e-9) return label;
  const double ux = (end.x - from.x) / length, uy = (end.y - from.y) / length;
  const double along = (label.x - from.x) * ux + (label.y - from.y) * uy;
  const double across = (label.y - from.y) * ux - (label.x - from.x) * uy;
  if (along < 0 || along > length || std::abs(across) >= room) return label;
  const double shift = (across < 0 ? -room : room) - across;
  return {label.x - shift * uy, label.y + shift * ux};
}

void draw_axes(Paper& paper, const SceneResult& drawn) {
  static constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
  constexpr double length = 20;
  // Where the three fit into the strip, wherever they point.
  Vec2 low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    low = {std::min(low.x, drawn.right[i]), std::min(low.y, -drawn.up[i])};
    high = {std::max(high.x, drawn.right[i]), std::max(high.y, -drawn.up[i])};
  }
  const Vec2 from{axes_width / 2 - length * (low.x + high.x) / 2, strip_height / 2 - length * (low.y + high.y) / 2};
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = drawn.right[i], y = -drawn.up[i], seen = std::hypot(x, y);
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double towards = drawn.right[j] * drawn.up[k] - drawn.right[k] * drawn.up[j];
    // Beside the ring, on the side that no arrow takes: below it the strip ends.
    Vec2 label{from.x + (drawn.right[j] + drawn.right[k] > 0 ? -11 : 11), from.y};
    if (seen > 0.15) {
      const Vec2 end{from.x + length * x, from.y + length * y};
      const double ux = x / seen, uy = y / seen;
      paper.line({from, {end.x - 3 * ux, end.y - 3 * uy}}, {ink, 1.2, Line::solid});
      paper.polygon({end,
                     {end.x - 6 * ux - 2.6 * uy, end.y - 6 * uy + 2.6 * ux},
                     {end.x - 6 * ux + 2.6 * uy, end.y - 6 * uy - 2.6 * ux}},
                    ink);
      label = {end.x + 6 * ux, end.y + 6 * uy};
      for (const std::size_t other : {j, k}) {
        label = beside(label, from, {from.x + length * drawn.right[other], from.y - length * drawn.up[other]});
      }
    } else {
      along_the_eye(paper, from, towards > 0);
    }
    paper.text(std::string(names[i]), {label.x, label.y + cap_height * text / 2 - 1},
               {text, Anchor::middle, ink, false, false});
  }
}

/// 1, 2 or 5 times a power of ten, so that `length` has `steps` of them at most.
double round_step(double length, int steps) {
  const double power = std::pow(10, std::floor(std::log10(length / steps)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power * steps >= length * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

std::string tick_text(double value, double step) {
  const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  const std::string shown = fmt::format("{:.{}f}", std::abs(value), digits);
  return value < -0.5 * step ? "\u2212" + shown : shown;
}

void draw_bar(Paper& paper, const ColourBar& bar, double left, double right) {
  const double top = 18, bottom = 27;
  const double share = (right - left) / static_cast<double>(std::max<std::size_t>(1, bar.colours.size()));
  for (std::size_t k = 0; k < bar.colours.size(); ++k) {
    const double at = left + share * static_cast<double>(k);
    paper.rectangle({at, top, std::min(right, at + share + 0.4), bottom}, bar.colours[k]);
  }
  paper.frame({left, top, right, bottom}, {ink, 0.7, Line::solid});
  // In the middle of the bar, or as near to it as the picture lets it be whole.
  const double half = text_width(bar.title, text) / 2, middle = (left + right) / 2;
  const double at = std::max(half, std::min(middle, paper.width() - half));
  paper.text(bar.title, {at, 12}, {text, Anchor::middle, ink, false, false});
  if (!(bar.high > bar.low)) return;
  const double step = round_step(bar.high - bar.low, right - left < 130 ? 3 : 6);
  for (double k = std::ceil(bar.low / step - 1e-9); k * step <= bar.high + 1e-9 * step; ++k) {
    const double x = left + (k * step - bar.low) / (bar.high - bar.low) * (right - left);
    paper.line({{x, bottom}, {x, bottom + 3}}, {ink, 0.7, Line::solid});
    paper.text(tick_text(k * step, step), {x, bottom + 5 + cap_height * text},
               {text, Anchor::middle, ink, false, false});
  }
}

}  // namespace

bool has_strip(const Scene& scene) { return scene.axes || scene.bar; }

namespace {

void draw_strip(Paper& paper, const Scene& scene, const SceneResult& drawn) {
  const double width = paper.width();
  if (scene.axes) draw_axes(paper, drawn);
  // The words and the outermost numbers reach over the ends of the bar.
  if (scene.bar) {
    const double left_of_bar = (scene.axes ? axes_width : 0) + 14;
    const double room = width - left_of_bar - 14, length = std::min(room, 300.0);
    const double left = left_of_bar + (room - length) / 2;
    draw_bar(paper, *scene.bar, left, left + length);
  }
}

}  // namespace

Paper strip_of(const Scene& scene, const SceneResult& drawn) {
  const int width = static_cast<int>(std::lround(scene.width / scene.pen()));
  Paper paper(width, static_cast<int>(strip_height));
  paper.rectangle({0, 0, static_cast<double>(width), strip_height}, scene.background);
  draw_strip(paper, scene, drawn);
  return paper;
}

Paper paper_of(const Scene& scene, const SceneResult& drawn) {
  const double pen = scene.pen(), width = scene.width / pen, height = scene.height / pen;
  const double strip = has_strip(scene) ? strip_height : 0;
  Paper paper(static_cast<int>(std::lround(width)), static_cast<int>(std::lround(height + strip)));
  paper.rectangle({0, 0, width, height + strip}, scene.background);
  for (const FlatShape& shape : flat_shapes(scene, fit_view(scene))) {
    std::vector<Vec2> points;
    for (const Point& p : shape.points) points.push_back({width / 2 + p[0] / pen, height / 2 - p[1] / pen});
    std::vector<Vec2> edge = points;
    if (shape.face) {
      edge.push_back(edge.front());
      paper.polygon(std::move(points), shape.colour);
    }
    paper.line(std::move(edge), {shape.face ? shape.edge : shape.colour, shape.width, shape.line});
  }
  if (strip > 0) {
    Paper below(paper.width(), static_cast<int>(strip_height));
    draw_strip(below, scene, drawn);
    paper.append(below, {0, height});
  }
  return paper;
}

}  // namespace render
