#pragma once
// What every law must hold, whatever it is (laws.h gives them): values to compare with come from the stored energy, by
// central differences, and from the work along a way.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/texture/laws/flat_joint.h"
#include "tests/support/laws.h"

namespace dem_test {

// Where the bodies of a law are taken: body 2 by `close` towards body 1, the rest small against it, body 1 along with
// it.
template <class Law>
std::array<Pose<double>, 2> poses_at(const Law& law, double close) {
  const double size = std::abs(close), turn = size / law.size;
  const Vector side = dem::texture::any_perpendicular(law.closing);
  return {displaced(law.rest[0], (0.3 * size) * Vector{0.5, -0.6, 0.4}, (0.1 * turn) * Vector{0.5, 0.2, -0.3}),
          displaced(law.rest[1], (0.3 * size) * Vector{0.5, -0.6, 0.4} + close * law.closing + (0.2 * size) * side,
                    (0.1 * turn) * Vector{-0.4, 0.7, 0.6})};
}

// Nothing acts where the bodies are at rest.
template <class Law>
void check_rest(Law law) {
  const Response r = law.step(law.rest[0], law.rest[1]);
  const double force = 1e-12 * law.stiffness * law.size;
  for (int body : {0, 1}) {
    CHECK(length(r.force[body]) < force);
    CHECK(length(r.moment[body]) < force * law.size);
  }
  CHECK(r.energy < 1e-24 * law.stiffness * law.size * law.size);
  CHECK(std::abs(r.heat) < 1e-24 * law.stiffness * law.size * law.size);
}

// Forces and moments are the central differences of the stored energy over all twelve components of the poses. The
// moments of frictional parts act at the contact point: they are the gradient up to the relative size of the motion.
template <class Law>
void check_gradient(const Law& law, double close) {
  Law here = law;
  const auto [one, two] = poses_at(law, close);
  const Response r = here.step(one, two);
  const double strain = std::abs(close) / law.size, h = 1e-3 * std::abs(close), scale = law.stiffness * std::abs(close);
  const auto energy = [&](int body, const Vector& shift, const Vector& angle) {
    Law moved = here;
    return body == 0 ? moved.step(displaced(one, shift, angle), two).energy
                     : moved.step(one, displaced(two, shift, angle)).energy;
  };
  const Vector axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, none{0, 0, 0};
  for (int body : {0, 1}) {
    for (int a = 0; a < 3; ++a) {
      CAPTURE(body);
      CAPTURE(a);
      const double w = h / law.size;
      const double force = -(energy(body, h * axes[a], none) - energy(body, -h * axes[a], none)) / (2 * h);
      const double moment = -(energy(body, none, w * axes[a]) - energy(body, none, -w * axes[a])) / (2 * w);
      CHECK(std::abs(force - dot(r.force[body], axes[a])) < 2 * strain * scale);
      CHECK(std::abs(moment - dot(r.moment[body], axes[a])) < 2 * strain * scale * law.size);
    }
  }
}

// What acts on the two bodies is in balance.
template <class Law>
void check_reaction(Law law, double close) {
  const auto [one, two] = poses_at(law, close);
  const Response r = law.step(one, two);
  const double scale = law.stiffness * std::abs(close);
  CHECK(length(r.force[0] + r.force[1]) < 1e-14 * scale);
  CHECK(length(cross(two.x - one.x, r.force[1]) + r.moment[0] + r.moment[1]) < 1e-13 * scale * law.size);
}

// On a way through pressing, shearing, turning, opening and closing again no step cools, and the work on the bodies is
// what is stored and what has become heat.
template <class Law>
void check_dissipation(Law law, double reach, bool dissipates) {
  constexpr int steps = 20000;
  const Vector side = dem::texture::any_perpendicular(law.closing), other = cross(law.closing, side);
  std::array<Pose<double>, 2> before = {law.rest[0], law.rest[1]};
  Response last = law.step(before[0], before[1]);
  double work = 0, turnover = 0, heat = 0, coldest = 0;
  for (int k = 1; k <= steps; ++k) {
    const double t = 2 * std::numbers::pi * k / steps, turn = 0.5 * reach / law.size;
    const Vector shift = (reach * (0.7 * std::sin(t) + 0.4 * std::sin(3 * t))) * law.closing +
                         (reach * std::sin(4 * t)) * side + (reach * (1 - std::cos(3 * t))) * other;
    const Vector angle = (turn * std::sin(2 * t)) * side + (turn * std::sin(5 * t)) * law.closing;
    const std::array<Pose<double>, 2> next = {
        displaced(law.rest[0], (reach * std::sin(t)) * Vector{0.3, -0.5, 0.2}, (turn * std::sin(t)) * other),
        displaced(law.rest[1], (reach * std::sin(t)) * Vector{0.3, -0.5, 0.2} + shift, angle)};
    const Response now = law.step(next[0], next[1]);
    for (std::size_t body : {0, 1}) {
      const Quaternion<double> q = relative(next[body].q, before[body].q);
      const double done = 0.5 * dot(last.force[body] + now.force[body], next[body].x - before[body].x) +
                          dot(last.moment[body] + now.moment[body], Vector{q.x, q.y, q.z});
      work -= done;
      turnover += std::abs(done);
    }
    heat += now.heat;
    coldest = std::min(coldest, now.heat);
    before = next;
    last = now;
  }
  CAPTURE(heat / turnover);
  CAPTURE((work - last.energy - heat) / turnover);
  CHECK(coldest >= -1e-15 * turnover);
  CHECK(std::abs(work - last.energy - heat) < 1e-3 * turnover);
  CHECK((dissipates ? heat > 1e-3 * turnover : heat == 0));
}

// All of it, for motions up to a thousandth of the size of the bodies. `dissipates`: whether its way warms it.
template <class Law>
void check_law(const std::string& name, const Law& law, bool dissipates) {
  CAPTURE(name);
  check_rest(law);
  for (const double strain : {1e-4, 1e-5}) {
    for (const double close : {strain * law.size, -strain * law.size}) {
      CAPTURE(close);
      check_gradient(law, close);
      check_reaction(law, close);
    }
  }
  check_dissipation(law, 1e-3 * law.size, dissipates);
}

}  // namespace dem_test
