#pragma once
// An order of points in space that keeps neighbours near in memory, along the curve of Morton (1966).
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace dem {

/// The lowest 21 bits of x, y and z in turn: those of x at places 0, 3, 6 ...
inline std::uint64_t morton(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto spread = [](std::uint32_t bits) {
    std::uint64_t v = bits & 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffffULL;
    v = (v | v << 16) & 0x1f0000ff0000ffULL;
    v = (v | v << 8) & 0x100f00f00f00f00fULL;
    v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
    return (v | v << 2) & 0x1249249249249249ULL;
  };
  return spread(x) | spread(y) << 1 | spread(z) << 2;
}

/// The slab that a point lies in, and its cell there.
struct SlabCell {
  std::uint32_t slab = 0;
  std::uint32_t x = 0, y = 0, z = 0;
};

/// order[new] = old: slab by slab, inside a slab along the Morton curve, points of one cell by number. cell_of(i): the
/// SlabCell of point i.
template <class Index, class CellOf>
std::vector<Index> slab_order(std::size_t count, const CellOf& cell_of) {
  std::vector<std::pair<std::uint32_t, std::uint64_t>> key(count);
  for (std::size_t i = 0; i < count; ++i) {
    const SlabCell cell = cell_of(i);
    key[i] = {cell.slab, morton(cell.x, cell.y, cell.z)};
  }
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return key[static_cast<std::size_t>(a)] < key[static_cast<std::size_t>(b)];
  });
  return order;
}

}  // namespace dem
