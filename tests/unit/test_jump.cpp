// Jumps of displacement across a band.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "engine/analysis/jump.h"
#include "engine/core/random.h"

using doctest::Approx;
using namespace dem::analysis;

namespace {

/// Points in a cube of side 2 about the origin.
std::vector<double> cube() {
  dem::RandomStream random(1, dem::Purpose::test_data);
  std::vector<double> points;
  for (int i = 0; i < 3000; ++i) points.push_back(random.uniform(-1, 1));
  return points;
}

}  // namespace

TEST_CASE("two halves that moved as wholes have moved by their difference") {
  const double angle = 0.5;  // of the normal, from x towards z
  const BandFrame band = band_frame({std::cos(angle), 0, std::sin(angle)}, 0.1, 0.4);
  CHECK(band.along[0] == Approx(-std::sin(angle)));
  CHECK(band.along[2] == Approx(std::cos(angle)));
  const auto points = cube();
  std::vector<double> moved;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const double side = points[i] * band.normal[0] + points[i + 2] * band.normal[2] > band.offset ? 1 : 0;
    moved.insert(moved.end(), {side * (0.3 * band.normal[0] - 0.2 * band.along[0]) + 7, side * 0.1 + 7,
                               side * (0.3 * band.normal[2] - 0.2 * band.along[2]) + 7});
  }
  const auto found = jump_across(points, moved, band);
  REQUIRE(found);
  CHECK(found->opening.moved == Approx(0.3));
  CHECK(found->slip.moved == Approx(-0.2));
  CHECK(std::abs(found->sideways.moved) == Approx(0.1));
  for (const Jump::Part& part : {found->opening, found->slip, found->sideways})
    CHECK(part.even == Approx(0).scale(1).epsilon(1e-9));  // the halves are stiff
  const JumpProfile profile = profile_across(points, moved, band, 0.1, 0.5);
  REQUIRE(profile.distance.size() == 10);
  CHECK(profile.across[9] - profile.across[0] == Approx(0.3));
}

TEST_CASE("an even strain is all of what it moves, and a band without two sides has no jump") {
  const auto points = cube();
  std::vector<double> moved;
  for (const double p : points) moved.push_back(1e-3 * p);
  const auto found = jump_across(points, moved, band_frame({0, 0, 1}, 0, 0.4));
  REQUIRE(found);
  CHECK(found->opening.moved > 1e-4);
  CHECK(found->opening.moved == Approx(found->opening.even));
  CHECK(found->opening.beyond() == Approx(0).scale(1e-4).epsilon(1e-6));
  CHECK_FALSE(jump_across(points, moved, band_frame({0, 0, 1}, 0.9, 0.4)));
}

TEST_CASE("a jump in a strained body is what the strain does not give") {
  const auto points = cube();
  std::vector<double> moved;
  for (std::size_t i = 0; i < points.size(); i += 3)
    moved.insert(moved.end(), {1e-3 * points[i], 0.0, -4e-3 * points[i + 2] + (points[i + 2] > 0 ? 2e-3 : 0.0)});
  const auto found = jump_across(points, moved, band_frame({0, 0, 1}, 0, 0.4));
  REQUIRE(found);
  CHECK(found->opening.beyond() == Approx(2e-3).epsilon(1e-6));
  CHECK(found->opening.even == Approx(-4e-3 * 0.6).epsilon(0.05));
}
