#include "reports/published/published.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/analysis/statistics.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/published/entries.h"
#include "reports/published/papers.h"
#include "reports/published/terms.h"
#include "reports/text.h"

namespace reports {
namespace {

using Json = nlohmann::json;

// Counts as counts, measurements with four digits.
std::string short_number(double value) { return std::floor(value) == value ? count(value) : number(value, 4); }

std::string interval_text(const analysis::Estimate& estimate, int digits = 3) {
  return fmt::format("95 % interval {} to {}", number(estimate.low, digits), number(estimate.high, digits));
}

Band band_of(const Comparison& row) {
  const auto* range = std::get_if<std::pair<double, double>>(&row.published);
  const auto [low, high] = range ? *range : std::pair(std::get<double>(row.published), std::get<double>(row.published));
  const auto reach = [&](double end) { return row.relative ? *row.tolerance * std::abs(end) : *row.tolerance; };
  return {low - reach(low), high + reach(high)};
}

void compare_value(const Terms& terms, const Json& term, Comparison& row) {
  analysis::Estimate ours;
  if (term.contains("fit")) {
    ours = terms.fitted(term);
    const double times = term.value("times", 1.0);
    for (double* part : {&ours.value, &ours.low, &ours.high}) *part *= times;
    const bool share = term.at("fit").get<std::string>().ends_with(".r_squared");
    if (ours.has_interval()) {
      row.detail = interval_text(ours) + " of the fit";
    } else if (!share) {
      row.detail = "no interval from so few points";
    }
  } else {
    const auto values = terms.values(term);
    ours = analysis::mean_of(values);
    const auto [mean, deviation, count] = analysis::spread(values);
    if (count > 1) row.detail = fmt::format("mean of {} seeds, standard deviation {}", count, number(deviation, 2));
    if (ours.has_interval()) row.detail += "; " + interval_text(ours);
  }
  row.estimate = ours;
  row.computed = ours.value;
  const auto* range = std::get_if<std::pair<double, double>>(&row.published);
  const double near = range ? std::clamp(ours.value, range->first, range->second) : std::get<double>(row.published);
  row.deviation = row.relative ? (ours.value - near) / near : ours.value - near;
  row.outcome = judge_value(ours.value, ours, band_of(row));
}

/// The slope of a trend: over seeds, where the cases have them, else through all points.
struct Slope {
  analysis::Estimate value;
  double p_value = std::nan("");
  std::string words;  ///< how sure it is
};

// Cases of one seed share their packing, so that each seed gives one slope, and it is these that scatter.
Slope paired_slope(const std::vector<double>& slopes) {
  const analysis::Trend trend = analysis::paired_trend(slopes);
  Slope all{trend.slope, trend.p_value, {}};
  const std::string each = number(all.value.value, 2);
  if (!all.value.has_interval()) {
    all.words = "slope " + each;
    return all;
  }
  all.words = fmt::format("slope {}, the mean of {} seeds ({}, p = {})", each, trend.seeds, interval_text(all.value, 2),
                          number(all.p_value, 2));
  return all;
}

Slope fitted_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto line = analysis::fit_line(x, y);
  if (!line) throw NotComputed{"a trend needs two different steps"};
  Slope all{line->slope, line->p_value, {}};
  if (all.value.has_interval()) {
    all.words = fmt::format("slope {} ({}, p = {})", number(all.value.value, 2), interval_text(all.value, 2),
                            number(all.p_value, 2));
  }
  return all;
}

// Detail lists the values, means of repeats, and tells how sure the slope is. Steps that the scenario has no case for are
// left out, as long as two are left. A change over all steps that is smaller than `resolution` of the values is undecided.
void compare_trend(const Terms& terms, const Json& entry, const Json& term, Comparison& row) {
  std::vector<double> means, x;
  std::vector<std::string> absent;
  std::map<double, std::vector<double>> of_seed;  // values step by step
  const auto axis = entry.at("over").items().begin();
  for (const Json& step : axis.value()) {
    const dem::Parameters at = {{axis.key(), step.get<double>()}};
    if (!terms.has_cases(term, at)) {
      absent.push_back(shortest(step.get<double>()));
      continue;
    }
    std::vector<double> values;
    for (const auto& [seed, value] : terms.by_seed(term, at)) {
      values.push_back(value);
      of_seed[seed].push_back(value);
    }
    means.push_back(analysis::spread(values).mean);
    x.push_back(step.get<double>());
  }
  if (x.size() < 2) {
    throw NotComputed{absent.empty() ? "a trend needs two cases"
                                     : "no cases at " + listed(absent) + " in this scenario"};
  }
  std::vector<double> slopes;
  for (const auto& [seed, values] : of_seed) {
    if (values.size() != x.size()) continue;  // not at every step
    if (const auto line = analysis::fit_line(x, values)) slopes.push_back(line->slope.value);
  }
  const Slope slope = terms.by_chance() ? paired_slope(slopes) : fitted_slope(x, of_seed.begin()->second);
  row.outcome = judge_sign(slope.value, std::get<std::string>(row.published) == "rises" ? 1 : -1, terms.by_chance());
  const std::string word = slope.value.value > 0 ? "rises" : slope.value.value < 0 ? "falls" : "stays level";
  const bool steady = std::ranges::is_sorted(means) || std::ranges::is_sorted(means, std::greater{});
  std::vector<std::string> shown;
  for (const double value : means) shown.push_back(short_number(value));
  row.detail = joined(shown, " → ") + (steady ? "" : ", not at every step");
  if (!absent.empty()) row.detail += "; not run: " + joined(absent, ", ");
  if (!slope.words.empty()) row.detail += "; " + slope.words;
  const double change = std::abs(slope.value.value * (x.back() - x.front()) / analysis::spread(means).mean);
  const double resolution = entry.value("resolution", 0.0);
  if (change < resolution) {
    row.outcome = Verdict::undecided;
    row.detail += fmt::format("; changes by {} of its mean, less than the {} change caused by halving the loading rate",
                              percent(change, 1), percent(resolution, 0));
  }
  const bool untold = terms.by_chance() && !slope.value.has_interval();
  row.computed = row.outcome != Verdict::undecided ? word : untold ? no_trend_text(slopes.size()) : "no clear trend";
  row.estimate = slope.value;
  row.p_value = slope.p_value;
}

// Two that are less apart than `resolution` of the larger are undecided.
void compare_greater(const Terms& terms, const Json& of, const Json& than, double resolution, Comparison& row) {
  const auto values = terms.values({{"difference", {of, than}}});
  const analysis::Estimate difference = analysis::mean_of(values);
  row.estimate = difference;
  row.outcome = judge_sign(difference, 1, terms.by_chance());
  row.computed = std::string(difference.value > 0 ? "greater" : difference.value < 0 ? "smaller" : "equal");
  const double one = analysis::spread(terms.values(of)).mean, other = analysis::spread(terms.values(than)).mean;
  // One notation for both.
  const bool powers = needs_powers(one) || needs_powers(other);
  const auto text = [&](double value) { return powers ? scientific(value, 4) : short_number(value); };
  row.detail = text(one) + " against " + text(other);
  if (difference.has_interval()) {
    row.detail += fmt::format("; difference {} ({})", number(difference.value, 2), interval_text(difference, 2));
  } else if (terms.by_chance()) {
    row.detail += "; " + seeds_text(values.size()) + ": no interval";
  }
  const double apart = std::abs(difference.value) / std::max(std::abs(one), std::abs(other));
  if (apart < resolution) {
    row.outcome = Verdict::undecided;
    row.computed = "no clear difference";
    row.detail += fmt::format("; {} apart, less than the {} change caused by halving the loading rate",
                              percent(apart, 1), percent(resolution, 0));
  }
}

Comparison described(const Json& entry) {
  Comparison row;
  row.id = entry.at("id").get<std::string>();
  row.source = entry.at("source").get<std::string>();
  row.quantity = entry.at("quantity").get<std::string>();
  row.unit = entry.value("unit", "");
  row.statement = entry.value("statement", "");
  row.stated = entry.value("stated", "");
  row.derived = entry.value("derived", "");
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

/// Whether the study has the cases of a term of the entry: two steps at least, where it goes over several.
bool has_cases(const Terms& terms, const Json& entry, const Json& term) {
  if (!entry.contains("over")) return terms.has_cases(term);
  const auto axis = entry.at("over").items().begin();
  return std::ranges::count_if(axis.value(), [&](const Json& step) {
           return terms.has_cases(term, {{axis.key(), step.get<double>()}});
         }) > 1;
}

/// Whether a number concerns the study: by the topics of its scenario, or by its cases.
bool concerns(const StudyResult& study, const Terms& terms, const Json& entry) {
  const std::vector<std::string>& asked = study.scenario->texts("published");
  const auto topics = entry.at("topics").get<std::vector<std::string>>();
  const std::string scale = entry.value("scale", "any");
  if (scale != "any" && scale != study.scenario->scale()) return false;
  const auto named = [&](const std::string& topic) { return std::ranges::find(asked, topic) != asked.end(); };
  if (!asked.empty() && std::ranges::none_of(topics, named)) return false;
  if (!asked.empty() && !entry.value("optional", false)) return true;
  return has_cases(terms, entry, entry.at("of")) && (!entry.contains("than") || terms.has_cases(entry.at("than")));
}

/// Compares a row with what the terms of `what` give: of the entry, or of another reading of it.
void evaluate(const StudyResult& study, const Terms& terms, const Json& entry, const Json& what, Comparison& row) {
  const Json& term = what.at("of");
  const bool elsewhere = row.scale != "any" && row.scale != study.scenario->scale();
  try {
    if (row.kind == "value") {
      compare_value(terms, term, row);
    } else if (row.kind == "trend") {
      compare_trend(terms, entry, term, row);
    } else {
      compare_greater(terms, term, what.contains("than") ? what.at("than") : entry.at("than"),
                      entry.value("resolution", 0.0), row);
    }
    row.verdict = elsewhere ? Verdict::not_judged : row.outcome;
    // None is none in a specimen of any size.
    const bool none = std::get_if<double>(&row.published) && std::get<double>(row.published) == 0;
    const bool loading = entry.value("of_loading", false);
    if (elsewhere && row.kind == "value" && !none && (loading || terms.of_size(term))) {
      row.deviation.reset();
      row.detail += std::string(row.detail.empty() ? "" : "; ") +
                    (loading ? "follows the loading" : "grows with the specimen") + ": not compared at this scale";
    }
  } catch (const NotComputed& reason) {
    row.detail = reason.why;
  }
}

void compare_entry(const StudyResult& study, const Terms& terms, const Paper& paper, const Json& entry,
                   std::vector<Comparison>& rows) {
  if (!concerns(study, terms, entry)) return;
  Comparison row = described(entry);
  row.scale = entry.value("scale", paper.scale);
  const Declared declared = declared_role(entry);
  row.role = declared.role;
  row.why = declared.why;
  row.of = declared.of;
  std::vector<Comparison> all = {row};
  // A formula beside a formula: any case has the parameters that it is made of.
  const Terms any_case(study, Terms::Lacking::taken_from_any);
  evaluate(study, row.role == Role::theory ? any_case : terms, entry, entry, all.front());
  for (const Json& reading : entry.value("readings", Json::array())) {
    const Json& term = reading.at("of");
    if (!has_cases(terms, entry, term)) continue;
    Comparison other = row;
    other.id = reading.at("id").get<std::string>();
    other.reading = reading.at("reading").get<std::string>();
    other.role = Role::sensitivity;
    other.why.clear();
    other.of = {row.id};
    other.statement.clear();
    evaluate(study, terms, entry, reading, other);
    all.push_back(std::move(other));
  }
  for (Comparison& one : all) rows.push_back(std::move(one));
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
      const Json published = Json::parse(dem::read_file(file));
      check_entries(published);
      use(paper, published);
    } catch (const Json::exception& error) {
      throw broken(error);
    } catch (const std::logic_error& error) {  // a result, parameter or derived value that is not declared
      throw broken(error);
    }
  }
}

}  // namespace

Tally Comparisons::tally() const {
  Tally counts;
  for (const Comparison& row : rows) counts.add(row.role, row.verdict, row.kind == "trend");
  return counts;
}

Comparisons compare(const StudyResult& study, const std::filesystem::path& papers) {
  Comparisons all;
  const Terms terms(study);
  read_papers(study, papers, [&](const Paper& paper, const Json& published) {
    const std::size_t before = all.rows.size();
    for (const Json& entry : published.at("numbers")) compare_entry(study, terms, paper, entry, all.rows);
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
      const bool printed = !entry.contains("stated") && !entry.contains("derived");
      if (printed && entry.at("kind").get<std::string>() == "value") add(entry);
    }
    for (const Json& entry : paper.value("quoted", Json::array())) add(entry);
  });
  return all;
}

}  // namespace reports
