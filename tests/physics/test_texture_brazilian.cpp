// The Brazilian test: stresses along the loaded diameter of an unbreakable disc against the closed solution, and what is
// read off a disc that splits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/texture/laws/flat_joint.h"
#include "engine/texture/loading/brazilian.h"
#include "engine/texture/loading/loading.h"
#include "engine/texture/quantities.h"
#include "engine/texture/results.h"
#include "tests/support/granite.h"
#include "tests/support/near.h"

using namespace dem::texture;

namespace {

constexpr double pi = std::numbers::pi;

// Quartz alone, joined by flat joints that nothing breaks: every bond's force follows from its two poses.
Settings unbreakable(double diameter, double thickness, double jaws, std::uint64_t seed) {
  Settings s = dem_test::granite(12.5, 25);
  s.minerals = {s.minerals[2]};
  s.minerals.front().share = 1;
  s.minerals.front().tensile_strength = s.minerals.front().cohesion = 1e15;
  s.one_mineral = true;
  s.same_mineral_boundaries = false;
  s.packing.seed = seed;
  s.test = brazilian(diameter, thickness, jaws);
  s.test.rate = 2e-7;
  s.test.sample_strain = 2e-5;
  s.packing.vessel = vessel_of(*s.test.body, 0);
  return s;
}

struct Stress {
  double xx = 0, zz = 0, volume = 0;
  void add(const Stress& other) {
    xx += other.xx;
    zz += other.zz;
    volume += other.volume;
  }
};

// Of each sphere, times its volume: the sum over its bonds of arm x force (Love 1927), tension positive.
std::vector<Stress> sphere_stresses(const Specimen& specimen, const Assembly& assembly) {
  std::vector<Stress> stress(specimen.packing.radius.size());
  const auto pose = [&](std::int32_t i) {
    const Row8& p = assembly.poses()[static_cast<std::size_t>(i)];
    return Pose<double>{{p.v[0], p.v[1], p.v[2]}, {p.v[4], p.v[5], p.v[6], p.v[7]}};
  };
  for (const BondSpec& bond : specimen.bonds) {
    const auto i = static_cast<std::size_t>(bond.first), j = static_cast<std::size_t>(bond.second);
    const Vec3 &a = specimen.packing.position[i], &b = specimen.packing.position[j];
    const double r1 = specimen.packing.radius[i], r2 = specimen.packing.radius[j], r = std::min(r1, r2);
    const Triple<double> d{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double length = root(dot(d, d)), share = 0.5 * (length + r1 - r2) / length;
    FlatJoint<double> joint{};
    joint.normal = bond.group.bond_modulus / (r1 + r2) * pi * r * r;
    joint.inverse_ratio = 1 / bond.group.bond_stiffness_ratio;
    joint.rho = flat_joint_arm * r;
    const Motion<double> m = motion(pose(bond.first), pose(bond.second), d, share, length);
    const Action<double> act = action(m, stiffness(joint));
    const double on = m.length;
    stress[i].xx -= share * on * m.n.x * act.force.x;
    stress[i].zz -= share * on * m.n.z * act.force.z;
    stress[j].xx -= (1 - share) * on * m.n.x * act.force.x;
    stress[j].zz -= (1 - share) * on * m.n.z * act.force.z;
  }
  for (std::size_t i = 0; i < stress.size(); ++i)
    stress[i].volume = 4.0 / 3 * pi * std::pow(specimen.packing.radius[i], 3);
  return stress;
}

// A disc under two line loads P across it (Hertz 1883; Timoshenko & Goodier, section 41), over 2 P / (pi D t); tension
// positive. (x, z) from its centre, over the radius.
std::array<double, 2> line_loaded(double x, double z) {
  const double low = (1 + z) * (1 + z) + x * x, high = (1 - z) * (1 - z) + x * x;
  return {1 - 2 * ((1 - z) * x * x / (high * high) + (1 + z) * x * x / (low * low)),
          1 - 2 * (std::pow(1 - z, 3) / (high * high) + std::pow(1 + z, 3) / (low * low))};
}

// What an arc of half angle `alpha` under an even pressure adds to that on the loaded diameter (Hondros 1959).
std::array<double, 2> of_arc(double z, double alpha) {
  const double p = z * z;
  const double one = (1 - p) * std::sin(2 * alpha) / (1 - 2 * p * std::cos(2 * alpha) + p * p) / alpha;
  const double two = std::atan((1 + p) / (1 - p) * std::tan(alpha)) / alpha;
  const auto [xx, zz] = line_loaded(0, z);
  return {one - two - xx, -one - two - zz};
}

// The mean over the share of the disc that a sphere stands for: itself and the pores about it. Stresses of spheres are such
// means. Six points on a circle have the second moments of a ball.
std::array<double, 2> mean_over(double x, double z, double radius, double solid) {
  const double ring = radius * std::cbrt(1 / solid) * std::sqrt(0.4);
  std::array<double, 2> sum{};
  for (int k = 0; k < 6; ++k) {
    const auto [xx, zz] = line_loaded(x + ring * std::cos(k * pi / 3), z + ring * std::sin(k * pi / 3));
    sum[0] += xx / 6;
    sum[1] += zz / 6;
  }
  return sum;
}

// The half angle of the even pressure whose second moment is that of the overlaps with both platens, or with both jaws, whose
// radius is `jaws` times that of the disc.
double arc_of(const Specimen& specimen, const Loading& loading, double diameter, double jaws) {
  const double approach = loading.history().back().platen_strain * diameter;
  double sum = 0, moment = 0;
  for (std::size_t i = 0; i < specimen.packing.radius.size(); ++i) {
    const double x = loading.assembly().poses()[i].v[0], z = loading.assembly().poses()[i].v[2];
    const double above = std::min(z - approach / 2, diameter - approach / 2 - z), jaw = jaws * diameter / 2;
    const double room = jaws > 0 ? jaw - std::hypot(x, jaw - above) : above;
    const double gap = room - specimen.packing.radius[i];
    if (gap >= 0) continue;
    sum -= gap;
    moment -= gap * x * x;
  }
  return std::sqrt(3 * moment / sum) / (diameter / 2);
}

}  // namespace

TEST_CASE("line load and arc of load agree far from the load") {
  CHECK(line_loaded(0, 0)[0] == 1);
  CHECK(line_loaded(0, 0)[1] == -3);
  for (const double z : {0.0, 0.3, 0.6}) {
    CHECK(std::abs(of_arc(z, 1e-3)[0]) < 1e-4);
    CHECK(std::abs(of_arc(z, 1e-3)[1]) < 1e-4);
  }
  // 15 degrees of arc take 2 % off the tension in the middle (Hondros 1959: 0.98).
  CHECK(of_arc(0, 7.5 * pi / 180)[0] == test::near(-0.023).epsilon(0.1));
}

TEST_CASE("stresses along the loaded diameter are those of the closed solution") {
  // Slices across the loaded diameter, from the centre to seven tenths of the radius, both halves together. Nearer to the loads
  // the tension turns to compression, and a share of it says nothing.
  constexpr int slices = 4;
  constexpr double reach = 0.7, half_width = 0.125, diameter = 27e-3, thickness = 8e-3;
  for (const double jaws : {0.0, 1.5}) {
    std::array<Stress, slices> measured{}, expected{};
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Settings settings = unbreakable(diameter, thickness, jaws, seed);
      dem::RunContext context;
      const Specimen specimen = make_specimen(settings, context);
      Loading loading(specimen, settings, 2);
      while (loading.advance() && loading.history().back().axial_stress < 8e6) {
      }
      const HistoryRow& last = loading.history().back();
      const double arc = arc_of(specimen, loading, diameter, jaws);
      const double nominal = last.axial_stress, radius = diameter / 2;
      const double solid = 1 - specimen.packing.porosity;
      const std::vector<Stress> stress = sphere_stresses(specimen, loading.assembly());
      for (std::size_t i = 0; i < stress.size(); ++i) {
        const Vec3& at = specimen.packing.position[i];
        const double x = at[0] / radius, z = at[2] / radius - 1;
        const int slice = static_cast<int>(std::abs(z) / reach * slices);
        if (std::abs(x) > half_width || slice >= slices) continue;
        const auto k = static_cast<std::size_t>(slice);
        const double v = stress[i].volume;
        measured[k].add({stress[i].xx * solid / nominal, stress[i].zz * solid / nominal, v});
        const auto [xx, zz] = mean_over(x, z, specimen.packing.radius[i] / radius, solid);
        const auto [more_xx, more_zz] = of_arc(z, arc);
        expected[k].add({(xx + more_xx) * v, (zz + more_zz) * v, v});
      }
    }
    for (std::size_t k = 0; k < slices; ++k) {
      const double v = measured[k].volume;
      MESSAGE("jaws ", jaws, ", slice ", k, ": xx ", measured[k].xx / v, " (", expected[k].xx / v, "), zz ",
              measured[k].zz / v, " (", expected[k].zz / v, ")");
      CHECK(measured[k].xx / v == test::near(expected[k].xx / v).epsilon(0.1));
      CHECK(measured[k].zz / v == test::near(expected[k].zz / v).epsilon(0.1));
    }
  }
}
