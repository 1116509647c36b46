#pragma once
// Slabs along z, each thicker than the reach of a contact before failure. Threads work on them in parallel, then on the
// contacts between even and odd pairs of slabs: every particle receives its forces in one fixed order, and the bits do
// not depend on the number of threads.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/texture/solver/input.h"

namespace dem::texture {

/// An order of particles in slabs thicker than the largest contact (along z), and along a Morton curve inside a slab:
/// order[new] = old. The number of slabs follows from heights and radii only.
std::vector<std::int32_t> order_in_slabs(const std::vector<Vec3>& position, const std::vector<double>& radius);

/// The slabs of particles that stand in their order.
struct Slabs {
  std::vector<std::int32_t> of;     ///< slab of each particle
  std::vector<std::int32_t> begin;  ///< first particle of each slab, and the number of particles

  [[nodiscard]] std::size_t count() const { return begin.size() - 1; }
  [[nodiscard]] std::size_t of_particle(std::size_t particle) const { return static_cast<std::size_t>(of[particle]); }

  // Blocks of contacts: one a slab, one a pair of neighbours, one for contacts that failure made between slabs further
  // apart.
  [[nodiscard]] std::size_t blocks() const { return 2 * count(); }
  [[nodiscard]] std::size_t block_of(std::int32_t first, std::int32_t second) const;
};

/// `wanted` slabs at most, or as many as fit (0). Throws std::logic_error when the particles are in another order.
Slabs cut_in_slabs(const std::vector<Vec3>& position, const std::vector<double>& radius, int wanted);

}  // namespace dem::texture
