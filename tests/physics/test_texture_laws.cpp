// Laws: what holds for each of them, and bonds against closed forms (stiffness, failure loads, partial damage).
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "engine/texture/laws/flat_joint.h"
#include "engine/texture/laws/parallel_bond.h"
#include "engine/texture/laws/properties.h"
#include "tests/support/granite.h"
#include "tests/support/law_checks.h"
#include "tests/support/laws.h"
#include "tests/support/near.h"

using namespace dem::texture;
using T = Triple<double>;
using dem_test::turned;

namespace {

constexpr double pi = std::numbers::pi;

// Two particles of radii 0.4 and 0.5 mm that overlap a little, in a skew direction.
struct Pair {
  double r1 = 0.4e-3, r2 = 0.5e-3;
  T d = 0.88e-3 * T{2.0 / 7, 3.0 / 7, 6.0 / 7};
  double length = 0.88e-3;
  double share = 0.5 * (0.88e-3 + 0.4e-3 - 0.5e-3) / 0.88e-3;
  double r = 0.4e-3, both = 0.9e-3;
};

PartlyBrokenJoint joint(const Pair& pair, const ContactGroup& g) {
  PartlyBrokenJoint j;
  const double kn = g.bond_modulus / pair.both;
  j.second = 1;
  j.reference = pair.d;
  j.reference_length = pair.length;
  j.share_one = pair.share;
  j.law = {kn * pi * pair.r * pair.r, 1 / g.bond_stiffness_ratio, flat_joint_arm * pair.r, g.tensile_strength / kn,
           g.cohesion / kn,           std::tan(g.friction_angle)};
  j.friction = g.friction;
  j.zero_angle = any_perpendicular(j.reference);
  return j;
}

const Mineral& feldspar() {
  static const Settings s = dem_test::granite(10, 20);
  return s.minerals[1];
}

// Motion of particle 2 that moves its face by `u` and turns it by `angle` about the contact point.
Pose<double> moved(const Pair& pair, const T& u, const T& angle) {
  Pose<double> two{pair.d + u, turned(angle)};
  const T arm = (1 - pair.share) * pair.d;  // from the contact point to particle 2
  two.x = two.x + rotate(two.q, arm) - arm;
  return two;
}

const Pose<double> at_rest{{0, 0, 0}, {1, 0, 0, 0}};

}  // namespace

TEST_CASE("every law: force is the gradient of the energy, action is reaction, rest is free, nothing cools") {
  const ContactGroup grain = inside(feldspar(), JointModulus::sum);
  const ContactGroup boundary = between(feldspar(), feldspar(), {0.9, 2.0, 1.0, 0.25, 0.7, 1.0});
  ContactGroup strong = grain, loose = boundary;
  strong.tensile_strength = strong.cohesion = 1e15;  // Pa
  loose.tensile_strength = 1, loose.cohesion = 0;
  const dem_test::PairLaw broken = dem_test::partly_broken(joint(Pair{}, strong), strong);
  using Wall = dem_test::WallLaw;
  dem_test::check_law("flat joint, intact", dem_test::bonded(strong, false), false);
  dem_test::check_law("flat joint, one element broken", broken, true);
  dem_test::check_law("flat joint, one element broken, scalar", dem_test::scalar(broken), true);
  dem_test::check_law("flat joint, breaking", dem_test::bonded(grain, false), true);
  dem_test::check_law("parallel bond", dem_test::bonded(boundary, true), true);
  dem_test::check_law("parallel bond, breaking", dem_test::bonded(loose, true), true);
  dem_test::check_law("linear contact", dem_test::touching(grain), true);
  dem_test::check_law("wall contact, lower platen", dem_test::wall(Wall::lower, grain.modulus), false);
  dem_test::check_law("wall contact, upper platen", dem_test::wall(Wall::upper, grain.modulus), false);
  dem_test::check_law("wall contact, jacket", dem_test::wall(Wall::jacket, grain.modulus), false);
}

TEST_CASE(
    "wall contact: push and stiffness are the first and second derivative of the energy by the place of the wall") {
  const double r = 0.4e-3, h = 1e-9;
  const WallContact contact{-2e-6, wall_stiffness(48e9, r)};
  CHECK(contact.stiffness == test::near(48e9 * 3.141592653589793 * r));
  for (const double overlap : {1e-6, 3e-6}) {  // less and more than at rest
    const double away = 4.6e-3 + overlap;
    const auto at = [&](double jacket) { return advance(contact, jacket_gap(jacket, away, r)); };
    const WallResult here = at(5e-3);
    CHECK(std::abs((at(5e-3 + h).energy - at(5e-3 - h).energy) / (2 * h) + here.push) < 1e-6 * contact.stiffness * r);
    CHECK(std::abs((at(5e-3 + h).push - at(5e-3 - h).push) / (2 * h) + here.stiffness) < 1e-6 * contact.stiffness);
    CHECK((here.push > 0) == (overlap > 2e-6));
  }
}

TEST_CASE("flat joint: small motions give the stiffness of three elements") {
  const Pair pair;
  const PartlyBrokenJoint j = joint(pair, inside(feldspar(), JointModulus::sum));
  const T n = (1 / pair.length) * pair.d, e1 = j.zero_angle, e2 = cross(n, e1);
  const double kn = j.law.normal / 3, ks = kn * j.law.inverse_ratio;
  struct Case {
    const char* name;
    T u, angle;
  };
  const double s = 1e-13, a = 1e-10;  // m, rad: the terms of second order stay below 1e-10 of the first
  const Case cases[] = {{"pull", s * n, {0, 0, 0}},
                        {"shear", s * e1, {0, 0, 0}},
                        {"bending", {0, 0, 0}, a * e2},
                        {"torsion", {0, 0, 0}, a * n},
                        {"mixed", s * n + (0.7 * s) * e2, a * e1 + (0.5 * a) * n}};
  for (const Case& c : cases) {
    CAPTURE(c.name);
    // Independent sum over the elements, linear in the motion.
    T force{0, 0, 0}, couple{0, 0, 0};
    for (const double degrees : {60.0, 180.0, 300.0}) {
      const double angle = degrees * pi / 180, arm = 2 * pair.r * std::sin(pi / 3) / (3 * pi / 3);
      const T rho = (arm * std::cos(angle)) * e1 + (arm * std::sin(angle)) * e2;
      const T w = c.u + cross(c.angle, rho);
      const T f = (-kn * dot(w, n)) * n - ks * (w - dot(w, n) * n);
      force = force + f;
      couple = couple + cross(rho, f);
    }
    const T arm1 = pair.share * pair.d, arm2 = (pair.share - 1) * pair.d;
    const T moment_1 = T{0, 0, 0} - couple - cross(arm1, force), moment_2 = couple + cross(arm2, force);
    // The displacements are differences of positions: rounding of 1e-19 m in 1e-13 m limits the comparison there,
    // so the law is given the motion itself.
    Motion<double> m = motion(at_rest, {pair.d, {1, 0, 0, 0}}, j.reference, j.share_one, j.reference_length);
    m.gap = dot(c.u, n);
    m.u = c.u - dot(c.u, n) * n;
    m.theta_n = dot(c.angle, n);
    m.theta_t = c.angle - m.theta_n * n;
    const Action<double> act = action(m, stiffness(j.law));
    const double size = root(dot(force, force)) + root(dot(couple, couple)) / pair.r;
    const auto near = [&](const T& x, const T& y, double scale) {
      const T e = x - y;
      return root(dot(e, e)) < 1e-10 * scale;
    };
    CHECK(near(act.force, force, size));
    CHECK(near(act.moment_1, moment_1, size * pair.r));
    CHECK(near(act.moment_2, moment_2, size * pair.r));
  }
}

TEST_CASE("motion of two poses reduces to displacement and rotation of the faces") {
  const Pair pair;
  const T n = (1 / pair.length) * pair.d, e1 = any_perpendicular(pair.d);
  const Pose<double> two = moved(pair, 1e-9 * n + 2e-9 * e1, 3e-6 * e1 + 4e-6 * n);
  const Motion<double> m = motion(at_rest, two, pair.d, pair.share, pair.length);
  CHECK(m.gap == test::near(1e-9).epsilon(1e-5));
  CHECK(dot(m.u, e1) == test::near(2e-9).epsilon(1e-5));
  CHECK(m.theta_n == test::near(4e-6).epsilon(1e-5));
  CHECK(dot(m.theta_t, e1) == test::near(3e-6).epsilon(1e-5));
}

TEST_CASE("force and moments are the derivative of the stored energy, at finite motion") {
  const Pair pair;
  const Mineral& mineral = feldspar();
  const PartlyBrokenJoint j = joint(pair, inside(mineral, JointModulus::sum));
  const ContactGroup g = between(mineral, mineral, {0.9, 2, 1, 0.25, 0.7, 1});
  const double kbn = g.bond_modulus / pair.both;
  const ParallelBond<double> bond = {0, 1, 0, kbn * pi * pair.r * pair.r, 1 / g.bond_stiffness_ratio, pair.r, 1, 1, 0};
  for (const Stiffness<double>& k : {stiffness(j.law), stiffness(bond)}) {
    const Pose<double> one{{1e-5, -2e-5, 1.5e-5}, turned({0.05, -0.02, 0.03})};
    const Pose<double> two{pair.d + T{2e-5, 3e-5, -1e-5}, turned({-0.03, 0.06, 0.08})};
    const auto u = [&](const Pose<double>& p, const Pose<double>& q) {
      return energy(motion(p, q, pair.d, pair.share, pair.length), k);
    };
    const Action<double> act = action(motion(one, two, pair.d, pair.share, pair.length), k);
    const double scale = root(dot(act.force, act.force));
    const T axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double force[3] = {act.force.x, act.force.y, act.force.z};
    const double m1[3] = {act.moment_1.x, act.moment_1.y, act.moment_1.z};
    const double m2[3] = {act.moment_2.x, act.moment_2.y, act.moment_2.z};
    for (int a = 0; a < 3; ++a) {
      const double h = 1e-8, w = 1e-5;
      const auto shift = [&](double s) { return Pose<double>{two.x + s * axes[a], two.q}; };
      const auto turn = [&](const Pose<double>& p, double s) { return dem_test::displaced(p, {0, 0, 0}, s * axes[a]); };
      CHECK(std::abs(-(u(one, shift(h)) - u(one, shift(-h))) / (2 * h) - force[a]) < 1e-7 * scale);
      CHECK(std::abs(-(u(turn(one, w), two) - u(turn(one, -w), two)) / (2 * w) - m1[a]) < 1e-7 * scale * pair.r);
      CHECK(std::abs(-(u(one, turn(two, w)) - u(one, turn(two, -w))) / (2 * w) - m2[a]) < 1e-7 * scale * pair.r);
    }
    // Momentum is kept by construction; angular momentum needs the sum of moments to vanish.
    const T total = cross(two.x - one.x, act.force) + act.moment_1 + act.moment_2;
    CHECK(root(dot(total, total)) < 1e-12 * scale * pair.length);
  }
}

TEST_CASE("flat joint: failure loads in pull, shear, bending and torsion") {
  const Pair pair;
  const ContactGroup g = inside(feldspar(), JointModulus::sum);
  const PartlyBrokenJoint fresh = joint(pair, g);
  const T n = (1 / pair.length) * pair.d, e1 = fresh.zero_angle, e2 = cross(n, e1);
  const double area = pi * pair.r * pair.r, arm = fresh.law.rho;
  // The largest factor at which nothing breaks, by bisection; then the load there.
  const auto limit = [&](const T& u, const T& angle) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      PartlyBrokenJoint probe = fresh;
      (advance(probe, at_rest, moved(pair, middle * u, middle * angle)).breaks == 0 ? low : high) = middle;
    }
    PartlyBrokenJoint probe = fresh;
    return advance(probe, at_rest, moved(pair, low * u, low * angle)).action;
  };
  // Small strengths keep the motion small, so that the discrete formulas of first order hold to 1e-6.
  SUBCASE("pull") {
    const Action<double> a = limit(1e-5 * n, {0, 0, 0});
    CHECK(-dot(a.force, n) == test::near(g.tensile_strength * area).epsilon(1e-6));
  }
  SUBCASE("bending: the element on the axis of e1 at 180 degrees is pulled most when turned about -e2") {
    // theta x rho for rho = -arm e1 and theta = a e2: n component a arm
    const Action<double> a = limit({0, 0, 0}, 0.02 * e2);
    const double couple = root(dot(a.moment_2 - dot(a.moment_2, n) * n, a.moment_2 - dot(a.moment_2, n) * n));
    // The formula is of first order: it is off by less than the angle at failure.
    CHECK(couple == test::near(g.tensile_strength * area * arm / 2).epsilon(fresh.law.opening / arm));
  }
  SUBCASE("torsion") {
    const Action<double> a = limit({0, 0, 0}, 0.2 * n);
    CHECK(std::abs(dot(a.moment_2, n)) == test::near(g.cohesion * area * arm).epsilon(2e-4));
  }
}

TEST_CASE("flat joint: the criterion itself, free of geometry") {
  // With strengths 1e-4 of feldspar's the motions at failure are so small that first order is exact to 1e-6.
  const Pair pair;
  ContactGroup g = inside(feldspar(), JointModulus::sum);
  g.tensile_strength *= 1e-4;
  g.cohesion *= 1e-4;
  const PartlyBrokenJoint fresh = joint(pair, g);
  const T n = (1 / pair.length) * pair.d, e1 = fresh.zero_angle, e2 = cross(n, e1);
  const double area = pi * pair.r * pair.r;
  const auto limit = [&](const T& fixed, const T& u, const T& angle) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      PartlyBrokenJoint probe = fresh;
      (advance(probe, at_rest, moved(pair, fixed + middle * u, middle * angle)).breaks == 0 ? low : high) = middle;
    }
    PartlyBrokenJoint probe = fresh;
    return advance(probe, at_rest, moved(pair, fixed + low * u, low * angle)).action;
  };
  const T none{0, 0, 0};
  CHECK(-dot(limit(none, 1e-7 * n, none).force, n) == test::near(g.tensile_strength * area).epsilon(1e-6));
  CHECK(-dot(limit(none, 1e-7 * e1, none).force, e1) == test::near(g.cohesion * area).epsilon(1e-6));
  // Under compression the cohesion grows by sigma tan(phi).
  const double push = 1e-10;
  const Action<double> pressed = limit((-push) * n, 1e-7 * e1, none);
  const double kn = g.bond_modulus / pair.both;
  CHECK(-dot(pressed.force, e1) ==
        test::near((g.cohesion + kn * push * std::tan(g.friction_angle)) * area).epsilon(1e-6));
  const double bending = std::abs(dot(limit(none, none, 1e-3 * e2).moment_2, e2));
  CHECK(bending == test::near(g.tensile_strength * area * fresh.law.rho / 2).epsilon(1e-6));
  const double torsion = std::abs(dot(limit(none, none, 1e-3 * n).moment_2, n));
  CHECK(torsion == test::near(g.cohesion * area * fresh.law.rho).epsilon(1e-6));
}

TEST_CASE("flat joint: partial damage, element by element") {
  const Pair pair;
  const ContactGroup g = inside(feldspar(), JointModulus::sum);
  PartlyBrokenJoint j = joint(pair, g);
  const T n = (1 / pair.length) * pair.d, e2 = cross(n, j.zero_angle);
  const double kn = j.law.normal / 3, opening = j.law.opening;
  // Turned about e2 the element at 180 degrees opens: its gap is angle * rho. Break it alone.
  const double angle = 1.2 * opening / j.law.rho;
  const JointResult first = advance(j, at_rest, moved(pair, {0, 0, 0}, angle * e2));
  REQUIRE(first.breaks == 1);
  CHECK(first.broke[0].element == 1);
  CHECK_FALSE(first.broke[0].shear);
  CHECK(first.broke[0].released == test::near(0.5 * kn * 1.44 * opening * opening).epsilon(angle));  // first order
  CHECK_FALSE(j.element[1].bonded);
  CHECK(j.element[0].bonded);
  CHECK(j.element[2].bonded);
  // In pure pull now two thirds of the stiffness act, and off centre: a couple appears.
  PartlyBrokenJoint two_left = j;
  two_left.element[1].slip = {0, 0, 0};
  const double pull = 0.5 * opening;
  const JointResult pulled = advance(two_left, at_rest, moved(pair, pull * n, {0, 0, 0}));
  CHECK(pulled.breaks == 0);
  CHECK(-dot(pulled.action.force, n) == test::near(2 * kn * pull).epsilon(1e-6));
  CHECK(std::abs(dot(pulled.action.moment_2, e2)) == test::near(kn * pull * j.law.rho).epsilon(1e-6));
  // In compression the broken element carries again.
  const JointResult pushed = advance(two_left, at_rest, moved(pair, (-pull) * n, {0, 0, 0}));
  CHECK(dot(pushed.action.force, n) == test::near(3 * kn * pull).epsilon(1e-6));
  // Pulled further the other two break, and nothing is left in tension.
  const JointResult last = advance(two_left, at_rest, moved(pair, (1.01 * opening) * n, {0, 0, 0}));
  CHECK(last.breaks == 2);
  CHECK(two_left.broken());
  CHECK(root(dot(last.action.force, last.action.force)) == 0);
  // Open and closed again it slides by Coulomb friction.
  const T e1 = j.zero_angle;
  const JointResult slid = advance(two_left, at_rest, moved(pair, (-pull) * n + (40 * opening) * e1, {0, 0, 0}));
  const double gap =
      -(root(dot(pair.d - pull * n + (40 * opening) * e1, pair.d - pull * n + (40 * opening) * e1)) - pair.length);
  const T t = slid.action.force - dot(slid.action.force, n) * n;
  CHECK(gap > 0);
  CHECK(root(dot(t, t)) > 0);
  CHECK(slid.friction_heat > 0);
}

TEST_CASE("flat joint: an element that still holds is no hinge for large angles, whatever its strength") {
  const Pair pair;
  PartlyBrokenJoint j = joint(pair, inside(feldspar(), JointModulus::sum));
  j.law.opening = j.law.cohesion = 1;  // m: no stress breaks it
  j.element[0].bonded = j.element[2].bonded = false;
  const T e2 = cross((1 / pair.length) * pair.d, j.zero_angle);
  const auto at = [&](double angle) { return moved(pair, {0, 0, 0}, angle * e2); };
  CHECK(advance(j, at_rest, at(0.99 * mismatch)).breaks == 0);
  const double before = stored(j, at_rest, at(1.01 * mismatch));
  const JointResult torn = advance(j, at_rest, at(1.01 * mismatch));
  REQUIRE(torn.breaks == 1);
  CHECK(torn.broke[0].element == 1);
  CHECK_FALSE(torn.broke[0].shear);
  CHECK(j.broken());
  CHECK(torn.broke[0].released + torn.friction_heat ==
        test::near(before - stored(j, at_rest, at(1.01 * mismatch))).epsilon(1e-2));
}

TEST_CASE("the bound that selects joints never misses a break") {
  const Pair pair;
  const ContactGroup g = inside(feldspar(), JointModulus::sum);
  dem::RandomStream random(3, dem::Purpose::test_data);
  int broke = 0;
  for (int i = 0; i < 20000; ++i) {
    PartlyBrokenJoint j = joint(pair, g);
    const auto vector = [&](double s) {
      return T{random.uniform(-s, s), random.uniform(-s, s), random.uniform(-s, s)};
    };
    const Pose<double> two = moved(pair, vector(1.5e-6), vector(4e-3));
    const Motion<double> m = motion(at_rest, two, j.reference, j.share_one, j.reference_length);
    const bool flagged = may_break(m, j.law);
    const bool breaks_now = advance(j, at_rest, two).breaks > 0;
    CHECK((flagged || !breaks_now));
    broke += breaks_now;
  }
  CHECK(broke > 1000);
  CHECK(broke < 19000);
}

TEST_CASE("parallel bond: stiffness of both parts, strength without moments, friction of the linear part") {
  const Pair pair;
  const ContactGroup g = between(feldspar(), feldspar(), {0.9, 2.0, 1.0, 0.25, 0.7, 1.0});
  const double area = pi * pair.r * pair.r, kbn = g.bond_modulus / pair.both, kn = area * g.modulus / pair.both;
  const ParallelBond<double> bond = {kn,
                                     1 / g.stiffness_ratio,
                                     g.friction,
                                     kbn * area,
                                     1 / g.bond_stiffness_ratio,
                                     pair.r,
                                     g.tensile_strength / kbn,
                                     g.cohesion / kbn,
                                     std::tan(g.friction_angle)};
  const T n = (1 / pair.length) * pair.d, e1 = any_perpendicular(pair.d), none{0, 0, 0};
  const auto at = [&](const T& u, const T& angle) {
    return motion(at_rest, moved(pair, u, angle), pair.d, pair.share, pair.length);
  };
  const double s = 1e-9;
  // Compression: both parts; tension: the bond alone.
  const Motion<double> pressed = at((-s) * n, none), pulled = at(s * n, none);
  const auto force = [&](const Motion<double>& m, const T& slip) {
    return action(m, stiffness(bond)).force + linear_part(m, bond, slip, none).force;
  };
  CHECK(dot(force(pressed, none), n) == test::near((kbn * area + kn) * s).epsilon(1e-6));
  CHECK(-dot(force(pulled, none), n) == test::near(kbn * area * s).epsilon(1e-6));
  // Shear of the linear part is limited by mu times its compression, and what is lost is heat.
  const Motion<double> sheared = at((-s) * n + (10 * s) * e1, none);
  const LinearPart<double> part = linear_part(sheared, bond, none, none);
  const T tangential = part.force - dot(part.force, sheared.n) * sheared.n;
  CHECK(root(dot(tangential, tangential)) == test::near(g.friction * kn * -sheared.gap).epsilon(1e-9));
  const double before = root(dot(sheared.u, sheared.u)), after = root(dot(part.shear, part.shear));
  CHECK(part.heat == test::near(0.5 * g.friction * kn * -sheared.gap * (before - after)).epsilon(1e-9));
  // Bending and twisting by the full disc.
  const Stiffness<double> k = stiffness(bond);
  CHECK(k.bending == test::near(kbn * pi * std::pow(pair.r, 4) / 4).epsilon(1e-12));
  CHECK(k.twisting == test::near(kbn / g.bond_stiffness_ratio * pi * std::pow(pair.r, 4) / 2).epsilon(1e-12));
  // Strength.
  CHECK_FALSE(breaks(at((0.999999 * bond.opening) * n, none), bond));
  CHECK(breaks(at((1.000001 * bond.opening) * n, none), bond));
  const double shear = bond.cohesion / bond.inverse_ratio;
  Motion<double> m = at(none, none);
  m.u = (0.999999 * shear) * e1;
  CHECK_FALSE(breaks(m, bond));
  m.u = (1.000001 * shear) * e1;
  CHECK(breaks(m, bond));
  CHECK_FALSE(breaks(at(none, 0.05 * e1), bond));  // beta = 0: bending alone never breaks it
}

TEST_CASE("material interaction by Eqs. 7 and 8") {
  Mineral a = feldspar(), b = feldspar();
  a.modulus = 40e9, b.modulus = 60e9, a.stiffness_ratio = 1, b.stiffness_ratio = 2, a.friction = 0.5, b.friction = 0.6;
  a.bond_modulus = 30e9, b.bond_modulus = 90e9, a.bond_stiffness_ratio = 1.5, b.bond_stiffness_ratio = 2.5;
  a.cohesion = 100e6, b.cohesion = 200e6, a.tensile_strength = 20e6, b.tensile_strength = 40e6;
  a.friction_angle = 0.5, b.friction_angle = 0.7;
  const ContactGroup g = between(a, b, {0.9, 2.0, 0.8, 0.25, 0.7, 0.9});
  CHECK(g.modulus == test::near(0.9 * 48e9));
  CHECK(g.bond_modulus == test::near(0.9 * 45e9));
  CHECK(g.stiffness_ratio == test::near(2.0 * (1 * 60 + 2 * 40) / 100.0));
  CHECK(g.bond_stiffness_ratio == test::near(2.0 * (1.5 * 90 + 2.5 * 30) / 120.0));
  CHECK(g.friction == test::near(0.4));
  CHECK(g.cohesion == test::near(0.7 * 150e6));
  CHECK(g.tensile_strength == test::near(0.25 * 30e6));
  CHECK(g.friction_angle == test::near(0.9 * 0.6));
  // A5: alike materials are left alone by coefficients of one.
  const ContactGroup same = between(a, a, {});
  CHECK(same.modulus == test::near(a.modulus));
  CHECK(same.stiffness_ratio == test::near(a.stiffness_ratio));
}
