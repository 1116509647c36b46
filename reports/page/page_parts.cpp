#include "reports/page/page_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>

#include "engine/analysis/ledger.h"
#include "engine/analysis/statistics.h"
#include "engine/core/files.h"
#include "engine/model/quantities.h"
#include "reports/granite.h"
#include "reports/page/page.h"
#include "reports/page/page_tables.h"
#include "reports/provenance.h"
#include "reports/published/laboratory.h"
#include "reports/text.h"

namespace reports {
namespace {

/// Cases with a record, by test, in report order.
std::vector<std::pair<std::string, std::vector<const CaseResult*>>> by_test(const StudyResult& study) {
  std::vector<std::pair<std::string, std::vector<const CaseResult*>>> groups;
  for (const CaseResult& result : study.cases) {
    if (!result.record) continue;
    const std::string test = words(result.test());
    auto group = std::ranges::find(groups, test, [](const auto& g) { return g.first; });
    if (group == groups.end()) group = groups.insert(groups.end(), {test, {}});
    group->second.push_back(&result);
  }
  return groups;
}

using analysis::Repeats;  // a column of the results

/// Of all repeats that have the result.
std::vector<double> values_of(const Repeats& repeats, std::string_view id) {
  std::vector<double> values;
  for (const CaseResult* result : repeats) {
    if (const double* value = result->record->find_result(id)) values.push_back(*value);
  }
  return values;
}

/// In its shown unit, without it; in powers of ten where another value of its row needs them.
std::string shown_result(const dem::Quantity& quantity, double value, bool powers = false) {
  if (!std::isfinite(value)) return "–";
  if (quantity.kind == dem::QuantityKind::count && std::floor(value) == value) return count(value);
  return powers ? scientific(quantity.factor * value, quantity.digits)
                : number(quantity.factor * value, quantity.digits);
}

/// "46.794 × 10⁶ N/m", "206.8 MPa".
std::string with_unit(const std::string& amount, const std::string& unit) {
  return unit.empty() ? amount : amount + (unit.starts_with("10") ? " × " : " ") + unit;
}

// Those of the first case, and of the first whose specimen has another form.
std::string specimen_text(const StudyResult& study) {
  std::string text, said;
  std::size_t least = std::numeric_limits<std::size_t>::max(), most = 0;
  for (const CaseResult& result : study.cases) {
    const dem::Table* particles = result.record ? result.record->find("particles") : nullptr;
    if (!particles) continue;
    least = std::min(least, particles->rows());
    most = std::max(most, particles->rows());
    const std::string size = texture::specimen_words(study, result);
    if (!text.empty() && (size == said || size.empty())) continue;
    const std::string shown =
        (size.empty() ? "" : size + ", ") + count(static_cast<double>(particles->rows())) + " particles";
    text += (text.empty() ? "" : "; ") + shown;
    if (!said.empty()) break;
    said = size;
  }
  // Blocks without a form of their own differ in their number.
  if (said.empty() && least < most)
    return count(static_cast<double>(least)) + " to " + count(static_cast<double>(most)) + " particles";
  return text;
}

std::string published_text(const Comparison& row) {
  if (const auto* text = std::get_if<std::string>(&row.published)) return *text;
  if (const auto* range = std::get_if<std::pair<double, double>>(&row.published)) {
    return with_unit(shortest(range->first) + " to " + shortest(range->second), row.unit);
  }
  return with_unit(shortest(std::get<double>(row.published)), row.unit);
}

// Three significant digits, or as many as the published number has.
std::string computed_text(const Comparison& row) {
  if (!row.computed) return "–";
  if (const auto* text = std::get_if<std::string>(&*row.computed)) return *text;
  const double ours = std::get<double>(*row.computed);
  std::size_t digits = 3;
  if (const auto* published = std::get_if<double>(&row.published)) {
    const bool whole = std::floor(*published) == *published && std::floor(ours) == ours;
    if (whole && row.unit.empty()) return count(ours);
    const std::string text = shortest(*published);
    const auto figures =
        static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return c >= '0' && c <= '9'; }));
    if (std::abs(*published) >= 1) digits = std::max(digits, figures);
    // Of a count, ours is a mean of seeds: no more than one decimal.
    if (row.unit.empty() && std::floor(*published) == *published && std::abs(*published) >= 100 && std::abs(ours) >= 1)
      digits = std::min(digits, static_cast<std::size_t>(std::floor(std::log10(std::abs(ours)))) + 2);
  }
  return with_unit(number(ours, static_cast<int>(digits)), row.unit);
}

std::string joined_notes(const std::vector<std::string>& notes) {
  std::vector<std::string> said;
  for (const std::string& note : notes) {
    if (!note.empty()) said.push_back(note);
  }
  return joined(said, " ");
}

// Of a share of something, "%" becomes points.
std::string difference_unit(const std::string& unit) { return unit == "%" ? "points" : unit; }

std::string deviation_text(const Comparison& row) {
  if (!row.deviation) return "–";
  if (*row.deviation == 0 && std::holds_alternative<std::pair<double, double>>(row.published)) return "within";
  if (row.relative) return with_sign(fixed(100 * *row.deviation, 1)) + " %";
  return with_unit(with_sign(number(*row.deviation, 2)), difference_unit(row.unit));
}

std::string tolerance_text(const Comparison& row) {
  if (!row.tolerance) return row.estimate && row.estimate->has_interval() ? "by interval" : "–";
  constexpr double rounding = 1e-6;  // a tolerance that lets only rounding pass
  if (*row.tolerance <= rounding) return "none";
  if (row.relative) return "± " + shortest(100 * *row.tolerance) + " %";
  return with_unit("± " + shortest(*row.tolerance), difference_unit(row.unit));
}

double last_finite(std::span<const double> values) {
  for (std::size_t i = values.size(); i-- > 0;) {
    if (std::isfinite(values[i])) return values[i];
  }
  return 0;
}

/// Parts of at most `widest` members, as even as can be: where each begins, and how many it has.
std::vector<std::pair<std::size_t, std::size_t>> even_parts(std::size_t members, std::size_t widest) {
  std::vector<std::pair<std::size_t, std::size_t>> parts;
  const std::size_t count = (members + widest - 1) / widest;
  for (std::size_t left = count, from = 0; left > 0; --left) {
    const std::size_t share = (members - from + left - 1) / left;
    parts.emplace_back(from, share);
    from += share;
  }
  return parts;
}

/// Heads that would stand in many narrow lines become letters, in a table that begins with column `from`; what these mean: "A: AR 1; B: AR 1, growth most contacts."
std::string shorten_heads(std::vector<std::string>& heads, std::size_t from) {
  constexpr std::size_t few = 4, longest = 24;
  const bool wide = std::ranges::any_of(heads, [](const std::string& head) { return head.size() > longest; });
  if (heads.size() < few || !wide) return {};
  std::vector<std::string> meanings;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    const std::string letter(1, static_cast<char>('A' + (from + i) % 26));
    meanings.push_back(letter + ": " + heads[i]);
    heads[i] = letter;
  }
  return joined(meanings, "; ") + ".";
}

/// Cases of one test that have a ledger, and their largest energy: all tables of a test have one unit.
struct Ledgers {
  std::vector<const CaseResult*> cases;
  double largest = 0;
};

Ledgers ledgers_of(const std::vector<const CaseResult*>& group) {
  Ledgers all;
  for (const CaseResult* result : group) {
    const dem::Table* history = result->record->find("history");
    if (!history || analysis::ledger_terms(*history).empty()) continue;
    all.cases.push_back(result);
    for (const analysis::LedgerTerm& term : analysis::ledger_terms(*history)) {
      all.largest = std::max(all.largest, std::abs(last_finite(history->real(term.column))));
    }
  }
  return all;
}

PageData ledger_table(const StudyResult& study, std::span<const CaseResult* const> kept, std::size_t from,
                      double largest, const std::string& test) {
  const bool bare = analysis::in_elastic_constants(kept.front()->record->table("history"));
  const auto [factor, unit] = bare ? std::pair<double, std::string>{1e6, "10⁻⁶ k box²"} : energy_unit(largest);
  std::vector<std::string> heads;
  for (const CaseResult* result : kept) heads.push_back(case_label(study, *result));
  const std::string key = shorten_heads(heads, from);
  PageData rows = new_list();
  const auto add = [&rows](const std::string& label, const std::vector<std::string>& values, bool strong) {
    PageData row = table_row(label, values);
    row.set("strong", strong);
    rows.push_back(row);
  };
  // Decimals for the largest value, so that a column can be added up; what is less shows as nearly nothing.
  const double most = factor * largest;
  const int places = most > 0 ? std::max(0, 4 - static_cast<int>(std::floor(std::log10(most)))) : 4;
  const auto cell = [&](double value) {
    const bool nearly_nothing = value != 0 && std::abs(factor * value) < 0.5 * std::pow(10.0, -places);
    return nearly_nothing ? "≈ 0" : value == 0 ? "0" : fixed(factor * value, places);
  };
  std::vector<double> left(kept.size(), 0);  // work less all the rest
  bool residual = false;
  for (const analysis::LedgerTerm& term : analysis::ledger_terms(kept.front()->record->table("history"))) {
    std::vector<std::string> values;
    bool some = false;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const dem::Table& history = kept[i]->record->table("history");
      const double value = history.has(term.column) ? last_finite(history.real(term.column)) : 0;
      values.push_back(history.has(term.column) ? cell(value) : "–");
      some = some || value != 0;
      left[i] += term.role == analysis::LedgerTerm::Role::work    ? value
                 : term.role == analysis::LedgerTerm::Role::share ? -value
                                                                  : 0;
    }
    residual = residual || term.role == analysis::LedgerTerm::Role::residual;
    if (bare && !some) continue;  // walls that hold, or no grain that grows
    add(term.label, values, term.role != analysis::LedgerTerm::Role::share);
  }
  if (!residual) {
    std::vector<std::string> values;
    for (const double value : left) values.push_back(cell(value));
    add("Residual", values, true);
  }
  PageData table;
  table.set("test", capital(test));
  table.set("unit", unit);
  table.set("key", key);
  table.set("lettered", !key.empty());
  table.set("heads", cells(heads));
  table.set("rows", rows);
  return table;
}

}  // namespace

/// Whether the cases differ in a parameter: what all have alike is in the scenario.
bool varies(const StudyResult& study, std::string_view parameter) {
  std::set<std::string> values;
  for (const CaseResult& result : study.cases) {
    if (const auto* value = dem::find_value(result.parameters, parameter)) values.insert(parameter_text(*value));
  }
  return values.size() > 1;
}

std::string case_label(const StudyResult& study, const CaseResult& result) {
  const dem::Parameters& first = study.cases.front().parameters;
  std::vector<std::string> parts;
  std::string aspect;  // what stands for a case that nothing sets apart
  for (const auto& [id, value] : result.parameters) {
    if (id == "test") continue;
    const dem::Parameter& parameter = dem::find_parameter(study.parameters, id);
    const auto* usual = dem::find_value(first, id);
    const std::string part = parameter_words(parameter, value);
    if (parameter.axis && aspect.empty()) aspect = part;
    const bool told = parameter.axis ? varies(study, id) : parameter.symbol.empty() || !usual || *usual != value;
    if (told && !part.empty()) parts.push_back(part);
  }
  if (parts.empty() && !aspect.empty()) parts.push_back(aspect);
  return parts.empty() ? capital(words(result.id)) : joined(parts, ", ");
}

PageData title_data(const StudyResult& study, const ReportOptions& options) {
  const dem::Scenario& scenario = *study.scenario;
  PageData data;
  data.set("title", scenario.text("title").empty() ? capital(words(scenario.name())) : scenario.text("title"));
  data.set("description", scenario.text("description"));
  data.set("has_description", !scenario.text("description").empty());
  data.set("scenario", scenario.name());
  data.set("model", words(scenario.model()));
  data.set("scale", scenario.scale());
  data.set("seed", std::to_string(scenario.seed()));
  data.set("engine_version", options.engine_version);
  const std::string specimen = specimen_text(study);
  data.set("has_specimen", !specimen.empty());
  data.set("specimen", specimen);
  const Provenance origin = provenance_of(study, options.engine_version);
  data.set("has_physics", !origin.physics_version.empty());
  data.set("physics_version", origin.physics_version);
  data.set("scenario_sha256", origin.scenario_sha256);
  const auto done = std::ranges::count_if(study.cases, [](const CaseResult& c) { return c.record != nullptr; });
  data.set("case_count", static_cast<std::size_t>(done) == study.cases.size()
                             ? fmt::format("{}", done)
                             : fmt::format("{} of {}", done, study.cases.size()));
  return data;
}

PageData cases_data(const StudyResult& study) {
  PageData list = new_list();
  std::vector<const CaseResult*> all;
  for (const CaseResult& result : study.cases) all.push_back(&result);
  for (const Repeats& repeats : analysis::repeats_of(all)) {
    const CaseResult& result = *repeats.front();
    PageData row;
    row.set("id", result.id);
    row.set("failed", !result.record);
    if (result.record) {
      const dem::Record& record = *result.record;
      std::vector<std::string> parameters;
      for (const auto& [id, value] : result.parameters) {
        const bool said = id == "test" || !varies(study, id) || (id == "seed" && repeats.size() > 1);
        const std::string part = said ? "" : parameter_words(dem::find_parameter(study.parameters, id), value);
        if (!part.empty()) parameters.push_back(part);
      }
      if (parameters.empty()) {  // nothing sets the cases apart: what all have alike
        for (const auto& [id, value] : result.parameters) {
          if (id == "test" || id == "seed") continue;
          const dem::Parameter& parameter = dem::find_parameter(study.parameters, id);
          const std::string part = parameter.symbol.empty() ? "" : parameter_words(parameter, value);
          if (!part.empty()) parameters.push_back(part);
        }
      }
      if (repeats.size() > 1) {
        std::vector<std::string> seeds;
        for (const CaseResult* one : repeats) {
          if (one->record) seeds.push_back(std::to_string(one->record->seed));
        }
        parameters.push_back("seeds " + listed(seeds));
      }
      row.set("test", words(result.test()));
      row.set("parameters", joined(parameters, ", "));
      using namespace dem::quantity;
      for (const dem::Quantity& size : {particles, contacts, grains, steps}) {
        row.set(std::string(size.id), record.has(size) ? count(record.value(size)) : "–");
      }
      row.set("seed", std::to_string(record.seed));
    } else {
      row.set("error", result.error.empty() ? "not run" : result.error);
    }
    list.push_back(row);
  }
  return list;
}

namespace {

// In the middle of a sentence.
std::string check_name(std::string_view id) { return id == "quasi_static" ? "quasi-static loading" : words(id); }

}  // namespace

bool checks_held(const StudyResult& study) {
  return std::ranges::all_of(study.cases, [](const CaseResult& result) {
    return !result.record || std::ranges::all_of(result.record->checks, &dem::Check::held);
  });
}

std::string checks_summary(const StudyResult& study) {
  std::size_t checks = 0, broken_checks = 0;
  std::vector<std::pair<std::string, std::vector<std::string>>> broken;  // by check
  for (const CaseResult& result : study.cases) {
    if (!result.record) continue;
    for (const dem::Check& check : result.record->checks) {
      ++checks;
      if (check.held) continue;
      ++broken_checks;
      auto group = std::ranges::find(broken, check.id, [](const auto& g) { return g.first; });
      if (group == broken.end()) group = broken.insert(broken.end(), {check.id, {}});
      group->second.push_back(result.id);
    }
  }
  if (checks == 0) return {};
  if (broken.empty()) {
    return checks == 1   ? "The check of the run held."
           : checks == 2 ? "Both checks of the runs held."
                         : fmt::format("All {} checks of the runs held.", checks);
  }
  std::vector<std::string> parts;
  for (const auto& [check, cases] : broken) parts.push_back(check_name(check) + " (" + joined(cases, ", ") + ")");
  return fmt::format("{} of {} checks did not hold: {}.", broken_checks, checks, joined(parts, "; "));
}

namespace {

// "Missed most: UCS, AR 1 (−20.0 %) and ...": what is missed, the largest relative deviations first.
std::string missed_text(const Comparisons& comparisons) {
  constexpr std::size_t named = 4;
  std::vector<const Comparison*> missed;
  for (const Comparison& row : comparisons.rows) {
    if (row.role == Role::number && row.verdict == Verdict::missed) missed.push_back(&row);
  }
  if (missed.empty()) return {};
  // In tolerances: comparable among units.
  std::ranges::stable_sort(missed, std::greater{}, [](const Comparison* row) {
    return row->deviation && row->tolerance && *row->tolerance > 0 ? std::abs(*row->deviation) / *row->tolerance : 0.0;
  });
  std::vector<std::string> parts;
  for (const Comparison* row : missed) {
    if (parts.size() == named) break;
    parts.push_back(row->quantity + (row->deviation ? " (" + deviation_text(*row) + ")" : ""));
  }
  const bool all = parts.size() == missed.size();
  return (all ? "Missed: " : "Missed by most: ") + joined(parts, "; ") + ".";
}

}  // namespace

namespace {

// In the middle of a sentence; names of people keep their capital.
std::string lower(std::string text) {
  const bool of_a_person = std::string_view(text).substr(0, text.find(' ')).ends_with("’s");
  if (!of_a_person && text.size() > 1 && text[0] >= 'A' && text[0] <= 'Z' && text[1] >= 'a' && text[1] <= 'z')
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

// What the first case of each test gave, as the mean of its seeds: "Compression, AR 1: Young’s modulus 68.2 GPa, ...".
std::string headline(const StudyResult& study) {
  constexpr std::size_t most = 3;  // results of a test
  std::vector<std::string> tests;
  for (const auto& [test, group] : by_test(study)) {
    const Repeats repeats = analysis::repeats_of(group).front();
    const CaseResult& first = *repeats.front();
    std::vector<std::string> ids;
    for (const auto& [id, value] : first.record->results) ids.push_back(id);
    std::ranges::stable_partition(ids, [](const auto& id) { return id.find("strength") != std::string::npos; });
    std::vector<std::string> said;
    for (const std::string& id : ids) {
      const dem::Quantity& quantity = dem::find_quantity(study.quantities, id);
      const double value = analysis::spread(values_of(repeats, id)).mean;
      if (quantity.kind != dem::QuantityKind::result || quantity.family() || quantity.of_size || !std::isfinite(value))
        continue;
      if (said.size() == most) break;
      const std::string_view unit = quantity.shown_unit();
      said.push_back(lower(std::string(quantity.name)) + " " + shown_result(quantity, value) +
                     (unit.empty() ? "" : " " + std::string(unit)));
    }
    if (said.empty()) continue;
    const std::string label = case_label(study, first);
    const bool alone = label == capital(words(first.id));
    tests.push_back((tests.empty() ? capital(test) : test) + (alone ? "" : ", " + label) +
                    (repeats.size() > 1 ? fmt::format(", mean of {} seeds: ", repeats.size()) : ": ") + listed(said));
  }
  return tests.empty() ? "" : joined(tests, "; ") + ".";
}

// Which figures agree with what is published, which do not.
PageData agreement_parts(const std::vector<DrawnFigure>& figures, const std::string& elsewhere) {
  PageData parts = new_list();
  bool first = true;
  for (const auto& [agreement, what] : {std::pair{Agreement::agrees, "In agreement with what is published:"},
                                        {Agreement::disagrees, "In disagreement:"},
                                        {Agreement::undecided, "Undecided:"}}) {
    std::vector<const DrawnFigure*> those;
    for (const DrawnFigure& figure : figures) {
      if (figure.agreement == agreement && !figure.expected) those.push_back(&figure);
    }
    if (those.empty()) continue;
    PageData links = new_list();
    for (std::size_t i = 0; i < those.size(); ++i) {
      PageData link;
      link.set("before", i == 0 ? "" : i + 1 == those.size() ? " and " : ", ");
      link.set("figure_id", std::string(those[i]->figure->id));
      link.set("figure_number", std::to_string(those[i]->number));
      links.push_back(link);
    }
    PageData part;
    // At another scale the first words name it.
    part.set("what", first && !elsewhere.empty() ? "At " + elsewhere + " scale, " + lower(what) : what);
    first = false;
    part.set("links", links);
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

PageData findings_data(const StudyResult& study, const Comparisons& comparisons,
                       const std::vector<DrawnFigure>& figures) {
  PageData list = new_list();
  const auto add = [&](const std::string& text, const std::string& state, PageData parts = new_list()) {
    PageData item;
    item.set("text", text);
    item.set("state", state);
    item.set("parts", parts);
    list.push_back(item);
  };
  for (const CaseResult& result : study.cases) {
    if (!result.record && !result.error.empty()) add("Case " + result.id + " failed: " + result.error, "bad");
  }
  const std::string results = headline(study);
  if (!results.empty()) add(results, "plain");
  if (!comparisons.rows.empty()) {
    const Tally counts = comparisons.tally();
    add(joined_notes({tally_text(counts, comparisons.scale), missed_text(comparisons)}), counts.missed > 0 ? "bad"
                                                                                         : counts.met > 0  ? "good"
                                                                                                           : "plain");
  }
  if (const std::vector<LaboratoryRow> rows = beside_laboratory(study); !rows.empty()) {
    const bool outside = std::ranges::count(rows, Verdict::missed, &LaboratoryRow::verdict) > 0;
    const bool within = std::ranges::count(rows, Verdict::met, &LaboratoryRow::verdict) > 0;
    add(laboratory_tally(rows), outside ? "bad" : within ? "good" : "plain");
  }
  if (std::ranges::any_of(figures, [](const DrawnFigure& f) { return f.agreement && !f.expected; })) {
    const bool judged = comparisons.scale.empty() || comparisons.scale == study.scenario->scale();
    add("", "plain", agreement_parts(figures, judged ? "" : study.scenario->scale()));
  }
  if (const std::string checks = checks_summary(study); !checks.empty())
    add(checks, checks_held(study) ? "good" : "bad");
  return list;
}

namespace {

// "15.8 ± 0.6", "1.020 ± 0.002", "(1.7 ± 0.4) × 10⁻⁵": both with the decimals of the mean's digits, or as many as the first
// digit of the deviation needs.
std::string mean_text(const dem::Quantity& quantity, const analysis::Spread& spread, bool powers) {
  const double mean = quantity.factor * spread.mean, deviation = std::abs(quantity.factor) * spread.deviation;
  const auto exponent = [](double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); };
  if (powers && mean != 0) {
    const double unit = std::pow(10.0, exponent(mean));
    const int places = std::max(quantity.digits - 1, -exponent(deviation / unit));
    return fmt::format("({} ± {}) × {}", fixed(mean / unit, places), fixed(deviation / unit, places),
                       power_of_ten(exponent(mean)));
  }
  const bool counted = quantity.kind == dem::QuantityKind::count;
  const int of_mean = mean == 0 || (counted && std::abs(mean) >= 10) ? 0
                      : counted                                      ? 1
                                : std::max(0, quantity.digits - 1 - exponent(mean));
  const int places = std::max({0, of_mean, -exponent(deviation)});
  return fixed(mean, places) + " ± " + fixed(deviation, places);
}

// The value of one case, or mean and standard deviation of several.
std::string result_text(const Repeats& column, std::string_view id, const dem::Quantity& quantity, bool powers) {
  const analysis::Spread spread = analysis::spread(values_of(column, id));
  if (spread.count == 0) return "–";
  if (spread.deviation == 0 || !std::isfinite(spread.deviation)) return shown_result(quantity, spread.mean, powers);
  return mean_text(quantity, spread, powers);
}

// Of those that figures do not show: families have as many members as the specimen has groups.
std::vector<std::string> results_of(const std::vector<const CaseResult*>& group, const StudyResult& study,
                                    bool diagnostics) {
  std::vector<std::string> ids;
  for (const CaseResult* result : group) {
    for (const auto& [id, value] : result->record->results) {
      const dem::Quantity& quantity = dem::find_quantity(study.quantities, id);
      if (quantity.family() || (quantity.kind != dem::QuantityKind::result) != diagnostics) continue;
      if (std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
    }
  }
  return ids;
}

}  // namespace

PageData results_data(const StudyResult& study, bool diagnostics) {
  PageData tables = new_list();
  for (const auto& [test, group] : by_test(study)) {
    const std::vector<Repeats> columns = analysis::repeats_of(group);
    const bool repeated = columns.size() < group.size();
    const std::size_t widest = repeated ? 4 : 8;  // columns that fit on a page
    const std::vector<std::string> ids = results_of(group, study, diagnostics);
    if (ids.empty()) continue;
    for (const auto& [from, members] : even_parts(columns.size(), widest)) {
      const std::span<const Repeats> shown(columns.data() + from, members);
      std::vector<std::string> heads;
      for (const Repeats& column : shown) {
        heads.push_back(case_label(study, *column.front()) +
                        (column.size() > 1 ? fmt::format(" ({} seeds)", column.size()) : ""));
      }
      const std::string key = shorten_heads(heads, from);
      PageData rows = new_list();
      for (const std::string& id : ids) {
        const dem::Quantity& quantity = dem::find_quantity(study.quantities, id);
        std::vector<std::string> values;
        const bool powers = std::ranges::any_of(group, [&](const CaseResult* one) {
          const double* value = one->record->find_result(id);
          return value && needs_powers(quantity.factor * *value);
        });
        for (const Repeats& column : shown) values.push_back(result_text(column, id, quantity, powers));
        rows.push_back(table_row(axis_title(quantity), values));
      }
      PageData table;
      table.set("test", capital(test.empty() ? "results" : words(test)) + ".");
      table.set("key", joined_notes({repeated ? "Of several seeds, mean ± standard deviation." : "", key}));
      table.set("lettered", !key.empty());
      table.set("heads", cells(heads));
      table.set("rows", rows);
      tables.push_back(table);
    }
  }
  return tables;
}

namespace {

// What a row is, where it does not count as met or missed.
std::string role_text(const Comparison& row, const std::vector<Comparison>& rows) {
  switch (row.role) {
    case Role::fitted:
      return "Fitted: " + row.why;
    case Role::theory:
      return "Theory: " + row.why;
    case Role::follows: {
      std::vector<std::string> names;
      for (const std::string& id : row.of) {
        const auto other = std::ranges::find(rows, id, &Comparison::id);
        if (other != rows.end()) names.push_back("“" + other->quantity + "”");
      }
      return "Not counted: follows from " + (names.empty() ? "others" : listed(names)) + ".";
    }
    case Role::sensitivity:
    case Role::number:
      break;
  }
  return {};
}

std::string verdict_class(const Comparison& row) {
  const std::string state = row.verdict == Verdict::met         ? "met"
                            : row.verdict == Verdict::missed    ? "missed"
                            : row.verdict == Verdict::undecided ? "undecided"
                                                                : "open";
  return row.role == Role::number ? state : state + " apart " + std::string(role_word(row.role));
}

}  // namespace

PageData comparisons_data(const Comparisons& comparisons) {
  if (comparisons.rows.empty()) return PageData{PageData::type::list};
  PageData rows = new_list();
  for (const Comparison& row : comparisons.rows) {
    const bool reading = row.role == Role::sensitivity;
    const std::string role = role_text(row, comparisons.rows);
    PageData item;
    item.set("quantity", reading ? "— " + row.reading : row.quantity);
    item.set("source", reading ? "" : row.source);
    item.set("statement", joined_notes({row.statement, role}));
    item.set("has_statement", !row.statement.empty() || !role.empty());
    item.set("published_value", reading ? "" : published_text(row));
    item.set("published_detail", row.published_detail);
    item.set("has_published_detail", !reading && !row.published_detail.empty());
    // One against the other: both numbers say more than the word.
    const std::size_t both =
        row.kind == "greater" && row.computed ? std::min(row.detail.find("; "), row.detail.size()) : 0;
    const std::string detail = row.detail.substr(both == 0 ? 0 : std::min(both + 2, row.detail.size()));
    item.set("computed_value", both == 0 ? computed_text(row) : row.detail.substr(0, both));
    item.set("detail", detail);
    item.set("has_detail", !detail.empty());
    item.set("deviation", deviation_text(row));
    item.set("tolerance", reading ? "" : tolerance_text(row));
    // Another reading has no verdict of its own.
    item.set("verdict", reading ? "" : std::string(verdict_word(row.verdict)));
    item.set("has_verdict", !reading);
    item.set("role", row.role == Role::number || reading ? "" : std::string(role_word(row.role)));
    item.set("has_role", row.role != Role::number && !reading);
    item.set("verdict_class", verdict_class(row));
    rows.push_back(item);
  }
  PageData block;
  block.set("paper", comparisons.paper);
  block.set("published_scale", comparisons.scale);
  block.set("counts", tally_text(comparisons.tally(), comparisons.scale));
  block.set("rows", rows);
  PageData list = new_list();
  list.push_back(block);
  return list;
}

PageData laboratory_data(const StudyResult& study) {
  PageData list = new_list();
  const std::vector<LaboratoryRow> found = beside_laboratory(study);
  if (found.empty()) return list;
  PageData rows = new_list();
  for (const LaboratoryRow& row : found) {
    PageData item;
    item.set("quantity", laboratory_name(row.number));
    item.set("measured", laboratory_text(row.number));
    item.set("ours", row.ours ? number(row.ours->value, 4) : "–");
    std::string detail;
    if (row.ours && row.seeds > 0) detail = row.seeds == 1 ? "one seed" : fmt::format("mean of {} seeds", row.seeds);
    if (row.ours && row.ours->has_interval()) {
      detail += (detail.empty() ? "" : "; ") +
                fmt::format("95 % interval {} to {}", number(row.ours->low, 3), number(row.ours->high, 3));
    }
    item.set("detail", detail);
    item.set("has_detail", !detail.empty());
    item.set("deviation", row.ours && row.number.value != 0 ? with_sign(percent(row.ours->value / row.number.value - 1))
                                                            : std::string());
    item.set("verdict", std::string(laboratory_word(row.verdict)));
    item.set("verdict_class", row.verdict == Verdict::met         ? "met"
                              : row.verdict == Verdict::missed    ? "missed"
                              : row.verdict == Verdict::undecided ? "undecided"
                                                                  : "open");
    rows.push_back(item);
  }
  PageData block;
  block.set("counts", laboratory_tally(found));
  block.set("rows", rows);
  list.push_back(block);
  return list;
}

PageData ledger_data(const StudyResult& study) {
  constexpr std::size_t widest = 8;  // columns that fit on a page
  PageData list = new_list();
  for (const auto& [test, group] : by_test(study)) {
    const Ledgers all = ledgers_of(group);
    const std::span<const CaseResult* const> cases(all.cases);
    for (const auto& [from, count] : even_parts(cases.size(), widest))
      list.push_back(ledger_table(study, cases.subspan(from, count), from, all.largest, test));
  }
  return list;
}

PageData checks_data(const StudyResult& study) {
  // By check, so that its name and its meaning are said once.
  std::vector<std::pair<const CaseResult*, const dem::Check*>> all;
  for (const CaseResult& result : study.cases) {
    if (!result.record) continue;
    for (const dem::Check& check : result.record->checks) all.emplace_back(&result, &check);
  }
  std::ranges::stable_sort(all, {}, [](const auto& entry) { return entry.second->id; });
  PageData list = new_list();
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    const dem::Check& first = *all[begin].second;
    while (end < all.size() && all[end].second->id == first.id) ++end;
    const std::span members(all.data() + begin, end - begin);
    const bool powers = std::ranges::any_of(
        members, [](const auto& one) { return needs_powers(one.second->value) || needs_powers(one.second->limit); });
    const auto amount = [&](double value) { return powers ? scientific(value, 2) : number(value, 2); };
    PageData rows = new_list();
    for (const auto& [result, check] : members) {
      PageData item;
      item.set("case", result->id);
      item.set("value", amount(check->value));
      item.set("limit", amount(check->limit));
      item.set("verdict", check->held ? "held" : "broken");
      item.set("verdict_class", check->held ? "met" : "missed");
      rows.push_back(item);
    }
    PageData group;
    group.set("check", capital(check_name(first.id)));
    group.set("meaning", first.meaning);
    group.set("rows", rows);
    list.push_back(group);
  }
  return list;
}

PageData notes_data(const StudyResult& study) {
  std::vector<std::pair<std::string, std::vector<std::string>>> said;  // each note, with the cases that have it
  for (const CaseResult& result : study.cases) {
    if (!result.record) continue;
    for (const std::string& note : result.record->notes) {
      auto same = std::ranges::find(said, note, [](const auto& one) { return one.first; });
      if (same == said.end()) same = said.insert(said.end(), {note, {}});
      same->second.push_back(result.id);
    }
  }
  PageData list = new_list();
  for (const auto& [note, cases] : said) {
    PageData item;
    item.set("case", cases.size() > 1 && cases.size() == study.cases.size() ? "all cases" : joined(cases, ", "));
    item.set("note", note);
    list.push_back(item);
  }
  return list;
}

}  // namespace reports
