#include "engine/texture/solver/neighbours.h"

#include <algorithm>
#include <cmath>

#include "engine/core/cell_grid.h"
#include "engine/texture/solver/packs.h"

namespace dem::texture {
namespace {

std::uint64_t key(std::int32_t a, std::int32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
}

// Pairs that have a contact already, as sorted keys.
std::vector<std::uint64_t> known_pairs(const std::vector<Block>& blocks) {
  std::vector<std::uint64_t> known;
  for (const Block& block : blocks) {
    for (std::size_t slot = 0; slot < block.joint_contact.size(); ++slot) {
      const FlatJointPack& pack = block.joints[slot / pack_width];
      const std::size_t lane = slot % pack_width;
      if (pack.field[FlatJointPack::normal][lane] > 0) known.push_back(key(pack.first[lane], pack.second[lane]));
    }
    for (std::size_t slot = 0; slot < block.bond_contact.size(); ++slot) {
      const ParallelBondPack& pack = block.bonds[slot / pack_width];
      const std::size_t lane = slot % pack_width;
      if (pack.field[ParallelBondPack::linear_normal][lane] > 0)
        known.push_back(key(pack.first[lane], pack.second[lane]));
    }
    for (const PartlyBrokenJoint& joint : block.broken) known.push_back(key(joint.first, joint.second));
    for (const SphereContact& contact : block.spheres) known.push_back(key(contact.first, contact.second));
  }
  std::sort(known.begin(), known.end());
  return known;
}

}  // namespace

bool Neighbours::due(const Particles& particles) const {
  double most = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Triple<double> moved = triple(particles.pose[i], 0) - triple(found_at_[i], 0);
    most = std::max(most, dot(moved, moved));
  }
  return !(2 * std::sqrt(most) < 0.8 * skin_);
}

void Neighbours::find(const Particles& particles, const Slabs& slabs, std::vector<Block>& blocks) {
  found_at_ = particles.pose;
  for (Block& block : blocks) block.candidates.clear();
  const std::vector<std::uint64_t> known = known_pairs(blocks);
  double largest = 0;
  for (const Row8& p : particles.pose) largest = std::max(largest, p.v[3]);
  const auto place = [&](std::size_t i) {
    const Row8& p = particles.pose[i];
    return std::array<double, 3>{p.v[0], p.v[1], p.v[2]};
  };
  const CellGrid grid(particles.size(), 2 * largest + skin_, place, 200);  // fragments far out share the rim cells
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Row8& one = particles.pose[i];
    const auto first = static_cast<std::int32_t>(i);
    grid.around(place(i), [&](std::int32_t j) {
      if (j <= first) return;
      const Row8& two = particles.pose[static_cast<std::size_t>(j)];
      const Triple<double> d = triple(two, 0) - triple(one, 0);
      const double limit = one.v[3] + two.v[3] + skin_;
      if (dot(d, d) >= limit * limit || std::binary_search(known.begin(), known.end(), key(first, j))) return;
      blocks[slabs.block_of(first, j)].candidates.push_back({first, j});
    });
  }
}

void form_contacts(Block& block, const Particles& particles, const ContactRules& rules) {
  const auto mineral = [&](std::int32_t p) {
    return static_cast<std::size_t>(particles.mineral[static_cast<std::size_t>(p)]);
  };
  for (auto& [first, second] : block.candidates) {
    if (first < 0) continue;
    const Triple<double> d = particles.place(second) - particles.place(first);
    const double r1 = particles.radius(first), r2 = particles.radius(second), both = r1 + r2, squared = dot(d, d);
    if (squared >= both * both) continue;
    const ContactGroup& group = rules.fresh[mineral(first)][mineral(second)];
    SphereContact contact;
    contact.first = first;
    contact.second = second;
    contact.law = linear_contact(group, r1, r2, root(squared));
    block.spheres.push_back(contact);
    first = -1;
  }
}

}  // namespace dem::texture
