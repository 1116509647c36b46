// Cases of a scenario, and how one is run.
#include "engine/lattice/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "engine/core/archive.h"

namespace dem::lattice {
namespace {

constexpr std::string_view version = "lattice 1";

// One case as the scenario asks for it.
struct Wanted {
  std::string test;
  std::int64_t elements_y = 12;
  std::string planes, moving, direction, method;
  double factor = 1;     // on loading.factor
  double stiffness = 1;  // on planes.stiffness
};

// 1.5 -> "1_5"
std::string in_id(double value) {
  std::string text = fmt::format("{:g}", value);
  std::replace(text.begin(), text.end(), '.', '_');
  return text;
}

CaseSpec spec_of(const Scenario& s, const Wanted& w, bool beside) {
  Scenario one = s.with("tests", std::vector<std::string>{w.test})
                     .with("block.elements_y", w.elements_y)
                     .with("loading.planes", w.planes)
                     .with("loading.moving", w.moving)
                     .with("loading.direction", w.direction)
                     .with("loading.factor", w.factor * s.real("loading.factor"))
                     .with("planes.stiffness", w.stiffness * s.real("planes.stiffness"))
                     .with("elastic.method", w.method);
  CaseSpec spec{fmt::format("{}_n_{}", w.test, w.elements_y), one, {}, {}};
  if (beside) {
    if (w.planes != "elastic") spec.id += "_" + w.planes;
    if (w.stiffness != 1) spec.id += "_k" + in_id(w.stiffness);
    if (w.moving != "both") spec.id += "_one";
    if (w.direction != "z") spec.id += "_" + w.direction;
    if (w.method != "rest") spec.id += "_" + w.method;
    if (w.factor != 1) spec.id += "_x" + in_id(w.factor);
  }
  (void)read_settings(one);  // bad values are found before anything runs
  std::vector<std::string> prefixes{"rock.", "correction.", "block.", "motion.", "loading.", "measure.", "tests"};
  if (w.test == "elastic") prefixes.emplace_back("elastic.");
  if (one.real("planes.stiffness") != 1) prefixes.emplace_back("planes.");
  spec.content = fmt::format("{}\n{}", version, one.canonical(prefixes));
  spec.parameters = {{"test", w.test},           {"elements_y", static_cast<double>(w.elements_y)},
                     {"planes", w.planes},       {"moving", w.moving},
                     {"direction", w.direction}, {"factor", w.factor}};
  if (w.test == "elastic") spec.parameters.emplace_back("method", w.method);
  if (w.stiffness != 1) spec.parameters.emplace_back("stiffness", w.stiffness);
  return spec;
}

std::vector<CaseSpec> cases(const Scenario& s) {
  std::vector<CaseSpec> all;
  const auto add = [&](const Wanted& w, bool beside) {
    CaseSpec spec = spec_of(s, w, beside);
    if (std::none_of(all.begin(), all.end(), [&](const CaseSpec& c) { return c.id == spec.id; }))
      all.push_back(std::move(spec));
  };
  for (const std::string& test : s.texts("tests")) {
    for (const std::int64_t n : s.integers("sweep.elements_y")) {
      add({test, n, s.text("loading.planes"), s.text("loading.moving"), s.text("loading.direction"),
           s.text("elastic.method")},
          false);
    }
  }
  for (std::size_t i = 0; i < s.count("extra"); ++i) {
    const auto key = [i](const char* name) { return fmt::format("extra[{}].{}", i, name); };
    add({s.text(key("test")), s.integer(key("elements_y")), s.text(key("planes")), s.text(key("moving")),
         s.text(key("direction")), s.text(key("method")), s.real(key("factor")), s.real(key("stiffness"))},
        true);
  }
  if (all.empty())
    throw InputError({s.file(), 0, 0}, "tests", "there is no case", "list at least one test and one block");
  return all;
}

Record head_of(const CaseSpec& spec, const Settings& settings) {
  Record r;
  r.model = "lattice";
  r.scenario = spec.scenario.name();
  r.case_id = spec.id;
  r.content = spec.content;
  r.physics_version = version;
  r.seed = spec.scenario.seed();
  r.parameters = spec.parameters;
  const Micro& m = settings.micro;
  r.results = {{"normal_stiffness_N_per_m", m.kn},
               {"shear_stiffness_N_per_m", m.ks},
               {"breaking_displacement_m", m.xb},
               {"initial_shear_resistance_N", m.fs0},
               {"contact_friction", m.mu},
               {"element_mass_kg", m.mass},
               {"opening_stress_theory_MPa", 1e-6 * opening_stress(m)}};
  return r;
}

// Saves the test now and then, and when asked to stop.
class Keeper {
 public:
  Keeper(const CaseSpec& spec, RunContext& context) : spec_(spec), context_(context), last_(Clock::now()) {}

  void look(const StrengthTest& test) {
    const bool stop = context_.stopped();
    const double since = std::chrono::duration<double>(Clock::now() - last_).count();
    if (!stop && since < context_.checkpoint_seconds) return;
    if (!context_.checkpoint.empty()) save_checkpoint(context_.checkpoint, spec_.content, test.state());
    if (stop) throw Interrupted{};
    last_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  const CaseSpec& spec_;
  RunContext& context_;
  Clock::time_point last_;
};

void run_strength(Record& record, const CaseSpec& spec, const Settings& settings, const Block& block,
                  RunContext& context) {
  StrengthTest test(block, settings.setup, settings.loading);
  if (!context.checkpoint.empty()) {
    StrengthTest::State state = test.state();
    if (load_checkpoint(context.checkpoint, spec.content, state).loaded) test.restore(state);
  }
  Keeper keeper(spec, context);
  const bool tension = settings.test == "tension";
  const double strength = tension ? settings.rock.tensile_strength : settings.rock.compressive_strength;
  const double expected = strength / settings.rock.young_modulus;
  for (int i = 0; test.advance(); ++i) {
    if (i % 10 != 0) continue;
    keeper.look(test);
    const double strain = std::abs(test.solver().strain());
    double done = 0.95 * std::min(1.0, strain / (1.3 * expected));
    if (test.failed()) {
      done = 0.95 +
             0.05 * static_cast<double>(test.solver().step() - test.failed_at()) / std::max(1, settings.loading.after);
    }
    context.report({"loading", test.solver().step(), done, strain, test.latest_stress()});
  }
  if (test.solver().cracks().empty()) {
    throw CaseError(fmt::format("no bond of the block of {} elements broke up to a strain of {:.3g}", block.site.size(),
                                settings.loading.largest_strain));
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
  Record record = head_of(spec, settings);
  if (settings.test == "elastic") {
    run_elastic(record, settings, block, context);
  } else {
    run_strength(record, spec, settings, block, context);
  }
  return record;
}

}  // namespace

Model model() { return {"lattice", version, keys, cases, run}; }

}  // namespace dem::lattice
