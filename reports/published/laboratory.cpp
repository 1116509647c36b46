#include "reports/published/laboratory.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/scenario/measured.h"
#include "engine/scenario/units.h"
#include "reports/published/terms.h"
#include "reports/text.h"

namespace reports {
namespace {

using Json = nlohmann::json;

void add_numbers(const StudyResult& study, const std::string& table, const std::string& mineral,
                 std::vector<LaboratoryNumber>& all) {
  const dem::Scenario& scenario = *study.scenario;
  for (const dem::Measurable& one : study.measurables) {
    const double unit = one.unit.empty() ? 1 : dem::to_si(1, one.unit);
    for (const dem::Measured& value : dem::measured(scenario, table + std::string(one.key))) {
      LaboratoryNumber number{
          .key = one.key, .name = one.name, .symbol = one.symbol, .unit = one.unit, .mineral = mineral};
      number.test = one.test;
      number.result = one.result;
      if (!one.by.empty()) number.result += scenario.text(table + std::string(one.by));
      number.fit = one.fit;
      number.pressure = value.at / dem::to_si(1, "MPa");
      number.value = value.value / unit;
      number.low = value.low / unit;
      number.high = value.high / unit;
      number.deviation = value.deviation / unit;
      number.is_range = !value.is_certain() && value.high - value.low > 2.5 * value.deviation;
      all.push_back(std::move(number));
    }
  }
}

/// Whether the study can have it at all: another program may know more tests than this one.
bool is_given(const StudyResult& study, const LaboratoryNumber& number) {
  return !number.fit.empty() ||
         std::ranges::any_of(study.quantities, [&](const dem::Quantity& q) { return q.covers(number.result); });
}

}  // namespace

std::vector<LaboratoryNumber> laboratory_numbers(const StudyResult& study) {
  std::vector<LaboratoryNumber> all;
  if (!study.scenario || study.measurables.empty()) return all;
  add_numbers(study, "measured.", "", all);
  for (std::size_t i = 0; i < study.scenario->count("mineral"); ++i) {
    const std::string entry = fmt::format("mineral[{}].", i);
    add_numbers(study, entry + "measured.", study.scenario->text(entry + "name"), all);
  }
  return all;
}

std::vector<LaboratoryRow> beside_laboratory(const StudyResult& study) {
  std::vector<LaboratoryRow> rows;
  const std::vector<LaboratoryNumber> numbers = laboratory_numbers(study);
  if (numbers.empty()) return rows;
  const Terms terms(study);
  for (const LaboratoryNumber& number : numbers) {
    LaboratoryRow row{.number = number, .ours = {}};
    try {
      if (!is_given(study, number)) throw NotComputed{};
      if (!number.fit.empty()) {
        row.ours = terms.fitted({{"fit", number.fit}, {"mineral", number.mineral}});
      } else {
        const std::vector<double> values = terms.values({{"test", number.test},
                                                         {"of", number.result},
                                                         {"mineral", number.mineral},
                                                         {"confining_pressure", number.pressure}});
        row.ours = analysis::mean_of(values);
        row.seeds = values.size();
      }
      row.verdict = number.deviation == 0 ? Verdict::not_judged
                                          : judge_value(row.ours->value, row.ours, {number.low, number.high});
    } catch (const NotComputed&) {
      row.ours.reset();
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string_view laboratory_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::met:
      return "within its uncertainty";
    case Verdict::missed:
      return "outside";
    case Verdict::undecided:
      return "undecided";
    case Verdict::not_judged:
      return "no uncertainty stated";
    case Verdict::not_computed:
      break;
  }
  return "not tested";
}

std::string laboratory_text(const LaboratoryNumber& number, bool with_unit) {
  std::string text = reports::shortest(std::stod(fmt::format("{:.6g}", number.value)));
  if (number.is_range) {
    text = fmt::format("{:.6g} to {:.6g}", number.low, number.high);
  } else if (number.deviation > 0) {
    text = fmt::format("{:.6g} ± {:.4g}", number.value, number.deviation);
  }
  return text + (with_unit && !number.unit.empty() ? " " + std::string(number.unit) : "");
}

std::string laboratory_name(const LaboratoryNumber& number) {
  std::string text(number.name);
  if (number.pressure > 0) text += " at σ₃ " + shortest(number.pressure) + " MPa";
  if (!number.mineral.empty()) text += " of " + number.mineral;
  return text;
}

bool is_small(const dem::Scenario& scenario) { return scenario.scale() == "smoke" || scenario.scale() == "draft"; }

std::string laboratory_source(const dem::Scenario& scenario) {
  const std::string source = scenario.text("measured.source");
  return source.empty() ? source : "Their source: " + source + ".";
}

std::string laboratory_tally(const std::vector<LaboratoryRow>& rows, const std::string& scale) {
  if (rows.empty()) return {};
  const auto counted = [&](Verdict verdict) { return std::ranges::count(rows, verdict, &LaboratoryRow::verdict); };
  std::vector<std::string> ours, others;
  const auto say = [&](Verdict verdict, std::string_view first, std::string_view later) {
    if (counted(verdict) > 0) ours.push_back(fmt::format("{} {}", ours.empty() ? first : later, counted(verdict)));
  };
  say(Verdict::met, "within the uncertainty of", "within that of");
  say(Verdict::missed, "outside the uncertainty of", "outside that of");
  say(Verdict::undecided, "undecided for", "undecided for");
  if (!ours.empty()) others.push_back("ours are " + listed(ours));
  const auto count_of = [&](Verdict verdict, std::string_view one, std::string_view many) {
    const auto number = counted(verdict);
    if (number > 0) others.push_back(fmt::format("{} {}", number, number > 1 ? many : one));
  };
  count_of(Verdict::not_judged, "has no stated uncertainty", "have no stated uncertainty");
  count_of(Verdict::not_computed, "is not tested here", "are not tested here");
  const std::string where = scale.empty() ? "Of " : "At " + scale + " scale, of ";
  return where + (rows.size() == 1 ? "one value" : fmt::format("{} values", rows.size())) +
         " measured in the laboratory " + joined(others, "; ") + ".";
}

}  // namespace reports
