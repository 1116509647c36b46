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
Vec2 free_place(const Panel& panel, const Occupancy& taken, const Vec2& point, double width, double size) {
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
      if (!panel.plot.grown(-1).holds(box)) cost += 500;
      if (cost < least) {
        least = cost;
        best = middle;
      }
    }
  return best;
}

/// Text on a veil where it cannot help covering something.
void write_label(Sheet& sheet, const Panel& panel, const std::string& text, const Vec2& middle, Occupancy& taken) {
  const Rect box = text_box(middle, text_width(text, panel.text), panel.text);
  if (taken.taken({box.left + 1, box.top + 1, box.right - 1, box.bottom - 1}) > 0) sheet.rectangle(box, {1, 1, 1}, 0.8);
  sheet.text(text, {middle.x, middle.y + cap_height * panel.text / 2}, {panel.text, Anchor::middle, ink, false, false});
  taken.add(box, 3);
}

/// The point of a box nearest to p.
Vec2 nearest(const Rect& box, const Vec2& p) {
  return {std::min(std::max(p.x, box.left), box.right), std::min(std::max(p.y, box.top), box.bottom)};
}

void draw_point(Sheet& sheet, const Panel& panel, const Mark& mark, Occupancy& taken) {
  const Vec2 at = panel.at(mark.x, mark.y, mark.side);
  if (!std::isfinite(at.x) || !std::isfinite(at.y) || !panel.plot.grown(0.5).holds({at.x, at.y, at.x, at.y})) return;
  sheet.marker(Marker::circle, at, 0.68 * panel.text, {1, 1, 1});
  sheet.marker(Marker::circle, at, 0.52 * panel.text, mark.colour);
  if (mark.label.empty()) return;
  const double width = text_width(mark.label, panel.text);
  const Vec2 middle = free_place(panel, taken, at, width, panel.text);
  const Rect box = text_box(middle, width, panel.text);
  const Vec2 end = nearest(box, at);
  const double length = std::hypot(end.x - at.x, end.y - at.y);
  if (length > 1.1 * panel.text) {
    const double start = 0.4 * panel.text / length;
    sheet.line({{at.x + start * (end.x - at.x), at.y + start * (end.y - at.y)}, end},
               {{0.35, 0.35, 0.35}, 0.7, Line::solid});
  }
  write_label(sheet, panel, mark.label, middle, taken);
  taken.add_line({at, end}, 2);
}

/// The label of a reference line lies beside it, at the freest of some places along it.
void label_line(Sheet& sheet, const Panel& panel, const Mark& mark, const std::vector<Vec2>& line, Occupancy& taken) {
  const double width = text_width(mark.label, panel.text), half = cap_height * panel.text / 2;
  const bool horizontal = mark.kind == Mark::Kind::horizontal;
  Vec2 best;
  double least = std::numeric_limits<double>::infinity();
  double order = 0;
  for (double along : {0.97, 0.03, 0.75, 0.5, 0.25})
    for (double side : {-1.0, 1.0}) {
      Vec2 middle;
      if (horizontal) {
        const double from = panel.plot.left + width / 2 + 4, to = panel.plot.right - width / 2 - 4;
        middle = {from + along * (to - from), line[0].y + side * (half + 4)};
      } else {
        const double from = panel.plot.bottom - half - 6, to = panel.plot.top + half + 8;
        middle = {line[0].x - side * (width / 2 + 5), from + along * (to - from)};
      }
      const Rect box = text_box(middle, width, panel.text);
      double cost = 8 * taken.taken({box.left + 1, box.top + 1, box.right - 1, box.bottom - 1}) + (order += 0.5);
      if (!panel.plot.holds(box)) cost += 500;
      if (cost < least) {
        least = cost;
        best = middle;
      }
    }
  write_label(sheet, panel, mark.label, best, taken);
}

std::vector<std::vector<Vec2>> reference_line(const Panel& panel, const Mark& mark) {
  const Rect& p = panel.plot;
  const bool horizontal = mark.kind == Mark::Kind::horizontal;
  const double value = horizontal ? panel.down(mark.y, mark.side) : panel.across(mark.x);
  return clip(horizontal ? std::vector<Vec2>{{p.left, value}, {p.right, value}}
                         : std::vector<Vec2>{{value, p.bottom}, {value, p.top}},
              p);
}

}  // namespace

void draw_marks(Sheet& sheet, const Panel& panel, Occupancy& taken) {
  for (const Mark& mark : panel.chart->marks)
    if (mark.kind != Mark::Kind::point)
      for (const auto& piece : reference_line(panel, mark)) sheet.line(piece, {mark.colour, 1.1, mark.line});
  for (const Mark& mark : panel.chart->marks)
    if (mark.kind != Mark::Kind::point && !mark.label.empty())
      for (const auto& piece : reference_line(panel, mark)) label_line(sheet, panel, mark, piece, taken);
  for (const Mark& mark : panel.chart->marks)
    if (mark.kind == Mark::Kind::point) draw_point(sheet, panel, mark, taken);
}

}  // namespace render
