#pragma once
// Charts: curves, bars, bands and marks on one or two value axes, with insets. Plain data in; PNG and vector SVG out
// (render/draw.h). Values are in the units that the axis titles name: the caller converts. Text is UTF-8 and
// understands _{...} and ^{...} for indices and exponents: "σ_{ci} (MPa)". NaN breaks a curve and leaves a bar out.
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/style.h"

namespace render {

/// Widths of charts and drawings (px): a column, 85 mm in print, and the page, 170 mm. One px is 0.2125 mm there, so that
/// text of 12 px is 7.2 pt.
constexpr int column_width = 400, page_width = 800;
constexpr double column_mm = 85;

enum class Side { left, right };  ///< which value axis

struct Axis {
  std::string title;                ///< UTF-8, with the unit: "Axial stress σ₁ (MPa)"
  std::optional<double> low, high;  ///< chosen from the data when absent
  bool logarithmic = false;
  std::vector<std::pair<double, std::string>> ticks;  ///< own ticks; empty: chosen
};

struct Series {
  std::string label;  ///< legend text; "" keeps it out of the legend
  std::vector<double> x, y;
  Colour colour;
  Line line = Line::solid;
  double width = 1.6;  ///< px at 100 dpi
  Marker marker = Marker::none;
  bool hollow = false;  ///< markers are outlines filled with white: what is published
  Side side = Side::left;
  std::vector<double> y_error = {};  ///< half lengths of error bars; empty: none
  std::string name = {};             ///< in plain data, where it is not the label: "AR 1, fit"
};

/// A filled band between two curves.
struct Band {
  std::string label;
  std::vector<double> x, low, high;
  Colour colour;
  Side side = Side::left;
  double opacity = 0.28;
  bool outlined = false;  ///< a fine dark line along its upper edge
  bool inside = false;    ///< its label stands in it where there is room for it, and leaves the legend then
};

/// Grouped or stacked bars: values[series][category].
struct Bars {
  std::vector<std::string> categories;
  std::vector<std::string> labels;
  std::vector<Colour> colours;
  std::vector<Pattern> patterns =
      {};  ///< of each series; empty: none. Hatched bars are hatched in their colour on white
  std::vector<std::vector<double>> values;
  std::vector<std::vector<double>> errors;  ///< empty: none
  bool stacked = false;
  bool print_values = false;
  std::string value_format = "{:.0f}";  ///< fmt format of printed values
  Side side = Side::left;
};

/// A labelled point, or a straight reference line across the plot.
struct Mark {
  enum class Kind { point, horizontal, vertical } kind = Kind::point;
  double x = 0, y = 0;
  std::string label;
  Colour colour;
  Side side = Side::left;
  Line line = Line::dash;  ///< for reference lines
};

struct Chart;
struct Inset {
  std::vector<Chart> chart;       ///< exactly one (a vector, so that the type may contain itself)
  std::array<double, 4> place{};  ///< left, bottom, width, height as fractions of the plot area; where it
                                  ///< would cover data, the nearest place that covers least
};

struct Chart {
  std::string title;    ///< usually empty: captions belong to the page
  Axis x, left, right;  ///< the right axis is drawn when something uses it
  std::vector<Band> bands;
  std::vector<Series> series;
  std::optional<Bars> bars;  ///< with bars, x is the axis of categories
  std::vector<Mark> marks;
  std::vector<Inset> insets;
  enum class Legend {
    none,
    top_left,
    top_right,
    bottom_left,
    bottom_right,
    outside_right,
    below
  } legend = Legend::top_left;
  int width = 400, height = 280;  ///< px; see column_width
  int foot = 0;                   ///< px of it that are left empty at the lower end
};

/// Height (px) of the frame of its data: legends and titles leave one chart more than another.
double plot_height(const Chart& chart);

}  // namespace render
