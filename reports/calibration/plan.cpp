#include "reports/calibration/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "engine/core/errors.h"
#include "engine/scenario/measured.h"
#include "engine/scenario/suggest.h"
#include "engine/scenario/units.h"
#include "reports/calibration/sensitivities.h"
#include "reports/text.h"

namespace calibrate {
namespace {

Parameter parameter_named(const dem::Scenario& scenario, const std::string& key, const std::string& name) {
  return {dem::texture::micro_parameter(scenario, key, name)};
}

/// "cohesion 0.5-2"
struct Range {
  std::string name;
  double low = 0, high = 0;
};

std::vector<Range> ranges_of(const dem::Scenario& scenario) {
  std::vector<Range> all;
  for (const std::string& text : scenario.texts("calibrate.ranges")) {
    const auto refuse = [&](const std::string& wrong) {
      return scenario.error(
          "calibrate.ranges", "\"" + text + "\" " + wrong,
          "write a parameter and the multiples of its starting value that it may have: \"cohesion 0.5-2\"");
    };
    const std::size_t blank = text.rfind(' ');
    if (blank == std::string::npos) throw refuse("has no range");
    Range range{text.substr(0, text.find_last_not_of(" :", blank) + 1), 0, 0};
    try {
      const dem::Measured said = dem::read_measured(text.substr(blank + 1), "");
      range.low = said.low;
      range.high = said.high;
    } catch (const dem::InputError&) {
      throw refuse("has no range at its end");
    }
    (void)parameter_named(scenario, "calibrate.ranges", range.name);
    if (!(range.low > 0 && range.low < range.high)) throw refuse("is no range of multiples above 0");
    if (range.low > 1 || range.high < 1) throw refuse("does not hold the start, 1");
    all.push_back(range);
  }
  return all;
}

void apply(const std::vector<Range>& ranges, std::vector<Parameter>& parameters) {
  for (Parameter& parameter : parameters) {
    for (const Range& range : ranges) {
      if (range.name != parameter.name) continue;
      parameter.low = range.low;
      parameter.high = parameter.kind.ends_with("friction_angle") ? std::min(range.high, parameter.high) : range.high;
    }
  }
}

const Target* find(const std::vector<Target>& targets, std::string_view key) {
  const auto at = std::ranges::find_if(targets, [&](const Target& t) { return t.number.key == key; });
  return at == targets.end() ? nullptr : &*at;
}

/// What cannot be true of any rock, or of none that this model can be.
void refuse_contradictions(const dem::Scenario& scenario, const std::string& table,
                           const std::vector<Target>& targets) {
  const auto text = [](const Target& target) { return reports::laboratory_text(target.number); };
  const auto error = [&](std::string_view key, const std::string& wrong, const std::string& right) {
    return scenario.error(table + std::string(key), wrong, right);
  };
  const Target* ucs = find(targets, "ucs");
  for (const std::string_view key : {"tensile_strength", "brazilian_strength"}) {
    const Target* tension = find(targets, key);
    if (!ucs || !tension || tension->number.low <= 0.25 * ucs->number.high) continue;
    throw error(
        key,
        fmt::format("{} is more than a quarter of the uniaxial compressive strength, {}", text(*tension), text(*ucs)),
        "no brittle rock has that, and no parameters of this model give both: look at the units, and whether "
        "the two are of the same rock");
  }
  const Target *initiation = find(targets, "crack_initiation"), *damage = find(targets, "crack_damage");
  for (const auto& [low, high] : {std::pair{initiation, damage}, {initiation, ucs}, {damage, ucs}}) {
    if (!low || !high || low->number.low < high->number.high) continue;
    throw error(low->number.key, fmt::format("{} is not below {}, {}", text(*low), high->name(), text(*high)),
                "cracks begin before crack damage, and that is before the peak: look which is which");
  }
  const Target* before = ucs;
  for (const Target& target : targets) {
    if (target.number.key != "peaks") continue;
    if (target.number.pressure <= 0) {
      throw error("peaks", "a peak at no confining pressure is the uniaxial strength", "write it as ucs");
    }
    if (before && target.number.pressure > before->number.pressure && target.number.high < before->number.low) {
      throw error(
          "peaks",
          fmt::format("{} at {} MPa is less than {} at {} MPa", text(target), reports::shortest(target.number.pressure),
                      text(*before), reports::shortest(before->number.pressure)),
          "strength rises with the confining pressure: look at the pressures");
    }
    before = &target;
  }
  if (find(targets, "hoek_brown_m") && !ucs) {
    throw error("hoek_brown_m", "m is of an envelope that begins at the uniaxial strength, and there is none",
                "measure ucs too, or leave m out");
  }
}

/// Tests by which m is fitted: the pressures of the scenario's sweep, else those of the measured peaks, else three.
std::vector<double> pressures_of_m(const dem::Scenario& scenario, const std::vector<Target>& targets) {
  std::set<double> pressures;
  for (const double p : scenario.reals("sweep.confining_pressure")) pressures.insert(std::round(p * 1e-6 * 1e9) / 1e9);
  pressures.erase(0);
  if (pressures.empty()) {
    for (const Target& target : targets)
      if (target.number.key == "peaks") pressures.insert(target.number.pressure);
  }
  if (pressures.empty()) pressures = {10, 20, 40};
  pressures.insert(0);
  return {pressures.begin(), pressures.end()};
}

bool among(std::string_view word, std::initializer_list<std::string_view> list) {
  return std::ranges::find(list, word) != list.end();
}

/// Whether a value is what tells a parameter in the first place.
bool answers_to(const Parameter& parameter, std::string_view key) {
  const std::string_view kind = parameter.kind;
  if (kind.ends_with("stiffness_ratio")) return key == "poisson_ratio";
  if (kind.ends_with("modulus")) return key == "young_modulus";
  if (kind.ends_with("tensile_strength")) return among(key, {"tensile_strength", "brazilian_strength"});
  if (kind == "cohesion") return key == "ucs";
  return kind == "friction_angle" && among(key, {"peaks", "hoek_brown_m"});
}

/// The stage in which a target is first aimed at: tension waits for the boundaries where they decide it.
std::size_t stage_of(const Target& target, const Subject& subject) {
  if (among(target.number.key, {"young_modulus", "poisson_ratio"})) return 0;
  if (among(target.number.key, {"peaks", "hoek_brown_m"})) return 3;
  const bool boundaries = std::ranges::any_of(
      subject.moved, [&](std::size_t k) { return subject.candidates[k].kind == "interaction.tensile_strength"; });
  return boundaries && among(target.number.key, {"tensile_strength", "brazilian_strength", "crack_initiation"}) ? 2 : 1;
}

/// And that in which a parameter begins to move.
std::size_t stage_of(const Parameter& parameter) {
  if (parameter.kind.ends_with("modulus") || parameter.kind.ends_with("stiffness_ratio")) return 0;
  if (parameter.kind.ends_with("friction_angle") || parameter.kind.ends_with("friction") ||
      parameter.kind == "interaction.cohesion")
    return 3;
  return parameter.kind.starts_with("interaction.") ? 2 : 1;
}

void add_test(std::vector<Test>& tests, const Test& test) {
  if (std::ranges::find(tests, test) == tests.end()) tests.push_back(test);
}

std::vector<Stage> stages_of(const Subject& subject) {
  constexpr std::array ids{"elastic", "strengths", "boundaries", "confined"};
  std::vector<Stage> stages;
  for (std::size_t at = 0; at < ids.size(); ++at) {
    Stage stage{ids[at], {}, {}, {}};
    bool begins = false;
    for (std::size_t k = 0; k < subject.moved.size(); ++k) {
      const std::size_t first = stage_of(subject.candidates[subject.moved[k]]);
      if (first <= at) stage.parameters.push_back(k);
      begins = begins || first == at;
    }
    for (std::size_t i = 0; i < subject.targets.size(); ++i) {
      const std::size_t first = stage_of(subject.targets[i], subject);
      if (first > at) continue;
      stage.targets.push_back(i);
      begins = begins || (first == at && !stage.parameters.empty());
    }
    if (!begins || stage.parameters.empty() || stage.targets.empty()) continue;
    for (const std::size_t i : stage.targets) {
      const reports::LaboratoryNumber& number = subject.targets[i].number;
      if (number.fit.empty()) {
        add_test(stage.tests, {number.test, number.pressure, at == 0});
      } else {
        for (const double p : subject.pressures) add_test(stage.tests, {number.test, p});
      }
    }
    stages.push_back(std::move(stage));
  }
  return stages;
}

}  // namespace

double Target::to_search(double value) const {
  return is_logarithmic() ? (value > 0 ? std::log(value) : std::nan("")) : value;
}
double Target::from_search(double value) const { return is_logarithmic() ? std::exp(value) : value; }
double Target::laboratory_deviation() const {
  return is_logarithmic() ? number.deviation / number.value : number.deviation;
}
std::string Target::symbol() const {
  static const std::vector<std::pair<std::string_view, std::string>> all = {
      {"young_modulus", "E"},        {"poisson_ratio", "ν"},      {"ucs", "UCS"},          {"tensile_strength", "TS"},
      {"brazilian_strength", "BTS"}, {"crack_initiation", "σci"}, {"crack_damage", "σcd"}, {"hoek_brown_m", "m"}};
  for (const auto& [key, symbol] : all) {
    if (key == number.key) return symbol;
  }
  return "peak at " + reports::shortest(number.pressure) + " MPa";
}

double expected_deviation(const Target& target, int seeds) {
  return std::max(std::hypot(target.laboratory_deviation(), scatter(target.number.key) / std::sqrt(seeds)), 1e-3);
}

Eigen::MatrixXd known_derivatives(const Subject& subject, const std::vector<Parameter>& parameters) {
  Eigen::MatrixXd known(static_cast<Eigen::Index>(subject.targets.size()),
                        static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < subject.targets.size(); ++i) {
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const reports::LaboratoryNumber& number = subject.targets[i].number;
      known(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          sensitivity(parameters[k].kind, number.key, number.pressure, subject.mineral.empty());
    }
  }
  return known;
}

std::string symbols(const Subject& subject, const std::vector<std::size_t>& targets) {
  std::vector<std::string> all;
  for (const std::size_t i : targets) all.push_back(subject.targets[i].symbol());
  return reports::listed(all);
}

Plan make_plan(const dem::Scenario& scenario, std::span<const dem::Measurable> measurables,
               std::span<const dem::Quantity> quantities) {
  reports::StudyResult study{.scenario = &scenario, .cases = {}};
  study.measurables = measurables;
  const std::vector<reports::LaboratoryNumber> numbers = reports::laboratory_numbers(study);
  if (numbers.empty()) {
    throw scenario.error(
        "measured", "nothing is measured: there is nothing to calibrate to",
        "write what the laboratory found below [measured], ucs = \"210 MPa +- 8\", or of a mineral alone "
        "below [mineral.measured] (docs/use/your-rock.md)");
  }
  Plan plan;
  const auto budget = static_cast<int>(scenario.integer("calibrate.budget"));
  plan.seeds = static_cast<int>(scenario.integer("calibrate.seeds"));
  const std::vector<Range> ranges = ranges_of(scenario);
  const std::vector<std::string> minerals = dem::texture::mineral_names(scenario);
  std::vector<std::string> owners;  // subjects, minerals first
  for (const std::string& mineral : minerals) {
    if (std::ranges::find(numbers, mineral, &reports::LaboratoryNumber::mineral) != numbers.end())
      owners.push_back(mineral);
  }
  const bool minerals_alone = !owners.empty();
  if (std::ranges::find(numbers, "", &reports::LaboratoryNumber::mineral) != numbers.end()) owners.emplace_back();
  std::vector<std::string> asked = scenario.texts("calibrate.parameters");
  for (const std::string& name : asked) (void)parameter_named(scenario, "calibrate.parameters", name);

  for (const std::string& owner : owners) {
    Subject subject;
    subject.mineral = owner;
    std::string table = "measured.";
    for (std::size_t i = 0; i < minerals.size(); ++i) {
      if (minerals[i] == owner) table = fmt::format("mineral[{}].measured.", i);
    }
    for (const reports::LaboratoryNumber& number : numbers) {
      if (number.mineral != owner) continue;
      const bool given = !number.fit.empty() || std::ranges::any_of(quantities, [&](const dem::Quantity& q) {
        return q.covers(number.result);
      });
      if (given) {
        subject.targets.push_back({number});
      } else {
        subject.notes.push_back(reports::laboratory_name(number) +
                                " is not aimed at: this version of the program has no such test.");
      }
    }
    if (subject.targets.empty()) continue;
    std::ranges::stable_sort(subject.targets, {}, [](const Target& t) {
      return std::pair(t.number.key == "peaks" ? 1 : 0, t.number.pressure);
    });
    refuse_contradictions(scenario, table, subject.targets);
    if (find(subject.targets, "hoek_brown_m")) subject.pressures = pressures_of_m(scenario, subject.targets);
    subject.budget = budget;
    if (owner.empty() && minerals.size() > 1) {
      // Boundaries have parameters of their own, and act on all targets at once: their search is longer. Each confining
      // pressure is one more test of every specimen.
      std::set<double> pressures(subject.pressures.begin(), subject.pressures.end());
      for (const Target& target : subject.targets) pressures.insert(target.number.pressure);
      pressures.erase(0);
      subject.budget = 2 * budget + static_cast<int>(pressures.size()) * (budget / 2);
    }

    // What the user names; else what there is, the parameters that matter most first.
    const auto of_subject = [&](const std::string& name) {
      const std::size_t dot = name.rfind('.');
      const std::string whose = dot == std::string::npos ? "" : name.substr(0, dot);
      return owner.empty() ? std::ranges::find(owners, whose) == owners.end() || whose.empty() : whose == owner;
    };
    for (const std::string& name : asked) {
      if (!of_subject(name)) continue;
      subject.candidates.push_back(parameter_named(scenario, "calibrate.parameters", name));
      subject.candidates.back().is_chosen = true;
    }
    const bool chosen = !subject.candidates.empty();
    if (chosen && subject.candidates.size() > subject.targets.size()) {
      std::vector<std::size_t> all(subject.targets.size());
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
      throw scenario.error(
          "calibrate.parameters",
          fmt::format("{} parameters cannot follow from {} measured value{}, {}", subject.candidates.size(),
                      subject.targets.size(), subject.targets.size() == 1 ? "" : "s", symbols(subject, all)),
          "measure more, or name at most as many parameters; without the key the program chooses what they determine");
    }
    if (!chosen) {
      const bool boundaries = owner.empty() && minerals.size() > 1;
      const auto add = [&](const std::string& name) {
        Parameter parameter = parameter_named(scenario, "calibrate.parameters", name);
        const bool there = std::ranges::all_of(parameter.start, [](double v) { return v > 0; });
        if (there) subject.candidates.push_back(std::move(parameter));
      };
      const auto of_boundaries = [&](std::initializer_list<const char*> names) {
        for (const char* name : names) add(std::string("interaction.") + name);
      };
      const auto of_minerals = [&](const std::string& name) { add((owner.empty() ? "" : owner + ".") + name); };
      if (owner.empty() && minerals_alone) {
        if (!boundaries && scenario.text("interaction.between") == "minerals") {
          throw scenario.error(
              "measured",
              "the rock has one mineral, whose own measured values set its parameters: none is left to "
              "move",
              "write all that was measured in one of the two tables, [measured] or [mineral.measured]");
        }
        of_boundaries({"tensile_strength", "modulus", "stiffness_ratio", "cohesion", "friction"});
      } else {
        of_minerals("modulus");
        of_minerals("stiffness_ratio");
        if (boundaries) {
          of_boundaries({"tensile_strength"});
        } else {
          of_minerals("tensile_strength");
        }
        of_minerals("cohesion");
        of_minerals("friction_angle");
        if (boundaries) {
          of_minerals("tensile_strength");
          of_boundaries({"modulus", "stiffness_ratio", "cohesion"});
        }
        of_minerals("friction");
      }
    }
    // Those whose own value is measured come first: the stiffness ratio must not follow UCS where nobody measured Poisson's
    // ratio.
    if (!chosen) {
      std::ranges::stable_partition(subject.candidates, [&](const Parameter& parameter) {
        return std::ranges::any_of(subject.targets,
                                   [&](const Target& target) { return answers_to(parameter, target.number.key); });
      });
    }
    apply(ranges, subject.candidates);

    Eigen::MatrixXd weighed = known_derivatives(subject, subject.candidates);
    for (std::size_t i = 0; i < subject.targets.size(); ++i)
      weighed.row(static_cast<Eigen::Index>(i)) /= expected_deviation(subject.targets[i], plan.seeds);
    subject.known = dem::calibration::identify(weighed, undetermined);
    for (std::size_t k = 0; k < subject.candidates.size(); ++k) {
      if (subject.known.free[k]) subject.moved.push_back(k);
    }
    if (subject.moved.empty()) {
      std::vector<std::size_t> all(subject.targets.size());
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
      throw scenario.error(chosen ? "calibrate.parameters" : "measured",
                           fmt::format("what is measured of {}, {}, does not determine any parameter that may move",
                                       subject.title(), symbols(subject, all)),
                           chosen ? "name parameters that these values follow, or leave the key out"
                                  : "measure young_modulus, ucs or tensile_strength");
    }
    subject.stages = stages_of(subject);
    plan.subjects.push_back(std::move(subject));
  }
  if (plan.subjects.empty()) {
    throw scenario.error("measured", "this program has a test for none of what is measured",
                         "measure young_modulus, ucs or tensile_strength");
  }
  return plan;
}

}  // namespace calibrate
