// What threads bring where the cores are not ours alone: the work of the three solvers in windows of a quarter of a
// second, on one thread and on two in turn, beside no other process and beside one busy process a core.
// One JSON line a figure: the median over the windows, and the median of the ratio of two threads to one next to it.
//   bench_busy [texture|lattice|sheet|all] [WINDOWS]
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/lattice/solver.h"
#include "engine/sheet/experiment.h"
#include "engine/sheet/grains.h"
#include "engine/texture/solver/assembly.h"
#include "tests/support/granite.h"

namespace {

constexpr double window = 0.25;  // s

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Processes at full load, until it goes out of scope.
class Load {
 public:
  explicit Load(int processes) {
    for (int i = 0; i < processes; ++i) {
      const pid_t child = fork();
      if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        for (volatile bool working = true; working;) {
        }
      }
      if (child > 0) children_.push_back(child);
    }
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;
  ~Load() {
    for (const pid_t child : children_) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
  }

 private:
  std::vector<pid_t> children_;
};

/// Some of the work of a solver on one thread (0) or two (1); returns how much that was.
using Work = std::function<double(std::size_t)>;

void compare(const std::string& solver, const char* unit, const Work& work, int windows) {
  for (const int beside : {0, 2}) {
    const Load load(beside);
    std::vector<double> rate[2], ratio;
    for (int w = 0; w < windows; ++w) {
      double made[2] = {};
      for (std::size_t which : {w % 2, 1 - w % 2}) {
        const double start = now();
        double units = 0, end = start;
        while (end < start + window) {
          units += work(which);
          end = now();
        }
        made[which] = units / (end - start);
        rate[which].push_back(made[which]);
      }
      ratio.push_back(made[1] / made[0]);
    }
    for (const int threads : {1, 2}) {
      fmt::print("{{\"name\": \"{}_beside_{}\", \"value\": {:.5g}, \"unit\": \"{}\", \"threads\": {}}}\n", solver,
                 beside, median(rate[threads - 1]), unit, threads);
    }
    fmt::print("{{\"name\": \"{}_beside_{}_two_to_one\", \"value\": {:.3f}, \"unit\": \"1\", \"threads\": 2}}\n",
               solver, beside, median(ratio));
    std::fflush(stdout);
  }
}

void texture(int windows) {
  namespace t = dem::texture;
  const t::Settings settings = dem_test::granite(12.5, 25);
  dem::RunContext context;
  context.threads = 2;
  context.specimens = std::filesystem::temp_directory_path() / "dem-bench-specimens";
  std::filesystem::create_directories(context.specimens);
  const t::AssemblyInput input = t::assembly_input(t::make_specimen(settings, context), settings);
  std::deque<t::Assembly> assemblies;
  for (const int threads : {1, 2}) {
    t::Assembly& assembly = assemblies.emplace_back(input, threads);
    const double speed = 0.5e-7 * settings.packing.vessel.height / assembly.time_step();
    assembly.drive(speed, -speed, 100);
  }
  compare(
      "texture", "steps/s",
      [&](std::size_t which) {
        assemblies[which].advance(20);
        return 20.0;
      },
      windows);
}

void lattice(int windows) {
  namespace l = dem::lattice;
  const l::Block block = l::make_block(l::block_shape(12), 1e-3);
  std::vector<l::Solver> solvers;
  for (const int threads : {1, 2}) {
    l::Setup setup;
    setup.micro = l::micro_of({90e9, 0.16, 25e6, 252e6, 1, 2650}, 1e-3);
    setup.viscosity = l::viscosity(setup.micro, static_cast<long>(block.site.size()));
    setup.threads = threads;
    solvers.emplace_back(block, setup);
  }
  compare(
      "lattice", "steps/s",
      [&](std::size_t which) {
        solvers[which].run(50, 1.7e-12, -1.7e-12);
        return 50.0;
      },
      windows);
}

void sheet(int windows) {
  namespace s = dem::sheet;
  s::Sheet sheet = s::make_sheet(200);
  const s::ElleMap map = s::voronoi_map({});
  s::apply_disorder(sheet, s::cover(map, sheet), std::vector<s::GrainProperties>(map.flynns.size()), {}, 1);
  std::deque<s::Sheet> sheets(2, sheet);
  std::deque<s::ConvergedSolver> solvers;
  std::deque<s::Experiment> experiments;
  for (const int threads : {1, 2}) {
    s::ConvergedSettings settings;
    settings.threads = threads;
    s::Sheet& one = sheets[static_cast<std::size_t>(threads - 1)];
    solvers.emplace_back(one, settings);
    s::Loading loading;
    loading.steps = 100;
    loading.most_breaks = 1000000;
    experiments.emplace_back(one, solvers.back(), loading, threads).advance();
  }
  compare(
      "sheet", "equilibria/s",
      [&](std::size_t which) {
        experiments[which].advance();
        return 1.0;
      },
      windows);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string which = argc > 1 ? argv[1] : "all";
  const int windows = argc > 2 ? std::max(1, std::atoi(argv[2])) : 21;
  if (which == "texture" || which == "all") texture(windows);
  if (which == "lattice" || which == "all") lattice(windows);
  if (which == "sheet" || which == "all") sheet(windows);
  return 0;
}
