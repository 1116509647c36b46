// Times of the spring sheet: factor, solve, load step from scratch, one break with its new equilibrium, and what the
// historical sweep would take to come as far. bench_sheet [COLUMNS] [BREAKS] [THREADS]
#include <fmt/core.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <span>

#include "engine/sheet/experiment.h"
#include "engine/sheet/grains.h"
#include "engine/sheet/stiffness.h"

namespace {

using namespace dem::sheet;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Time on processors, all threads together: what it costs however busy the machine is.
double cpu() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

void line(const char* name, double value, const char* unit, int threads, int size) {
  fmt::print("{{\"name\": \"{}\", \"value\": {:.6g}, \"unit\": \"{}\", \"threads\": {}, \"size\": {}}}\n", name, value,
             unit, threads, size);
  std::fflush(stdout);
}

Sheet polycrystal(int columns) {
  Sheet sheet = make_sheet(columns);
  const ElleMap map = voronoi_map({});
  apply_disorder(sheet, cover(map, sheet), std::vector<GrainProperties>(map.flynns.size()), {}, 1);
  return sheet;
}

// One broken spring relaxed by the historical sweep until it is as converged as ours, and by our solver, on a small
// sheet: the sweep needs about (columns)^2 sweeps of (columns)^2 particles. Times are of the processor, one thread.
struct Race {
  double sweeps = 0, sweep_seconds = 0, our_seconds = 0;
};
Race race(int columns, int threads) {
  Sheet sheet = polycrystal(columns);
  ConvergedSettings settings;
  settings.threads = threads;
  ConvergedSolver solver(sheet, settings);
  Loading loading;
  loading.steps = 100;
  loading.most_breaks = 50;
  Experiment experiment(sheet, solver, loading, threads);
  experiment.run();
  Forces forces;
  compute_forces(sheet, forces, threads);
  const int slot = most_critical(sheet, forces, threads).slot;
  sheet.joined[static_cast<std::size_t>(slot)] = 0;
  Sheet other = sheet;
  Race r;
  double t = cpu();
  (void)solver.relax(sheet, forces, std::span(&slot, 1));
  r.our_seconds = cpu() - t;
  HistoricalSettings block;
  block.stop = 0;
  block.most_sweeps = 100;
  HistoricalSolver historical(block, 1);
  compute_forces(other, forces, threads);
  t = cpu();
  while (forces.unbalanced > settings.tolerance * forces.largest && r.sweeps < 1e6) {
    historical.relax(other, forces, {});
    r.sweeps += block.most_sweeps;
  }
  r.sweep_seconds = cpu() - t;
  return r;
}

}  // namespace

int main(int argc, char** argv) {
  const int columns = argc > 1 ? std::atoi(argv[1]) : 400;
  const int breaks = argc > 2 ? std::atoi(argv[2]) : 200;
  const int threads = argc > 3 ? std::atoi(argv[3]) : 2;
  Sheet sheet = polycrystal(columns);
  const int size = sheet.particles();

  Forces forces;
  compute_forces(sheet, forces, threads);
  double t = now();
  for (int k = 0; k < 10; ++k) compute_forces(sheet, forces, threads);
  line("forces", (now() - t) / 10, "s", threads, size);
  {
    t = now();
    const Dissection dissection(sheet.lattice);
    line("dissection", now() - t, "s", threads, size);
    ModifiedFactor factor(dissection, threads);
    const BlockMatrix matrix = assemble(sheet, forces);
    t = now();
    factor.factorise(matrix);
    line("factor", now() - t, "s", threads, size);
    line("factor_bytes", static_cast<double>(factor.factor().bytes()), "B", threads, size);
    std::vector<double> b(2 * static_cast<std::size_t>(size), 1e-6);
    t = now();
    for (int k = 0; k < 5; ++k) factor.solve(b);
    line("solve", (now() - t) / 5, "s", threads, size);
  }

  ConvergedSettings settings;
  settings.threads = threads;
  t = now();
  ConvergedSolver solver(sheet, settings);
  Loading loading;
  loading.steps = 100;
  loading.most_breaks = breaks;
  Experiment experiment(sheet, solver, loading, threads);
  experiment.advance();
  line("load_step_from_scratch", now() - t, "s", threads, size);
  double in_breaks = 0, cpu_in_breaks = 0;
  bool more = true;
  while (more) {
    const auto before = experiment.state().breaks.size();
    t = now();
    const double spent = cpu();
    more = experiment.advance();
    if (experiment.state().breaks.size() > before) in_breaks += now() - t, cpu_in_breaks += cpu() - spent;
  }
  const auto done = static_cast<double>(experiment.state().breaks.size());
  const SolverWork work = solver.work();
  line("break", in_breaks / done, "s", threads, size);
  line("break_cpu", cpu_in_breaks / done, "s", threads, size);
  line("breaks", done, "1", threads, size);
  line("solves_a_relaxation", static_cast<double>(work.solves) / static_cast<double>(work.relaxations), "1", threads,
       size);
  line("breaks_a_factor", done / static_cast<double>(work.factorisations), "1", threads, size);
  line("worst_unbalanced", experiment.state().equilibrium.worst, "1", threads, size);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  line("memory", static_cast<double>(usage.ru_maxrss) / 1048576.0, "GiB", threads, size);

  HistoricalSettings sweeps;
  sweeps.stop = 0;
  sweeps.most_sweeps = 20;
  HistoricalSolver historical(sweeps, threads);
  t = cpu();
  historical.relax(sheet, forces, {});
  const double sweep = (cpu() - t) / sweeps.most_sweeps;
  line("historical_sweep", sweep, "s", 1, size);
  const int small = columns < 100 ? columns : 100;
  const Race r = race(small, 1);
  const Sheet of_race = make_sheet(small);
  line("historical_sweeps_a_break", r.sweeps, "1", 1, of_race.particles());
  line("historical_break_as_converged", r.sweep_seconds, "s", 1, of_race.particles());
  line("times_faster", r.sweep_seconds / r.our_seconds, "1", 1, of_race.particles());
  const double scale = static_cast<double>(size) / of_race.particles();
  line("historical_break_extrapolated", r.sweeps * scale * sweep, "s", 1, size);
  line("times_faster_extrapolated", r.sweeps * scale * sweep / (cpu_in_breaks / done), "1", threads, size);
  return 0;
}
