#include "reports/published/published.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "engine/analysis/statistics.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/published/papers.h"
#include "reports/published/terms.h"
#include "reports/text.h"

namespace reports {
namespace {

using Json = nlohmann::json;

// Counts as counts, measurements with four digits.
std::string short_number(double value) { return std::floor(value) == value ? count(value) : number(value, 4); }

void compare_value(const Terms& terms, const Json& entry, Comparison& row) {
  const Json& term = entry.at("of");
  double ours = 0;
  if (term.contains("fit")) {
    const analysis::Estimate estimate = terms.fitted(term);
    ours = estimate.value * term.value("times", 1.0);
    row.estimate = estimate;
    row.detail = estimate.has_interval()
                     ? fmt::format("95 % interval {} to {}", number(estimate.low), number(estimate.high))
                     : "as many points as unknowns: no interval";
  } else {
    const auto values = terms.values(term);
    const auto [mean, deviation, count] = analysis::spread(values);
    ours = mean;
    if (count > 1) row.detail = fmt::format("mean of {} seeds, standard deviation {}", count, number(deviation, 2));
  }
  row.computed = ours;
  const auto* range = std::get_if<std::pair<double, double>>(&row.published);
  const double near = range ? std::clamp(ours, range->first, range->second) : std::get<double>(row.published);
  row.deviation = row.relative ? (ours - near) / near : ours - near;
  row.verdict = std::abs(*row.deviation) <= *row.tolerance ? Verdict::met : Verdict::missed;
}

// The sign of the least-squares slope; detail lists the values, means of repeats, and tells how sure the slope is. Steps that
// the scenario has no case for are left out, as long as two are left.
void compare_trend(const Terms& terms, const Json& entry, Comparison& row) {
  std::vector<double> ours, x, y;
  std::vector<std::string> absent;
  const auto axis = entry.at("over").items().begin();
  for (const Json& step : axis.value()) {
    const dem::Parameters at = {{axis.key(), step.get<double>()}};
    if (!terms.has_cases(entry.at("of"), at)) {
      absent.push_back(shortest(step.get<double>()));
      continue;
    }
    const auto values = terms.values(entry.at("of"), at);
    ours.push_back(analysis::spread(values).mean);
    for (const double value : values) {
      x.push_back(step.get<double>());
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

void compare_greater(const Terms& terms, const Json& entry, Comparison& row) {
  const double ours = terms.values(entry.at("of")).front();
  const double other = terms.values(entry.at("than")).front();
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

/// Whether a number concerns the study: by the topics of its scenario, or by its cases.
bool concerns(const StudyResult& study, const Terms& terms, const Json& entry) {
  const std::vector<std::string>& asked = study.scenario->texts("published");
  const auto topics = entry.at("topics").get<std::vector<std::string>>();
  const auto named = [&](const std::string& topic) { return std::ranges::find(asked, topic) != asked.end(); };
  if (!asked.empty() && std::ranges::none_of(topics, named)) return false;
  if (!asked.empty() && !entry.value("optional", false)) return true;
  if (!entry.contains("over")) {
    return terms.has_cases(entry.at("of")) && (!entry.contains("than") || terms.has_cases(entry.at("than")));
  }
  const auto axis = entry.at("over").items().begin();
  return std::ranges::count_if(axis.value(), [&](const Json& step) {
           return terms.has_cases(entry.at("of"), {{axis.key(), step.get<double>()}});
         }) > 1;
}

void compare_entry(const StudyResult& study, const Terms& terms, const Json& entry, std::vector<Comparison>& rows) {
  if (!concerns(study, terms, entry)) return;
  Comparison row = described(entry);
  try {
    if (row.kind == "value")
      compare_value(terms, entry, row);
    else if (row.kind == "trend")
      compare_trend(terms, entry, row);
    else if (row.kind == "greater")
      compare_greater(terms, entry, row);
    else
      throw dem::EnvironmentError("unknown kind '" + row.kind + "' of published number " + row.id);
  } catch (const NotComputed& reason) {
    row.detail = reason.why;
  }
  rows.push_back(std::move(row));
}

/// Gives the numbers of every paper that the study is about to `use`.
template <class Use>
void read_papers(const StudyResult& study, const std::filesystem::path& folder, const Use& use) {
  if (!study.of_a_paper) return;
  for (const Paper& paper : papers_of(study.scenario->model(), folder)) {
    const std::filesystem::path file = paper.folder / "published.json";
    if (!std::filesystem::exists(file)) continue;
    const auto broken = [&](const std::exception& error) {
      return dem::EnvironmentError("papers/" + paper.folder.filename().string() +
                                   "/published.json cannot be read: " + error.what());
    };
    try {
      use(paper, Json::parse(dem::read_file(file)));
    } catch (const Json::exception& error) {
      throw broken(error);
    } catch (const std::logic_error& error) {  // a result, parameter or derived value that is not declared
      throw broken(error);
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
  const Terms terms(study);
  read_papers(study, papers, [&](const Paper& paper, const Json& published) {
    const std::size_t before = all.rows.size();
    for (const Json& entry : published.at("numbers")) compare_entry(study, terms, entry, all.rows);
    if (all.rows.size() == before) return;
    all.paper += (all.paper.empty() ? "" : "; ") + paper.name;
    all.scale = paper.scale;
  });
  return all;
}

std::vector<PublishedNumber> published_numbers(const StudyResult& study, const std::filesystem::path& papers) {
  std::vector<PublishedNumber> all;
  read_papers(study, papers, [&](const Paper&, const Json& paper) {
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
