#pragma once
// Table 4 of Zhao et al. 2021 (in compression) and small assemblies, for tests and benchmarks.
#include <array>
#include <numbers>

#include "engine/core/random.h"
#include "engine/texture/loading/compression.h"
#include "engine/texture/setup.h"
#include "engine/texture/solver/slabs.h"

namespace dem_test {

inline dem::texture::Settings granite(double diameter_mm, double height_mm) {
  dem::texture::Settings s;
  const auto mineral = [&](const char* name, double share, double low, double high, double density, double e, double k,
                           double tension, double cohesion, double angle) {
    s.minerals.push_back({name, share, low * 1e-3, high * 1e-3, density, e * 1e9, k, 0.6, e * 1e9, k, tension * 1e6,
                          cohesion * 1e6, angle * std::numbers::pi / 180});
  };
  mineral("plagioclase", 0.17, 2, 6, 2600, 55, 1.6, 50, 174, 50);
  mineral("alkali feldspar", 0.48, 3, 4, 2600, 48, 1.6, 40, 188, 50);
  mineral("quartz", 0.29, 2, 3, 2650, 58, 1.0, 58, 292, 60);
  mineral("biotite", 0.06, 2, 2, 2850, 40, 2.0, 26, 90, 40);
  s.interaction = {0.9, 2.0, 1.0, 0.25, 0.7, 1.0};
  s.packing.vessel = {diameter_mm * 1e-3, height_mm * 1e-3};
  s.packing.radius_min = 0.35e-3;
  s.packing.modulus = 58e9;
  s.packing.pressure = 0.58e9;
  s.test = dem::texture::compression();
  return s;
}

/// The packing and the minerals alone, for tests of specimens: diameter (m), height twice the diameter.
inline dem::texture::PackingSettings granite_packing(double diameter, std::uint64_t seed = 1) {
  dem::texture::PackingSettings packing = granite(diameter * 1e3, 2e3 * diameter).packing;
  packing.vessel = {diameter, 2 * diameter};
  packing.seed = seed;
  return packing;
}

inline std::vector<dem::texture::MineralGrains> granite_minerals() {
  std::vector<dem::texture::MineralGrains> grains;
  for (const dem::texture::Mineral& m : granite(10, 20).minerals)
    grains.push_back({m.share, m.diameter_min, m.diameter_max});
  return grains;
}

/// A jittered cubic block of bonded spheres of two minerals; grain boundaries where the minerals meet and at random.
inline dem::texture::AssemblyInput block(int nx, int ny, int nz) {
  using namespace dem::texture;
  const Settings s = granite(10, 20);
  dem::RandomStream random(7, dem::Purpose::test_data);
  std::vector<Vec3> position;
  std::vector<double> radius;
  const double d = 0.8e-3;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        position.push_back({x * d + random.uniform(-0.02, 0.02) * d, y * d + random.uniform(-0.02, 0.02) * d,
                            (z + 0.5) * d + random.uniform(-0.02, 0.02) * d});
        radius.push_back(d * random.uniform(0.52, 0.56));
      }
    }
  }
  AssemblyInput input;
  for (const std::int32_t old : order_in_slabs(position, radius)) {
    input.position.push_back(position[static_cast<std::size_t>(old)]);
    input.radius.push_back(radius[static_cast<std::size_t>(old)]);
    input.mineral.push_back(old % 5 == 0 ? 2 : 1);
    input.density.push_back(2600);
  }
  for (std::size_t i = 0; i < input.position.size(); ++i) {
    for (std::size_t j = i + 1; j < input.position.size(); ++j) {
      double squared = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        squared += (input.position[i][a] - input.position[j][a]) * (input.position[i][a] - input.position[j][a]);
      }
      if (squared > (input.radius[i] + input.radius[j]) * (input.radius[i] + input.radius[j])) continue;
      BondSpec spec;
      spec.first = static_cast<std::int32_t>(i);
      spec.second = static_cast<std::int32_t>(j);
      const Mineral& a = s.minerals[static_cast<std::size_t>(input.mineral[i])];
      const Mineral& b = s.minerals[static_cast<std::size_t>(input.mineral[j])];
      spec.boundary = input.mineral[i] != input.mineral[j] || (i * 7 + j) % 3 == 0;
      spec.group = spec.boundary ? between(a, b, s.interaction) : inside(a, JointModulus::sum);
      input.bonds.push_back(spec);
    }
  }
  for (const Mineral& a : s.minerals) {
    input.fresh.emplace_back();
    for (const Mineral& b : s.minerals) input.fresh.back().push_back(between(a, b, s.interaction));
    input.wall_modulus.push_back(a.modulus);
  }
  input.z_high = nz * d;
  return input;
}

}  // namespace dem_test
