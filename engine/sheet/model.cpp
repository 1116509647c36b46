// Cases of a scenario, and how one is run.
#include "engine/sheet/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "engine/model/keeper.h"
#include "engine/sheet/quantities.h"

namespace dem::sheet {
namespace {

constexpr std::string_view version = "sheet 9";

// Keys that this case has no use for.
std::vector<std::pair<std::string, std::string>> idle_keys(const Scenario& s, const Settings& settings) {
  std::vector<std::pair<std::string, std::string>> idle;
  const auto add = [&](const char* path, const std::string& why) { idle.emplace_back(path, why); };
  const bool grown = settings.source == "voronoi", layers = settings.source == "layers";
  const std::string source = "grains.source is \"" + settings.source + "\"";
  if (!grown) {
    for (const char* path : {"grains.count", "grains.periodic", "grains.expanding", "grains.expanding_mineral"})
      add(path, "it is for grown grains, and " + source);
  }
  if (!layers) {
    for (const char* path : {"grains.layer_low", "grains.layer_high", "grains.layer_grains"})
      add(path, "it is for source \"layers\", and " + source);
  }
  if (grown && settings.expanding == 0) add("grains.expanding_mineral", "grains.expanding is 0");
  if (settings.source == "file") add("grains.lloyd", "it is for grown grains, and " + source);
  if (layers && settings.layer_grains < 2) add("grains.lloyd", "the layer is one grain");
  const bool growth = settings.loading.kind == LoadingKind::growth;
  if (growth) add("loading.step", "marked grains grow by the growth of their [[rule]]");
  for (std::size_t i = 0; i < settings.rules.size(); ++i) {
    if (!growth)
      idle.emplace_back(fmt::format("rule[{}].growth", i),
                        "it is for loading.kind \"growth\", and loading.kind is \"" + s.text("loading.kind") + "\"");
  }
  return idle;
}

// A broken file, a map that does not cover the sheet or has too few grains, and a rule that fits nothing are found before
// anything runs.
void refuse_specimen(const Scenario& s, const Settings& settings) {
  if (settings.source != "file" && settings.expanding == 0 && settings.rules.empty()) return;
  try {
    (void)make_specimen(settings);
  } catch (const RuleError& rule) {
    throw s.error(fmt::format("rule[{}].{}", rule.rule, rule.key), rule.wrong, rule.right());
  } catch (const TooFewInside& few) {
    throw s.error(
        "grains.expanding",
        fmt::format("{} grains should expand, but only {} lie inside the box", settings.expanding, few.inside),
        "lower it or raise grains.count");
  }
}

CaseSpec case_of(Scenario one, std::string id, bool check) {
  const Settings settings = read_settings(one);
  if (check) refuse_specimen(one, settings);
  const std::string kind = one.text("loading.kind");
  std::string inputs;
  if (settings.source == "file")
    inputs = "map = " + sha256(read_input(settings.file, largest_map, {}, "grains.file")) + "\n";
  const auto of = [](const Parameter& parameter, ParameterValue value) {
    return std::pair{std::string(parameter.id), std::move(value)};
  };
  Parameters parameters = {{"test", kind},
                           of(parameter::spread, one.real("disorder.spread")),
                           of(parameter::solver, settings.solver),
                           of(parameter::columns, static_cast<double>(settings.columns)),
                           of(parameter::seed, static_cast<double>(settings.seed))};
  auto idle = idle_keys(one, settings);
  CaseSpec made =
      make_case(model(), std::move(id), std::move(one), std::move(parameters), {kind, settings.solver}, inputs);
  made.idle = std::move(idle);
  return made;
}

std::vector<CaseSpec> cases(const Scenario& s) {
  const std::string& kind = s.text("loading.kind");
  std::vector<double> spreads = s.reals("sweep.spread");
  const bool swept = !spreads.empty();
  if (!swept) spreads.push_back(s.real("disorder.spread"));
  refuse_repeated(s, "sweep.spread", s.reals("sweep.spread"));
  refuse_repeated(s, "solvers", s.texts("solvers"));
  const std::vector<std::int64_t> seeds = seeds_of(s);
  std::vector<CaseSpec> all;
  for (const std::string& solver : s.texts("solvers")) {
    const bool main = solver == s.texts("solvers").front();
    for (const double spread : spreads) {
      for (const std::int64_t seed : seeds) {
        // Another solver is set beside the first case.
        if (!main && (spread != spreads.front() || seed != seeds.front())) continue;
        std::string id = kind;
        if (swept) id += "_spread_" + id_part(spread);
        if (!main) id += "_" + solver;
        all.push_back(case_of(s.with("solvers", std::vector<std::string>{solver})
                                  .with("disorder.spread", spread, swept ? "sweep.spread" : "")
                                  .with("seed", seed),
                              std::move(id) + seed_part(s, seed), main && spread == spreads.front()));
      }
    }
  }
  return all;
}

// What a checkpoint keeps.
struct Kept {
  ExperimentState experiment;
  ConvergedState solver;
  SolverWork work;
  std::vector<std::vector<double>> fields;  // of the snapshots taken: displacement, mean, differential, strain
  std::uint64_t next_snapshot = 0;

  template <class Archive>
  void archive(Archive& a) {
    a(experiment, solver, work, fields, next_snapshot);
  }
};

Table table_of(const std::string& name, const std::vector<std::vector<double>>& fields, std::size_t at) {
  Table t;
  t.name = name;
  t.attributes = {{"strain", fmt::format("{:g}", fields[at + 3].front())}};
  t.add("displacement", "1", fields[at], 2);
  t.add("mean_stress", "1", fields[at + 1]);
  t.add("differential_stress", "1", fields[at + 2]);
  return t;
}

class Run {
 public:
  Run(const CaseSpec& spec, RunContext& context)
      : spec_(spec),
        context_(context),
        settings_(read_settings(spec.scenario)),
        specimen_(make_specimen(settings_)),
        keeper_(spec, context) {
    // Below some ten thousand particles threads wait for each other longer than they work; the result is the same.
    threads_ = specimen_.sheet.particles() < 12000 ? 1 : context.threads;
    settings_.loading.grows = specimen_.grows;
    settings_.converged.threads = threads_;
    initial_ = specimen_.sheet;
    if (settings_.solver == "converged") {
      converged_ = std::make_unique<ConvergedSolver>(specimen_.sheet, settings_.converged);
    } else {
      historical_ = std::make_unique<HistoricalSolver>(settings_.historical, threads_);
    }
    experiment_ = std::make_unique<Experiment>(specimen_.sheet, solver(), settings_.loading, threads_);
  }

  Record record() {
    resume();
    experiment_->run([&](const Experiment&) {
      observe();
      return true;
    });
    observe();
    if (kept_.fields.empty() || kept_.fields.back().front() != experiment_->strain()) take();
    Record r = new_record(model(), spec_);
    const Specimen before{initial_, specimen_.map, specimen_.cover, specimen_.grains, specimen_.grows};
    add_results(r, settings_, before, *experiment_, total_work());
    if (kept_.next_snapshot < settings_.snapshots.size()) {
      r.notes.push_back(
          fmt::format("The loading ended at a strain of {:g}, before the snapshots at {:g}: {}.", experiment_->strain(),
                      fmt::join(std::span(settings_.snapshots).subspan(kept_.next_snapshot), ", "),
                      static_cast<int>(experiment_->state().breaks.size()) >= settings_.loading.most_breaks
                          ? "most_breaks springs were broken"
                          : "the stress had fallen below its stop_share"));
    }
    for (std::size_t k = 0; k < kept_.fields.size(); k += 4) {
      r.tables.push_back(table_of(fmt::format("snapshots/{:04}", k / 4), kept_.fields, k));
    }
    return r;
  }

 private:
  Solver& solver() { return converged_ ? static_cast<Solver&>(*converged_) : *historical_; }

  SolverWork total_work() {
    SolverWork w = solver().work();
    const SolverWork& before = kept_.work;
    w.relaxations += before.relaxations, w.solves += before.solves, w.patches += before.patches;
    w.factorisations += before.factorisations, w.changes += before.changes, w.searches += before.searches;
    w.negative_pivots += before.negative_pivots, w.settled += before.settled;
    return w;
  }

  void resume() {
    if (!keeper_.resume(kept_)) return;
    experiment_->restore(kept_.experiment);
    if (converged_ && !kept_.solver.coupling.empty()) {
      converged_->restore(specimen_.sheet, kept_.solver);
      // The factor that was made again has been counted before.
      kept_.work.factorisations -= solver().work().factorisations;
      kept_.work.changes -= solver().work().changes;
      kept_.work.negative_pivots -= solver().work().negative_pivots;
    }
  }

  void observe() {
    const ExperimentState& state = experiment_->state();
    if (experiment_->between_steps() && kept_.next_snapshot < settings_.snapshots.size() &&
        experiment_->strain() >= settings_.snapshots[kept_.next_snapshot] * (1 - 1e-9)) {
      take();
      while (kept_.next_snapshot < settings_.snapshots.size() &&
             experiment_->strain() >= settings_.snapshots[kept_.next_snapshot] * (1 - 1e-9)) {
        ++kept_.next_snapshot;
      }
    }
    const WallStress wall = wall_stress(experiment_->sheet(), experiment_->forces());
    const double still =  // of the load step: half of it is loading
        state.breaking   ? 0.5
        : state.left > 0 ? 0.5 + 0.5 * static_cast<double>(state.left) / static_cast<double>(state.whole)
                         : 0.0;
    const double done = (state.step - still) / std::max(1, settings_.loading.steps);
    context_.report({"loading", static_cast<std::int64_t>(state.breaks.size()), std::clamp(done, 0.0, 1.0),
                     experiment_->strain(), 1e10 * (wall.xx - wall.yy)});  // k = 1 stands for 10 GPa
    keeper_.look([&] {
      Kept now{experiment_->snapshot(), {}, total_work(), kept_.fields, kept_.next_snapshot};
      if (converged_) now.solver = converged_->state();
      return now;
    });
  }

  void take() {
    const Specimen before{initial_, {}, {}, {}, {}};
    Table t = snapshot_table("", before, *experiment_);
    for (auto& column : t.columns) kept_.fields.push_back(std::get<std::vector<double>>(std::move(column.values)));
    kept_.fields.push_back({experiment_->strain()});
  }

  const CaseSpec& spec_;
  RunContext& context_;
  Settings settings_;
  Specimen specimen_;
  Sheet initial_;
  int threads_ = 1;
  std::unique_ptr<ConvergedSolver> converged_;
  std::unique_ptr<HistoricalSolver> historical_;
  std::unique_ptr<Experiment> experiment_;
  Kept kept_;
  Keeper keeper_;
};

Record run(const CaseSpec& spec, RunContext& context) { return Run(spec, context).record(); }

}  // namespace

Model model() { return {"sheet", version, keys, quantities, parameters, cases, run}; }

}  // namespace dem::sheet
