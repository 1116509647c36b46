// Frame, ticks, labels, titles and the legend.
#include <algorithm>
#include <cmath>

#include "render/chart/layout.h"

namespace render {
namespace {

constexpr double sample_length = 2.3, sample_gap = 0.5, row_height = 1.45, column_gap = 1.5;  // in text sizes

/// The middle of a title along an axis, kept inside from ... to.
double fitted(const ChartLayout& layout, const std::string& title, double middle, double from, double to) {
  const double half = text_width(title, layout.title_size()) / 2 + 2;
  return std::max(from + half, std::min(middle, to - half));
}

bool on_axis(const Scale& scale, const Tick& tick) {
  const double share = scale.share(tick.value);
  return share >= -1e-6 && share <= 1 + 1e-6;
}

void draw_x_axis(Paper& paper, const ChartLayout& layout, const Stroke& stroke) {
  const Rect& p = layout.plot;
  const TextStyle style{layout.text, Anchor::middle, ink, false, false};
  const double base = p.bottom + label_gap + cap_height * layout.text + 1;
  for (const Tick& tick : layout.x.ticks) {
    if (layout.chart->bars || !on_axis(layout.x, tick)) continue;
    const double x = layout.across(tick.value), length = tick.major ? tick_length : minor_tick_length;
    paper.line({{x, p.bottom}, {x, p.bottom - length}}, stroke);
    paper.line({{x, p.top}, {x, p.top + length}}, stroke);
    if (!tick.label.empty()) paper.text(tick.label, {x, base}, style);
  }
  std::size_t lines = 1;
  for (std::size_t c = 0; c < layout.categories.size(); ++c) {
    lines = std::max(lines, layout.categories[c].size());
    for (std::size_t k = 0; k < layout.categories[c].size(); ++k)
      paper.text(layout.categories[c][k],
                 {layout.across(static_cast<double>(c)), base + 1.2 * layout.text * static_cast<double>(k)}, style);
  }
  const double below = base + 1.2 * layout.text * static_cast<double>(lines - 1) + 1.6 * layout.title_size();
  TextStyle title = style;
  title.size = layout.title_size();
  for (std::size_t k = 0; k < layout.x_title.size(); ++k)
    paper.text(layout.x_title[k],
               {fitted(layout, layout.x_title[k], p.middle().x, layout.area.left, layout.area.right),
                below + 1.2 * title.size * static_cast<double>(k)},
               title);
  TextStyle multiplier = style;
  multiplier.anchor = Anchor::end;
  if (!layout.x.multiplier.empty()) paper.text(layout.x.multiplier, {p.right, below}, multiplier);
}

void draw_y_axis(Paper& paper, const ChartLayout& layout, Side side, bool mirrored, const Stroke& stroke) {
  const Rect& p = layout.plot;
  const Scale& scale = layout.scale(side);
  const std::vector<std::string>& lines = side == Side::left ? layout.left_title : layout.right_title;
  const double edge = side == Side::left ? p.left : p.right, inward = side == Side::left ? 1 : -1;
  const TextStyle style{layout.text, side == Side::left ? Anchor::end : Anchor::start, ink, false, false};
  double widest = 0;
  for (const Tick& tick : scale.ticks) {
    if (!on_axis(scale, tick)) continue;
    const double y = layout.down(tick.value, side), length = tick.major ? tick_length : minor_tick_length;
    paper.line({{edge, y}, {edge + inward * length, y}}, stroke);
    if (mirrored) paper.line({{p.right, y}, {p.right - length, y}}, stroke);
    if (tick.label.empty()) continue;
    paper.text(tick.label, {edge - inward * label_gap, y + cap_height * layout.text / 2}, style);
    widest = std::max(widest, text_width(tick.label, layout.text));
  }
  const TextStyle title{layout.title_size(), Anchor::middle, ink, false, true};
  const double off = label_gap + widest + 0.55 * layout.title_size(), line = 1.2 * layout.title_size();
  const double first = side == Side::left ? edge - off - line * (static_cast<double>(lines.size()) - 1)
                                          : edge + off + cap_height * layout.title_size();
  for (std::size_t k = 0; k < lines.size(); ++k)
    paper.text(lines[k],
               {first + line * static_cast<double>(k),
                fitted(layout, lines[k], p.middle().y, layout.area.top, layout.area.bottom)},
               title);
  TextStyle multiplier = style;
  multiplier.anchor = side == Side::left ? Anchor::start : Anchor::end;
  if (!scale.multiplier.empty()) paper.text(scale.multiplier, {edge, p.top - 0.5 * layout.text}, multiplier);
}

void draw_sample(Paper& paper, const ChartLayout& layout, const LegendKey& key, double left, double middle) {
  const double right = left + sample_length * layout.text;
  if (key.swatch) {
    const double half = 0.42 * layout.text, centre = (left + right) / 2;
    const Rect box{centre - 1.6 * half, middle - half, centre + 1.6 * half, middle + half};
    if (key.pattern == Pattern::none) paper.rectangle(box, key.colour, key.opacity);
    paper.hatch(box, key.pattern, hatch_gap, {key.colour, hatch_width, Line::solid});
    if (key.opacity >= 1) paper.frame(box, {ink, 0.6, Line::solid});
    return;
  }
  paper.line({{left, middle}, {right, middle}}, {key.colour, key.width, key.line});
  paper.marker(key.marker, {(left + right) / 2, middle}, 0.52 * layout.text, key.colour, key.hollow);
}

double key_width(const ChartLayout& layout, const LegendKey& key) {
  return (sample_length + sample_gap) * layout.text + text_width(key.label, layout.text);
}

bool in_rows(const ChartLayout& layout) { return layout.legend == Chart::Legend::below; }

/// Upper left corners of a legend's keys, relative to its box; rows are as wide as `max_width` at most.
std::vector<Vec2> key_places(const ChartLayout& layout, const std::vector<LegendKey>& keys, double max_width) {
  std::vector<Vec2> places;
  Vec2 at;
  double all = 0, widest = 0;
  for (const LegendKey& key : keys) {
    all += key_width(layout, key) + column_gap * layout.text;
    widest = std::max(widest, key_width(layout, key));
  }
  const bool columns = all - column_gap * layout.text > max_width;  // more than one row: keys stand in columns
  for (const LegendKey& key : keys) {
    const double width = columns ? widest : key_width(layout, key);
    if (in_rows(layout) && at.x > 0 && at.x + width > max_width) at = {0, at.y + row_height * layout.text};
    places.push_back(at);
    if (in_rows(layout))
      at.x += width + column_gap * layout.text;
    else
      at.y += row_height * layout.text;
  }
  return places;
}

}  // namespace

std::vector<LegendKey> legend_keys(const ChartLayout& layout) {
  const Chart& chart = *layout.chart;
  std::vector<LegendKey> keys;
  const auto swatch = [&](const std::string& label, const Colour& colour, double opacity, Pattern pattern) {
    keys.push_back({.label = label, .colour = colour, .swatch = true, .opacity = opacity, .pattern = pattern});
  };
  if (chart.bars)
    for (std::size_t s = 0; s < chart.bars->labels.size(); ++s)
      if (!chart.bars->labels[s].empty())
        swatch(chart.bars->labels[s], chart.bars->colours[s], 1,
               s < chart.bars->patterns.size() ? chart.bars->patterns[s] : Pattern::none);
  for (const Series& s : chart.series)
    if (!s.label.empty())
      keys.push_back({.label = s.label,
                      .colour = s.colour,
                      .line = s.line,
                      .width = s.width,
                      .marker = s.marker,
                      .hollow = s.hollow});
  for (std::size_t b = chart.bands.size(); b-- > 0;) {  // from above, as bands are stacked
    const Band& band = chart.bands[b];
    const bool holds_its_own = b < layout.inside.size() && layout.inside[b];
    if (!band.label.empty() && !holds_its_own) swatch(band.label, band.colour, band.opacity, Pattern::none);
  }
  return keys;
}

Vec2 legend_size(const ChartLayout& layout, const std::vector<LegendKey>& keys, double max_width) {
  if (layout.legend == Chart::Legend::none) return {};
  const auto places = key_places(layout, keys, max_width);
  Vec2 size;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    size.x = std::max(size.x, places[i].x + key_width(layout, keys[i]));
    size.y = std::max(size.y, places[i].y + row_height * layout.text);
  }
  return size;
}

void draw_legend(Paper& paper, const ChartLayout& layout) {
  if (layout.legend == Chart::Legend::none) return;
  const auto keys = legend_keys(layout);
  const auto places = key_places(layout, keys, layout.area.width() - 8);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const double left = layout.legend_box.left + places[i].x;
    const double middle = layout.legend_box.top + places[i].y + row_height * layout.text / 2;
    draw_sample(paper, layout, keys[i], left, middle);
    paper.text(keys[i].label,
               {left + (sample_length + sample_gap) * layout.text, middle + cap_height * layout.text / 2},
               {layout.text, Anchor::start, ink, false, false});
  }
}

void draw_axes(Paper& paper, const ChartLayout& layout) {
  const Stroke stroke{ink, 0.9, Line::solid};
  paper.frame(layout.plot, stroke);
  draw_x_axis(paper, layout, stroke);
  draw_y_axis(paper, layout, Side::left, !layout.has_right, stroke);
  if (layout.has_right) draw_y_axis(paper, layout, Side::right, false, stroke);
  if (!layout.chart->title.empty())
    paper.text(layout.chart->title, {layout.plot.left, layout.area.top + 8 + cap_height * layout.title_size()},
               {layout.title_size(), Anchor::start, ink, true, false});
}

}  // namespace render
