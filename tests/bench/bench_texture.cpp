// Speed of the grain texture solver: one JSON line a figure.
//   bench_texture [smoke|draft|paper] [steps]
#include <fmt/core.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "engine/texture/solver/assembly.h"
#include "tests/support/granite.h"

using namespace dem::texture;

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
  for (const int threads : {1, 2}) {
    Assembly assembly(input, threads);
    const double speed = 0.5e-7 * settings.packing.vessel.height / assembly.time_step();
    assembly.drive(speed, -speed, 100);
    assembly.advance(50);
    double best = 1e300;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const auto start = std::chrono::steady_clock::now();
      assembly.advance(steps);
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    const auto line = [&](const char* name, double value, const char* unit) {
      fmt::print("{{\"name\": \"{}\", \"value\": {:.6g}, \"unit\": \"{}\", \"threads\": {}, \"size\": {}}}\n", name,
                 value, unit, threads, input.bonds.size());
    };
    line("texture_contact_updates", contacts * steps / best, "1/s");
    line("texture_particle_steps", particles * steps / best, "1/s");
    line("texture_contact_memory", static_cast<double>(assembly.counts().bytes) / contacts, "B");
  }
  return 0;
}
