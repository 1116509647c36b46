#pragma once
// Cases along a parameter: a sweep with its repeats, and numbers read off it.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/cases.h"
#include "engine/analysis/fits.h"
#include "engine/analysis/statistics.h"

namespace dem::analysis {

/// One place of a sweep: the record of its first seed, and those of every seed.
struct Point {
  const Record* record = nullptr;
  double value = 0;                    ///< of the swept parameter, in its unit
  std::vector<const Record*> repeats;  ///< of every seed, this record's first
};

/// The cases of one test along one parameter, by its value: those that agree with the test's first record in every other
/// parameter. Those that differ from one of these in their seed alone are its repeats.
std::vector<Point> series_of(std::span<const CaseResult> cases, std::string_view test, const Parameter& axis);

/// A number read off a record; NaN where it has none.
using ValueOf = std::function<double(const Record&)>;
/// A result in the unit in which it is shown.
ValueOf shown(const Quantity& quantity);

/// Over the repeats of a point.
Spread spread(const Point& point, const ValueOf& value);

/// Against the swept parameter, over the seeds that have a value at every point; nothing with fewer than two points.
std::optional<Trend> trend(std::span<const Point> points, const ValueOf& value);

}  // namespace dem::analysis
