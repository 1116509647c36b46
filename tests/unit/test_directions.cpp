// Density of poles against closed forms, nets and roses.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/analysis/directions.h"
#include "engine/core/random.h"

using doctest::Approx;
using namespace dem::analysis;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Poles spread evenly over the hemisphere: heights in equal steps, turned by the golden angle.
Poles even(int n) {
  Poles poles;
  for (int k = 0; k < n; ++k) {
    const double z = (k + 0.5) / n, across = std::sqrt(1 - z * z), turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
    poles.direction.push_back({across * std::cos(turn), across * std::sin(turn), z});
    poles.weight.push_back(1);
  }
  return poles;
}

Poles girdle(int n) {
  Poles poles;
  for (int k = 0; k < n; ++k) {
    const double turn = std::numbers::pi * (k + 0.5) / n;
    poles.direction.push_back({std::cos(turn), std::sin(turn), 0});
    poles.weight.push_back(1);
  }
  return poles;
}

dem::Table cracks(const std::vector<Direction>& normals, const std::vector<double>& area,
                  const std::vector<std::int32_t>& mode, const std::vector<std::int32_t>& contact) {
  dem::Table table{"cracks", {}, {}};
  std::vector<double> flat;
  for (const Direction& n : normals) flat.insert(flat.end(), n.begin(), n.end());
  table.add("normal", "1", flat, 3);
  table.add("area", "m^2", area);
  table.add("mode", "", mode);
  table.add("place", "", std::vector<std::int32_t>(area.size(), 0));
  table.add("contact", "", contact);
  return table;
}

}  // namespace

TEST_CASE("poles spread evenly have a density of 1 in every direction, and no maximum beyond chance") {
  const PoleDensity density(even(4000));
  for (double dip = 0; dip <= 90; dip += 10)
    for (double turn = 0; turn < 360; turn += 40) {
      const Direction at{std::sin(dip * degree) * std::cos(turn * degree),
                         std::sin(dip * degree) * std::sin(turn * degree), std::cos(dip * degree)};
      CHECK(density.times_uniform(at) == Approx(1).epsilon(0.03));
    }
  CHECK(maximum_of(density).deviations < 1);
}

TEST_CASE("one pole has the density of its kernel, and is found to a hundredth of a degree") {
  const double dip = 50 * degree, turn = 110 * degree;  // of the pole, from the vertical
  Poles poles;
  for (int k = 0; k < 30; ++k) {
    poles.direction.push_back({std::sin(dip) * std::cos(turn), std::sin(dip) * std::sin(turn), std::cos(dip)});
    poles.weight.push_back(2.5);
  }
  const PoleDensity density(poles);
  const double f = 2 * (1 + 30.0 / 9);
  CHECK(density.concentration() == Approx(f));
  const Maximum found = maximum_of(density);
  CHECK(found.times_uniform == Approx(f / (1 - std::exp(-f))).epsilon(1e-6));
  CHECK(found.dip() == Approx(50).epsilon(2e-4));
  // The pole points up towards 110 degrees: so does the plane's downward slope.
  CHECK(found.dip_direction() == Approx(110).epsilon(2e-4));
  CHECK(found.to_axis() == Approx(40).epsilon(3e-4));
  // A right angle away from it the kernel says exp(-f) of that.
  CHECK(density.times_uniform({-std::sin(turn), std::cos(turn), 0}) ==
        Approx(f * std::exp(-f) / (1 - std::exp(-f))).epsilon(1e-9));
}

TEST_CASE("a girdle has the density of a line over its great circle: upright planes of every strike") {
  const PoleDensity density(girdle(720));
  const double f = density.concentration();
  // Mean of exp(f (|cos t| - 1)) over the circle, by fine steps, over that of all directions.
  double sum = 0;
  constexpr int steps = 20000;
  for (int k = 0; k < steps; ++k) sum += std::exp(f * (std::abs(std::cos(std::numbers::pi * (k + 0.5) / steps)) - 1));
  const double on = sum / steps * f / (1 - std::exp(-f));
  for (double turn = 0; turn < 180; turn += 7)
    CHECK(density.times_uniform({std::cos(turn * degree), std::sin(turn * degree), 0}) == Approx(on).epsilon(1e-3));
  CHECK(density.times_uniform({0, 0, 1}) < 1e-6);
  CHECK(maximum_of(density).dip() == Approx(90).epsilon(1e-3));
  for (const double share : strikes_of(girdle(720), 18)) CHECK(share == Approx(1.0 / 18));
}

TEST_CASE("weights count as that many poles; equal ones do not matter") {
  Poles once = even(50), twice = once, doubled = once;
  for (double& w : doubled.weight) w = 7;
  CHECK(doubled.effective() == Approx(50));
  CHECK(PoleDensity(doubled).times_uniform({0, 0, 1}) == Approx(PoleDensity(once).times_uniform({0, 0, 1})));
  // Three of one weight and one that is not there.
  twice.direction.resize(4);
  twice.weight = {1, 1, 1, 0};
  CHECK(twice.effective() == Approx(3));
}

TEST_CASE("the kernel of a uniform sample scatters by what the deviations are counted in") {
  // A thousand samples of forty poles each at random: the density at the top scatters as stated.
  dem::RandomStream random(1, dem::Purpose::test_data);
  double sum = 0, squares = 0;
  constexpr int samples = 2000;
  for (int s = 0; s < samples; ++s) {
    Poles poles;
    for (int k = 0; k < 40; ++k) {
      const double z = random.uniform(), across = std::sqrt(1 - z * z), turn = 2 * std::numbers::pi * random.uniform();
      poles.direction.push_back({across * std::cos(turn), across * std::sin(turn), z});
      poles.weight.push_back(k % 2 == 0 ? 1 : 2);
    }
    const PoleDensity density(poles);
    const double deviations = density.deviations(density.times_uniform({0.6, 0, 0.8}));
    sum += deviations;
    squares += deviations * deviations;
  }
  CHECK(std::abs(sum / samples) < 0.1);
  CHECK(squares / samples == Approx(1).epsilon(0.1));
}

TEST_CASE("elements of one joint that broke alike are one pole") {
  const Direction up{0, 0, 1}, along{2, 0, 0};
  const Poles poles = poles_of(cracks({up, up, along, up}, {1, 2, 4, 8}, {0, 0, 0, 1}, {5, 5, 6, 5}));
  REQUIRE(poles.weight.size() == 3);
  CHECK(poles.weight[0] == 3);
  CHECK(poles.weight[1] == 4);
  CHECK(poles.weight[2] == 8);
  CHECK(poles.direction[1][0] == 1);  // made a unit vector
  CHECK(poles_of(cracks({up}, {1}, {0}, {5}), -1, 1).weight.empty());
}

TEST_CASE("a strike is the level line of its plane; level cracks have none") {
  const auto share = strikes_of({{{0, 1, 0}, {std::sqrt(0.5), 0, std::sqrt(0.5)}, {0, 0, 1}}, {1, 1, 5}}, 18);
  const double across = std::sqrt(0.5);
  CHECK(share[0] == Approx(1 / (1 + across)));       // normal along y: strike along x
  CHECK(share[9] == Approx(across / (1 + across)));  // normal in xz: strike along y
  CHECK(std::isnan(strikes_of({{{0, 0, 1}}, {1}}, 18)[0]));
  CHECK(std::isnan(strikes_of({}, 18)[0]));
}

TEST_CASE("the net keeps areas: half of the hemisphere lies within 60 degrees, half of the disc within 1/sqrt(2)") {
  const auto at = schmidt({std::sin(60 * degree), 0, -std::cos(60 * degree)});
  CHECK(at[0] == Approx(std::sqrt(0.5)));
  CHECK(schmidt({1, 0, 0})[0] == Approx(1));
  CHECK(schmidt({0, 0, 1})[0] == 0);
  for (const double x : {-0.9, -0.2, 0.0, 0.5})
    for (const double y : {-0.3, 0.0, 0.4}) {
      const Direction d = from_schmidt(x, y);
      CHECK(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] == Approx(1));
      CHECK(schmidt(d)[0] == Approx(x));
      CHECK(schmidt(d)[1] == Approx(y));
    }
}
