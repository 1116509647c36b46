#include "engine/texture/solver/neighbours.h"

#include <algorithm>
#include <cmath>

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

using Cell = std::array<std::int64_t, 3>;

/// Particles by cells of one width; fragments far out share the rim cells.
class CellGrid {
 public:
  CellGrid(const std::vector<Row8>& poses, double skin) {
    double largest = 0;
    std::array<double, 3> high = {-huge, -huge, -huge};
    for (const Row8& p : poses) {
      largest = std::max(largest, p.v[3]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low_[axis] = std::min(low_[axis], p.v[axis]);
        high[axis] = std::max(high[axis], p.v[axis]);
      }
    }
    width_ = 2 * largest + skin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cells_[axis] =
          std::clamp<std::int64_t>(static_cast<std::int64_t>((high[axis] - low_[axis]) / width_) + 1, 1, 200);
    }
    head_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]), -1);
    next_.assign(poses.size(), -1);
    for (std::size_t i = poses.size(); i-- > 0;) {
      const std::size_t c = flat(cell_of(poses[i]));
      next_[i] = head_[c];
      head_[c] = static_cast<std::int32_t>(i);
    }
  }

  /// Calls visit(j) for the particles j of the 27 cells round that of a pose, cell by cell, in ascending order within
  /// each.
  template <class Visit>
  void around(const Row8& pose, const Visit& visit) const {
    const Cell c = cell_of(pose);
    for (std::int64_t dz = -1; dz <= 1; ++dz) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
          const Cell at = {c[0] + dx, c[1] + dy, c[2] + dz};
          if (at[0] < 0 || at[1] < 0 || at[2] < 0 || at[0] >= cells_[0] || at[1] >= cells_[1] || at[2] >= cells_[2])
            continue;
          for (std::int32_t j = head_[flat(at)]; j >= 0; j = next_[static_cast<std::size_t>(j)]) visit(j);
        }
      }
    }
  }

 private:
  [[nodiscard]] Cell cell_of(const Row8& p) const {
    Cell c{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      c[axis] = std::min(static_cast<std::int64_t>((p.v[axis] - low_[axis]) / width_), cells_[axis] - 1);
    }
    return c;
  }
  [[nodiscard]] std::size_t flat(const Cell& c) const {
    return static_cast<std::size_t>((c[2] * cells_[1] + c[1]) * cells_[0] + c[0]);
  }
  std::array<double, 3> low_ = {huge, huge, huge};
  double width_ = 0;
  Cell cells_{};
  std::vector<std::int32_t> head_, next_;
};

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
  const CellGrid grid(particles.pose, skin_);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Row8& one = particles.pose[i];
    const auto first = static_cast<std::int32_t>(i);
    grid.around(one, [&](std::int32_t j) {
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
