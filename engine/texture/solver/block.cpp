#include "engine/texture/solver/block.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/texture/solver/packs.h"
#include "engine/texture/solver/slabs.h"

namespace dem::texture {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double parted = 0.05;  // a broken contact open by this share of its length is dropped

/// A bond as it lies between its particles.
struct Branch {
  Triple<double> d;  ///< from the first to the second, m
  double share_one;  ///< of d, up to the face
  double r, both;    ///< smaller radius, sum of radii, m
};

void fill_lane(FlatJointPack& pack, int lane, const BondSpec& spec, const Branch& at) {
  using F = FlatJointPack;
  const double length = root(dot(at.d, at.d));
  const double kn = spec.group.bond_modulus / at.both;  // Pa/m
  const double values[F::fields] = {at.d.x,
                                    at.d.y,
                                    at.d.z,
                                    at.share_one,
                                    length,
                                    kn * pi * at.r * at.r,
                                    1 / spec.group.bond_stiffness_ratio,
                                    flat_joint_arm * at.r,
                                    spec.group.tensile_strength / kn,
                                    spec.group.cohesion / kn,
                                    std::tan(spec.group.friction_angle)};
  for (int f = 0; f < F::fields; ++f) pack.field[f][lane] = values[f];
}

void fill_lane(ParallelBondPack& pack, int lane, const BondSpec& spec, const Branch& at) {
  using F = ParallelBondPack;
  const double length = root(dot(at.d, at.d)), area = pi * at.r * at.r;
  const ContactGroup& g = spec.group;
  const double kbn = g.bond_modulus / at.both;
  const double values[F::fields] = {at.d.x,
                                    at.d.y,
                                    at.d.z,
                                    at.share_one,
                                    length,
                                    area * g.modulus / at.both,
                                    1 / g.stiffness_ratio,
                                    g.friction,
                                    spec.frictional ? 0.0 : area * kbn,
                                    spec.frictional ? 0.0 : 1 / g.bond_stiffness_ratio,
                                    at.r,
                                    spec.frictional ? huge : g.tensile_strength / kbn,
                                    spec.frictional ? huge : g.cohesion / kbn,
                                    spec.frictional ? 0.0 : std::tan(g.friction_angle),
                                    0,
                                    0,
                                    0,
                                    0,
                                    0,
                                    0};
  for (int f = 0; f < F::fields; ++f) pack.field[f][lane] = values[f];
}

template <class Pack>
void place(std::vector<Pack>& packs, std::vector<std::int32_t>& contact, std::size_t number, const BondSpec& spec,
           const Branch& at) {
  const int lane = static_cast<int>(contact.size() % pack_width);
  if (lane == 0) packs.emplace_back();
  fill_lane(packs.back(), lane, spec, at);
  packs.back().first[lane] = spec.first;
  packs.back().second[lane] = spec.second;
  contact.push_back(static_cast<std::int32_t>(number));
}

}  // namespace

std::vector<Block> install_contacts(const AssemblyInput& input, const Slabs& slabs) {
  std::vector<Block> blocks(slabs.blocks());
  for (std::size_t c = 0; c < input.bonds.size(); ++c) {
    const BondSpec& spec = input.bonds[c];
    const auto i = static_cast<std::size_t>(spec.first), j = static_cast<std::size_t>(spec.second);
    const Vec3 &x1 = input.position[i], &x2 = input.position[j];
    const double r1 = input.radius[i], r2 = input.radius[j];
    const Triple<double> d{x2[0] - x1[0], x2[1] - x1[1], x2[2] - x1[2]};
    const double length = root(dot(d, d));
    const double share_one = 0.5 * (length + r1 - r2) / length;  // the face lies in the middle of the overlap
    const Branch at{d, share_one, std::min(r1, r2), r1 + r2};
    Block& block = blocks[slabs.block_of(spec.first, spec.second)];
    if (spec.boundary) {
      place(block.bonds, block.bond_contact, c, spec, at);
    } else {
      place(block.joints, block.joint_contact, c, spec, at);
    }
  }
  for (Block& block : blocks) {
    pad(block.joints, block.joint_contact);
    pad(block.bonds, block.bond_contact);
    block.flagged.resize(std::max(block.joint_contact.size(), block.bond_contact.size()));
  }
  return blocks;
}

void drop_parted(Block& block, const Particles& particles) {
  const auto near = [&](std::int32_t first, std::int32_t second, double length) {
    const Triple<double> d = particles.place(second) - particles.place(first);
    return root(dot(d, d)) < (1 + parted) * length;
  };
  for (PartlyBrokenJoint& joint : block.broken) {
    if (!joint.alive || !joint.broken()) continue;
    joint.alive = near(joint.first, joint.second, joint.reference_length);
  }
  std::erase_if(block.broken, [](const PartlyBrokenJoint& joint) { return !joint.alive; });
  block.watched = -1;
  using F = ParallelBondPack;
  for (std::size_t slot = 0; slot < block.bond_contact.size(); ++slot) {
    ParallelBondPack& pack = block.bonds[slot / pack_width];
    const std::size_t lane = slot % pack_width;
    if (pack.field[F::normal][lane] > 0 || pack.field[F::linear_normal][lane] == 0) continue;
    if (!near(pack.first[lane], pack.second[lane], pack.field[F::length][lane])) pack.field[F::linear_normal][lane] = 0;
  }
  for (SphereContact& contact : block.spheres) {
    contact.alive = near(contact.first, contact.second, contact.law.length);
  }
  std::erase_if(block.spheres, [](const SphereContact& contact) { return contact.alive == 0; });
}

ContactCounts count(const std::vector<Block>& blocks) {
  ContactCounts c;
  for (const Block& block : blocks) {
    const auto real = [](const std::vector<std::int32_t>& slots) {
      return std::count_if(slots.begin(), slots.end(), [](std::int32_t contact) { return contact >= 0; });
    };
    c.joints += real(block.joint_contact);
    c.bonds += real(block.bond_contact);
    c.broken_joints += static_cast<std::int64_t>(block.broken.size());
    c.fresh += static_cast<std::int64_t>(block.spheres.size());
    c.bytes += static_cast<std::int64_t>(
        block.joints.size() * sizeof(FlatJointPack) + block.bonds.size() * sizeof(ParallelBondPack) +
        block.broken.size() * sizeof(PartlyBrokenJoint) + block.spheres.size() * sizeof(SphereContact));
  }
  return c;
}

}  // namespace dem::texture
