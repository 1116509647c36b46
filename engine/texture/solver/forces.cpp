#include "engine/texture/solver/forces.h"

#include <algorithm>
#include <limits>

#include "engine/texture/solver/events.h"

namespace dem::texture {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

template <class Pack>
std::int32_t size(const std::vector<Pack>& packs) {
  return static_cast<std::int32_t>(packs.size());
}

// For closed_joints(): what stays_open() needs. A lane without a living joint is always open.
void watch(OpenJointPack& pack, std::size_t lane, const PartlyBrokenJoint& joint, bool alive) {
  const double reach = joint.open != 0 ? 4 * joint.law.rho * joint.law.rho : infinite;
  pack.length[lane] = alive ? joint.reference_length : -infinite;
  pack.reach[lane] = alive ? reach : 0;
  pack.first[lane] = joint.first;
  pack.second[lane] = joint.second;
}

// Which broken joints have to be looked at: most are open, and show without further work that they still are.
void find_active(Block& block, const Particles& particles, const Kernels& kernels) {
  const auto count = static_cast<std::int64_t>(block.broken.size());
  if (block.watched != count) {
    block.watch.resize((block.broken.size() + pack_width - 1) / pack_width);
    for (std::size_t at = 0; at < block.watch.size() * pack_width; ++at) {
      const PartlyBrokenJoint& joint = block.broken[std::min(at, block.broken.size() - 1)];
      watch(block.watch[at / pack_width], at % pack_width, joint, joint.alive && at < block.broken.size());
    }
    block.watched = count;
  }
  block.active.resize(block.watch.size() * pack_width);
  block.active.resize(static_cast<std::size_t>(kernels.closed_joints(
      block.watch.data(), static_cast<std::int32_t>(count), particles.pose.front().v, block.active.data())));
}

void add_broken_joints(Block& block, Particles& particles, const Kernels& kernels, std::int64_t step, BondLoop& loop) {
  find_active(block, particles, kernels);
  if (block.active.empty()) return;
  kernels.broken_joints(block.broken.data(), block.active.data(), size(block.active), loop);
  block.account.friction += loop.heat;
  break_elements(block, particles, step, loop.flagged_count);
  for (const std::int32_t k : block.active) {
    const auto at = static_cast<std::size_t>(k);
    const PartlyBrokenJoint& joint = block.broken[at];
    watch(block.watch[at / pack_width], at % pack_width, joint, joint.alive);
  }
}

void add_spheres(Block& block, Particles& particles) {
  constexpr std::size_t ahead = 6;  // particles lie anywhere
  for (std::size_t i = 0; i < block.spheres.size(); ++i) {
    if (i + ahead < block.spheres.size()) {
      particles.fetch_ahead(block.spheres[i + ahead].first);
      particles.fetch_ahead(block.spheres[i + ahead].second);
    }
    SphereContact& contact = block.spheres[i];
    if (contact.alive == 0) continue;
    const LinearResult result =
        advance(contact.law, particles.sphere(contact.first), particles.sphere(contact.second), particles.step);
    block.account.friction += result.heat;
    contact.energy = result.energy;
    if (result.closed) particles.add(contact.first, contact.second, result.action);
  }
}

}  // namespace

void add_forces(Block& block, Particles& particles, const ContactRules& rules, const Kernels& kernels,
                std::int64_t step) {
  BondLoop loop{particles.pose.front().v, particles.force.front().v, block.flagged.data(), 0, 0};
  if (!block.joints.empty()) {
    kernels.flat_joints(block.joints.data(), size(block.joints), loop);
    if (loop.flagged_count > 0) take_breaking_joints(block, particles, rules, loop.flagged_count);
  }
  if (!block.bonds.empty()) {
    kernels.parallel_bonds(block.bonds.data(), size(block.bonds), loop);
    block.account.friction += loop.heat;
    if (loop.flagged_count > 0) break_bonds(block, particles, step, loop.flagged_count);
  }
  add_broken_joints(block, particles, kernels, step, loop);
  add_spheres(block, particles);
}

double stored_energy(const Block& block, const Particles& particles, const Kernels& kernels) {
  double sum = 0;
  const double* poses = particles.pose.front().v;
  if (!block.joints.empty()) sum += kernels.flat_joint_energy(block.joints.data(), size(block.joints), poses);
  if (!block.bonds.empty()) sum += kernels.parallel_bond_energy(block.bonds.data(), size(block.bonds), poses);
  for (const PartlyBrokenJoint& joint : block.broken) {
    if (joint.alive) sum += stored(joint, particles.at(joint.first), particles.at(joint.second));
  }
  for (const SphereContact& contact : block.spheres) sum += contact.alive ? contact.energy : 0.0;
  return sum;
}

}  // namespace dem::texture
