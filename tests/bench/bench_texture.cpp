// Speed of the grain texture solver: one JSON line a figure.
//   bench_texture [smoke|draft|paper] [steps]
#include <fmt/core.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "engine/texture/setup.h"

namespace {

using namespace dem::texture;

// Table 4 of Zhao et al. 2021.
Settings granite(double diameter, double height) {
  Settings s;
  const double degree = 0.017453292519943295;
  const auto mineral = [&](const char* name, double share, double low, double high, double density, double e, double k,
                           double tension, double cohesion, double angle) {
    s.minerals.push_back({name, share, low * 1e-3, high * 1e-3, density, e * 1e9, k, 0.6, e * 1e9, k, tension * 1e6,
                          cohesion * 1e6, angle * degree});
  };
  mineral("plagioclase", 0.17, 2, 6, 2600, 55, 1.6, 50, 174, 50);
  mineral("alkali feldspar", 0.48, 3, 4, 2600, 48, 1.6, 40, 188, 50);
  mineral("quartz", 0.29, 2, 3, 2650, 58, 1.0, 58, 292, 60);
  mineral("biotite", 0.06, 2, 2, 2850, 40, 2.0, 26, 90, 40);
  s.interaction = {0.9, 2.0, 1.0, 0.25, 0.7, 1.0};
  s.packing.vessel = {diameter * 1e-3, height * 1e-3};
  s.packing.radius_min = 0.35e-3;
  s.packing.modulus = 58e9;
  s.packing.pressure = 0.58e9;
  return s;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string size = argc > 1 ? argv[1] : "paper";
  const int steps = argc > 2 ? std::atoi(argv[2]) : 400;
  const Settings settings = size == "smoke" ? granite(6.25, 12.5) : size == "draft" ? granite(12.5, 25) : granite(25, 50);
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
      fmt::print("{{\"name\": \"{}\", \"value\": {:.6g}, \"unit\": \"{}\", \"threads\": {}, \"size\": {}}}\n", name, value,
                 unit, threads, input.bonds.size());
    };
    line("texture_contact_updates", contacts * steps / best, "1/s");
    line("texture_particle_steps", particles * steps / best, "1/s");
    line("texture_contact_memory", static_cast<double>(assembly.counts().bytes) / contacts, "B");
  }
  return 0;
}
