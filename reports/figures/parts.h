#pragma once
// Pieces that figures of any model share: which cases a figure shows, curves from a history, panels for what is missing.
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/analysis/series.h"
#include "reports/figure.h"
#include "reports/text.h"

namespace reports {

/// A case in a series: its place on the swept axis and how it looks in every chart.
struct SeriesCase : analysis::Point {
  std::string label;  ///< "AR 2"
  std::string id;     ///< suffix for panels: "ar_2"
  render::Colour colour;
  render::Line line = render::Line::solid;
};

/// The cases of one test along one parameter (analysis::series_of), with their looks.
std::vector<SeriesCase> series_of(const StudyResult& study, std::string_view test, const dem::Parameter& axis);
/// The places alone, for the analysis.
std::vector<analysis::Point> points_of(const std::vector<SeriesCase>& cases);

using analysis::shown;
using analysis::Spread;
using analysis::ValueOf;

/// Means of a value along the swept parameter, with error bars of one standard deviation where there are repeats.
render::Series means(const std::vector<SeriesCase>& cases, const ValueOf& value);

/// The straight line through a value of all cases and repeats against the swept parameter.
std::optional<analysis::Trend> trend_of(const std::vector<SeriesCase>& cases, const ValueOf& value);
/// "rises by 1.2 MPa per degree of dip (95 % interval 0.4 to 2, p = 0.01)", that it shows no clear trend, or
/// "has the slope 1.2 MPa per degree of dip: one seed cannot show a trend"; "" with one case.
std::string trend_words(const std::vector<SeriesCase>& cases, const ValueOf& value, std::string_view unit,
                        const dem::Parameter& axis);
/// "AR 1", "AR 2", ...
std::vector<std::string> labels_of(const std::vector<SeriesCase>& cases);

/// A straight line through a value, by the name of what it is of.
struct Trend {
  std::string name;
  std::optional<analysis::Trend> fit;
};
/// Which of them rise or fall, as a sentence of the finding, and their slopes with intervals as a table.
void add_trends(FigureContent& content, const std::vector<Trend>& trends, const dem::Parameter& axis);
/// Of a result, in its own unit: differences of a share are points.
std::string trend_words(const std::vector<SeriesCase>& cases, const dem::Quantity& quantity,
                        const dem::Parameter& axis);
/// "29.1 (95 % interval 27 to 31.2)", shorter in tables: "29.1 (27 to 31.2)".
std::string estimate_text(const analysis::Estimate& estimate, int digits, bool in_table = false);
/// In a sentence: "29.1 MPa (95 % interval 27 to 31.2)"; "... −10 to 61: contains zero)" where it does, so that
/// the points tell not even a sign.
std::string told(const analysis::Estimate& estimate, int digits, std::string_view unit = {});

/// A table of the cases of a test that have no record, with the reason; nothing when all have one.
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

/// Ends the axis of x 5 % of its length beyond the last point of the curves, so that none falls along the frame.
void leave_room(render::Chart& chart);

/// A line through a function of x in equal steps from `low` to `high`; points that are not finite are left out.
render::Series line_of(double low, double high, const std::function<double(double)>& y, int steps = 60);

/// The y value of a column where `x` first reaches `at`, linear in between; NaN when it never does.
double at_first(std::span<const double> x, std::span<const double> y, double at);

/// What a paper states, in a chart, where it states it: hollow markers, hatched bars, thin lines with their names, all of
/// one grey. What is not known is left out; so is all of it for a rock that no paper is about.
inline constexpr render::Colour published_colour{0.30, 0.30, 0.30};
struct PublishedPoint {
  double x = 0, y = 0;
};
/// Values by their ids, at places along x; what is not known is no point.
std::vector<PublishedPoint> published_points(const StudyResult& study,
                                             std::initializer_list<std::pair<double, std::string_view>> of);
void add_published(render::Chart& chart, const std::vector<PublishedPoint>& points, const std::string& label);
/// Beside ours in grouped bars: a value a category, NaN where there is none.
void add_published(render::Bars& bars, const std::vector<double>& values, const std::string& label = "published");
/// A line across the chart at a value, "published D_{2}".
void add_published(render::Chart& chart, render::Mark::Kind kind, double value, const std::string& label);

/// What the user's laboratory measured, as points with bars of its uncertainty, all of one colour. Null: not measured.
inline constexpr render::Colour laboratory_colour{0.72, 0.05, 0.42};
struct LaboratoryPoint {
  double x = 0;
  const LaboratoryNumber* number = nullptr;
};
void add_laboratory(render::Chart& chart, const std::vector<LaboratoryPoint>& points,
                    const std::string& label = "laboratory", render::Marker marker = render::Marker::square);
/// Beside ours in grouped bars: one a category.
void add_laboratory(render::Bars& bars, const std::vector<const LaboratoryNumber*>& numbers);

/// A note in a panel's place.
Panel note_panel(std::string id, std::string caption, std::string text);
bool is_note(const Panel& panel);

/// "206.8, 201.3 and 198.4 MPa", means of repeats, with the labels of the cases when some have no value. `digits` significant ones; 0: a count.
std::string by_case(const std::vector<SeriesCase>& cases, const ValueOf& value, int digits, std::string_view unit);
/// Of a result, in its own unit.
std::string by_case(const std::vector<SeriesCase>& cases, const dem::Quantity& quantity, int digits);

}  // namespace reports
