#pragma once
// Pieces that figures of any model share: which cases a figure shows, curves from a history, panels for what is missing.
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/figure.h"

namespace reports {

/// A case in a series: its record, its place on the swept axis and how it looks in every chart.
struct SeriesCase {
  const dem::Record* record = nullptr;
  double value = 0;        ///< of the swept parameter
  std::string label;       ///< "AR 2"
  std::string id;          ///< suffix for panels: "ar_2"
  render::Colour colour;
  render::Line line = render::Line::solid;
};

/// The cases of one test along one parameter, by its value: those that agree with the test's first record in every other
/// parameter. `short_name` makes the labels ("AR" gives "AR 2").
std::vector<SeriesCase> series_of(const StudyResult& study, std::string_view test, std::string_view parameter,
                                  std::string_view short_name);

/// A table of the cases of a test that have no record, with the reason; nothing when all have one.
/// Cases belong to a test when their id starts with its name.
std::optional<Panel> missing_cases(const StudyResult& study, std::string_view test);

/// A curve from two columns of a history; points that are not finite are left out.
struct CurveOf {
  std::string x, y;               ///< columns
  double x_factor = 1, y_factor = 1;
};
render::Series curve(const dem::Table& history, const CurveOf& of);

/// The y value of a column where `x` first reaches `at`, linear in between; NaN when it never does.
double at_first(std::span<const double> x, std::span<const double> y, double at);

/// A note in a panel's place.
Panel note_panel(std::string id, std::string caption, std::string text);

/// Result of a record, or NaN.
double result_or_nan(const dem::Record& record, std::string_view name);

/// "206.8, 201.3 and 198.4 MPa", with the labels of the cases when some have no value. `digits` significant ones; 0: a count.
std::string by_case(const std::vector<SeriesCase>& cases, const std::function<double(const dem::Record&)>& value,
                    int digits, std::string_view unit);

}  // namespace reports
