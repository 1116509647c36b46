// Curves, bands, bars and error bars.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/chart/curve.h"
#include "render/chart/layout.h"

namespace render {
namespace {

bool inside(const Rect& r, const Vec2& p) {
  return p.x >= r.left - 0.5 && p.x <= r.right + 0.5 && p.y >= r.top - 0.5 && p.y <= r.bottom + 0.5;
}

void draw_band(Sheet& sheet, const Panel& panel, const Band& band) {
  std::vector<Vec2> upper, lower;
  const auto flush = [&] {
    sheet.band(std::move(upper), std::move(lower), band.colour, 0.28);
    upper.clear();
    lower.clear();
  };
  const Rect& p = panel.plot;
  Vec2 last_high, last_low;
  const auto add = [&](const Vec2& high, const Vec2& low) {
    upper.push_back({high.x, std::clamp(high.y, p.top, p.bottom)});
    lower.push_back({low.x, std::clamp(low.y, p.top, p.bottom)});
  };
  for (std::size_t i = 0; i < band.x.size(); ++i) {
    const Vec2 high = panel.at(band.x[i], band.high[i], band.side), low = panel.at(band.x[i], band.low[i], band.side);
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

void draw_error(Sheet& sheet, const Panel& panel, double x, double low, double high, const Colour& colour) {
  const double cap = 0.25 * panel.text;
  const Stroke stroke{colour, 1, Line::solid};
  for (const auto& line : {std::vector<Vec2>{{x, low}, {x, high}}, std::vector<Vec2>{{x - cap, low}, {x + cap, low}},
                           std::vector<Vec2>{{x - cap, high}, {x + cap, high}}})
    for (auto& piece : clip(line, {panel.plot.left - cap, panel.plot.top, panel.plot.right + cap, panel.plot.bottom}))
      sheet.line(std::move(piece), stroke);
}

void draw_points(Sheet& sheet, const Panel& panel, const Series& series) {
  for (std::size_t i = 0; i < series.y_error.size(); ++i) {
    const Vec2 high = panel.at(series.x[i], series.y[i] + series.y_error[i], series.side);
    Vec2 low = panel.at(series.x[i], series.y[i] - series.y_error[i], series.side);
    if (!std::isfinite(low.y)) low.y = panel.plot.bottom + 10;  // below a log axis
    if (std::isfinite(high.y) && inside({panel.plot.left, -1e9, panel.plot.right, 1e9}, high))
      draw_error(sheet, panel, high.x, low.y, high.y, series.colour);
  }
  const Marker marker = series.marker == Marker::none ? Marker::circle : series.marker;  // a lonely point
  for (const Vec2& p : markers_of(panel, series)) sheet.marker(marker, p, 0.52 * panel.text, series.colour);
}

double luminance(const Colour& c) { return 0.299 * c.red + 0.587 * c.green + 0.114 * c.blue; }

/// Height (px) of a bar's error beyond its end.
double error_height(const Panel& panel, const Bar& bar) {
  const Scale& scale = panel.scale(panel.chart->bars->side);
  if (!(bar.error > 0)) return 0;
  if (!scale.logarithmic) return bar.error / (scale.high - scale.low) * panel.plot.height();
  return (scale.share(bar.value + bar.error) - scale.share(bar.value)) * panel.plot.height();
}

/// Where the value of a grouped bar is printed.
Rect value_box(const Panel& panel, const Bar& bar) {
  const ValueText value = value_text(panel, bar);
  const double wide = value.upward ? cap_height * value.size : value.width;
  const double tall = value.upward ? value.width : cap_height * value.size;
  const double beyond = error_height(panel, bar) + 3, x = bar.rect.middle().x;
  const double top = bar.value < 0 ? bar.rect.bottom + beyond : bar.rect.top - beyond - tall;
  return {x - wide / 2, top, x + wide / 2, top + tall};
}

void print_value(Sheet& sheet, const Panel& panel, const Bar& bar) {
  const Bars& bars = *panel.chart->bars;
  const ValueText value = value_text(panel, bar);
  TextStyle style{value.size, Anchor::middle, ink, false, value.upward};
  if (bars.stacked) {
    const Vec2 middle = bar.rect.middle();
    const double height = cap_height * value.size;
    if (bar.rect.height() < height + 3 || value.width > bar.rect.width() + 8) return;  // no room in this part
    style.colour = luminance(bars.colours[bar.series]) < 0.55 ? Colour{1, 1, 1} : ink;
    style.upward = false;
    sheet.text(value.text, {middle.x, middle.y + height / 2}, style);
    return;
  }
  const Rect box = value_box(panel, bar);
  sheet.text(value.text, value.upward ? Vec2{box.right, box.middle().y} : Vec2{box.middle().x, box.bottom}, style);
}

void draw_bars(Sheet& sheet, const Panel& panel) {
  const Bars& bars = *panel.chart->bars;
  for (const Bar& bar : bars_of(panel)) {
    sheet.rectangle(bar.rect, bars.colours[bar.series]);
    sheet.frame(bar.rect, {ink, 0.6, Line::solid});
    const double end = bar.value < 0 ? bar.rect.bottom : bar.rect.top, half = error_height(panel, bar);
    if (half > 0) draw_error(sheet, panel, bar.rect.middle().x, end + half, end - half, ink);
    if (bars.print_values) print_value(sheet, panel, bar);
  }
  const Scale& scale = panel.scale(bars.side);
  const double zero = panel.down(0, bars.side);
  if (!scale.logarithmic && scale.low < 0 && scale.high > 0)
    sheet.line({{panel.plot.left, zero}, {panel.plot.right, zero}}, {ink, 0.9, Line::solid});
}

}  // namespace

ValueText value_text(const Panel& panel, const Bar& bar) {
  ValueText value;
  value.text = fmt::format(fmt::runtime(panel.chart->bars->value_format), bar.value);
  if (!value.text.empty() && value.text.front() == '-') value.text.replace(0, 1, "\u2212");
  value.size = 0.88 * panel.text;
  value.width = text_width(value.text, value.size);
  value.upward = value.width > 1.25 * bar.rect.width();
  return value;
}

std::vector<Bar> bars_of(const Panel& panel) {
  std::vector<Bar> placed;
  if (!panel.chart->bars) return placed;
  const Bars& bars = *panel.chart->bars;
  const std::size_t count = bars.values.size();
  constexpr double share = 0.76;  // of a category's room
  const double width = bars.stacked ? 0.6 : share / static_cast<double>(std::max<std::size_t>(count, 1));
  const Scale& scale = panel.scale(bars.side);
  const double floor = scale.logarithmic ? scale.low : std::clamp(0.0, scale.low, scale.high);
  const auto height = [&](double v) { return std::clamp(panel.down(v, bars.side), panel.plot.top, panel.plot.bottom); };
  for (std::size_t c = 0; c < bars.categories.size(); ++c) {
    double above = 0, below = 0;
    for (std::size_t s = 0; s < count; ++s) {
      const double value = bars.values[s][c];
      if (!std::isfinite(value) || (scale.logarithmic && value <= 0)) continue;
      const double base = bars.stacked ? (value < 0 ? below : above) : floor;
      const double end = bars.stacked ? base + value : value;
      (value < 0 ? below : above) += value;
      const double left = bars.stacked ? -width / 2 : -share / 2 + static_cast<double>(s) * width;
      const double from = panel.across(static_cast<double>(c) + left),
                   to = from + width * panel.plot.width() / (panel.x.high - panel.x.low);
      const double a = height(scale.logarithmic && base <= 0 ? scale.low : base), b = height(end);
      const double error = bars.errors.empty() || !std::isfinite(bars.errors[s][c]) ? 0 : bars.errors[s][c];
      placed.push_back({{from, std::min(a, b), to, std::max(a, b)}, s, c, value, error});
    }
  }
  return placed;
}

std::vector<std::vector<Vec2>> curve_of(const Panel& panel, const Series& series) {
  if (series.line == Line::none) return {};
  std::vector<Vec2> line;
  line.reserve(series.x.size());
  for (std::size_t i = 0; i < series.x.size(); ++i) line.push_back(panel.at(series.x[i], series.y[i], series.side));
  auto pieces = clip(line, panel.plot);
  for (auto& piece : pieces) piece = simplified(piece);
  return pieces;
}

std::vector<Vec2> markers_of(const Panel& panel, const Series& series) {
  std::vector<Vec2> places;
  const bool lonely = series.x.size() == 1 && series.marker == Marker::none;  // a line of one point would not show
  if (series.marker == Marker::none && !lonely) return places;
  const bool thin = series.line != Line::none && series.x.size() > 60;
  const double spacing = thin ? 2.4 * panel.text : 0.25;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const Vec2 p = panel.at(series.x[i], series.y[i], series.side);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !inside(panel.plot, p)) continue;
    if (!places.empty() && std::hypot(p.x - places.back().x, p.y - places.back().y) < spacing) continue;
    places.push_back(p);
  }
  return places;
}

Occupancy data_occupancy(const Panel& panel, const Sheet& sheet) {
  Occupancy taken(sheet.width(), sheet.height());
  for (const Series& series : panel.chart->series) {
    for (const auto& piece : curve_of(panel, series)) taken.add_line(piece);
    const double half = 0.35 * panel.text;
    for (const Vec2& p : markers_of(panel, series)) taken.add({p.x - half, p.y - half, p.x + half, p.y + half});
    for (std::size_t i = 0; i < series.y_error.size(); ++i) {
      const Vec2 low = panel.at(series.x[i], series.y[i] - series.y_error[i], series.side);
      const Vec2 high = panel.at(series.x[i], series.y[i] + series.y_error[i], series.side);
      for (const auto& piece : clip({low, high}, panel.plot)) taken.add_line(piece);
    }
  }
  for (const Band& band : panel.chart->bands)
    for (std::size_t i = 0; i + 1 < band.x.size(); ++i) {
      const Vec2 a = panel.at(band.x[i], band.high[i], band.side),
                 b = panel.at(band.x[i + 1], band.low[i + 1], band.side);
      if (std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(b.x) && std::isfinite(b.y))
        taken.add(
            {a.x, std::max(panel.plot.top, std::min(a.y, b.y)), b.x, std::min(panel.plot.bottom, std::max(a.y, b.y))},
            0.4);
    }
  for (const Bar& bar : bars_of(panel)) {
    taken.add(bar.rect);
    if (panel.chart->bars->print_values && !panel.chart->bars->stacked) taken.add(value_box(panel, bar));
  }
  for (const Mark& mark : panel.chart->marks) {
    if (mark.kind == Mark::Kind::point) {
      const Vec2 p = panel.at(mark.x, mark.y, mark.side);
      const double half = 0.4 * panel.text;
      if (std::isfinite(p.x) && std::isfinite(p.y)) taken.add({p.x - half, p.y - half, p.x + half, p.y + half}, 3);
    } else if (mark.kind == Mark::Kind::horizontal) {
      const double y = panel.down(mark.y, mark.side);
      for (const auto& piece : clip({{panel.plot.left, y}, {panel.plot.right, y}}, panel.plot))
        taken.add_line(piece, 0.6);
    } else {
      const double x = panel.across(mark.x);
      for (const auto& piece : clip({{x, panel.plot.top}, {x, panel.plot.bottom}}, panel.plot))
        taken.add_line(piece, 0.6);
    }
  }
  return taken;
}

void draw_data(Sheet& sheet, const Panel& panel) {
  for (const Band& band : panel.chart->bands) draw_band(sheet, panel, band);
  if (panel.chart->bars) draw_bars(sheet, panel);
  for (const Series& series : panel.chart->series)
    for (auto& piece : curve_of(panel, series))
      sheet.line(std::move(piece), {series.colour, series.width, series.line});
}

void draw_points(Sheet& sheet, const Panel& panel) {
  for (const Series& series : panel.chart->series) draw_points(sheet, panel, series);
}

}  // namespace render
