// Results and energies, a table for each test.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/analysis/ending.h"
#include "engine/analysis/ledger.h"
#include "engine/analysis/peaks.h"
#include "engine/model/quantities.h"
#include "reports/page/page_cases.h"
#include "reports/page/page_parts.h"
#include "reports/page/page_tables.h"
#include "reports/text.h"

namespace reports {
namespace {

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

// An energy at the end of loading: a test that is followed further does more work, of which nothing else of the report tells.
double energy_at_end(const dem::Record& record, const std::string& column) {
  const auto values = record.table("history").real(column);
  return analysis::is_followed(record) ? values[analysis::end_of_loading(record)] : last_finite(values);
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
      all.largest = std::max(all.largest, std::abs(energy_at_end(*result->record, term.column)));
    }
  }
  return all;
}

PageData ledger_table(const StudyResult& study, std::span<const CaseResult* const> kept, std::size_t from,
                      double largest, const std::string& test) {
  const bool bare = analysis::in_elastic_constants(kept.front()->record->table("history"));
  const auto [factor, unit] = bare ? std::pair<double, std::string>{1e6, "10⁻⁶ k box²"} : energy_unit(largest);
  std::vector<std::string> heads;
  for (const CaseResult* result : kept) heads.push_back(case_label(study, *result, true));
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
      const double value = history.has(term.column) ? energy_at_end(*kept[i]->record, term.column) : 0;
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
  table.set("state",
            analysis::has_end_of_loading(*kept.front()->record) ? "at the end of loading" : "at the end of the test");
  table.set("key", key);
  table.set("lettered", !key.empty());
  table.set("heads", cells(heads));
  table.set("rows", rows);
  return table;
}

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
  // What is left of equal values after rounding is no scatter.
  const bool equal = spread.deviation <= 1e-12 * std::abs(spread.mean);
  if (equal || !std::isfinite(spread.deviation)) return shown_result(quantity, spread.mean, powers);
  return mean_text(quantity, spread, powers);
}

// What a result is called in a table of those columns.
std::string_view name_in(const dem::Quantity& quantity, std::span<const Repeats> columns) {
  std::vector<const dem::Record*> records;
  for (const Repeats& column : columns) {
    for (const CaseResult* result : column) {
      if (result->record->has(quantity)) records.push_back(result->record);
    }
  }
  return analysis::name_of(quantity, records);
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
        rows.push_back(table_row(axis_title(quantity, name_in(quantity, shown)), values));
      }
      PageData table;
      table.set("test", capital(test.empty() ? "results" : words(test)) + ".");
      table.set("key", joined_notes({repeated ? "Mean ± standard deviation over the seeds." : "", key}));
      table.set("lettered", !key.empty());
      table.set("heads", cells(heads));
      table.set("rows", rows);
      table.set("short", is_short(ids.size()));
      tables.push_back(table);
    }
  }
  return tables;
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

}  // namespace reports
