#include "engine/analysis/series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace dem::analysis {

std::vector<Point> series_of(std::span<const CaseResult> cases, std::string_view test, const Parameter& axis) {
  const std::array<std::string_view, 2> but{axis.id, "seed"};
  std::vector<Point> points;
  const CaseResult* first = nullptr;
  for (const CaseResult& one : cases) {
    const ParameterValue* place = find_value(one.parameters, axis.id);
    const double* value = place ? std::get_if<double>(place) : nullptr;
    if (!one.record || !value || one.test() != test) continue;
    if (!first) first = &one;
    if (!alike(first->parameters, one.parameters, but)) continue;
    const auto same = std::ranges::find(points, *value, &Point::value);
    if (same != points.end()) {
      same->repeats.push_back(one.record);
    } else {
      points.push_back({one.record, *value, {one.record}});
    }
  }
  std::ranges::stable_sort(points, {}, &Point::value);
  return points;
}

ValueOf shown(const Quantity& quantity) {
  return [quantity](const Record& record) { return quantity.factor * record.value_or_nan(quantity); };
}

Spread spread(const Point& point, const ValueOf& value) {
  std::vector<double> values;
  for (const Record* record : point.repeats) values.push_back(value(*record));
  return spread(values);
}

std::optional<Trend> trend(std::span<const Point> points, const ValueOf& value) {
  std::map<std::uint64_t, std::pair<std::vector<double>, std::vector<double>>> of_seed;  // x and y
  std::vector<double> steps;
  for (const Point& point : points) {
    bool some = false;
    for (const Record* record : point.repeats) {
      const double v = value(*record);
      if (!std::isfinite(v)) continue;
      auto& [x, y] = of_seed[record->seed];
      x.push_back(point.value);
      y.push_back(v);
      some = true;
    }
    if (some) steps.push_back(point.value);
  }
  std::vector<double> slopes;
  for (const auto& [seed, line] : of_seed) {
    if (line.first != steps) continue;
    if (const auto fit = fit_line(line.first, line.second)) slopes.push_back(fit->slope.value);
  }
  if (slopes.empty()) return {};
  return paired_trend(slopes);
}

}  // namespace dem::analysis
