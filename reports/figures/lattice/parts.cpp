#include "reports/figures/lattice/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "reports/text.h"

namespace reports::lattice {
namespace {

bool same_choices(const dem::Record& a, const dem::Record& b) {
  constexpr std::array but{parameter::elements_y.id, parameter::factor.id};
  return analysis::alike(a.parameters, b.parameters, but);
}

}  // namespace

std::vector<const dem::Record*> records_of(const StudyResult& study, std::string_view test) {
  std::vector<const dem::Record*> found;
  for (const CaseResult& c : study.cases) {
    if (c.record && c.record->text("test") == test) found.push_back(c.record);
  }
  return found;
}

const dem::Record* main_record(const StudyResult& study, std::string_view test) {
  const auto all = records_of(study, test);
  return all.empty() ? nullptr : all.front();
}

std::vector<const dem::Record*> by_size(const StudyResult& study, std::string_view test) {
  std::vector<const dem::Record*> found;
  for (const dem::Record* r : records_of(study, test)) {
    const bool repeated = std::ranges::any_of(
        found, [&](const dem::Record* f) { return f->number("elements_y") == r->number("elements_y"); });
    if (!repeated && same_choices(*r, *records_of(study, test).front())) found.push_back(r);
  }
  std::ranges::stable_sort(found, {}, [](const dem::Record* r) { return r->number("elements_y"); });
  return found;
}

std::string planes_of(const dem::Record& record) { return record.text(parameter::planes_in(record.text("test")).id); }

std::string choice_words(const dem::Record& record, const dem::Record& main) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : record.parameters) {
    if (name == "elements_y" || name == "test") continue;
    const auto theirs = std::ranges::find(main.parameters, name, [](const auto& p) { return p.first; });
    if (theirs != main.parameters.end() && theirs->second == value) continue;
    if (name == "factor") {
      parts.push_back("loading steps × " + number(std::get<double>(value), 3));
    } else if (name == "stiffness") {
      parts.push_back("springs of the planes × " + number(std::get<double>(value), 3));
    } else if (name == "moving") {
      parts.emplace_back("one plane moves");
    } else if (name == "direction") {
      parts.push_back("load along " + std::get<std::string>(value));
    } else if (name == "method") {
      parts.emplace_back("the paper’s loading steps");
    } else if (name == parameter::planes_in(record.text("test")).id) {
      parts.push_back(parameter_text(value) + " planes");
    } else {
      parts.push_back(words(name) + " " + parameter_text(value));
    }
  }
  return parts.empty() ? "as the series" : listed(parts);
}

bool has_failure(const dem::Record& r) {
  if (r.text("test") == "tension") return r.has(quantity::failure_time);
  return r.has(quantity::sliding_start) && r.has(quantity::a1_time) && r.has(quantity::compressive_strength);
}

std::string no_failure_words(const dem::Record& r) {
  return fmt::format("{} of {} elements did not end in failure, so that its moments are not known", r.text("test"),
                     count(r.value(quantity::particles)));
}

render::Series window_sum(const dem::Table& history, const std::vector<std::string>& columns, double from, double to,
                          double zero, double factor) {
  const auto time = history.real("time");
  render::Series series;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < from || time[i] > to) continue;
    double sum = 0;
    for (const std::string& column : columns) sum += history.real(column)[i];
    series.x.push_back(1e6 * (time[i] - zero));
    series.y.push_back(factor * sum);
  }
  return series;
}

render::Series window(const dem::Table& history, const std::string& column, double from, double to, double zero,
                      double factor) {
  return window_sum(history, {column}, from, to, zero, factor);
}

render::Series whole(const dem::Table& history, const std::string& x, double x_factor,
                     const std::vector<std::string>& columns, double factor) {
  const auto along = history.real(x);
  render::Series series;
  for (const double value : along) series.x.push_back(x_factor * value);
  series.y.assign(along.size(), 0.0);
  for (const std::string& column : columns) {
    const auto values = history.real(column);
    for (std::size_t i = 0; i < values.size(); ++i) series.y[i] += factor * values[i];
  }
  return series;
}

render::Series styled(render::Series series, const std::string& label, std::size_t colour, render::Line line,
                      double width) {
  series.label = label;
  series.colour = render::palette(colour);
  series.line = line;
  series.width = width;
  return series;
}

render::Mark upright(double x, const std::string& label) {
  return {.kind = render::Mark::Kind::vertical,
          .x = x,
          .y = 0,
          .label = label,
          .colour = {0.35, 0.35, 0.35},
          .line = render::Line::dot};
}
render::Mark dot(double x, double y, const std::string& label) {
  return {.kind = render::Mark::Kind::point, .x = x, .y = y, .label = label, .colour = {0, 0, 0}};
}

std::string sentence(const std::vector<std::string>& parts) {
  if (parts.empty()) return {};
  std::string text = joined(parts, "; ") + ".";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

render::Colour time_colour(double share) {
  constexpr std::array<render::Colour, 5> stops{
      {{0.99, 0.85, 0.30}, {0.95, 0.60, 0.20}, {0.80, 0.30, 0.35}, {0.48, 0.13, 0.50}, {0.10, 0.05, 0.30}}};
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double part = at - static_cast<double>(low);
  const auto mix = [&](double render::Colour::*c) {
    return stops[low].*c + part * (stops[low + 1].*c - stops[low].*c);
  };
  return {mix(&render::Colour::red), mix(&render::Colour::green), mix(&render::Colour::blue)};
}

const std::vector<std::string>& elastic_columns() {
  static const std::vector<std::string> names{"elastic_normal", "elastic_shear", "elastic_planes"};
  return names;
}
const std::vector<std::string>& heat_columns() {
  static const std::vector<std::string> names{"viscous_heat", "breaking_heat_normal", "breaking_heat_shear",
                                              "frictional_heat"};
  return names;
}

double time_of_least(const dem::Table& history, const std::vector<std::string>& columns, double from) {
  const render::Series s = window_sum(history, columns, from, 1e9, 0, 1);
  if (s.y.empty()) return from;
  return 1e-6 * s.x[static_cast<std::size_t>(std::ranges::min_element(s.y) - s.y.begin())];
}

}  // namespace reports::lattice
