#include "engine/texture/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>

#include "engine/model/keeper.h"
#include "engine/scenario/units.h"
#include "engine/texture/genesis/packing.h"
#include "engine/texture/keys.h"
#include "engine/texture/loading/loading.h"
#include "engine/texture/loading/test.h"
#include "engine/texture/micro_parameters.h"
#include "engine/texture/quantities.h"
#include "engine/texture/results.h"

namespace dem::texture {
namespace {

// Raised whenever results change.
constexpr std::string_view physics_version = "grain_texture 6";

/// One specimen of the scenario, and how it is tested.
struct Variant {
  double aspect_ratio = 1, dip = 0, seed_scale = 1;  ///< -, rad, -
  std::string growth = {}, between = {}, only_mineral = {};
  std::string raised = {};    ///< name of the parameter that is (sweep.raised); "": none
  double pressure_ratio = 0;  ///< of the packing
  double swept = 0;           ///< what cases of the test differ in beside (TestEntry::sweep), SI; a confining pressure
  std::int64_t seed = 1;
  std::optional<std::size_t> extra = {};  ///< the [[extra]] that asks for it; none: the sweeps do

  [[nodiscard]] auto values() const {
    return std::tie(aspect_ratio, dip, seed_scale, growth, between, only_mineral, raised, pressure_ratio, swept, seed);
  }
};

constexpr double degrees = 57.295779513082323;
// Without the rounding noise of conversions, so that ids and axes read "30" and not "29.999999999999996".
double tidy(double value) { return std::round(value * 1e9) / 1e9; }

/// The key that a value of a variant comes from, for errors about it; "": the key itself.
std::string source_of(const Scenario& base, const Variant& v, const std::string& name) {
  if (v.extra) {
    const std::string key = fmt::format("extra[{}].{}", *v.extra, name);
    return base.declares(key) ? key : std::string();
  }
  const std::string sweep = "sweep." + name;
  return base.given(sweep) ? sweep : std::string();
}

/// The scenario with one parameter raised, of a rock or of one mineral alone.
Scenario raise(const Scenario& scenario, const std::string& name, const std::string& only_mineral) {
  const std::string key = scenario.texts("sweep.raised").empty() ? "sensitivity.parameter" : "sweep.raised";
  const MicroParameter parameter = micro_parameter(scenario, key, name);
  const bool of_another = parameter.name != parameter.kind && parameter.name != only_mineral + "." + parameter.kind;
  if (!only_mineral.empty() && (parameter.is_of_boundaries() || of_another)) {
    throw scenario.error(key, "'" + name + "' does nothing: " + only_mineral + " stands alone",
                         "leave it out, or the mineral");
  }
  const double factor = scenario.real("sensitivity.factor");
  if (factor > parameter.high) {
    throw scenario.error("sensitivity.factor", fmt::format("'{}' cannot be {} times as large", name, factor),
                         fmt::format("give at most {:.3g}", parameter.high));
  }
  return multiplied(scenario, parameter, factor, key);
}

CaseSpec case_of(const Scenario& base, const std::string& test, const Variant& v) {
  const auto from = [&](std::string_view name) { return source_of(base, v, std::string(name)); };
  const std::optional<Sweep>& sweep = test_entry(test).sweep;
  const double dip = tidy(v.dip * degrees);
  const double swept = sweep ? tidy(v.swept / to_si(1, sweep->parameter.unit)) : 0;
  const bool confined = sweep && sweep->parameter.id == parameter::confining_pressure.id;
  Scenario scenario = base.with("texture.aspect_ratio", v.aspect_ratio, from("aspect_ratio"))
                          .with("texture.seed_scale", v.seed_scale, from("seed_scale"))
                          .with("texture.growth", v.growth, from("growth"))
                          .with("interaction.between", v.between, from("between"))
                          .with("packing.pressure_ratio", v.pressure_ratio, from("pressure_ratio"))
                          .with("texture.dip", v.dip, from("dip"))
                          .with("texture.only_mineral", v.only_mineral, from("mineral"))
                          .with("compression.confining_pressure", confined ? v.swept : 0.0, from("confining_pressure"))
                          .with("seed", v.seed);
  if (sweep && !confined) scenario = std::move(scenario).with(sweep->key(), v.swept, from(sweep->name));
  scenario = std::move(scenario).with("sensitivity.parameter", v.raised);
  if (!v.raised.empty()) scenario = raise(scenario, v.raised, v.only_mineral);
  if (const auto resolve = test_entry(test).resolve) scenario = resolve(scenario);
  std::string id = test + "_" + (v.only_mineral.empty() ? "ar_" + id_part(v.aspect_ratio) : id_part(v.only_mineral));
  if (!base.reals("sweep.dip").empty() || v.dip != 0) id += "_dip_" + id_part(dip);
  if (swept > 0) id += fmt::format("_{}_{}", sweep->parameter.in_ids, id_part(swept));
  if (v.seed_scale != base.real("texture.seed_scale")) id += "_seed_scale_" + id_part(v.seed_scale);
  if (v.growth != base.text("texture.growth")) id += "_" + v.growth;
  if (v.between != base.text("interaction.between")) id += "_between_" + v.between;
  if (v.pressure_ratio != base.real("packing.pressure_ratio")) id += "_pressure_ratio_" + id_part(v.pressure_ratio);
  if (!v.raised.empty()) id += "_" + id_part(v.raised) + "_raised";
  id += seed_part(base, v.seed);
  const auto of = [](const Parameter& parameter, ParameterValue value) {
    return std::pair{std::string(parameter.id), std::move(value)};
  };
  Parameters parameters = {{"test", test},
                           of(parameter::aspect_ratio, v.aspect_ratio),
                           of(parameter::dip, dip),
                           of(parameter::seed_scale, v.seed_scale),
                           of(parameter::growth, v.growth),
                           of(parameter::between, v.between),
                           of(parameter::pressure_ratio, v.pressure_ratio),
                           of(parameter::raised, v.raised),
                           of(parameter::mineral, v.only_mineral),
                           of(parameter::confining_pressure, confined ? swept : 0.0),
                           of(parameter::seed, static_cast<double>(v.seed))};
  if (sweep && !confined) parameters.push_back(of(sweep->parameter, swept));
  std::vector<std::string> kinds = {test};
  if (test_entry(test).read(scenario).loads()) kinds.emplace_back("loaded");  // Key::when of the rock and the solver
  return make_case(model(), std::move(id), std::move(scenario), std::move(parameters), kinds);
}

std::vector<double> swept(const Scenario& s, const std::string& sweep, const std::string& single) {
  const std::vector<double>& values = s.reals(sweep);
  return values.empty() ? std::vector<double>{s.real(single)} : values;
}

/// Every combination of what is swept for a test; repeats innermost, so that the specimens of one kind stand together.
std::vector<Variant> variants_of(const Scenario& s, const std::optional<Sweep>& sweep) {
  std::vector<Variant> variants;
  const auto add = [&](const Variant& v, const std::string& key) {
    if (std::ranges::any_of(variants, [&](const Variant& other) { return other.values() == v.values(); })) {
      if (v.extra) return;  // what sets it apart in one rock may be usual in another
      throw s.error(key, "the same specimen is asked for twice", "give each specimen once");
    }
    variants.push_back(v);
  };
  std::vector<std::string> lists = {"sweep.aspect_ratio", "sweep.dip", "sweep.mineral"};
  for (const TestEntry& entry : tests()) {
    if (entry.sweep) lists.push_back(entry.sweep->list());
  }
  for (const std::string& list : lists) {
    const bool empty = list == "sweep.mineral" ? s.texts(list).empty() : s.reals(list).empty();
    if (s.given(list) && empty) {
      throw s.error(list, "the list is empty", "give at least one value, or leave the key out");
    }
  }
  const std::vector<std::int64_t> seeds = seeds_of(s);
  const auto add_repeats = [&](Variant v, const std::string& key) {
    for (const std::int64_t seed : seeds) {
      v.seed = seed;
      add(v, key);
    }
  };
  std::vector<std::string> raised = s.texts("sweep.raised");
  refuse_repeated(s, "sweep.raised", raised);
  raised.insert(raised.begin(), raised.empty() ? s.text("sensitivity.parameter") : "");  // beside the specimen as it is
  std::vector<std::string> minerals = s.texts("sweep.mineral");
  if (minerals.empty()) minerals.push_back(s.text("texture.only_mineral"));
  for (const std::string& mineral : minerals) {
    for (const double ar : swept(s, "sweep.aspect_ratio", "texture.aspect_ratio")) {
      for (const double dip : swept(s, "sweep.dip", "texture.dip")) {
        for (const std::string& parameter : raised) {
          for (const double value : sweep ? swept(s, sweep->list(), sweep->key()) : std::vector<double>{0}) {
            add_repeats({.aspect_ratio = ar,
                         .dip = dip,
                         .seed_scale = s.real("texture.seed_scale"),
                         .growth = s.text("texture.growth"),
                         .between = s.text("interaction.between"),
                         .only_mineral = mineral,
                         .raised = parameter,
                         .pressure_ratio = s.real("packing.pressure_ratio"),
                         .swept = value},
                        s.reals("sweep.dip").empty() ? "sweep.aspect_ratio" : "sweep.dip");
          }
        }
      }
    }
  }
  for (std::size_t i = 0; i < s.count("extra"); ++i) {
    const auto key = [i](const char* name) { return fmt::format("extra[{}].{}", i, name); };
    add_repeats({.aspect_ratio = s.real(key("aspect_ratio")),
                 .dip = s.real("texture.dip"),
                 .seed_scale = s.real(key("seed_scale")),
                 .growth = s.text(key("growth")),
                 .between = s.text(key("between")),
                 .only_mineral = s.text("texture.only_mineral"),
                 .pressure_ratio = s.real(key("pressure_ratio")),
                 .swept = sweep ? s.real(sweep->key()) : 0,
                 .extra = i},
                key("aspect_ratio"));
  }
  return variants;
}

// Two tests of 36,000 particles side by side (17 MB of contacts each) made 430 steps a second together, one of them on both
// threads 480 to 740; tests of 4,500 particles are better off side by side.
int threads_of(double particles) { return std::clamp(static_cast<int>(particles / 15000), 1, 64); }

std::vector<CaseSpec> cases(const Scenario& scenario) {
  const std::vector<std::string>& tests = scenario.texts("tests");
  std::vector<CaseSpec> list;
  for (const std::string& test : tests) {
    if (std::count(tests.begin(), tests.end(), test) > 1) {
      throw scenario.error("tests", "'" + test + "' is named twice", "name each test once");
    }
    for (const Variant& v : variants_of(scenario, test_entry(test).sweep)) {
      CaseSpec made = case_of(scenario, test, v);
      const Settings settings = read_settings(made.scenario, test);
      if (settings.test.loads()) made.threads = threads_of(expected_spheres(settings.packing));
      list.push_back(std::move(made));
    }
  }
  return list;
}

// Runs the test to its end, from its checkpoint if there is one.
Loading load(const Specimen& specimen, const Settings& settings, const CaseSpec& spec, RunContext& context) {
  // Two threads pay from some thousand particles on: below, they mostly wait for each other.
  const auto threads = [useful = static_cast<int>(specimen.packing.radius.size() / 2000), &context] {
    return std::clamp(useful, 1, std::max(1, context.threads_now()));
  };
  Loading loading(specimen, settings, threads());
  Keeper keeper(spec, context);
  if (Loading kept = loading; keeper.resume(kept)) loading = std::move(kept);
  const Test& test = settings.test;
  while (!loading.ended()) {
    keeper.look([&]() -> const Loading& { return loading; });
    loading.set_threads(threads());
    loading.advance();
    if (loading.history().empty()) {
      context.report({std::string(test.before->words), loading.assembly().step(), 0, 0, test.confining_pressure});
      continue;
    }
    const HistoryRow& row = loading.history().back();
    context.report({std::string(test.words), static_cast<std::int64_t>(row.step), loading.fraction(), row.platen_strain,
                    row.axial_stress});
  }
  return loading;
}

Record run(const CaseSpec& spec, RunContext& context) {
  const Settings settings = read_settings(spec.scenario, spec.test());
  const Specimen specimen = make_specimen(settings, context);
  Record record = new_record(model(), spec);
  if (settings.test.loads()) {
    add_test(record, specimen, settings, load(specimen, settings, spec, context));
  } else {
    add_specimen(record, specimen, settings);
  }
  return record;
}

std::vector<std::string> specimens(const CaseSpec& spec) {
  return specimen_files(read_settings(spec.scenario, spec.test()));
}

void make_specimens(const CaseSpec& spec, RunContext& context) {
  keep_specimen(read_settings(spec.scenario, spec.test()), context);
}

}  // namespace

Model model() {
  return {"grain_texture", physics_version, &keys,       &quantities, &parameters, &cases, &run,
          &specimens,      &make_specimens, &measurables};
}

}  // namespace dem::texture
