#include "reports/published.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/text.h"

namespace reports {
namespace {

using Json = nlohmann::json;

/// Why a term has no value: said in the table instead of a number.
struct NotComputed {
  std::string why;
};

// Counts as counts, measurements with four digits.
std::string short_number(double value) { return std::floor(value) == value ? count(value) : number(value, 4); }

std::string case_id(const Json& term, const std::string& step) {
  std::string id = term.at("case").get<std::string>();
  const std::size_t place = id.find("{}");
  if (place != std::string::npos) id.replace(place, 2, step);
  return id;
}

const dem::Record& record_of(const StudyResult& study, const std::string& id) {
  const auto found = std::ranges::find(study.cases, id, &CaseResult::id);
  if (found == study.cases.end()) throw NotComputed{"no case " + id + " in this scenario"};
  if (!found->record) throw NotComputed{"case " + id + (found->error.empty() ? " was not run" : " failed")};
  return *found->record;
}

double value_of(const StudyResult& study, const Json& term, const std::string& step);

std::vector<double> values_of(const StudyResult& study, const Json& terms, const std::string& step) {
  std::vector<double> values;
  for (const Json& term : terms) values.push_back(value_of(study, term, step));
  return values;
}

double value_of(const StudyResult& study, const Json& term, const std::string& step) {
  double value = 0;
  if (term.contains("quotient")) {
    const auto parts = values_of(study, term.at("quotient"), step);
    if (parts.at(1) == 0) throw NotComputed{"division by zero"};
    value = parts.at(0) / parts.at(1);
  } else if (term.contains("difference")) {
    const auto parts = values_of(study, term.at("difference"), step);
    value = parts.at(0) - parts.at(1);
  } else if (term.contains("sum")) {
    for (const double part : values_of(study, term.at("sum"), step)) value += part;
  } else {
    const std::string id = case_id(term, step);
    const dem::Record& record = record_of(study, id);
    const std::string result = term.at("result").get<std::string>();
    if (!record.has_result(result)) throw NotComputed{"case " + id + " has no " + words(result)};
    value = record.result(result);
  }
  if (!std::isfinite(value)) throw NotComputed{"the result is not a number"};
  return value * term.value("times", 1.0);
}

void compare_value(const StudyResult& study, const Json& entry, Comparison& row) {
  const double ours = value_of(study, entry.at("of"), {});
  row.computed = ours;
  const auto* range = std::get_if<std::pair<double, double>>(&row.published);
  const double near = range ? std::clamp(ours, range->first, range->second) : std::get<double>(row.published);
  row.deviation = row.relative ? (ours - near) / near : ours - near;
  row.verdict = std::abs(*row.deviation) <= *row.tolerance ? Verdict::met : Verdict::missed;
}

// The sign of the least-squares slope over equally spaced steps; detail lists the values.
void compare_trend(const StudyResult& study, const Json& entry, Comparison& row) {
  std::vector<double> ours;
  for (const Json& step : entry.at("over")) ours.push_back(value_of(study, entry.at("of"), step.get<std::string>()));
  if (ours.size() < 2) throw NotComputed{"a trend needs two cases"};
  const double middle = 0.5 * static_cast<double>(ours.size() - 1);
  double slope = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) slope += (static_cast<double>(i) - middle) * ours[i];
  row.computed = std::string(slope > 0 ? "rises" : slope < 0 ? "falls" : "stays level");
  const bool steady = std::ranges::is_sorted(ours) || std::ranges::is_sorted(ours, std::greater{});
  std::vector<std::string> shown;
  for (const double value : ours) shown.push_back(short_number(value));
  row.detail = joined(shown, " → ") + (steady ? "" : ", not at every step");
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
    if (published.is_array()) row.published = std::pair(published.at(0).get<double>(), published.at(1).get<double>());
    else row.published = published.get<double>();
    const Json& tolerance = entry.at("tolerance");
    row.relative = tolerance.contains("relative");
    row.tolerance = tolerance.at(row.relative ? "relative" : "absolute").get<double>();
  } else {
    row.published = row.kind == "trend" ? entry.at("published").get<std::string>() : "greater";
    std::vector<std::string> values;
    for (const Json& value : entry.value("published_values", Json::array())) values.push_back(shortest(value.get<double>()));
    row.published_detail = joined(values, " → ");
  }
  return row;
}

bool optional_and_absent(const StudyResult& study, const Json& entry) {
  return entry.value("optional", false) && entry.at("of").contains("case") &&
         std::ranges::find(study.cases, case_id(entry.at("of"), {}), &CaseResult::id) == study.cases.end();
}

void compare_entry(const StudyResult& study, const Json& entry, std::vector<Comparison>& rows) {
  const auto scenarios = entry.at("scenarios").get<std::vector<std::string>>();
  if (std::ranges::find(scenarios, study.scenario->name()) == scenarios.end()) return;
  if (optional_and_absent(study, entry)) return;
  Comparison row = described(entry);
  try {
    if (row.kind == "value") compare_value(study, entry, row);
    else if (row.kind == "trend") compare_trend(study, entry, row);
    else if (row.kind == "greater") compare_greater(study, entry, row);
    else throw dem::EnvironmentError("unknown kind '" + row.kind + "' of published number " + row.id);
  } catch (const NotComputed& reason) {
    row.detail = reason.why;
  }
  rows.push_back(std::move(row));
}

}  // namespace

std::string_view verdict_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::met: return "met";
    case Verdict::missed: return "missed";
    case Verdict::not_computed: break;
  }
  return "not computed";
}

Comparisons compare(const StudyResult& study, const std::filesystem::path& published_folder) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(published_folder)) {
    for (const auto& file : std::filesystem::directory_iterator(published_folder)) {
      if (file.path().extension() == ".json") files.push_back(file.path());
    }
  }
  std::ranges::sort(files);
  Comparisons all;
  for (const auto& file : files) {
    try {
      const Json json = Json::parse(dem::read_file(file));
      if (json.at("model").get<std::string>() != study.scenario->model()) continue;
      const std::size_t before = all.rows.size();
      for (const Json& entry : json.at("numbers")) compare_entry(study, entry, all.rows);
      if (all.rows.size() == before) continue;
      all.paper += (all.paper.empty() ? "" : "; ") + json.at("paper").get<std::string>();
      all.scale = json.value("scale", "paper");
    } catch (const Json::exception& error) {
      throw dem::EnvironmentError("the published numbers in " + file.filename().string() +
                                  " cannot be read: " + error.what());
    }
  }
  return all;
}

}  // namespace reports
