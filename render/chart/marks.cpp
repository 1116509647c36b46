// Labelled points and reference lines; labels look for a free place near their point.
#include <array>
#include <cmath>
#include <limits>

#include "render/chart/layout.h"

namespace render {
namespace {

Rect text_box(const Vec2& middle, double width, double size) {
  const double half = cap_height * size / 2 + 2;
  return {middle.x - width / 2 - 2, middle.y - half, middle.x + width / 2 + 2, middle.y + half};
}

/// Where the label of a point covers least: near places first, away from curves, inside the plot.
Vec2 free_place(const ChartLayout& layout, const Occupancy& taken, const Vec2& point, double width, double size) {
  static constexpr std::array<std::array<double, 2>, 8> ways{
      {{0, -1}, {0.8, -0.7}, {-0.8, -0.7}, {1, 0}, {-1, 0}, {0.8, 0.7}, {-0.8, 0.7}, {0, 1}}};
  Vec2 best = point;
  double least = std::numeric_limits<double>::infinity();
  for (double distance : {0.5, 1.2, 2.0, 3.0, 4.2, 5.6})
    for (std::size_t w = 0; w < ways.size(); ++w) {
      const double reach = distance * size;
      const Vec2 middle{point.x + ways[w][0] * (reach + width / 2), point.y + ways[w][1] * (reach + 0.5 * size)};
      const Rect box = text_box(middle, width, size);
      double cost = 8 * taken.taken(box) + 6 * distance + 0.3 * static_cast<double>(w);
      if (!layout.plot.grown(-1).holds(box)) cost += 500;
      if (cost < least) {
        least = cost;
        best = middle;
      }
    }
  return best;
}

/// Text on a veil where it cannot help covering something.
void write_label(Paper& paper, const ChartLayout& layout, const std::string& text, const Vec2& middle,
                 Occupancy& taken) {
  const Rect box = text_box(middle, text_width(text, layout.text), layout.text);
  if (taken.taken({box.left + 1, box.top + 1, box.right - 1, box.bottom - 1}) > 0) paper.rectangle(box, {1, 1, 1}, 0.8);
  paper.text(text, {middle.x, middle.y + cap_height * layout.text / 2},
             {layout.text, Anchor::middle, ink, false, false});
  taken.add(box, 3);
}

/// The point of a box nearest to p.
Vec2 nearest(const Rect& box, const Vec2& p) {
  return {std::min(std::max(p.x, box.left), box.right), std::min(std::max(p.y, box.top), box.bottom)};
}

void draw_point(Paper& paper, const ChartLayout& layout, const Mark& mark, Occupancy& taken) {
  const Vec2 at = layout.at(mark.x, mark.y, mark.side);
  if (!std::isfinite(at.x) || !std::isfinite(at.y) || !layout.plot.grown(0.5).holds({at.x, at.y, at.x, at.y})) return;
  paper.marker(Marker::circle, at, 0.68 * layout.text, {1, 1, 1});
  paper.marker(Marker::circle, at, 0.52 * layout.text, mark.colour);
  if (mark.label.empty()) return;
  const double width = text_width(mark.label, layout.text);
  const Vec2 middle = free_place(layout, taken, at, width, layout.text);
  const Rect box = text_box(middle, width, layout.text);
  const Vec2 end = nearest(box, at);
  const double length = std::hypot(end.x - at.x, end.y - at.y);
  if (length > 1.1 * layout.text) {
    const double start = 0.4 * layout.text / length;
    paper.line({{at.x + start * (end.x - at.x), at.y + start * (end.y - at.y)}, end},
               {{0.35, 0.35, 0.35}, 0.7, Line::solid});
  }
  write_label(paper, layout, mark.label, middle, taken);
  taken.add_line({at, end}, 2);
}

/// The label of a reference line lies beside it, at the freest of some places along it.
void label_line(Paper& paper, const ChartLayout& layout, const Mark& mark, const std::vector<Vec2>& line,
                Occupancy& taken) {
  const double width = text_width(mark.label, layout.text), half = cap_height * layout.text / 2;
  const bool horizontal = mark.kind == Mark::Kind::horizontal;
  Vec2 best;
  double least = std::numeric_limits<double>::infinity();
  double order = 0;
  for (double along : {0.97, 0.03, 0.75, 0.5, 0.25})
    for (double side : {-1.0, 1.0}) {
      Vec2 middle;
      if (horizontal) {
        const double from = layout.plot.left + width / 2 + 4, to = layout.plot.right - width / 2 - 4;
        middle = {from + along * (to - from), line[0].y + side * (half + 4)};
      } else {
        const double from = layout.plot.bottom - half - 6, to = layout.plot.top + half + 8;
        middle = {line[0].x - side * (width / 2 + 5), from + along * (to - from)};
      }
      const Rect box = text_box(middle, width, layout.text);
      double cost = 8 * taken.taken({box.left + 1, box.top + 1, box.right - 1, box.bottom - 1}) + (order += 0.5);
      if (!layout.plot.holds(box)) cost += 500;
      const bool on_ticks = box.left < layout.plot.left + tick_room || box.right > layout.plot.right - tick_room;
      if (!horizontal && on_ticks) cost += 3;
      if (cost < least) {
        least = cost;
        best = middle;
      }
    }
  write_label(paper, layout, mark.label, best, taken);
}

std::vector<std::vector<Vec2>> reference_line(const ChartLayout& layout, const Mark& mark) {
  const Rect& p = layout.plot;
  const bool horizontal = mark.kind == Mark::Kind::horizontal;
  const double value = horizontal ? layout.down(mark.y, mark.side) : layout.across(mark.x);
  return clip(horizontal ? std::vector<Vec2>{{p.left, value}, {p.right, value}}
                         : std::vector<Vec2>{{value, p.bottom}, {value, p.top}},
              p);
}

}  // namespace

void draw_marks(Paper& paper, const ChartLayout& layout, Occupancy& taken) {
  for (const Mark& mark : layout.chart->marks)
    if (mark.kind != Mark::Kind::point)
      for (const auto& piece : reference_line(layout, mark)) paper.line(piece, {mark.colour, 1.1, mark.line});
  for (const Mark& mark : layout.chart->marks)
    if (mark.kind != Mark::Kind::point && !mark.label.empty())
      for (const auto& piece : reference_line(layout, mark)) label_line(paper, layout, mark, piece, taken);
  for (const Mark& mark : layout.chart->marks)
    if (mark.kind == Mark::Kind::point) draw_point(paper, layout, mark, taken);
}

}  // namespace render
