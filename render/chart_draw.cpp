// A chart from its parts, in the order of painting.
#include <array>
#include <stdexcept>

#include "render/chart_panel.h"

namespace render {
namespace {

void check(const Chart& chart) {
  const auto need = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(std::string("chart: ") + what);
  };
  need(chart.width >= 40 && chart.height >= 40, "the picture is smaller than 40 x 40 px");
  for (const Series& s : chart.series) {
    need(s.x.size() == s.y.size(), "a series has unequal numbers of x and y");
    need(s.y_error.empty() || s.y_error.size() == s.y.size(), "a series needs an error for each value, or none");
  }
  for (const Band& b : chart.bands)
    need(b.x.size() == b.low.size() && b.x.size() == b.high.size(), "a band has unequal numbers of x, low and high");
  if (chart.bars) {
    const Bars& bars = *chart.bars;
    need(bars.colours.size() >= bars.values.size(), "bars need a colour for each series");
    need(bars.labels.size() <= bars.values.size(), "bars have more labels than series");
    need(bars.errors.empty() || bars.errors.size() == bars.values.size(), "bars need errors for each series, or none");
    for (const auto* rows : {&bars.values, &bars.errors})
      for (const auto& row : *rows)
        need(row.size() == bars.categories.size(), "bars need a value for each category (NaN where there is none)");
  }
  for (const Inset& inset : chart.insets) {
    need(inset.chart.size() == 1, "an inset holds exactly one chart");
    check(inset.chart[0]);
  }
}

bool in_a_corner(Chart::Legend legend) {
  return legend == Chart::Legend::top_left || legend == Chart::Legend::top_right ||
         legend == Chart::Legend::bottom_left || legend == Chart::Legend::bottom_right;
}

/// The layout with the legend where it was asked for, or in another corner, or below: where it covers no data.
Panel with_free_legend(const Sheet& sheet, const Chart& chart, const Rect& area, double text) {
  Panel panel = lay_out(chart, area, text, chart.legend);
  if (!in_a_corner(panel.legend)) return panel;
  const Occupancy taken = data_occupancy(panel, sheet);
  using enum Chart::Legend;
  for (Chart::Legend corner : {chart.legend, top_left, top_right, bottom_right, bottom_left}) {
    panel = lay_out(chart, area, text, corner);
    if (panel.plot.holds(panel.legend_box) && taken.taken(panel.legend_box.grown(3)) == 0) return panel;
  }
  return lay_out(chart, area, text, below);
}

}  // namespace

void draw_chart(Sheet& sheet, const Chart& chart, const Rect& area, double text) {
  const Panel panel = with_free_legend(sheet, chart, area, text);
  draw_data(sheet, panel);
  Occupancy taken = data_occupancy(panel, sheet);
  if (panel.legend != Chart::Legend::none) taken.add(panel.legend_box, 3);
  draw_marks(sheet, panel, taken);
  draw_axes(sheet, panel);
  draw_legend(sheet, panel);
  for (const Inset& inset : chart.insets) {
    const Rect& p = panel.plot;
    const double left = p.left + inset.place[0] * p.width(), bottom = p.bottom - inset.place[1] * p.height();
    const Rect place{left, bottom - inset.place[3] * p.height(), left + inset.place[2] * p.width(), bottom};
    sheet.rectangle(place, {1, 1, 1});
    draw_chart(sheet, inset.chart[0], place, 0.86 * text);
  }
}

Sheet sheet_of(const Chart& chart) {
  check(chart);
  Sheet sheet(chart.width, chart.height);
  sheet.rectangle({0, 0, static_cast<double>(chart.width), static_cast<double>(chart.height)}, {1, 1, 1});
  draw_chart(sheet, chart, {0, 0, static_cast<double>(chart.width), static_cast<double>(chart.height)});
  return sheet;
}

}  // namespace render
