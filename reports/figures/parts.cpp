#include "reports/figures/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "reports/text.h"

namespace reports {
namespace {

std::string id_part(double value) {
  std::string text = fmt::format("{:.6g}", value);
  std::ranges::replace(text, '.', '_');
  std::ranges::replace(text, '-', 'm');
  return text;
}

}  // namespace

std::vector<SeriesCase> series_of(const StudyResult& study, std::string_view test, const dem::Parameter& axis) {
  std::vector<SeriesCase> cases;
  for (analysis::Point& point : analysis::series_of(study.cases, test, axis)) {
    const std::size_t i = cases.size();
    const std::string id = fmt::format("{}_{}", axis.in_ids, id_part(point.value));
    cases.push_back(
        {std::move(point), parameter_words(axis, point.value), id, render::palette(i), render::line_style(i)});
  }
  return cases;
}

std::vector<std::string> labels_of(const std::vector<SeriesCase>& cases) {
  std::vector<std::string> labels;
  for (const SeriesCase& one : cases) labels.push_back(one.label);
  return labels;
}

std::vector<analysis::Point> points_of(const std::vector<SeriesCase>& cases) { return {cases.begin(), cases.end()}; }

render::Series means(const std::vector<SeriesCase>& cases, const ValueOf& value) {
  render::Series series;
  series.marker = render::Marker::circle;
  bool repeated = false;
  for (const SeriesCase& item : cases) {
    const Spread spread = analysis::spread(item, value);
    if (spread.count == 0) continue;
    repeated = repeated || spread.count > 1;
    series.x.push_back(item.value);
    series.y.push_back(spread.mean);
    series.y_error.push_back(spread.deviation);
  }
  if (!repeated) series.y_error.clear();
  return series;
}

std::optional<analysis::Trend> trend_of(const std::vector<SeriesCase>& cases, const ValueOf& value) {
  return analysis::trend(points_of(cases), value);
}

namespace {

std::string p_words(const analysis::Trend& fit) {
  return fit.p_value < 0.001 ? "≤ 0.001" : "= " + number(fit.p_value, 2);
}

}  // namespace

void add_trends(FigureContent& content, const std::vector<Trend>& trends, const dem::Parameter& axis) {
  TextTable table{{"Cracks", "Slope per " + std::string(axis.step), "95 % interval", "p"}, {}};
  std::vector<std::string> rising, falling, unclear, untold;
  std::size_t seeds = 0;
  for (const auto& [name, fit] : trends) {
    if (!fit) continue;
    const double slope = fit->slope.value;
    const bool known = fit->slope.has_interval();
    const std::string p = known ? p_words(*fit) : "";
    table.rows.push_back({name, number(slope, 2),
                          known ? number(fit->slope.low, 2) + " to " + number(fit->slope.high, 2) : "–",
                          p.starts_with("= ") ? p.substr(2) : p});
    seeds = std::max(seeds, fit->seeds);
    if (!known)
      untold.push_back(with_sign(number(slope, 2)) + " (" + name + ")");
    else
      (!fit->is_clear() ? unclear : slope < 0 ? falling : rising).push_back(name);
  }
  if (table.rows.empty()) return;
  const bool any_known = untold.size() < table.rows.size();
  if (!any_known) {  // too few seeds
    table.head.resize(2);
    for (auto& row : table.rows) row.resize(2);
  }
  content.panels.push_back({.id = "trends",
                            .caption = "Slopes of straight lines through the numbers of cracks against " +
                                       std::string(axis.words) + (any_known ? "." : "; too few seeds for an interval."),
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  std::vector<std::string> said;
  if (!rising.empty()) said.push_back(listed(rising) + " cracks become more");
  if (!falling.empty()) said.push_back(listed(falling) + " cracks become fewer");
  if (!unclear.empty())
    said.push_back(rising.empty() && falling.empty() ? "no class of cracks shows a clear trend"
                                                     : listed(unclear) + " cracks show no clear trend");
  if (!said.empty()) content.finding += " With " + std::string(axis.words) + ", " + joined(said, "; ") + ".";
  if (!untold.empty())
    content.finding +=
        " Slopes per " + std::string(axis.step) + ": " + joined(untold, ", ") + "; " + no_trend_text(seeds) + ".";
}

std::string trend_words(const std::vector<SeriesCase>& cases, const ValueOf& value, std::string_view unit,
                        const dem::Parameter& axis) {
  const auto fit = trend_of(cases, value);
  if (!fit) return {};
  const double slope = fit->slope.value;
  const std::string of =
      (unit.empty() || unit == "°" ? std::string(unit) : " " + std::string(unit)) + " per " + std::string(axis.step);
  if (!fit->slope.has_interval()) {
    return fmt::format("has the slope {}{}: {}", with_sign(number(slope, 2)), of, no_trend_text(fit->seeds));
  }
  const std::string interval =
      fmt::format("95 % interval {} to {}, p {}", number(fit->slope.low, 2), number(fit->slope.high, 2), p_words(*fit));
  if (!fit->is_clear()) return fmt::format("shows no clear trend: slope {}{} ({})", number(slope, 2), of, interval);
  return fmt::format("{} by {}{} ({})", slope < 0 ? "falls" : "rises", number(std::abs(slope), 2), of, interval);
}

std::string trend_words(const std::vector<SeriesCase>& cases, const dem::Quantity& quantity,
                        const dem::Parameter& axis) {
  const std::string_view unit = quantity.shown_unit();
  return trend_words(cases, shown(quantity), unit == "%" ? "points" : unit, axis);
}

std::string estimate_text(const analysis::Estimate& estimate, int digits, bool in_table) {
  const std::string value = number(estimate.value, digits);
  if (!estimate.has_interval()) return in_table ? value : value + " (no interval from so few points)";
  return fmt::format("{} ({}{} to {})", value, in_table ? "" : "95 % interval ", number(estimate.low, digits),
                     number(estimate.high, digits));
}

std::string told(const analysis::Estimate& estimate, int digits, std::string_view unit) {
  const std::string space = unit.empty() || unit == "°" ? "" : " ";
  const std::string value = number(estimate.value, digits) + space + std::string(unit);
  if (!estimate.has_interval()) return value + " (no interval from so few points)";
  const bool is_known = estimate.low > 0 || estimate.high < 0;
  return fmt::format("{} (95 % interval {} to {}{})", value, number(estimate.low, digits),
                     number(estimate.high, digits), is_known ? "" : ": contains zero");
}

std::optional<Panel> missing_cases(const StudyResult& study, std::string_view test) {
  TextTable table{{"Case", "Why it is not shown"}, {}};
  for (const CaseResult& result : study.cases) {
    if (result.record || result.test() != test) continue;
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

void leave_room(render::Chart& chart) {
  constexpr double room = 0.05;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const render::Series& series : chart.series) {
    for (const double x : series.x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  if (!(high > low)) return;
  const double from = chart.x.low.value_or(std::min(low, 0.0)), length = high - from;
  chart.x.high = high + room * length;
  if (!chart.x.low) chart.x.low = from < 0 ? from - room * length : 0;
}

render::Series line_of(double low, double high, const std::function<double(double)>& y, int steps) {
  render::Series series;
  for (int i = 0; i <= steps; ++i) {
    const double x = low + (high - low) * i / steps;
    const double value = y(x);
    if (!std::isfinite(value)) continue;
    series.x.push_back(x);
    series.y.push_back(value);
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

std::vector<PublishedPoint> published_points(const StudyResult& study,
                                             std::initializer_list<std::pair<double, std::string_view>> of) {
  std::vector<PublishedPoint> points;
  for (const auto& [x, id] : of) {
    const double y = study.published_value(id);
    if (std::isfinite(y)) points.push_back({x, y});
  }
  return points;
}

void add_published(render::Chart& chart, const std::vector<PublishedPoint>& points, const std::string& label) {
  render::Series series{.label = label,
                        .x = {},
                        .y = {},
                        .colour = published_colour,
                        .line = render::Line::none,
                        .marker = render::Marker::diamond,
                        .hollow = true};
  for (const PublishedPoint& point : points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    series.x.push_back(point.x);
    series.y.push_back(point.y);
  }
  if (!series.x.empty()) chart.series.push_back(std::move(series));
}

void add_published(render::Bars& bars, const std::vector<double>& values, const std::string& label) {
  if (std::ranges::none_of(values, [](double v) { return std::isfinite(v); })) return;
  bars.patterns.resize(bars.values.size(), render::Pattern::none);
  bars.labels.push_back(label);
  bars.colours.push_back(published_colour);
  bars.patterns.push_back(render::Pattern::rising);
  if (!bars.errors.empty()) bars.errors.emplace_back(values.size(), std::nan(""));
  bars.values.push_back(values);
}

void add_published(render::Chart& chart, render::Mark::Kind kind, double value, const std::string& label) {
  if (!std::isfinite(value)) return;
  const bool upright = kind == render::Mark::Kind::vertical;
  chart.marks.push_back({.kind = kind,
                         .x = upright ? value : 0,
                         .y = upright ? 0 : value,
                         .label = label,
                         .colour = published_colour,
                         .line = render::Line::dash});
}

void add_laboratory(render::Chart& chart, const std::vector<LaboratoryPoint>& points, const std::string& label,
                    render::Marker marker) {
  render::Series series{.label = label,
                        .x = {},
                        .y = {},
                        .colour = laboratory_colour,
                        .line = render::Line::none,
                        .marker = marker,
                        .hollow = true};
  for (const LaboratoryPoint& point : points) {
    if (!point.number || !std::isfinite(point.x)) continue;
    series.x.push_back(point.x);
    series.y.push_back(point.number->value);
    series.y_error.push_back(0.5 * (point.number->high - point.number->low));
  }
  if (!series.x.empty()) chart.series.push_back(std::move(series));
}

void add_laboratory(render::Bars& bars, const std::vector<const LaboratoryNumber*>& numbers) {
  if (std::ranges::none_of(numbers, [](const LaboratoryNumber* one) { return one != nullptr; })) return;
  std::vector<double> values, errors;
  for (const LaboratoryNumber* one : numbers) {
    values.push_back(one ? one->value : std::nan(""));
    errors.push_back(one ? 0.5 * (one->high - one->low) : std::nan(""));
  }
  bars.errors.resize(bars.values.size(), std::vector<double>(numbers.size(), std::nan("")));
  bars.errors.push_back(std::move(errors));
  bars.patterns.resize(bars.values.size(), render::Pattern::none);
  bars.labels.emplace_back("laboratory");
  bars.colours.push_back(laboratory_colour);
  bars.patterns.push_back(render::Pattern::rising);
  bars.values.push_back(std::move(values));
}

Panel note_panel(std::string id, std::string caption, std::string text) {
  return {.id = std::move(id),
          .caption = std::move(caption),
          .alt = "",
          .content = TextTable{{"Not drawn"}, {{std::move(text)}}},
          .per_row = 1};
}

bool is_note(const Panel& panel) {
  const auto* table = std::get_if<TextTable>(&panel.content);
  return table && table->head == std::vector<std::string>{"Not drawn"};
}

std::string by_case(const std::vector<SeriesCase>& cases, const ValueOf& value, int digits, std::string_view unit) {
  std::vector<std::string> items;
  for (const SeriesCase& item : cases) {
    const double v = analysis::spread(item, value).mean;
    if (std::isfinite(v)) items.push_back(digits > 0 ? number(v, digits) : count(std::round(v)));
  }
  if (items.size() != cases.size()) {  // some are missing: say which is which
    items.clear();
    for (const SeriesCase& item : cases) {
      const double v = analysis::spread(item, value).mean;
      if (std::isfinite(v))
        items.push_back((digits > 0 ? number(v, digits) : count(std::round(v))) + " (" + item.label + ")");
    }
  }
  return items.empty() ? "not measured" : listed(items) + (unit.empty() ? "" : " " + std::string(unit));
}

std::string by_case(const std::vector<SeriesCase>& cases, const dem::Quantity& quantity, int digits) {
  return by_case(cases, shown(quantity), digits, quantity.shown_unit());
}

void add_curves(render::Chart& chart, const std::vector<SeriesCase>& cases, const CurveOf& of, double up_to) {
  for (const SeriesCase& item : cases) {
    render::Series series = curve(item.record->table("history"), of);
    const auto beyond = std::ranges::find_if(series.x, [&](double x) { return x > up_to; }) - series.x.begin();
    series.x.resize(static_cast<std::size_t>(beyond));
    series.y.resize(static_cast<std::size_t>(beyond));
    if (series.x.empty()) continue;
    series.label = item.label;
    series.colour = item.colour;
    series.line = item.line;
    chart.series.push_back(std::move(series));
  }
}

void add_missing(FigureContent& content, const StudyResult& study, std::initializer_list<std::string_view> tests) {
  for (const std::string_view test : tests) {
    auto missing = missing_cases(study, test);
    if (!missing) continue;
    missing->id += "_" + std::string(test);
    content.panels.push_back(std::move(*missing));
  }
}

}  // namespace reports
