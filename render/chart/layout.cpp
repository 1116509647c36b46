// Scales and places.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/chart/layout.h"

namespace render {
namespace {

struct Ranges {
  Range x, left, right;
  bool has_right = false;
  bool marked = false;  ///< points with markers: they should not sit on the frame
  Range& y(Side side) {
    if (side == Side::right) has_right = true;
    return side == Side::left ? left : right;
  }
};

void take(Range& range, const Axis& axis, double value) {
  if (!axis.logarithmic || value > 0) range.take(value);
}

void take_bars(Ranges& ranges, const Chart& chart) {
  const Bars& bars = *chart.bars;
  ranges.x.take(-0.5);
  ranges.x.take(static_cast<double>(bars.categories.size()) - 0.5);
  Range& y = ranges.y(bars.side);
  const Axis& axis = bars.side == Side::left ? chart.left : chart.right;
  if (!axis.logarithmic) y.take(0);
  for (std::size_t c = 0; c < bars.categories.size(); ++c) {
    double above = 0, below = 0;
    for (std::size_t s = 0; s < bars.values.size(); ++s) {
      const double value = bars.values[s][c], error = bars.errors.empty() ? 0 : bars.errors[s][c];
      if (!std::isfinite(value)) continue;
      const double base = bars.stacked ? (value < 0 ? below : above) : 0;
      take(y, axis, base + value);
      if (std::isfinite(error)) {
        take(y, axis, value < 0 ? std::min(base + value + error, 0.0) : base + value + error);
        take(y, axis, value < 0 ? base + value - error : std::max(base + value - error, 0.0));
      }
      (value < 0 ? below : above) += value;
    }
  }
}

Ranges ranges_of(const Chart& chart) {
  Ranges ranges;
  for (const Series& s : chart.series) {
    const Axis& axis = s.side == Side::left ? chart.left : chart.right;
    ranges.marked = ranges.marked || s.marker != Marker::none;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
      take(ranges.x, chart.x, s.x[i]);
      Range& y = ranges.y(s.side);
      take(y, axis, s.y[i]);
      if (s.y_error.empty()) continue;
      take(y, axis, s.y[i] + s.y_error[i]);
      take(y, axis, s.y[i] - s.y_error[i]);
    }
  }
  for (const Band& b : chart.bands) {
    const Axis& axis = b.side == Side::left ? chart.left : chart.right;
    for (std::size_t i = 0; i < b.x.size(); ++i) {
      take(ranges.x, chart.x, b.x[i]);
      take(ranges.y(b.side), axis, b.low[i]);
      take(ranges.y(b.side), axis, b.high[i]);
    }
  }
  if (chart.bars) take_bars(ranges, chart);
  for (const Mark& m : chart.marks) {
    if (m.kind != Mark::Kind::horizontal) take(ranges.x, chart.x, m.x);
    if (m.kind != Mark::Kind::vertical) take(ranges.y(m.side), m.side == Side::left ? chart.left : chart.right, m.y);
  }
  return ranges;
}

/// Height (px) that values printed at the ends of bars need.
double value_room(const ChartLayout& layout) {
  double room = 0;
  for (const Bar& bar : bars_of(layout)) {
    const ValueText value = value_text(layout, bar);
    room = std::max(room, value.upward ? value.width : value.size);
  }
  return room + 0.5 * layout.text;
}

/// A little air beyond the data, more where values are printed at bars, none over stacks (of 100 %).
Range with_air(const ChartLayout& layout, Range range, Side side) {
  const Chart& chart = *layout.chart;
  const Axis& axis = side == Side::left ? chart.left : chart.right;
  if (!range.any || axis.logarithmic) return range;
  double air = 0.02;
  if (chart.bars && chart.bars->side == side && chart.bars->stacked) air = 0;
  if (chart.bars && chart.bars->side == side && !chart.bars->stacked && chart.bars->print_values)
    air = std::min(0.5, value_room(layout) / layout.plot.height());
  const double room = air * (range.high - range.low), low = range.low;
  range.high = range.high <= 0 ? std::min(0.0, range.high + room) : range.high + room;
  range.low = low >= 0 ? std::max(0.0, low - room) : low - room;
  return range;
}

double widest_label(const Scale& scale, double size) {
  double widest = 0;
  for (const Tick& tick : scale.ticks)
    if (!tick.label.empty()) widest = std::max(widest, text_width(tick.label, size));
  return widest;
}

/// Fewer ticks until labels along x stand apart.
Scale x_scale(const Axis& axis, const Range& data, bool tight, double width, double size) {
  for (int wanted = std::clamp(static_cast<int>(width / (4.6 * size)), 2, 10);; --wanted) {
    Scale scale = make_scale(axis, data, wanted, tight);
    double right_end = -1e300;
    bool apart = true;
    for (const Tick& tick : scale.ticks) {
      if (tick.label.empty()) continue;
      const double centre = scale.share(tick.value) * width, half = text_width(tick.label, size) / 2;
      if (centre - half < right_end + 0.6 * size && centre + half > right_end) apart = apart && right_end < -1e200;
      right_end = centre + half;
    }
    if (apart || wanted <= 1 || !axis.ticks.empty()) return scale;
  }
}

void make_scales(ChartLayout& layout, const Ranges& ranges) {
  const Chart& chart = *layout.chart;
  if (chart.bars) {
    layout.x = Scale{};
    layout.x.low = -0.5;
    layout.x.high = std::max(0.5, static_cast<double>(chart.bars->categories.size()) - 0.5);
    layout.categories.clear();
    const double slot = layout.plot.width() / std::max<std::size_t>(1, chart.bars->categories.size());
    for (const auto& name : chart.bars->categories)
      layout.categories.push_back(wrapped(name, 0.94 * slot, layout.text));
  } else {
    Range x = ranges.x;
    const double air = (ranges.marked ? 0.04 : 0.02) * (x.high - x.low);
    layout.x = x_scale(chart.x, x, false, layout.plot.width(), layout.text);
    // A round end of the axis is good; a third of a step of empty paper, or points on the frame, are not.
    const bool loose = layout.x.high - layout.x.low > 1.1 * (x.high - x.low);
    if (x.any && !chart.x.logarithmic && x.high > x.low && (ranges.marked || loose)) {
      if (x.low > air || x.low < 0) x.low -= air;
      if (x.high > 0 || x.high < -air) x.high += air;
      layout.x = x_scale(chart.x, x, true, layout.plot.width(), layout.text);
    }
  }
  const int wanted = std::clamp(static_cast<int>(layout.plot.height() / (3.4 * layout.text)), 2, 8);
  const auto ticks = [&](const Axis& axis) { return axis.logarithmic ? 2 * wanted : wanted; };  // powers are short
  layout.left = make_scale(chart.left, with_air(layout, ranges.left, Side::left), ticks(chart.left), false);
  layout.right = make_scale(chart.right, with_air(layout, ranges.right, Side::right), ticks(chart.right), false);
}

/// Room left, top, right and bottom of the plot for labels and titles (without legend).
Rect margins(const ChartLayout& layout) {
  const Chart& chart = *layout.chart;
  const double text = layout.text, title = layout.title_size();
  const auto side = [&](const Scale& scale, const std::vector<std::string>& lines) {
    double room = 4 + widest_label(scale, text) + label_gap;
    if (!lines.empty()) room += (0.25 + 1.2 * static_cast<double>(lines.size())) * title;
    return room;
  };
  Rect m;
  m.left = side(layout.left, layout.left_title);
  m.right = layout.has_right ? side(layout.right, layout.right_title) : 8;
  m.top = 8;
  if (!layout.left.multiplier.empty() || (layout.has_right && !layout.right.multiplier.empty())) m.top += 1.2 * text;
  if (!chart.title.empty()) m.top += 1.9 * title;
  std::size_t lines = 1;
  for (const auto& name : layout.categories) lines = std::max(lines, name.size());
  m.bottom = 6 + label_gap + (0.8 + 1.2 * static_cast<double>(lines - 1)) * text;
  if (!layout.x_title.empty() || !layout.x.multiplier.empty())
    m.bottom += (0.4 + 1.2 * static_cast<double>(std::max<std::size_t>(1, layout.x_title.size()))) * title;
  for (const Tick& tick : layout.x.ticks) {  // labels at the ends of the x axis reach over it
    const double half = text_width(tick.label, text) / 2 + 2;
    m.left = std::max(m.left, half - layout.x.share(tick.value) * layout.plot.width());
    m.right = std::max(m.right, half - (1 - layout.x.share(tick.value)) * layout.plot.width());
  }
  return m;
}

void place_legend(ChartLayout& layout, const Vec2& size) {
  const double gap = 0.7 * layout.text;
  const Rect& p = layout.plot;
  switch (layout.legend) {
    case Chart::Legend::none:
      break;
    case Chart::Legend::top_left:
      layout.legend_box = {p.left + gap, p.top + gap, p.left + gap + size.x, p.top + gap + size.y};
      break;
    case Chart::Legend::top_right:
      layout.legend_box = {p.right - gap - size.x, p.top + gap, p.right - gap, p.top + gap + size.y};
      break;
    case Chart::Legend::bottom_left:
      layout.legend_box = {p.left + gap, p.bottom - gap - size.y, p.left + gap + size.x, p.bottom - gap};
      break;
    case Chart::Legend::bottom_right:
      layout.legend_box = {p.right - gap - size.x, p.bottom - gap - size.y, p.right - gap, p.bottom - gap};
      break;
    case Chart::Legend::outside_right:
      layout.legend_box = {layout.area.right - size.x - 4, p.top, layout.area.right - 4, p.top + size.y};
      break;
    case Chart::Legend::below: {
      const double left =
          std::max(layout.area.left + 4, std::min(p.middle().x - size.x / 2, layout.area.right - 4 - size.x));
      layout.legend_box = {left, layout.area.bottom - size.y - 4, left + size.x, layout.area.bottom - 4};
      break;
    }
  }
}

}  // namespace

std::vector<std::string> wrapped(const std::string& text, double width, double size) {
  std::vector<std::string> lines(1);
  std::string word;
  const auto flush = [&] {
    if (word.empty()) return;
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || text_width(longer, size) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
    word.clear();
  };
  for (char c : text) {
    if (c == ' ' || c == '\n') flush();
    if (c == '\n') lines.emplace_back();
    if (c != ' ' && c != '\n') word += c;
  }
  flush();
  return lines;
}

ChartLayout lay_out(const Chart& chart, const Rect& area, double text, Chart::Legend legend) {
  Ranges ranges = ranges_of(chart);
  ChartLayout layout;
  layout.chart = &chart;
  layout.area = area;
  layout.text = text;
  layout.has_right = ranges.has_right;
  layout.inside.resize(chart.bands.size());
  layout.plot = {area.left + 4 * text, area.top + text, area.right - text, area.bottom - 3.5 * text};
  const auto lines = [&](const std::string& title, double room) {
    return title.empty() ? std::vector<std::string>{} : wrapped(title, room - 4, layout.title_size());
  };
  layout.x_title = lines(chart.x.title, area.width());
  Vec2 size;
  constexpr int passes = 3;
  // Ticks depend on the plot's size, the plot on the ticks' labels and on the legend, and that on which bands hold theirs.
  for (int pass = 0; pass < passes; ++pass) {
    layout.left_title = lines(chart.left.title, layout.plot.bottom - area.top);
    layout.right_title = lines(chart.right.title, layout.plot.bottom - area.top);
    make_scales(layout, ranges);
    const auto keys = legend_keys(layout);
    layout.legend = keys.empty() ? Chart::Legend::none : legend;
    const Rect m = margins(layout);
    size = legend_size(layout, keys, area.width() - 8);
    layout.plot = {area.left + m.left, area.top + m.top, area.right - m.right, area.bottom - m.bottom};
    if (layout.legend == Chart::Legend::below) layout.plot.bottom -= size.y + 0.5 * text;
    if (layout.legend == Chart::Legend::outside_right) layout.plot.right -= size.x + text;
    layout.plot.right = std::max(layout.plot.right, layout.plot.left + 20);
    layout.plot.bottom = std::max(layout.plot.bottom, layout.plot.top + 20);
    for (std::size_t b = 0; b < chart.bands.size(); ++b) {
      const bool may = chart.bands[b].inside && !chart.bands[b].label.empty() && (pass == 0 || layout.inside[b]);
      const std::optional<Vec2> place = may ? place_inside(layout, chart.bands[b]) : std::nullopt;
      if (pass < passes - 1 || place) layout.inside[b] = place;  // a bigger plot has room where a smaller one had
    }
  }
  place_legend(layout, size);
  return layout;
}

Provenance extents(const Chart& chart) {
  const Ranges ranges = ranges_of(chart);
  Provenance facts;
  const auto add = [&facts](const char* name, const Range& range) {
    if (range.any) facts.emplace_back(name, fmt::format("{:.6g} to {:.6g}", range.low, range.high));
  };
  if (!chart.bars) add("Extent x", ranges.x);
  add("Extent left", ranges.left);
  add("Extent right", ranges.right);
  return facts;
}

}  // namespace render
