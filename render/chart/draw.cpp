// A chart from its parts, in the order of painting.
#include <array>
#include <cmath>
#include <stdexcept>

#include "render/chart/layout.h"

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

/// Insets stay where they were asked for when no data lies there; else they move to the nearest place that covers
/// least.
std::vector<Rect> inset_places(const ChartLayout& layout, Occupancy& taken) {
  std::vector<Rect> places;
  const Rect& p = layout.plot;
  for (const Inset& inset : layout.chart->insets) {
    const double width = inset.place[2] * p.width(), height = inset.place[3] * p.height();
    const auto at = [&](double left, double bottom) {
      const double x = p.left + left * p.width(), y = p.bottom - bottom * p.height();
      return Rect{x, y - height, x + width, y};
    };
    Rect best = at(inset.place[0], inset.place[1]);
    double least = 100 * taken.taken(best);
    constexpr int steps = 24;
    constexpr double gap = 0.02;  // keeps off the ticks
    const bool covers = least > 0;
    for (int i = 0; covers && i < steps * steps; ++i) {
      const double left = gap + (1 - inset.place[2] - 2 * gap) * (i % steps) / (steps - 1);
      const double bottom = gap + (1 - inset.place[3] - 2 * gap) * static_cast<double>(i / steps) / (steps - 1);
      const double cost =
          100 * taken.taken(at(left, bottom)) + std::hypot(left - inset.place[0], bottom - inset.place[1]);
      if (cost < least) {
        best = at(left, bottom);
        least = cost;
      }
    }
    taken.add(best, 3);
    places.push_back(best);
  }
  return places;
}

/// The layout with the legend where it was asked for, or in another corner, or below: where it covers no data.
ChartLayout with_free_legend(const Paper& paper, const Chart& chart, const Rect& area, double text) {
  ChartLayout layout = lay_out(chart, area, text, chart.legend);
  if (!in_a_corner(layout.legend)) return layout;
  using enum Chart::Legend;
  for (Chart::Legend corner : {chart.legend, top_left, top_right, bottom_right, bottom_left}) {
    layout = lay_out(chart, area, text, corner);
    Occupancy taken = data_occupancy(layout, paper);
    inset_places(layout, taken);  // takes their places
    if (layout.plot.holds(layout.legend_box) && taken.taken(layout.legend_box.grown(3)) == 0) return layout;
  }
  return lay_out(chart, area, text, below);
}

Rect area_of(const Chart& chart) {
  return {0, 0, static_cast<double>(chart.width), static_cast<double>(chart.height - chart.foot)};
}

}  // namespace

void draw_chart(Paper& paper, const Chart& chart, const Rect& area, double text) {
  const ChartLayout layout = with_free_legend(paper, chart, area, text);
  draw_data(paper, layout);
  Occupancy taken = data_occupancy(layout, paper);
  const std::vector<Rect> insets = inset_places(layout, taken);
  if (layout.legend != Chart::Legend::none) taken.add(layout.legend_box, 3);
  draw_marks(paper, layout, taken);
  draw_axes(paper, layout);
  draw_points(paper, layout);
  draw_legend(paper, layout);
  for (std::size_t i = 0; i < insets.size(); ++i) {
    paper.rectangle(insets[i], {1, 1, 1});
    draw_chart(paper, chart.insets[i].chart[0], insets[i], 0.86 * text);
  }
}

Paper paper_of(const Chart& chart) {
  check(chart);
  Paper paper(chart.width, chart.height);
  paper.rectangle({0, 0, static_cast<double>(chart.width), static_cast<double>(chart.height)}, {1, 1, 1});
  draw_chart(paper, chart, area_of(chart));
  return paper;
}

double plot_height(const Chart& chart) {
  check(chart);
  const Paper paper(chart.width, chart.height);
  return with_free_legend(paper, chart, area_of(chart), 12).plot.height();
}

}  // namespace render
