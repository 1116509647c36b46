// Frame, ticks, labels, titles and the legend.
#include <algorithm>
#include <cmath>

#include "render/chart/layout.h"

namespace render {
namespace {

constexpr double sample_length = 2.3, sample_gap = 0.5, row_height = 1.45, column_gap = 1.5;  // in text sizes

/// A title along an axis, made smaller when it is longer than `room`, and kept inside from ... to.
struct FittedTitle {
  double size, middle;
};
FittedTitle fitted(const Panel& panel, const std::string& title, double middle, double from, double to) {
  const double width = text_width(title, panel.title_size()), room = to - from - 4;
  const double shrink = std::clamp(room / std::max(width, 1.0), 0.6, 1.0), half = shrink * width / 2 + 2;
  return {shrink * panel.title_size(), std::max(from + half, std::min(middle, to - half))};
}

bool on_axis(const Scale& scale, const Tick& tick) {
  const double share = scale.share(tick.value);
  return share >= -1e-6 && share <= 1 + 1e-6;
}

void draw_x_axis(Sheet& sheet, const Panel& panel, const Stroke& stroke) {
  const Rect& p = panel.plot;
  const TextStyle style{panel.text, Anchor::middle, ink, false, false};
  const double base = p.bottom + label_gap + cap_height * panel.text + 1;
  for (const Tick& tick : panel.x.ticks) {
    if (panel.chart->bars || !on_axis(panel.x, tick)) continue;
    const double x = panel.across(tick.value), length = tick.major ? tick_length : minor_tick_length;
    sheet.line({{x, p.bottom}, {x, p.bottom - length}}, stroke);
    sheet.line({{x, p.top}, {x, p.top + length}}, stroke);
    if (!tick.label.empty()) sheet.text(tick.label, {x, base}, style);
  }
  TextStyle category = style;
  category.size = panel.category_text;
  std::size_t lines = 1;
  for (std::size_t c = 0; c < panel.categories.size(); ++c) {
    lines = std::max(lines, panel.categories[c].size());
    for (std::size_t k = 0; k < panel.categories[c].size(); ++k)
      sheet.text(panel.categories[c][k],
                 {panel.across(static_cast<double>(c)), base + 1.2 * panel.text * static_cast<double>(k)}, category);
  }
  const double below = base + 1.2 * panel.text * static_cast<double>(lines - 1) + 1.6 * panel.title_size();
  TextStyle title = style;
  const FittedTitle fit = fitted(panel, panel.chart->x.title, p.middle().x, panel.area.left, panel.area.right);
  title.size = fit.size;
  if (!panel.chart->x.title.empty()) sheet.text(panel.chart->x.title, {fit.middle, below}, title);
  TextStyle multiplier = style;
  multiplier.anchor = Anchor::end;
  if (!panel.x.multiplier.empty()) sheet.text(panel.x.multiplier, {p.right, below}, multiplier);
}

void draw_y_axis(Sheet& sheet, const Panel& panel, Side side, bool mirrored, const Stroke& stroke) {
  const Rect& p = panel.plot;
  const Scale& scale = panel.scale(side);
  const Axis& axis = side == Side::left ? panel.chart->left : panel.chart->right;
  const double edge = side == Side::left ? p.left : p.right, inward = side == Side::left ? 1 : -1;
  const TextStyle style{panel.text, side == Side::left ? Anchor::end : Anchor::start, ink, false, false};
  double widest = 0;
  for (const Tick& tick : scale.ticks) {
    if (!on_axis(scale, tick)) continue;
    const double y = panel.down(tick.value, side), length = tick.major ? tick_length : minor_tick_length;
    sheet.line({{edge, y}, {edge + inward * length, y}}, stroke);
    if (mirrored) sheet.line({{p.right, y}, {p.right - length, y}}, stroke);
    if (tick.label.empty()) continue;
    sheet.text(tick.label, {edge - inward * label_gap, y + cap_height * panel.text / 2}, style);
    widest = std::max(widest, text_width(tick.label, panel.text));
  }
  const FittedTitle fit = fitted(panel, axis.title, p.middle().y, panel.area.top, panel.area.bottom);
  const TextStyle title{fit.size, Anchor::middle, ink, false, true};
  const double off = label_gap + widest + 0.55 * panel.title_size();
  const double x = side == Side::left ? edge - off : edge + off + cap_height * panel.title_size();
  if (!axis.title.empty()) sheet.text(axis.title, {x, fit.middle}, title);
  TextStyle multiplier = style;
  multiplier.anchor = side == Side::left ? Anchor::start : Anchor::end;
  if (!scale.multiplier.empty()) sheet.text(scale.multiplier, {edge, p.top - 0.5 * panel.text}, multiplier);
}

void draw_sample(Sheet& sheet, const Panel& panel, const LegendEntry& entry, double left, double middle) {
  const double right = left + sample_length * panel.text;
  if (entry.swatch) {
    const double half = 0.42 * panel.text, centre = (left + right) / 2;
    const Rect box{centre - 1.6 * half, middle - half, centre + 1.6 * half, middle + half};
    sheet.rectangle(box, entry.colour, entry.opacity);
    if (entry.opacity >= 1) sheet.frame(box, {ink, 0.6, Line::solid});
    return;
  }
  sheet.line({{left, middle}, {right, middle}}, {entry.colour, entry.width, entry.line});
  sheet.marker(entry.marker, {(left + right) / 2, middle}, 0.52 * panel.text, entry.colour);
}

double entry_width(const Panel& panel, const LegendEntry& entry) {
  return (sample_length + sample_gap) * panel.text + text_width(entry.label, panel.text);
}

bool in_rows(const Panel& panel) { return panel.legend == Chart::Legend::below; }

/// Upper left corners of the entries, relative to the legend's box; rows are as wide as `max_width` at most.
std::vector<Vec2> entry_places(const Panel& panel, const std::vector<LegendEntry>& entries, double max_width) {
  std::vector<Vec2> places;
  Vec2 at;
  double all = 0, widest = 0;
  for (const LegendEntry& entry : entries) {
    all += entry_width(panel, entry) + column_gap * panel.text;
    widest = std::max(widest, entry_width(panel, entry));
  }
  const bool columns = all - column_gap * panel.text > max_width;  // more than one row: entries stand in columns
  for (const LegendEntry& entry : entries) {
    const double width = columns ? widest : entry_width(panel, entry);
    if (in_rows(panel) && at.x > 0 && at.x + width > max_width) at = {0, at.y + row_height * panel.text};
    places.push_back(at);
    if (in_rows(panel))
      at.x += width + column_gap * panel.text;
    else
      at.y += row_height * panel.text;
  }
  return places;
}

}  // namespace

std::vector<LegendEntry> legend_entries(const Chart& chart) {
  std::vector<LegendEntry> entries;
  if (chart.bars)
    for (std::size_t s = 0; s < chart.bars->labels.size(); ++s)
      if (!chart.bars->labels[s].empty())
        entries.push_back({chart.bars->labels[s], chart.bars->colours[s], true, 1, Line::none, 1, Marker::none});
  for (const Series& s : chart.series)
    if (!s.label.empty()) entries.push_back({s.label, s.colour, false, 1, s.line, s.width, s.marker});
  for (const Band& b : chart.bands)
    if (!b.label.empty()) entries.push_back({b.label, b.colour, true, 0.28, Line::none, 1, Marker::none});
  return entries;
}

Vec2 legend_size(const Panel& panel, const std::vector<LegendEntry>& entries, double max_width) {
  if (panel.legend == Chart::Legend::none) return {};
  const auto places = entry_places(panel, entries, max_width);
  Vec2 size;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    size.x = std::max(size.x, places[i].x + entry_width(panel, entries[i]));
    size.y = std::max(size.y, places[i].y + row_height * panel.text);
  }
  return size;
}

void draw_legend(Sheet& sheet, const Panel& panel) {
  if (panel.legend == Chart::Legend::none) return;
  const auto entries = legend_entries(*panel.chart);
  const auto places = entry_places(panel, entries, panel.area.width() - 8);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double left = panel.legend_box.left + places[i].x;
    const double middle = panel.legend_box.top + places[i].y + row_height * panel.text / 2;
    draw_sample(sheet, panel, entries[i], left, middle);
    sheet.text(entries[i].label,
               {left + (sample_length + sample_gap) * panel.text, middle + cap_height * panel.text / 2},
               {panel.text, Anchor::start, ink, false, false});
  }
}

void draw_axes(Sheet& sheet, const Panel& panel) {
  const Stroke stroke{ink, 0.9, Line::solid};
  sheet.frame(panel.plot, stroke);
  draw_x_axis(sheet, panel, stroke);
  draw_y_axis(sheet, panel, Side::left, !panel.has_right, stroke);
  if (panel.has_right) draw_y_axis(sheet, panel, Side::right, false, stroke);
  if (!panel.chart->title.empty())
    sheet.text(panel.chart->title, {panel.plot.left, panel.area.top + 8 + cap_height * panel.title_size()},
               {panel.title_size(), Anchor::start, ink, true, false});
}

}  // namespace render
