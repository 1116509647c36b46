// What each parameter of the contacts does when it is raised alone, paired by seed (Zhao et al. 2021, section 3.2).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/texture/micro_parameters.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

using analysis::Estimate;
using dem::texture::MicroParameter;

std::string text_of(const CaseResult& one, const dem::Parameter& parameter) {
  const auto* value = dem::find_value(one.parameters, parameter.id);
  const auto* text = value ? std::get_if<std::string>(value) : nullptr;
  return text ? *text : std::string();
}

double number_of(const CaseResult& one, const dem::Parameter& parameter) {
  const auto* value = dem::find_value(one.parameters, parameter.id);
  const auto* number = value ? std::get_if<double>(value) : nullptr;
  return number ? *number : 0;
}

/// The specimens of one mineral alone, or of the rock: as they are, or with one parameter raised. By seed.
struct Specimens {
  std::map<double, const dem::Record*> pulled;
  std::map<double, std::map<double, const dem::Record*>> pressed;  ///< by confining pressure (MPa) first
};

struct Group {
  std::string mineral;                  ///< "": the rock
  std::vector<std::string> raised;      ///< names, in the order of the cases
  std::map<std::string, Specimens> of;  ///< "": as they are
  [[nodiscard]] std::set<double> pressures() const {
    std::set<double> all;
    for (const auto& [name, specimens] : of)
      for (const auto& [pressure, records] : specimens.pressed) all.insert(pressure);
    return all;
  }
};

std::vector<Group> groups_of(const StudyResult& study) {
  std::vector<Group> groups;
  for (const CaseResult& one : study.cases) {
    if (!one.record || (one.test() != test_compression && one.test() != test_tension)) continue;
    const std::string mineral = text_of(one, parameter::mineral), raised = text_of(one, parameter::raised);
    auto group = std::ranges::find(groups, mineral, &Group::mineral);
    if (group == groups.end()) group = groups.insert(groups.end(), {mineral, {}, {}});
    if (!raised.empty() && std::ranges::find(group->raised, raised) == group->raised.end())
      group->raised.push_back(raised);
    Specimens& specimens = group->of[raised];
    const double seed = number_of(one, parameter::seed);
    auto& records = one.test() == test_tension ? specimens.pulled
                                               : specimens.pressed[number_of(one, parameter::confining_pressure)];
    records.try_emplace(seed, one.record);
  }
  std::erase_if(groups, [](const Group& group) { return group.raised.empty() || !group.of.contains(""); });
  return groups;
}

/// What is read off the specimens, by seed.
struct Observed {
  std::string head, words;  ///< "UCS", "of charts and sentences"
  std::function<std::map<double, double>(const Specimens&)> read;
};

std::map<double, double> values(const std::map<double, const dem::Record*>& records, const dem::Quantity& of) {
  std::map<double, double> found;
  for (const auto& [seed, record] : records) {
    if (const double value = record->value_or_nan(of); std::isfinite(value) && value != 0) found[seed] = value;
  }
  return found;
}

std::map<double, double> pressed(const Specimens& specimens, double pressure, const dem::Quantity& of) {
  const auto at = specimens.pressed.find(pressure);
  return at == specimens.pressed.end() ? std::map<double, double>() : values(at->second, of);
}

// Eq. 10 with s = 1 and sigma_c = UCS, through the peak under one pressure.
std::map<double, double> m_by(const Specimens& specimens, double pressure) {
  const auto ucs = pressed(specimens, 0, quantity::compressive_strength),
             peak = pressed(specimens, pressure, quantity::compressive_strength);
  std::map<double, double> found;
  for (const auto& [seed, value] : peak) {
    const auto at = ucs.find(seed);
    if (at == ucs.end()) continue;
    const double sigma_c = at->second, rise = value - pressure;  // MPa
    found[seed] = (rise * rise / sigma_c - sigma_c) / pressure;
  }
  return found;
}

std::vector<Observed> observed(const Group& group) {
  const auto of = [](std::string head, const dem::Quantity& quantity) {
    return Observed{head, head, [quantity](const Specimens& s) { return pressed(s, 0, quantity); }};
  };
  std::vector<Observed> all = {of("E", quantity::young_modulus), of("ν", quantity::poisson_ratio)};
  const auto one_percent = std::ranges::find(quantity::initiation_readings, "one_percent_of_cracks", &dem::Reading::id);
  if (one_percent != quantity::initiation_readings.end()) all.push_back(of("σ_ci", one_percent->quantity));
  all.push_back(of("σ_cd", quantity::crack_damage));
  all.push_back(of("UCS", quantity::compressive_strength));
  all.push_back({"TS", "TS", [](const Specimens& s) { return values(s.pulled, quantity::tensile_strength); }});
  const std::set<double> pressures = group.pressures();
  for (const double pressure : pressures) {
    if (pressure <= 0) continue;
    const std::string head = "peak at " + shortest(pressure) + " MPa";
    all.push_back(
        {head, head, [pressure](const Specimens& s) { return pressed(s, pressure, quantity::compressive_strength); }});
  }
  if (!pressures.empty() && *pressures.begin() <= 0 && *pressures.rbegin() > 0) {
    const double highest = *pressures.rbegin();
    all.push_back({"m", "m", [highest](const Specimens& s) { return m_by(s, highest); }});
  }
  return all;
}

/// Relative change (%) by raising a parameter: each seed against itself.
struct Change {
  Estimate mean;
  double deviation = 0;  ///< between seeds
  std::size_t seeds = 0;
  [[nodiscard]] bool is_known() const { return seeds > 0; }
  /// Whether it stands out of the scatter of seeds; of one or two, nobody knows.
  [[nodiscard]] bool is_clear() const { return !mean.has_interval() || mean.low > 0 || mean.high < 0; }
};

Change change(const Group& group, const std::string& raised, const Observed& of) {
  const auto base = of.read(group.of.at("")), now = of.read(group.of.at(raised));
  std::vector<double> changes;
  for (const auto& [seed, value] : now) {
    if (const auto at = base.find(seed); at != base.end()) changes.push_back(100 * (value / at->second - 1));
  }
  return {analysis::mean_of(changes), analysis::spread(changes).deviation, changes.size()};
}

std::string cell(const Change& of) {
  if (!of.is_known()) return "–";
  const std::string mean = (of.mean.value >= 0.05 ? "+" : "") + fixed(of.mean.value, 1);
  return of.seeds > 1 ? mean + " ± " + fixed(of.deviation, 1) : mean;
}

std::string file_part(std::string name) {
  std::ranges::replace(name, ' ', '_');
  return name;
}

// "σ_t,b" as charts write it: "σ_{t,b}".
std::string indexed(const std::string& symbol) {
  const std::size_t at = symbol.find('_');
  return at == std::string::npos ? symbol : symbol.substr(0, at) + "_{" + symbol.substr(at + 1) + "}";
}

// "C_b", of one mineral of several "C_b, quartz".
std::string symbol_of(const MicroParameter& parameter, const std::string& alone) {
  const std::string owner = parameter.name == parameter.kind ? "" : parameter.name.substr(0, parameter.name.rfind('.'));
  const bool said = parameter.is_of_boundaries() || owner.empty() || owner == alone;
  return parameter.symbol + (said ? "" : ", " + owner);
}

// "α_E, modulus (0.9)", "C_b, cohesion": coefficients with the value that they start from.
std::string in_words(const MicroParameter& parameter, const std::string& alone) {
  const std::string symbol = symbol_of(parameter, alone);
  if (parameter.is_of_boundaries())
    return fmt::format("{}, {} ({})", symbol, words(parameter.kind.substr(parameter.kind.find('.') + 1)),
                       shortest(parameter.start.front()));
  if (parameter.kind == "modulus") return symbol + ", moduli";
  if (parameter.kind == "stiffness_ratio") return symbol + ", stiffness ratios";
  return symbol + ", " + words(parameter.kind);
}

/// Bars of some results, a group for each parameter; nothing where none has a value.
std::optional<render::Chart> bars(const Group& group, const std::vector<MicroParameter>& parameters,
                                  const std::vector<Observed>& all, std::initializer_list<std::string_view> heads,
                                  bool rest = false) {
  render::Bars bars;
  for (const MicroParameter& parameter : parameters)
    bars.categories.push_back(indexed(symbol_of(parameter, group.mineral)));
  bool any = false, whiskers = false;
  for (const Observed& of : all) {
    const bool named = std::ranges::find(heads, of.head) != heads.end();
    if (!named && !(rest && of.head.starts_with("peak"))) continue;
    std::vector<double> means, errors;
    for (const MicroParameter& parameter : parameters) {
      const Change found = change(group, parameter.name, of);
      means.push_back(found.mean.value);
      errors.push_back(found.seeds > 1 ? found.deviation : std::nan(""));
      any = any || found.is_known();
      whiskers = whiskers || found.seeds > 1;
    }
    bars.colours.push_back(render::palette(bars.labels.size()));
    bars.labels.push_back(indexed(of.head));
    bars.values.push_back(std::move(means));
    bars.errors.push_back(std::move(errors));
  }
  if (!any) return std::nullopt;
  if (!whiskers) bars.errors.clear();
  render::Chart chart;
  chart.bars = std::move(bars);
  chart.left.title = "Change (%)";
  chart.legend = render::Chart::Legend::below;
  return chart;
}

/// "E follows α_E (+7.2 %)": the parameter that moves a result most, where that stands out of the scatter.
std::string follows(const Group& group, const std::vector<MicroParameter>& parameters, const Observed& of) {
  const MicroParameter* most = nullptr;
  Change largest;
  bool any = false;
  for (const MicroParameter& parameter : parameters) {
    const Change found = change(group, parameter.name, of);
    any = any || found.is_known();
    if (!found.is_known() || !found.is_clear() || found.mean.value == 0) continue;
    if (most && std::abs(found.mean.value) <= std::abs(largest.mean.value)) continue;
    most = &parameter;
    largest = found;
  }
  if (!most) return any ? of.words + ": none clearly" : "";
  return fmt::format("{} by {} ({} %)", of.words, symbol_of(*most, group.mineral), cell(largest));
}

}  // namespace

FigureContent sensitivities(const StudyResult& study) {
  FigureContent content;
  add_missing(content, study, {test_compression, test_tension});
  const std::vector<Group> groups = groups_of(study);
  if (groups.empty()) return content;
  const double factor = study.scenario->real("sensitivity.factor");
  std::vector<std::string> said;
  bool boundaries = false, of_minerals = false, several = false;
  for (const Group& group : groups) {
    std::vector<MicroParameter> parameters;
    for (const std::string& name : group.raised)
      parameters.push_back(dem::texture::micro_parameter(*study.scenario, "sweep.raised", name));
    for (const MicroParameter& parameter : parameters) (parameter.is_of_boundaries() ? boundaries : of_minerals) = true;
    const std::vector<Observed> all = observed(group);
    const std::string suffix = group.mineral.empty() || groups.size() == 1 ? "" : "_" + file_part(group.mineral);
    const std::string whose = group.mineral.empty() ? "the rock" : group.mineral;
    const auto add = [&](const char* id, const std::string& caption, std::optional<render::Chart> chart) {
      if (!chart) return;
      content.panels.push_back({.id = id + suffix,
                                .caption = caption + (groups.size() > 1 ? ", " + whose : "") + ".",
                                .alt = "Bars of the changes by each parameter; they stand in the table.",
                                .content = std::move(*chart)});
    };
    add("elastic", "Elastic constants", bars(group, parameters, all, {"E", "ν"}));
    add("strengths", "Strengths without confining pressure", bars(group, parameters, all, {"UCS", "TS"}));
    add("initiation", "Crack initiation (1 % of the cracks) and crack damage",
        bars(group, parameters, all, {"σ_ci", "σ_cd"}));
    add("confined", "Peak under confining pressure, and the Hoek-Brown m by it",
        bars(group, parameters, all, {"m"}, true));
    TextTable table{{"Raised"}, {}};
    for (const Observed& of : all) table.head.push_back(of.head + " (%)");
    for (const MicroParameter& parameter : parameters) {
      std::vector<std::string> row = {in_words(parameter, group.mineral)};
      for (const Observed& of : all) {
        const Change found = change(group, parameter.name, of);
        several = several || found.seeds > 1;
        row.push_back(cell(found));
      }
      table.rows.push_back(std::move(row));
    }
    content.panels.push_back(
        {.id = "table" + suffix,
         .caption = fmt::format("Changes of {} in %, each parameter alone times {}{}.{}", whose, shortest(factor),
                                of_minerals ? "; E_b with E_c, and k_b with k_c" : "",
                                several ? " Each seed is compared with itself: means and standard deviations."
                                        : " One specimen, compared with itself."),
         .alt = "",
         .content = table,
         .per_row = 1});
    std::vector<std::string> parts;
    for (const Observed& of : all) {
      if (std::string one = follows(group, parameters, of); !one.empty()) parts.push_back(std::move(one));
    }
    if (!parts.empty()) said.push_back((groups.size() > 1 ? capital(whose) + ": " : "") + joined(parts, "; "));
  }
  if (boundaries) {
    content.statement =
        "Poisson’s ratio of the rock follows α_k, its tensile strength α_t; UCS is controlled by α_C and α_φ, and m is "
        "mainly related to α_φ.";
    content.rows = {"alpha_k_sets_nu", "alpha_t_sets_ts", "alpha_c_phi_set_ucs", "alpha_phi_sets_m"};
  } else if (of_minerals) {
    content.statement =
        "In a mineral alone k_b sets Poisson’s ratio, both moduli set E, and the bonded tensile strength TS and, in "
        "part, "
        "UCS; UCS is set by the cohesion, and the friction angle acts under confining pressure.";
    content.rows = {"k_sets_nu",         "moduli_set_e",      "bond_strength_sets_ts",  "cohesion_phi_not_ts",
                    "bond_strength_ucs", "cohesion_sets_ucs", "phi_acts_under_pressure"};
  }
  if (said.empty()) return content;
  content.finding = "What moves each result most" +
                    std::string(several ? ", where the 95 % interval over seeds tells it from scatter"
                                        : ", in one specimen, which tells no scatter") +
                    ": " + joined(said, ". ") + ".";
  content.headline = content.finding;
  return content;
}

}  // namespace reports::texture
