#include "reports/published/published.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/after_peak.h"
#include "reports/envelopes.h"
#include "reports/figures/texture/parts.h"
#include "engine/analysis/orientation.h"
#include "reports/page/text.h"

namespace reports {
namespace {

using Json = nlohmann::json;

/// Why a term has no value: said in the table instead of a number.
struct NotComputed {
  std::string why;
};

// Counts as counts, measurements with four digits.
std::string short_number(double value) { return std::floor(value) == value ? count(value) : number(value, 4); }

// A step of a trend, and which repeat of its case ("" or "_seed_2").
struct Place {
  std::string step, repeat;
};

// A case without confining pressure has none in its id.
std::string case_id(const Json& term, const Place& at) {
  constexpr std::string_view pressure = "_sigma3_{}";
  std::string id = term.at("case").get<std::string>();
  const std::size_t confined = id.find(pressure);
  const std::size_t place = id.find("{}");
  if (confined != std::string::npos && at.step == "0")
    id.erase(confined, pressure.size());
  else if (place != std::string::npos)
    id.replace(place, 2, at.step);
  return id + at.repeat;
}

bool has_case(const StudyResult& study, const std::string& id) {
  return std::ranges::find(study.cases, id, &CaseResult::id) != study.cases.end();
}

// Whether the scenario has every case that a term needs at a step.
bool asked_for(const StudyResult& study, const Json& term, const Place& at) {
  if (term.contains("case")) return has_case(study, case_id(term, at));
  for (const char* parts : {"quotient", "difference", "sum"}) {
    if (!term.contains(parts)) continue;
    return std::ranges::all_of(term.at(parts), [&](const Json& part) { return asked_for(study, part, at); });
  }
  return true;
}

// The endings of the repeats in a study: "" and, for others than the first seed, "_seed_2".
std::vector<std::string> repeats_of(const StudyResult& study) {
  std::vector<std::string> found{""};
  for (const CaseResult& one : study.cases) {
    const std::size_t place = one.id.rfind("_seed_");
    if (place == std::string::npos || one.id.find_first_not_of("0123456789", place + 6) != std::string::npos) continue;
    const std::string ending = one.id.substr(place);
    if (std::ranges::find(found, ending) == found.end()) found.push_back(ending);
  }
  return found;
}

const dem::Record& record_of(const StudyResult& study, const std::string& id) {
  const auto found = std::ranges::find(study.cases, id, &CaseResult::id);
  if (found == study.cases.end()) throw NotComputed{"no case " + id + " in this scenario"};
  if (!found->record) throw NotComputed{"case " + id + (found->error.empty() ? " was not run" : " failed")};
  return *found->record;
}

analysis::Estimate fitted(const StudyResult& study, const Json& term) {
  const std::string name = term.at("fit").get<std::string>();
  const std::string mineral = term.value("mineral", "");
  const auto found = envelopes_of(study, mineral).find(name);
  if (!found) throw NotComputed{"too few pressures to fit " + (mineral.empty() ? "" : mineral + ", ") + name};
  return *found;
}

// What a case's tables tell and its results do not hold.
double measured(const StudyResult& study, const dem::Record& record, const std::string& name) {
  if (name == "crack_angle") {
    if (!record.find("cracks")) throw NotComputed{"case " + record.case_id + " keeps no cracks"};
    return analysis::orientation_of(record.table("cracks"), 0).mean;
  }
  if (name == "stress_after_peak") {
    if (!record.find("history")) throw NotComputed{"case " + record.case_id + " keeps no history"};
    const auto cases = series_of(texture::of_mineral(study, ""), texture::test_compression, texture::confining_axis);
    return stress_after_peak(common_reach(cases))(record);
  }
  throw dem::EnvironmentError("unknown measure '" + name + "' of a published number");
}

double value_of(const StudyResult& study, const Json& term, const Place& at);

std::vector<double> values_of(const StudyResult& study, const Json& terms, const Place& at) {
  std::vector<double> values;
  for (const Json& term : terms) values.push_back(value_of(study, term, at));
  return values;
}

double value_of(const StudyResult& study, const Json& term, const Place& at) {
  double value = 0;
  if (term.contains("quotient")) {
    const auto parts = values_of(study, term.at("quotient"), at);
    if (parts.at(1) == 0) throw NotComputed{"division by zero"};
    value = parts.at(0) / parts.at(1);
  } else if (term.contains("difference")) {
    const auto parts = values_of(study, term.at("difference"), at);
    value = parts.at(0) - parts.at(1);
  } else if (term.contains("sum")) {
    for (const double part : values_of(study, term.at("sum"), at)) value += part;
  } else if (term.contains("fit")) {
    value = fitted(study, term).value;
  } else {
    const std::string id = case_id(term, at);
    const dem::Record& record = record_of(study, id);
    if (term.contains("measure")) {
      value = measured(study, record, term.at("measure").get<std::string>());
    } else {
      const std::string result = term.at("result").get<std::string>();
      if (!record.has_result(result)) throw NotComputed{"case " + id + " has no " + words(result)};
      value = record.result(result);
    }
  }
  if (!std::isfinite(value)) throw NotComputed{"the result is not a number"};
  return value * term.value("times", 1.0);
}

// The value in every repeat that has one, the first seed's first.
std::vector<double> with_repeats(const StudyResult& study, const Json& term, const std::string& step) {
  std::vector<double> values;
  for (const std::string& repeat : repeats_of(study)) {
    const Place at{step, repeat};
    if (!repeat.empty() && !asked_for(study, term, at)) continue;
    try {
      values.push_back(value_of(study, term, at));
    } catch (const NotComputed&) {
      if (repeat.empty()) throw;
    }
  }
  return values;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void compare_value(const StudyResult& study, const Json& entry, Comparison& row) {
  const Json& term = entry.at("of");
  double ours = 0;
  if (term.contains("fit")) {
    const analysis::Estimate estimate = fitted(study, term);
    ours = estimate.value * term.value("times", 1.0);
    row.estimate = estimate;
    row.detail = estimate.has_interval()
                     ? fmt::format("95 % interval {} to {}", number(estimate.low), number(estimate.high))
                     : "as many points as unknowns: no interval";
  } else {
    const auto values = with_repeats(study, term, {});
    ours = mean(values);
    if (values.size() > 1) {
      double squares = 0;
      for (const double value : values) squares += (value - ours) * (value - ours);
      row.detail = fmt::format("mean of {} seeds, standard deviation {}", values.size(),
                               number(std::sqrt(squares / static_cast<double>(values.size() - 1)), 2));
    }
  }
  row.computed = ours;
  const auto* range = std::get_if<std::pair<double, double>>(&row.published);
  const double near = range ? std::clamp(ours, range->first, range->second) : std::get<double>(row.published);
  row.deviation = row.relative ? (ours - near) / near : ours - near;
  row.verdict = std::abs(*row.deviation) <= *row.tolerance ? Verdict::met : Verdict::missed;
}

double number_in_id(std::string text) {  // "1_5" is 1.5
  std::ranges::replace(text, '_', '.');
  return std::stod(text);
}

// The sign of the least-squares slope; detail lists the values, means of repeats, and tells how sure the slope is. Steps that
// the scenario has no case for are left out, as long as two are left.
void compare_trend(const StudyResult& study, const Json& entry, Comparison& row) {
  std::vector<double> ours, x, y;
  std::vector<std::string> absent;
  const Json& steps = entry.at("over");
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const std::string step = steps[k].get<std::string>();
    if (!asked_for(study, entry.at("of"), {step, {}})) {
      absent.push_back(step);
      continue;
    }
    const auto values = with_repeats(study, entry.at("of"), step);
    ours.push_back(mean(values));
    for (const double value : values) {
      x.push_back(number_in_id(step));
      y.push_back(value);
    }
  }
  if (ours.size() < 2) {
    throw NotComputed{absent.empty() ? "a trend needs two cases"
                                     : "no cases at " + listed(absent) + " in this scenario"};
  }
  const auto line = analysis::fit_line(x, y);
  if (!line) throw NotComputed{"a trend needs two different steps"};
  const double slope = line->slope.value;
  row.computed = std::string(slope > 0 ? "rises" : slope < 0 ? "falls" : "stays level");
  const bool steady = std::ranges::is_sorted(ours) || std::ranges::is_sorted(ours, std::greater{});
  std::vector<std::string> shown;
  for (const double value : ours) shown.push_back(short_number(value));
  row.detail = joined(shown, " → ") + (steady ? "" : ", not at every step");
  if (!absent.empty()) row.detail += "; not run: " + joined(absent, ", ");
  if (line->slope.has_interval()) {
    row.detail += fmt::format("; slope {} (95 % interval {} to {}, p = {})", number(slope, 2),
                              number(line->slope.low, 2), number(line->slope.high, 2), number(line->p_value, 2));
  }
  row.estimate = line->slope;
  row.p_value = line->p_value;
  row.by_interval = x.size() > ours.size() && line->slope.has_interval();
  if (row.by_interval && line->slope.low <= 0 && line->slope.high >= 0) row.computed = std::string("lost in scatter");
  row.verdict = *row.computed == row.published ? Verdict::met : Verdict::missed;
}

void compare_greater(const StudyResult& study, const Json& entry, Comparison& row) {
  const double ours = value_of(study, entry.at("of"), {});
  const double other = value_of(study, entry.at("than"), {});
  row.computed = std::string(ours > other ? "greater" : ours < other ? "smaller" : "equal");
  row.detail = short_number(ours) + " against " + short_number(other);
  row.verdict = ours > other ? Verdict::met : Verdict::missed;
}

Comparison described(const Json& entry) {
  Comparison row;
  row.id = entry.at("id").get<std::string>();
  row.source = entry.at("source").get<std::string>();
  row.quantity = entry.at("quantity").get<std::string>();
  row.unit = entry.value("unit", "");
  row.statement = entry.value("statement", "");
  row.kind = entry.at("kind").get<std::string>();
  if (row.kind == "value") {
    const Json& published = entry.at("published");
    if (published.is_array())
      row.published = std::pair(published.at(0).get<double>(), published.at(1).get<double>());
    else
      row.published = published.get<double>();
    const Json& tolerance = entry.at("tolerance");
    row.relative = tolerance.contains("relative");
    row.tolerance = tolerance.at(row.relative ? "relative" : "absolute").get<double>();
  } else {
    row.published = row.kind == "trend" ? entry.at("published").get<std::string>() : "greater";
    std::vector<std::string> values;
    for (const Json& value : entry.value("published_values", Json::array()))
      values.push_back(shortest(value.get<double>()));
    row.published_detail = joined(values, " → ");
  }
  return row;
}

bool optional_and_absent(const StudyResult& study, const Json& entry) {
  return entry.value("optional", false) && entry.at("of").contains("case") &&
         !has_case(study, case_id(entry.at("of"), {}));
}

void compare_entry(const StudyResult& study, const Json& entry, std::vector<Comparison>& rows) {
  const auto scenarios = entry.at("scenarios").get<std::vector<std::string>>();
  if (std::ranges::find(scenarios, study.scenario->name()) == scenarios.end()) return;
  if (optional_and_absent(study, entry)) return;
  Comparison row = described(entry);
  try {
    if (row.kind == "value")
      compare_value(study, entry, row);
    else if (row.kind == "trend")
      compare_trend(study, entry, row);
    else if (row.kind == "greater")
      compare_greater(study, entry, row);
    else
      throw dem::EnvironmentError("unknown kind '" + row.kind + "' of published number " + row.id);
  } catch (const NotComputed& reason) {
    row.detail = reason.why;
  }
  rows.push_back(std::move(row));
}

/// Gives every file of the study's model to `use`, by name; none for a rock that the papers are not about.
template <class Use>
void read_papers(const StudyResult& study, const std::filesystem::path& folder, const Use& use) {
  if (!of_published_rock(study)) return;
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& paper : std::filesystem::directory_iterator(folder)) {
      if (const auto file = paper.path() / "published.json"; std::filesystem::exists(file)) files.push_back(file);
    }
  }
  std::ranges::sort(files);
  for (const auto& file : files) {
    try {
      const Json json = Json::parse(dem::read_file(file));
      if (json.at("model").get<std::string>() == study.scenario->model()) use(json);
    } catch (const Json::exception& error) {
      throw dem::EnvironmentError("papers/" + file.parent_path().filename().string() +
                                  "/published.json cannot be read: " + error.what());
    }
  }
}

}  // namespace

std::string_view verdict_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::met:
      return "met";
    case Verdict::missed:
      return "missed";
    case Verdict::not_computed:
      break;
  }
  return "not computed";
}

Comparisons compare(const StudyResult& study, const std::filesystem::path& papers) {
  Comparisons all;
  read_papers(study, papers, [&](const Json& paper) {
    const std::size_t before = all.rows.size();
    for (const Json& entry : paper.at("numbers")) compare_entry(study, entry, all.rows);
    if (all.rows.size() == before) return;
    all.paper += (all.paper.empty() ? "" : "; ") + paper.at("paper").get<std::string>();
    all.scale = paper.value("scale", "paper");
  });
  return all;
}

std::vector<PublishedNumber> published_numbers(const StudyResult& study,
                                               const std::filesystem::path& papers) {
  std::vector<PublishedNumber> all;
  read_papers(study, papers, [&](const Json& paper) {
    const auto add = [&](const Json& entry) {
      const Json& published = entry.at("published");
      const bool range = published.is_array();
      all.push_back({entry.at("id").get<std::string>(), entry.at("source").get<std::string>(),
                     entry.at("quantity").get<std::string>(), entry.value("unit", ""),
                     (range ? published.at(0) : published).get<double>(),
                     (range ? published.at(1) : published).get<double>()});
    };
    for (const Json& entry : paper.at("numbers")) {
      if (entry.at("kind").get<std::string>() == "value") add(entry);
    }
    for (const Json& entry : paper.value("quoted", Json::array())) add(entry);
  });
  return all;
}

}  // namespace reports
