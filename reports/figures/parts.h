#pragma once
// Pieces that figures of any model share: which cases a figure shows, curves from a history, panels for what is missing.
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/figure.h"
#include "engine/analysis/fits.h"

namespace reports {

/// A case in a series: its record, its place on the swept axis and how it looks in every chart.
struct SeriesCase {
  const dem::Record* record = nullptr;
  double value = 0;   ///< of the swept parameter
  std::string label;  ///< "AR 2"
  std::string id;     ///< suffix for panels: "ar_2"
  render::Colour colour;
  render::Line line = render::Line::solid;
  std::vector<const dem::Record*> repeats;  ///< of every seed, this record's first
};

/// A parameter that cases differ in, and its words.
struct Axis {
  std::string_view parameter;  ///< "confining_pressure_MPa"
  std::string_view name;       ///< in labels: "σ₃"
  std::string_view unit;       ///< with its space: " MPa"
  std::string_view id;         ///< in names of files: "sigma3"
  std::string_view title;      ///< of a chart's axis
  std::string_view words;      ///< "the confining pressure"
  std::string_view step;       ///< "MPa of confining pressure"
};

/// The cases of one test along one parameter, by its value: those that agree with the test's first record in every other
/// parameter. Those that differ from one of these in their seed alone are its repeats.
std::vector<SeriesCase> series_of(const StudyResult& study, std::string_view test, const Axis& axis);

using Measure = std::function<double(const dem::Record&)>;
/// A result by name, NaN where a record has none.
Measure result(std::string name, double factor = 1);

/// Mean and standard deviation of a measure over the repeats of a case; NaN where none has it.
struct Spread {
  double mean = 0, deviation = 0;
  std::size_t count = 0;
};
Spread spread_of(const SeriesCase& item, const Measure& value);

/// Means of a measure along the swept parameter, with error bars of one standard deviation where there are repeats.
render::Series means(const std::vector<SeriesCase>& cases, const Measure& value);

/// The straight line through a measure of all cases and repeats against the swept parameter.
std::optional<analysis::LineFit> trend_of(const std::vector<SeriesCase>& cases, const Measure& value);
/// "rises by 1.2 MPa per degree of dip (95 % interval 0.4 to 2, p = 0.01)", or that scatter hides it; "" with one case.
std::string trend_words(const std::vector<SeriesCase>& cases, const Measure& value, std::string_view unit,
                        const Axis& axis);
/// "29.1 (95 % interval 27 to 31.2)", shorter in tables: "29.1 (27 to 31.2)".
std::string estimate_text(const analysis::Estimate& estimate, int digits, bool in_table = false);

/// A table of the cases of a test that have no record, with the reason; nothing when all have one.
/// Cases belong to a test when their id starts with its name.
std::optional<Panel> missing_cases(const StudyResult& study, std::string_view test);
/// Those of several tests, as panels of their own.
void add_missing(FigureContent& content, const StudyResult& study, std::initializer_list<std::string_view> tests);

/// A curve from two columns of a history; points that are not finite are left out.
struct CurveOf {
  std::string x, y;  ///< columns
  double x_factor = 1, y_factor = 1;
};
render::Series curve(const dem::Table& history, const CurveOf& of);
/// That curve of every case, in its colour and line, up to where x reaches `up_to`.
void add_curves(render::Chart& chart, const std::vector<SeriesCase>& cases, const CurveOf& of,
                double up_to = std::numeric_limits<double>::infinity());

/// A line through a function of x in equal steps from `low` to `high`; points that are not finite are left out.
render::Series line_of(double low, double high, const std::function<double(double)>& y, int steps = 60);

/// The y value of a column where `x` first reaches `at`, linear in between; NaN when it never does.
double at_first(std::span<const double> x, std::span<const double> y, double at);

/// A note in a panel's place.
Panel note_panel(std::string id, std::string caption, std::string text);
bool is_note(const Panel& panel);

/// Result of a record, or NaN.
double result_or_nan(const dem::Record& record, std::string_view name);

/// "206.8, 201.3 and 198.4 MPa", means of repeats, with the labels of the cases when some have no value. `digits` significant ones; 0: a count.
std::string by_case(const std::vector<SeriesCase>& cases, const Measure& value, int digits, std::string_view unit);

}  // namespace reports
