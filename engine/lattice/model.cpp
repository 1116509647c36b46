// Cases of a scenario, and how one is run.
#include "engine/lattice/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/lattice/quantities.h"
#include "engine/model/keeper.h"

namespace dem::lattice {
namespace {

constexpr std::string_view version = "lattice 3";

// One case as the scenario asks for it.
struct Wanted {
  std::string test;
  std::int64_t elements_y = 12;
  std::string planes, moving, direction, method;
  double factor = 1;                                                  // on loading.factor
  double stiffness = 1;                                               // on planes.stiffness
  double pressure = 0, tensile_deficit = 0, compressive_deficit = 0;  // Pa, shares
  std::optional<std::size_t> extra = {};  // the [[extra]] that asks for it; none: the sweep does
};

CaseSpec spec_of(const Scenario& s, const Wanted& w) {
  const bool beside = w.extra.has_value();
  // The key that a value comes from, for errors about it; "": the key itself.
  const auto from = [&](const char* name) { return beside ? fmt::format("extra[{}].{}", *w.extra, name) : ""; };
  Scenario one = s.with("tests", std::vector<std::string>{w.test}, from("test"))
                     .with("block.elements_y", w.elements_y, beside ? from("elements_y") : "sweep.elements_y")
                     .with("planes." + w.test, w.planes, from("planes"))
                     .with("loading.moving", w.moving, from("moving"))
                     .with("loading.direction", w.direction, from("direction"))
                     .with("loading.factor", w.factor * s.real("loading.factor"), from("factor"))
                     .with("planes.stiffness", w.stiffness * s.real("planes.stiffness"), from("stiffness"))
                     .with("loading.confining_pressure", w.pressure, from("confining_pressure"))
                     .with("correction.tensile_deficit", w.tensile_deficit, from("tensile_deficit"))
                     .with("correction.compressive_deficit", w.compressive_deficit, from("compressive_deficit"))
                     .with("elastic.method", w.method, from("method"));
  // Without the noise of conversions, as the usual values are.
  const auto percent = [](double share) { return std::round(1e11 * share) / 1e9; };
  const double mega = std::round(1e3 * w.pressure) / 1e9;
  std::string id = fmt::format("{}_n_{}", w.test, w.elements_y);
  if (beside) {
    if (w.planes != s.text("planes." + w.test)) id += "_" + w.planes;
    if (w.stiffness != 1) id += "_k" + id_part(w.stiffness);
    if (w.moving != "both") id += "_one";
    if (w.direction != "z") id += "_" + w.direction;
    if (w.method != "rest") id += "_" + w.method;
    if (w.factor != 1) id += "_x" + id_part(w.factor);
    if (w.pressure != s.real("loading.confining_pressure")) id += "_sigma3_" + id_part(mega);
    if (w.tensile_deficit != s.real("correction.tensile_deficit")) id += "_tu" + id_part(percent(w.tensile_deficit));
    if (w.compressive_deficit != s.real("correction.compressive_deficit"))
      id += "_cu" + id_part(percent(w.compressive_deficit));
  }
  (void)read_settings(one);  // bad values are found before anything runs
  const auto of = [](const Parameter& parameter, ParameterValue value) {
    return std::pair{std::string(parameter.id), std::move(value)};
  };
  Parameters parameters = {{"test", w.test},
                           of(parameter::elements_y, static_cast<double>(w.elements_y)),
                           of(parameter::planes_in(w.test), w.planes),
                           of(parameter::moving, w.moving),
                           of(parameter::direction, w.direction),
                           of(parameter::factor, w.factor),
                           of(parameter::stiffness, w.stiffness),
                           of(parameter::confining_pressure, mega),
                           of(parameter::tensile_deficit, percent(w.tensile_deficit)),
                           of(parameter::compressive_deficit, percent(w.compressive_deficit))};
  if (w.test == "elastic") parameters.push_back(of(parameter::method, w.method));
  return make_case(model(), std::move(id), std::move(one), std::move(parameters), {w.test});
}

std::vector<CaseSpec> cases(const Scenario& s) {
  refuse_repeated(s, "tests", s.texts("tests"));
  refuse_repeated(s, "sweep.elements_y", s.integers("sweep.elements_y"));
  std::vector<CaseSpec> all;
  const auto add = [&](const Wanted& w, const std::string& extra) {
    CaseSpec spec = spec_of(s, w);
    const auto there = std::ranges::find(all, spec.id, &CaseSpec::id);
    if (there != all.end()) {
      if (there->content == spec.content) return;  // the very same case, which the sweep has too
      throw s.error(extra, "another case is called " + spec.id, "give values that tell the two apart");
    }
    all.push_back(std::move(spec));
  };
  for (const std::string& test : s.texts("tests")) {
    for (const std::int64_t n : s.integers("sweep.elements_y")) {
      add({.test = test,
           .elements_y = n,
           .planes = s.text("planes." + test),
           .moving = s.text("loading.moving"),
           .direction = s.text("loading.direction"),
           .method = s.text("elastic.method"),
           .pressure = s.real("loading.confining_pressure"),
           .tensile_deficit = s.real("correction.tensile_deficit"),
           .compressive_deficit = s.real("correction.compressive_deficit")},
          "");
    }
  }
  for (std::size_t i = 0; i < s.count("extra"); ++i) {
    const auto key = [i](const char* name) { return fmt::format("extra[{}].{}", i, name); };
    add({s.text(key("test")), s.integer(key("elements_y")), s.text(key("planes")), s.text(key("moving")),
         s.text(key("direction")), s.text(key("method")), s.real(key("factor")), s.real(key("stiffness")),
         s.real(key("confining_pressure")), s.real(key("tensile_deficit")), s.real(key("compressive_deficit")), i},
        key("test"));
  }
  if (all.empty())
    throw s.error(s.texts("tests").empty() ? "tests" : "sweep.elements_y", "there is no case",
                  "list at least one test and one block");
  return all;
}

void add_micro(Record& r, const Micro& m) {
  r.put(quantity::normal_stiffness, m.kn);
  r.put(quantity::shear_stiffness, m.ks);
  r.put(quantity::breaking_displacement, m.xb);
  r.put(quantity::initial_shear_resistance, m.fs0);
  r.put(quantity::contact_friction, m.mu);
  r.put(quantity::element_mass, m.mass);
  r.put(quantity::opening_stress_theory, 1e-6 * opening_stress(m));
}

void run_strength(Record& record, const CaseSpec& spec, const Settings& settings, const Block& block,
                  RunContext& context) {
  StrengthTest test(block, settings.setup, settings.loading);
  Keeper keeper(spec, context);
  if (StrengthTest::State state = test.state(); keeper.resume(state)) test.restore(state);
  const bool tension = settings.test == "tension";
  const double strength = tension ? settings.rock.tensile_strength : settings.rock.compressive_strength;
  const double expected = strength / settings.rock.young_modulus;
  for (int i = 0; test.advance(); ++i) {
    if (i % 10 != 0) continue;
    keeper.look([&] { return test.state(); });
    const double strain = std::abs(test.solver().strain());
    // Where it will fail is a guess: a quarter further than here at least, and where it is given up at most.
    const Loading& l = settings.loading;
    double done = 0.95 * std::min(1.0, strain / std::min(std::max(1.3 * expected, 1.25 * strain), l.largest_strain));
    done = std::max(done, 0.95 * static_cast<double>(test.solver().step()) / static_cast<double>(l.most_steps));
    if (test.failed()) {
      done = 0.95 +
             0.05 * static_cast<double>(test.solver().step() - test.failed_at()) / std::max(1, settings.loading.after);
    }
    context.report({"loading", test.solver().step(), done, strain, test.latest_stress()});
  }
  add_strength(record, settings, block, test);
}

void run_elastic(Record& record, const Settings& settings, const Block& block, RunContext& context) {
  const auto tick = [&](double share) {
    if (context.stopped()) throw Interrupted{};
    context.report({"elastic", 0, share, share * settings.strains.back(), std::numeric_limits<double>::quiet_NaN()});
  };
  const auto points = settings.method == ElasticMethod::rest
                          ? elastic_at_rest(block, settings.setup, settings.strains, tick)
                          : elastic_by_steps(block, settings.setup, settings.loading, settings.strains, tick);
  add_elastic(record, settings, block, points);
}

Record run(const CaseSpec& spec, RunContext& context) {
  Settings settings = read_settings(spec.scenario);
  // Two threads meet twice a step: below about a thousand elements one is faster.
  const Block block = make_block(settings.shape, settings.micro.diameter);
  settings.setup.threads = block.site.size() < 1000 ? 1 : context.threads;
  settings.setup.set = fastest_set(block, settings.setup);
  Record record = new_record(model(), spec);
  add_micro(record, settings.micro);
  constexpr double little = 0.05;
  if (settings.micro.ks < little * settings.micro.kn) {
    record.notes.push_back(fmt::format(
        "The shear stiffness of a bond is {:.2g} of its normal stiffness, because Poisson’s ratio is near its limit of "
        "0.2: the block shears with hardly any resistance.",
        settings.micro.ks / settings.micro.kn));
  }
  if (settings.test == "elastic") {
    run_elastic(record, settings, block, context);
  } else {
    run_strength(record, spec, settings, block, context);
  }
  return record;
}

}  // namespace

Model model() { return {"lattice", version, keys, quantities, parameters, cases, run}; }

}  // namespace dem::lattice
