// Speed of the grain texture solver: one JSON line a figure.
//   bench_texture [smoke|draft|paper] [steps]
#include <fmt/core.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "engine/core/instruction_set.h"
#include "engine/texture/solver/assembly.h"
#include "tests/support/granite.h"

using namespace dem::texture;

namespace {

// Time of this thread on a processor: what a core does, however busy the machine.
double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void drive(Assembly& assembly, const Settings& settings) {
  const double speed = 0.5e-7 * settings.packing.vessel.height / assembly.time_step();
  assembly.drive(speed, -speed, 100);
  assembly.advance(50);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string size = argc > 1 ? argv[1] : "paper";
  const int steps = argc > 2 ? std::atoi(argv[2]) : 400;
  const Settings settings = size == "smoke"   ? dem_test::granite(6.25, 12.5)
                            : size == "draft" ? dem_test::granite(12.5, 25)
                                              : dem_test::granite(25, 50);
  dem::RunContext context;
  context.threads = 2;
  context.specimens = std::filesystem::temp_directory_path() / "dem-bench-specimens";
  std::filesystem::create_directories(context.specimens);
  const Specimen specimen = make_specimen(settings, context);
  const AssemblyInput input = assembly_input(specimen, settings);
  const double contacts = static_cast<double>(input.bonds.size());
  const double particles = static_cast<double>(input.position.size());
  const auto line = [&](const std::string& name, double value, const char* unit, int threads) {
    fmt::print("{{\"name\": \"{}\", \"value\": {:.6g}, \"unit\": \"{}\", \"threads\": {}, \"size\": {}}}\n", name,
               value, unit, threads, input.bonds.size());
  };
  for (const dem::InstructionSet set : dem::instruction_sets()) {
    Assembly assembly(input, 1);
    assembly.set_kernels(kernels(set));
    drive(assembly, settings);
    double best = 1e300;
    for (int window = 0; window < 40; ++window) {
      const double start = thread_seconds();
      assembly.advance(steps / 20);
      best = std::min(best, thread_seconds() - start);
    }
    line(fmt::format("texture_contact_updates_{}_cpu", dem::name_of(set)), contacts * (steps / 20) / best, "1/s", 1);
  }
  for (const int threads : {1, 2}) {
    Assembly assembly(input, threads);
    drive(assembly, settings);
    double best = 1e300;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const auto start = std::chrono::steady_clock::now();
      assembly.advance(steps);
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    line("texture_contact_updates", contacts * steps / best, "1/s", threads);
    line("texture_particle_steps", particles * steps / best, "1/s", threads);
    line("texture_contact_memory", static_cast<double>(assembly.counts().bytes) / contacts, "B", threads);
  }
  return 0;
}
