#pragma once
// Laws as their common test sees them (test_texture_laws.cpp): two bodies, whose poses the test sets, and what the law
// makes of them. Two particles with a contact go through the solver's own forces and account; a wall is a body like any
// other.
#include <cmath>

#include "engine/texture/laws/wall_contact.h"
#include "engine/texture/solver/block.h"
#include "engine/texture/solver/forces.h"
#include "engine/texture/solver/slabs.h"

namespace dem_test {

using dem::texture::Pose;
using dem::texture::Quaternion;
using dem::texture::Triple;
using Vector = Triple<double>;

inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }

/// The rotation by a vector of angles, rad.
inline Quaternion<double> turned(const Vector& angle) {
  const double a = length(angle);
  if (a == 0) return {1, 0, 0, 0};
  const double s = std::sin(a / 2) / a;
  return {std::cos(a / 2), s * angle.x, s * angle.y, s * angle.z};
}

inline Quaternion<double> product(const Quaternion<double>& a, const Quaternion<double>& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// The pose after a shift (m) and then a turn about its own place (rad).
inline Pose<double> displaced(const Pose<double>& pose, const Vector& shift, const Vector& angle) {
  return {pose.x + shift, product(turned(angle), pose.q)};
}

struct Response {
  Vector force[2], moment[2];  ///< on bodies 1 and 2, moments about their own places, N, N m
  double energy = 0;           ///< stored, J
  double heat = 0;             ///< of this step, J
};

/// Two particles with one contact between them.
struct PairLaw {
  Pose<double> rest[2];  ///< where nothing acts
  Vector closing;        ///< unit vector: body 2 moved along it presses
  double size = 0;       ///< m
  double stiffness = 0;  ///< an upper bound, N/m
  dem::texture::Block block;
  dem::texture::Particles particles;
  dem::texture::ContactRules rules;
  double heat_before = 0;

  Response step(const Pose<double>& one, const Pose<double>& two) {
    using namespace dem::texture;
    const Pose<double> next[2] = {one, two};
    for (std::int32_t p : {0, 1}) {
      const auto i = static_cast<std::size_t>(p);
      const Pose<double> before = particles.at(p);
      const Vector v = (1 / particles.step) * (next[p].x - before.x);
      const Quaternion<double> q = relative(next[p].q, before.q);
      const Vector w = (2 / particles.step) * Vector{q.x, q.y, q.z};
      particles.velocity[i] = {{v.x, v.y, v.z, 0, w.x, w.y, w.z, 0}};
      const Pose<double>& at = next[p];
      particles.pose[i] = {{at.x.x, at.x.y, at.x.z, particles.radius(p), at.q.w, at.q.x, at.q.y, at.q.z}};
      particles.force[i] = {};
    }
    add_forces(block, particles, rules, kernels(), 0);
    Response r{};
    for (std::size_t i : {0, 1}) {
      r.force[i] = triple(particles.force[i], 0);
      r.moment[i] = triple(particles.force[i], 1);
    }
    r.energy = stored_energy(block, particles, kernels());
    const double heat = block.account.friction + block.account.bond_tension + block.account.bond_shear;
    r.heat = heat - heat_before;
    heat_before = heat;
    return r;
  }
};

/// Particles of radii 0.4 and 0.5 mm that overlap a little in a skew direction, without a contact.
inline PairLaw two_particles(const dem::texture::ContactGroup& group) {
  using namespace dem::texture;
  const double r1 = 0.4e-3, r2 = 0.5e-3;
  PairLaw law;
  law.size = 0.88e-3;
  const Vector n{2.0 / 7, 3.0 / 7, 6.0 / 7};
  law.closing = -1.0 * n;
  law.rest[0] = {{0, 0, 0}, {1, 0, 0, 0}};
  law.rest[1] = {law.size * n, {1, 0, 0, 0}};
  law.stiffness = std::numbers::pi * r1 * r1 * (group.modulus + group.bond_modulus) / (r1 + r2);
  law.particles.velocity.resize(2);
  law.particles.force.resize(2);
  law.particles.step = 1e-8;
  const Vector& x2 = law.rest[1].x;
  law.particles.pose = {Row8{{0, 0, 0, r1, 1, 0, 0, 0}}, Row8{{x2.x, x2.y, x2.z, r2, 1, 0, 0, 0}}};
  law.rules.friction = {group.friction};
  return law;
}

/// With a flat joint, or a parallel bond on a grain boundary, as the solver installs it.
inline PairLaw bonded(const dem::texture::ContactGroup& group, bool boundary) {
  using namespace dem::texture;
  PairLaw law = two_particles(group);
  AssemblyInput input;
  for (const Row8& p : law.particles.pose) {
    input.position.push_back({p.v[0], p.v[1], p.v[2]});
    input.radius.push_back(p.v[3]);
  }
  input.bonds = {{0, 1, boundary, false, group}};
  law.block = install_contacts(input, Slabs{{0, 0}, {0, 2}}).front();
  return law;
}

/// With a flat joint of which one element has broken before; `joint` is of two such particles.
inline PairLaw partly_broken(const dem::texture::PartlyBrokenJoint& joint, const dem::texture::ContactGroup& group) {
  PairLaw law = two_particles(group);
  law.block.broken = {joint};
  law.block.broken.front().element[1].bonded = 0;
  law.block.flagged.resize(dem::texture::pack_width);
  return law;
}

/// With a contact of spheres.
inline PairLaw touching(const dem::texture::ContactGroup& group) {
  using namespace dem::texture;
  PairLaw law = two_particles(group);
  const auto& p = law.particles;
  law.block.spheres = {{0, 1, linear_contact(group, p.radius(0), p.radius(1), length(law.rest[1].x)), 0, 1}};
  return law;
}

/// A flat joint in its scalar form, which the solver takes for the joints that its vector code flags.
struct JointLaw {
  Pose<double> rest[2];
  Vector closing;
  double size = 0, stiffness = 0;
  dem::texture::PartlyBrokenJoint joint;

  Response step(const Pose<double>& one, const Pose<double>& two) {
    const dem::texture::JointResult result = advance(joint, one, two);
    Response r{};
    r.force[0] = -1.0 * result.action.force;
    r.force[1] = result.action.force;
    r.moment[0] = result.action.moment_1;
    r.moment[1] = result.action.moment_2;
    r.energy = stored(joint, one, two);
    r.heat = result.friction_heat;
    for (int b = 0; b < result.breaks; ++b) r.heat += result.broke[b].released;
    return r;
  }
};

inline JointLaw scalar(const PairLaw& pair) {
  JointLaw law;
  for (std::size_t i : {0, 1}) law.rest[i] = pair.rest[i];
  law.closing = pair.closing;
  law.size = pair.size;
  law.stiffness = pair.stiffness;
  law.joint = pair.block.broken.front();
  return law;
}

/// A sphere (body 2) and a platen or the jacket (body 1, which carries its plane or its axis with it).
struct WallLaw {
  enum Kind { lower, upper, jacket } kind = lower;
  Pose<double> rest[2];
  Vector closing;
  double size = 0, stiffness = 0, radius = 0, jacket_radius = 0;
  dem::texture::WallContact contact;

  Response step(const Pose<double>& one, const Pose<double>& two) const {
    using namespace dem::texture;
    const Vector x = rotate_back(one.q, two.x - one.x);  // as the wall sees the sphere
    const double away = std::hypot(x.x, x.y);
    const WallResult result = advance(
        contact, kind == jacket ? jacket_gap(jacket_radius, away, radius) : platen_gap(0, kind == upper, x.z, radius));
    const double push = result.push;
    const Vector f =
        kind == jacket ? Vector{-push * x.x / away, -push * x.y / away, 0} : Vector{0, 0, kind == upper ? -push : push};
    Response r{};
    r.force[1] = rotate(one.q, f);
    r.force[0] = -1.0 * r.force[1];
    r.moment[0] = cross(two.x - one.x, r.force[0]);  // the reaction acts on the same line
    r.energy = result.energy;
    return r;
  }
};

inline WallLaw wall(WallLaw::Kind kind, double modulus) {
  WallLaw law;
  law.kind = kind;
  law.size = law.radius = 0.4e-3;
  law.jacket_radius = 5e-3;
  law.stiffness = dem::texture::wall_stiffness(modulus, law.radius);
  const double overlap = 0.01 * law.radius;
  law.contact = {-overlap, law.stiffness};
  law.rest[0] = law.rest[1] = {{1e-3, -2e-3, 3e-3}, {1, 0, 0, 0}};
  const double away = law.jacket_radius - law.radius + overlap, near = law.radius - overlap;
  const Vector place = kind == WallLaw::jacket ? Vector{0.6 * away, 0.8 * away, 2e-3}
                                               : Vector{0, 0, kind == WallLaw::upper ? -near : near};
  law.closing = kind == WallLaw::jacket ? Vector{0.6, 0.8, 0} : Vector{0, 0, kind == WallLaw::upper ? 1.0 : -1.0};
  law.rest[1].x = law.rest[1].x + place;
  return law;
}

}  // namespace dem_test
