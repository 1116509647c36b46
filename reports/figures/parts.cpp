#include "reports/figures/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reports/text.h"

namespace reports {
namespace {

bool has_parameter(const dem::Record& record, std::string_view name) {
  return std::ranges::any_of(record.parameters, [&](const auto& p) { return p.first == name; });
}

// Equal in all parameters but one.
bool alike(const dem::Record& a, const dem::Record& b, std::string_view but) {
  return std::ranges::all_of(a.parameters, [&](const auto& mine) {
    return mine.first == but || std::ranges::find(b.parameters, mine) != b.parameters.end();
  });
}

std::string id_part(double value) {
  std::string text = fmt::format("{:.6g}", value);
  std::ranges::replace(text, '.', '_');
  std::ranges::replace(text, '-', 'm');
  return text;
}

}  // namespace

std::vector<SeriesCase> series_of(const StudyResult& study, std::string_view test, std::string_view parameter,
                                  std::string_view short_name) {
  std::vector<SeriesCase> cases;
  for (const CaseResult& result : study.cases) {
    if (!result.record || !has_parameter(*result.record, "test") || !has_parameter(*result.record, parameter)) continue;
    if (result.record->text("test") != test) continue;
    if (!cases.empty() && !alike(*cases.front().record, *result.record, parameter)) continue;
    const double value = result.record->number(parameter);
    std::string id(short_name);
    std::ranges::transform(id, id.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    cases.push_back({result.record, value, fmt::format("{} {:.6g}", short_name, value), id + "_" + id_part(value), {}, {}});
  }
  std::ranges::stable_sort(cases, {}, &SeriesCase::value);
  constexpr std::array lines{render::Line::solid, render::Line::dash, render::Line::dash_dot, render::Line::dot};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].colour = render::palette(i);
    cases[i].line = lines[i % lines.size()];
  }
  return cases;
}

std::optional<Panel> missing_cases(const StudyResult& study, std::string_view test) {
  TextTable table{{"Case", "Why it is not shown"}, {}};
  for (const CaseResult& result : study.cases) {
    if (result.record || !result.id.starts_with(test)) continue;
    table.rows.push_back({result.id, result.error.empty() ? "It was not run." : result.error});
  }
  if (table.rows.empty()) return std::nullopt;
  return Panel{.id = "missing", .caption = "Cases without a result.", .alt = "", .content = table, .per_row = 1};
}

render::Series curve(const dem::Table& history, const CurveOf& of) {
  const auto x = history.real(of.x);
  const auto y = history.real(of.y);
  render::Series series;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    series.x.push_back(of.x_factor * x[i]);
    series.y.push_back(of.y_factor * y[i]);
  }
  return series;
}

double at_first(std::span<const double> x, std::span<const double> y, double at) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < at) continue;
    if (i == 0 || x[i] == at) return y[i];
    const double part = (at - x[i - 1]) / (x[i] - x[i - 1]);
    return y[i - 1] + part * (y[i] - y[i - 1]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Panel note_panel(std::string id, std::string caption, std::string text) {
  return {.id = std::move(id),
          .caption = std::move(caption),
          .alt = "",
          .content = TextTable{{"Not drawn"}, {{std::move(text)}}},
          .per_row = 1};
}

double result_or_nan(const dem::Record& record, std::string_view name) {
  return record.has_result(name) ? record.result(name) : std::numeric_limits<double>::quiet_NaN();
}

std::string by_case(const std::vector<SeriesCase>& cases, const std::function<double(const dem::Record&)>& value,
                    int digits, std::string_view unit) {
  std::vector<std::string> items;
  for (const SeriesCase& item : cases) {
    const double v = value(*item.record);
    if (std::isfinite(v)) items.push_back(digits > 0 ? number(v, digits) : count(v));
  }
  if (items.size() != cases.size()) {  // some are missing: say which is which
    items.clear();
    for (const SeriesCase& item : cases) {
      const double v = value(*item.record);
      if (std::isfinite(v)) items.push_back((digits > 0 ? number(v, digits) : count(v)) + " (" + item.label + ")");
    }
  }
  return items.empty() ? "not measured" : listed(items) + (unit.empty() ? "" : " " + std::string(unit));
}

}  // namespace reports
