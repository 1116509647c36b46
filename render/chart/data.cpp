// Curves, bands, bars and error bars.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/chart/curve.h"
#include "render/chart/layout.h"
#include "render/colour.h"

namespace render {
namespace {

bool inside(const Rect& r, const Vec2& p) {
  return p.x >= r.left - 0.5 && p.x <= r.right + 0.5 && p.y >= r.top - 0.5 && p.y <= r.bottom + 0.5;
}

void draw_band(Paper& paper, const ChartLayout& layout, const Band& band) {
  std::vector<Vec2> upper, lower;
  const auto flush = [&] {
    std::vector<Vec2> edge = upper;
    paper.band(std::move(upper), std::move(lower), band.colour, band.opacity);
    if (band.outlined) paper.line(std::move(edge), {ink, 0.6, Line::solid});
    upper.clear();
    lower.clear();
  };
  const Rect& p = layout.plot;
  Vec2 last_high, last_low;
  const auto add = [&](const Vec2& high, const Vec2& low) {
    upper.push_back({high.x, std::clamp(high.y, p.top, p.bottom)});
    lower.push_back({low.x, std::clamp(low.y, p.top, p.bottom)});
  };
  for (std::size_t i = 0; i < band.x.size(); ++i) {
    const Vec2 high = layout.at(band.x[i], band.high[i], band.side), low = layout.at(band.x[i], band.low[i], band.side);
    if (!std::isfinite(high.x) || !std::isfinite(high.y) || !std::isfinite(low.y)) {
      flush();
      last_high = {std::numeric_limits<double>::quiet_NaN(), 0};
      continue;
    }
    if (i > 0 && std::isfinite(last_high.x) && high.x > last_high.x) {
      // Corners where an edge crosses the frame, so that clamping keeps its slope inside.
      std::vector<double> cuts;
      for (double t :
           {(p.left - last_high.x) / (high.x - last_high.x), (p.right - last_high.x) / (high.x - last_high.x)})
        cuts.push_back(t);
      for (double y : {p.top, p.bottom}) {
        cuts.push_back((y - last_high.y) / (high.y - last_high.y));
        cuts.push_back((y - last_low.y) / (low.y - last_low.y));
      }
      std::sort(cuts.begin(), cuts.end());
      for (double t : cuts) {
        if (!(t > 0 && t < 1)) continue;
        const double x = last_high.x + t * (high.x - last_high.x);
        if (x >= p.left - 1e-9 && x <= p.right + 1e-9)
          add({x, last_high.y + t * (high.y - last_high.y)}, {x, last_low.y + t * (low.y - last_low.y)});
      }
    }
    if (high.x >= p.left - 1e-9 && high.x <= p.right + 1e-9) add(high, low);
    last_high = high;
    last_low = low;
  }
  flush();
}

void draw_error(Paper& paper, const ChartLayout& layout, double x, double low, double high, const Colour& colour) {
  const double cap = 0.25 * layout.text;
  const Stroke stroke{colour, 1, Line::solid};
  for (const auto& line : {std::vector<Vec2>{{x, low}, {x, high}}, std::vector<Vec2>{{x - cap, low}, {x + cap, low}},
                           std::vector<Vec2>{{x - cap, high}, {x + cap, high}}})
    for (auto& piece :
         clip(line, {layout.plot.left - cap, layout.plot.top, layout.plot.right + cap, layout.plot.bottom}))
      paper.line(std::move(piece), stroke);
}

void draw_points(Paper& paper, const ChartLayout& layout, const Series& series) {
  for (std::size_t i = 0; i < series.y_error.size(); ++i) {
    const Vec2 high = layout.at(series.x[i], series.y[i] + series.y_error[i], series.side);
    Vec2 low = layout.at(series.x[i], series.y[i] - series.y_error[i], series.side);
    if (!std::isfinite(low.y)) low.y = layout.plot.bottom + 10;  // below a log axis
    if (std::isfinite(high.y) && inside({layout.plot.left, -1e9, layout.plot.right, 1e9}, high))
      draw_error(paper, layout, high.x, low.y, high.y, series.colour);
  }
  const Marker marker = series.marker == Marker::none ? Marker::circle : series.marker;  // a lonely point
  for (const Vec2& p : markers_of(layout, series))
    paper.marker(marker, p, 0.52 * layout.text, series.colour, series.hollow);
}

/// Black or white, whichever is read better on a ground.
Colour ink_on(const Colour& ground) {
  return contrast(ground, ink) >= contrast(ground, {1, 1, 1}) ? ink : Colour{1, 1, 1};
}

void label_bands(Paper& paper, const ChartLayout& layout) {
  for (std::size_t b = 0; b < layout.inside.size(); ++b) {
    if (!layout.inside[b]) continue;
    const Band& band = layout.chart->bands[b];
    const Vec2& at = *layout.inside[b];
    paper.text(band.label, {at.x, at.y + cap_height * layout.text / 2},
               {layout.text, Anchor::middle, ink_on(band.colour), false, false});
  }
}

/// Height (px) of a bar's error beyond its end.
double error_height(const ChartLayout& layout, const Bar& bar) {
  const Scale& scale = layout.scale(layout.chart->bars->side);
  if (!(bar.error > 0)) return 0;
  if (!scale.logarithmic) return bar.error / (scale.high - scale.low) * layout.plot.height();
  return (scale.share(bar.value + bar.error) - scale.share(bar.value)) * layout.plot.height();
}

/// Where the value of a grouped bar is printed.
Rect value_box(const ChartLayout& layout, const Bar& bar) {
  const ValueText value = value_text(layout, bar);
  const double wide = value.upward ? cap_height * value.size : value.width;
  const double tall = value.upward ? value.width : cap_height * value.size;
  const double beyond = error_height(layout, bar) + 3, x = bar.rect.middle().x;
  const double top = bar.value < 0 ? bar.rect.bottom + beyond : bar.rect.top - beyond - tall;
  return {x - wide / 2, top, x + wide / 2, top + tall};
}

void print_value(Paper& paper, const ChartLayout& layout, const Bar& bar) {
  const Bars& bars = *layout.chart->bars;
  const ValueText value = value_text(layout, bar);
  TextStyle style{value.size, Anchor::middle, ink, false, value.upward};
  if (bars.stacked) {
    const Vec2 middle = bar.rect.middle();
    const double height = cap_height * value.size;
    if (bar.rect.height() < height + 3 || value.width > bar.rect.width() + 8) return;  // no room in this part
    style.colour = ink_on(bars.colours[bar.series]);
    style.upward = false;
    paper.text(value.text, {middle.x, middle.y + height / 2}, style);
    return;
  }
  const Rect box = value_box(layout, bar);
  paper.text(value.text, value.upward ? Vec2{box.right, box.middle().y} : Vec2{box.middle().x, box.bottom}, style);
}

void draw_bars(Paper& paper, const ChartLayout& layout) {
  const Bars& bars = *layout.chart->bars;
  for (const Bar& bar : bars_of(layout)) {
    const Pattern pattern = bar.series < bars.patterns.size() ? bars.patterns[bar.series] : Pattern::none;
    paper.rectangle(bar.rect, pattern == Pattern::none ? bars.colours[bar.series] : Colour{1, 1, 1});
    paper.hatch(bar.rect, pattern, hatch_gap, {bars.colours[bar.series], hatch_width, Line::solid});
    paper.frame(bar.rect, {ink, 0.6, Line::solid});
    const double end = bar.value < 0 ? bar.rect.bottom : bar.rect.top, half = error_height(layout, bar);
    if (half > 0) draw_error(paper, layout, bar.rect.middle().x, end + half, end - half, ink);
    if (bars.print_values) print_value(paper, layout, bar);
  }
  const Scale& scale = layout.scale(bars.side);
  const double zero = layout.down(0, bars.side);
  if (!scale.logarithmic && scale.low < 0 && scale.high > 0)
    paper.line({{layout.plot.left, zero}, {layout.plot.right, zero}}, {ink, 0.9, Line::solid});
}

std::string printed(const Bars& bars, double value) {
  std::string text = with_thousands(fmt::format(fmt::runtime(bars.value_format), std::abs(value)));
  return value < 0 && text.find_first_of("123456789") != std::string::npos ? "\u2212" + text : text;
}

}  // namespace

ValueText value_text(const ChartLayout& layout, const Bar& bar) {
  ValueText value;
  value.text = printed(*layout.chart->bars, bar.value);
  value.size = layout.text;
  value.width = text_width(value.text, value.size);
  // Values of neighbours do not touch: with one that is wider than its bar, all stand upright.
  const Bars& bars = *layout.chart->bars;
  const bool alone = bars.stacked || bars.values.size() == 1;
  const auto widest = [&] {
    double width = value.width;
    for (const auto& series : bars.values) {
      for (const double one : series) {
        if (std::isfinite(one)) width = std::max(width, text_width(printed(bars, one), value.size));
      }
    }
    return width + 3;
  };
  value.upward = alone ? value.width > 1.25 * bar.rect.width() : widest() > bar.rect.width();
  return value;
}

std::optional<Vec2> place_inside(const ChartLayout& layout, const Band& band) {
  const double width = text_width(band.label, layout.text) + 6;
  // Where most room is, off the vertical lines if any place is.
  std::optional<Vec2> best, crossed_best;
  double most = 1.25 * layout.text, crossed_most = most;  // the least room
  const auto is_crossed = [&](double from, double to) {
    return std::ranges::any_of(layout.chart->marks, [&](const Mark& mark) {
      const double x = layout.across(mark.x);
      return mark.kind == Mark::Kind::vertical && x > from && x < to;
    });
  };
  for (double left = layout.plot.left + tick_room; left + width <= layout.plot.right - tick_room; left += 4) {
    const double right = left + width;
    if (band.x.empty() || layout.across(band.x.front()) > left) continue;
    double top = layout.plot.top, bottom = layout.plot.bottom;
    bool reached = false;
    // Edges are straight between their points: they are nearest at those, and where the label begins and ends.
    for (std::size_t i = 0; i + 1 < band.x.size() && !reached; ++i) {
      const Vec2 a = layout.at(band.x[i], band.high[i], band.side),
                 b = layout.at(band.x[i + 1], band.high[i + 1], band.side);
      if (b.x < left || !(b.x > a.x)) continue;
      const double low_a = layout.down(band.low[i], band.side), low_b = layout.down(band.low[i + 1], band.side);
      for (const double x : {std::max(a.x, left), std::min(b.x, right)}) {
        const double t = (x - a.x) / (b.x - a.x);
        top = std::max(top, a.y + t * (b.y - a.y));
        bottom = std::min(bottom, low_a + t * (low_b - low_a));
      }
      reached = b.x >= right;
    }
    if (!reached) continue;
    const Vec2 middle{left + width / 2, (top + bottom) / 2};
    if (bottom - top > most && !is_crossed(left, right)) {
      most = bottom - top;
      best = middle;
    }
    if (bottom - top > crossed_most) {
      crossed_most = bottom - top;
      crossed_best = middle;
    }
  }
  return best ? best : crossed_best;
}

std::vector<Bar> bars_of(const ChartLayout& layout) {
  std::vector<Bar> placed;
  if (!layout.chart->bars) return placed;
  const Bars& bars = *layout.chart->bars;
  const std::size_t count = bars.values.size();
  constexpr double share = 0.76;  // of a category's room
  const double width = bars.stacked ? 0.6 : share / static_cast<double>(std::max<std::size_t>(count, 1));
  const Scale& scale = layout.scale(bars.side);
  const double floor = scale.logarithmic ? scale.low : std::clamp(0.0, scale.low, scale.high);
  const auto height = [&](double v) {
    return std::clamp(layout.down(v, bars.side), layout.plot.top, layout.plot.bottom);
  };
  for (std::size_t c = 0; c < bars.categories.size(); ++c) {
    double above = 0, below = 0;
    for (std::size_t s = 0; s < count; ++s) {
      const double value = bars.values[s][c];
      if (!std::isfinite(value) || (scale.logarithmic && value <= 0)) continue;
      const double base = bars.stacked ? (value < 0 ? below : above) : floor;
      const double end = bars.stacked ? base + value : value;
      (value < 0 ? below : above) += value;
      const double left = bars.stacked ? -width / 2 : -share / 2 + static_cast<double>(s) * width;
      const double from = layout.across(static_cast<double>(c) + left),
                   to = from + width * layout.plot.width() / (layout.x.high - layout.x.low);
      const double a = height(scale.logarithmic && base <= 0 ? scale.low : base), b = height(end);
      const double error = bars.errors.empty() || !std::isfinite(bars.errors[s][c]) ? 0 : bars.errors[s][c];
      placed.push_back({{from, std::min(a, b), to, std::max(a, b)}, s, c, value, error});
    }
  }
  return placed;
}

std::vector<std::vector<Vec2>> curve_of(const ChartLayout& layout, const Series& series) {
  if (series.line == Line::none) return {};
  std::vector<Vec2> line;
  line.reserve(series.x.size());
  for (std::size_t i = 0; i < series.x.size(); ++i) line.push_back(layout.at(series.x[i], series.y[i], series.side));
  auto pieces = clip(line, layout.plot);
  for (auto& piece : pieces) piece = simplified(piece);
  return pieces;
}

std::vector<Vec2> markers_of(const ChartLayout& layout, const Series& series) {
  std::vector<Vec2> places;
  const bool lonely = series.x.size() == 1 && series.marker == Marker::none;  // a line of one point would not show
  if (series.marker == Marker::none && !lonely) return places;
  const bool thin = series.line != Line::none && series.x.size() > 60;
  const double spacing = thin ? 2.4 * layout.text : 0.25;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const Vec2 p = layout.at(series.x[i], series.y[i], series.side);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !inside(layout.plot, p)) continue;
    if (!places.empty() && std::hypot(p.x - places.back().x, p.y - places.back().y) < spacing) continue;
    places.push_back(p);
  }
  return places;
}

Occupancy data_occupancy(const ChartLayout& layout, const Paper& paper) {
  Occupancy taken(paper.width(), paper.height());
  for (const Series& series : layout.chart->series) {
    for (const auto& piece : curve_of(layout, series)) taken.add_line(piece);
    const double half = 0.35 * layout.text;
    for (const Vec2& p : markers_of(layout, series)) taken.add({p.x - half, p.y - half, p.x + half, p.y + half});
    for (std::size_t i = 0; i < series.y_error.size(); ++i) {
      const Vec2 low = layout.at(series.x[i], series.y[i] - series.y_error[i], series.side);
      const Vec2 high = layout.at(series.x[i], series.y[i] + series.y_error[i], series.side);
      for (const auto& piece : clip({low, high}, layout.plot)) taken.add_line(piece);
    }
  }
  for (const Band& band : layout.chart->bands)
    for (std::size_t i = 0; i + 1 < band.x.size(); ++i) {
      const Vec2 a = layout.at(band.x[i], band.high[i], band.side),
                 b = layout.at(band.x[i + 1], band.low[i + 1], band.side);
      if (std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(b.x) && std::isfinite(b.y))
        taken.add(
            {a.x, std::max(layout.plot.top, std::min(a.y, b.y)), b.x, std::min(layout.plot.bottom, std::max(a.y, b.y))},
            0.4);
    }
  for (const Bar& bar : bars_of(layout)) {
    taken.add(bar.rect);
    if (layout.chart->bars->print_values && !layout.chart->bars->stacked) taken.add(value_box(layout, bar));
  }
  for (const Mark& mark : layout.chart->marks) {
    if (mark.kind == Mark::Kind::point) {
      const Vec2 p = layout.at(mark.x, mark.y, mark.side);
      const double half = 0.4 * layout.text;
      if (std::isfinite(p.x) && std::isfinite(p.y)) taken.add({p.x - half, p.y - half, p.x + half, p.y + half}, 3);
    } else if (mark.kind == Mark::Kind::horizontal) {
      const double y = layout.down(mark.y, mark.side);
      for (const auto& piece : clip({{layout.plot.left, y}, {layout.plot.right, y}}, layout.plot))
        taken.add_line(piece, 0.6);
    } else {
      const double x = layout.across(mark.x);
      for (const auto& piece : clip({{x, layout.plot.top}, {x, layout.plot.bottom}}, layout.plot))
        taken.add_line(piece, 0.6);
    }
  }
  return taken;
}

void draw_data(Paper& paper, const ChartLayout& layout) {
  for (const Band& band : layout.chart->bands) draw_band(paper, layout, band);
  label_bands(paper, layout);
  if (layout.chart->bars) draw_bars(paper, layout);
  for (const Series& series : layout.chart->series)
    for (auto& piece : curve_of(layout, series))
      paper.line(std::move(piece), {series.colour, series.width, series.line});
}

void draw_points(Paper& paper, const ChartLayout& layout) {
  for (const Series& series : layout.chart->series) draw_points(paper, layout, series);
}

}  // namespace render
