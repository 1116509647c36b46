#pragma once
// A chart in the making: scales, the plot area, where its data lies in it, and the parts that are drawn from that.
// Besides the files of this folder only canvas.cpp looks in here.
#include <optional>
#include <string>
#include <vector>

#include "render/chart/occupancy.h"
#include "render/chart/ticks.h"
#include "render/paper/paper.h"

namespace render {

constexpr Colour ink{0.12, 0.12, 0.12};
constexpr double tick_length = 5, minor_tick_length = 3, label_gap = 5, hatch_gap = 3.6, hatch_width = 1.1;
constexpr double tick_room = 8;  ///< px inside the frame that hold its ticks, with some air

/// The key of a legend to one thing drawn: its sample and its label.
struct LegendKey {
  std::string label;
  Colour colour;
  bool swatch = false;  ///< a filled square (bars, bands) instead of a line with its marker
  double opacity = 1;
  Line line = Line::none;
  double width = 1;
  Marker marker = Marker::none;
  bool hollow = false;
  Pattern pattern = Pattern::none;
};

struct ChartLayout {
  const Chart* chart = nullptr;
  Rect area, plot;   ///< all that the chart may use; the frame of its data
  double text = 12;  ///< size of tick labels (px)
  Scale x, left, right;
  bool has_right = false;
  Chart::Legend legend = Chart::Legend::none;
  Rect legend_box;
  std::vector<std::vector<std::string>> categories;           ///< names under bars, in lines
  std::vector<std::string> x_title, left_title, right_title;  ///< in lines
  std::vector<std::optional<Vec2>> inside;                    ///< middle of the label of each band that holds its own

  [[nodiscard]] double title_size() const { return text * 1.08; }
  [[nodiscard]] const Scale& scale(Side side) const { return side == Side::left ? left : right; }
  [[nodiscard]] double across(double value) const { return plot.left + x.share(value) * plot.width(); }
  [[nodiscard]] double down(double value, Side side) const {
    return plot.bottom - scale(side).share(value) * plot.height();
  }
  [[nodiscard]] Vec2 at(double vx, double vy, Side side) const { return {across(vx), down(vy, side)}; }
};

/// A bar in its place.
struct Bar {
  Rect rect;
  std::size_t series = 0, category = 0;
  double value = 0, error = 0;
};

/// Scales and places for a chart in `area`, its legend at `legend`, whatever the chart asks for; none without labels.
ChartLayout lay_out(const Chart& chart, const Rect& area, double text, Chart::Legend legend);

/// Breaks a text at blanks and "\n" so that its lines are not wider than `width`, where that is possible.
std::vector<std::string> wrapped(const std::string& text, double width, double size);

/// What the legend explains: all that has a label and does not hold it.
std::vector<LegendKey> legend_keys(const ChartLayout& layout);
Vec2 legend_size(const ChartLayout& layout, const std::vector<LegendKey>& keys, double max_width);

std::vector<Bar> bars_of(const ChartLayout& layout);

/// Where the label of a band has most room in it; nothing when it has too little everywhere.
std::optional<Vec2> place_inside(const ChartLayout& layout, const Band& band);

/// The printed value of a bar; it stands upright where bars are too narrow for it.
struct ValueText {
  std::string text;
  double size = 0, width = 0;  ///< px
  bool upward = false;
};
ValueText value_text(const ChartLayout& layout, const Bar& bar);
/// The line of a series inside the plot area, simplified; pieces where values are missing or outside.
std::vector<std::vector<Vec2>> curve_of(const ChartLayout& layout, const Series& series);
/// Places of the series' markers; long lines carry few of them.
std::vector<Vec2> markers_of(const ChartLayout& layout, const Series& series);
/// What the data covers.
Occupancy data_occupancy(const ChartLayout& layout, const Paper& paper);

void draw_axes(Paper& paper, const ChartLayout& layout);
void draw_data(Paper& paper, const ChartLayout& layout);    ///< bands, bars and lines
void draw_points(Paper& paper, const ChartLayout& layout);  ///< markers and error bars: over the frame
void draw_legend(Paper& paper, const ChartLayout& layout);
void draw_marks(Paper& paper, const ChartLayout& layout, Occupancy& taken);

/// The whole chart.
void draw_chart(Paper& paper, const Chart& chart, const Rect& area, double text = 12);

/// Paper of Chart::width x height with the chart on it. Throws std::invalid_argument when columns of the chart
/// differ in length.
Paper paper_of(const Chart& chart);

/// The ranges of the data, as facts for a picture's metadata: {"Extent x", "0 to 0.31"}.
Provenance extents(const Chart& chart);

}  // namespace render
