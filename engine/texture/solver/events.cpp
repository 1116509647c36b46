#include "engine/texture/solver/events.h"

#include <algorithm>
#include <numbers>

#include "engine/texture/laws/parallel_bond.h"
#include "engine/texture/solver/packs.h"

namespace dem::texture {
namespace {

Vec3 array(const Triple<double>& t) { return {t.x, t.y, t.z}; }

// A broken joint whose faces have lost each other becomes a contact of spheres, with the same stiffness and distance at
// rest. Its shear and its couples are let go: what they had stored turns into heat (never less than nothing, as the
// mean over the elements of a convex energy is at least the energy of the mean gap).
void roll(Block& block, Particles& particles, PartlyBrokenJoint& joint, const Action<double>& action) {
  const Pose<double> one = particles.at(joint.first), two = particles.at(joint.second);
  const Motion<double> m = motion(one, two, joint.reference, joint.share_one, joint.reference_length);
  const double closed = std::min(m.gap, 0.0);
  const Action<double> kept =
      action_at_contact(m, joint.share_one, (-joint.law.normal * closed) * m.n, Triple<double>{0, 0, 0});
  block.account.friction += stored(joint, one, two) - 0.5 * joint.law.normal * closed * closed +
                            particles.half_work(joint.first, joint.second, action - kept);
  SphereContact contact;
  contact.first = joint.first;
  contact.second = joint.second;
  contact.law.normal = joint.law.normal;
  contact.law.shear = joint.law.normal * joint.law.inverse_ratio;
  contact.law.friction = joint.friction;
  contact.law.length = joint.reference_length;
  block.spheres.push_back(contact);
  joint.alive = false;
}

// The same for a broken parallel bond: its linear part goes on as it is, shear included.
void roll(Block& block, Particles& particles, ParallelBondPack& pack, int lane) {
  using F = ParallelBondPack;
  const auto get = [&](F::Field f) { return pack.field[f][lane]; };
  SphereContact contact;
  contact.first = pack.first[lane];
  contact.second = pack.second[lane];
  LinearContact& law = contact.law;
  law.normal = get(F::linear_normal);
  law.shear = law.normal * get(F::linear_inverse_ratio);
  law.friction = get(F::friction);
  law.length = get(F::length);
  const Motion<double> m = motion(particles.at(contact.first), particles.at(contact.second),
                                  {get(F::dx), get(F::dy), get(F::dz)}, get(F::share_one), get(F::length));
  const Triple<double> shear{get(F::shear_x), get(F::shear_y), get(F::shear_z)};
  // Take back what the pack added: the contact acts with the others of its kind, in this same step, after the slide of
  // it.
  const Triple<double> f = (-law.normal * std::min(m.gap, 0.0)) * m.n - law.shear * shear;
  particles.add(contact.first, contact.second,
                Action<double>{} - action_at_contact(m, get(F::share_one), f, Triple<double>{0, 0, 0}));
  law.slide =
      shear - particles.step * velocity_at_contact(particles.sphere(contact.first), particles.sphere(contact.second),
                                                   m.length * m.n, get(F::share_one));
  block.spheres.push_back(contact);
  pack.field[F::linear_normal][lane] = 0;
  pack.field[F::cohesion][lane] = huge;
}

PartlyBrokenJoint joint_of(const FlatJointPack& pack, int lane, std::int32_t contact, double friction) {
  using F = FlatJointPack;
  const auto get = [&](F::Field f) { return pack.field[f][lane]; };
  PartlyBrokenJoint joint;
  joint.first = pack.first[lane];
  joint.second = pack.second[lane];
  joint.contact = contact;
  joint.reference = {get(F::dx), get(F::dy), get(F::dz)};
  joint.share_one = get(F::share_one);
  joint.reference_length = get(F::length);
  joint.law = {get(F::normal), get(F::inverse_ratio), get(F::rho), get(F::opening), get(F::cohesion), get(F::tan_phi)};
  joint.friction = friction;
  joint.zero_angle = any_perpendicular(joint.reference);
  return joint;
}

}  // namespace

void take_breaking_joints(Block& block, Particles& particles, const ContactRules& rules, std::int32_t count) {
  for (std::int32_t k = 0; k < count; ++k) {
    const auto slot = static_cast<std::size_t>(block.flagged[static_cast<std::size_t>(k)]);
    FlatJointPack& pack = block.joints[slot / pack_width];
    const std::size_t lane = slot % pack_width;
    const std::int32_t contact = block.joint_contact[slot];
    const PartlyBrokenJoint joint =
        joint_of(pack, static_cast<int>(lane), contact, rules.friction[static_cast<std::size_t>(contact)]);
    const Pose<double> one = particles.at(joint.first), two = particles.at(joint.second);
    PartlyBrokenJoint probe = joint;
    if (advance(probe, one, two).breaks == 0) continue;
    const Motion<double> m = motion(one, two, joint.reference, joint.share_one, joint.reference_length);
    particles.add(joint.first, joint.second, Action<double>{} - action(m, stiffness(joint.law)));
    retire(pack, lane);
    block.broken.push_back(joint);
  }
}

void break_elements(Block& block, Particles& particles, std::int64_t step, std::int32_t count) {
  for (std::int32_t k = 0; k < count; ++k) {
    PartlyBrokenJoint& joint = block.broken[static_cast<std::size_t>(block.flagged[static_cast<std::size_t>(k)])];
    const Pose<double> one = particles.at(joint.first), two = particles.at(joint.second);
    const bool was_broken = joint.broken();
    const JointResult result = advance(joint, one, two);
    block.account.friction += result.friction_heat;
    if (was_broken) {
      roll(block, particles, joint, result.action);
      continue;
    }
    particles.add(joint.first, joint.second, result.action);
    for (int b = 0; b < result.breaks; ++b) {
      const ElementBreak& e = result.broke[b];
      const double r = joint.law.rho / flat_joint_arm;
      const double released = e.released + particles.half_work(joint.first, joint.second, e.removed);
      (e.shear ? block.account.bond_shear : block.account.bond_tension) += released;
      block.account.cracks.push_back({static_cast<double>(step), joint.contact, static_cast<std::int8_t>(e.shear), 0,
                                      array(e.position), array(e.normal), std::numbers::pi * r * r / 3, released,
                                      array(e.removed.force)});
    }
  }
}

void break_bonds(Block& block, Particles& particles, std::int64_t step, std::int32_t count) {
  using F = ParallelBondPack;
  for (std::int32_t k = 0; k < count; ++k) {
    const auto slot = static_cast<std::size_t>(block.flagged[static_cast<std::size_t>(k)]);
    ParallelBondPack& pack = block.bonds[slot / pack_width];
    const std::size_t lane = slot % pack_width;
    const auto get = [&](F::Field f) { return pack.field[f][lane]; };
    if (get(F::normal) == 0) {
      roll(block, particles, pack, static_cast<int>(lane));
      continue;
    }
    const std::int32_t first = pack.first[lane], second = pack.second[lane];
    const Pose<double> one = particles.at(first), two = particles.at(second);
    const ParallelBond<double> bond = {get(F::linear_normal), get(F::linear_inverse_ratio),
                                       get(F::friction),      get(F::normal),
                                       get(F::inverse_ratio), get(F::radius),
                                       get(F::opening),       get(F::cohesion),
                                       get(F::tan_phi)};
    const Motion<double> m = motion(one, two, {get(F::dx), get(F::dy), get(F::dz)}, get(F::share_one), get(F::length));
    const bool shear = !(m.gap > bond.opening);
    const Action<double> removed = action(m, stiffness(bond));
    particles.add(first, second, Action<double>{} - removed);
    const double released = energy(m, stiffness(bond)) + particles.half_work(first, second, removed);
    (shear ? block.account.bond_shear : block.account.bond_tension) += released;
    block.account.cracks.push_back({static_cast<double>(step), block.bond_contact[slot],
                                    static_cast<std::int8_t>(shear), 1,
                                    array(one.x + (get(F::share_one) * m.length) * m.n), array(m.n),
                                    std::numbers::pi * bond.radius * bond.radius, released, array(removed.force)});
    retire(pack, lane);
  }
}

}  // namespace dem::texture
