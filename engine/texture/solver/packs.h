#pragma once
// Lanes of the packs that the kernels run over: taken out of use, padded, moved up.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/texture/solver/kernels.h"

namespace dem::texture {

inline constexpr double huge = 1e300;

/// The lane does nothing any more and never breaks. The linear part of a parallel bond stays.
template <class Pack>
void retire(Pack& pack, std::size_t lane) {
  pack.field[Pack::normal][lane] = 0;
  pack.field[Pack::opening][lane] = huge;
  pack.field[Pack::cohesion][lane] = huge;
  pack.field[Pack::tan_phi][lane] = 0;
}

inline bool lives(const FlatJointPack& pack, std::size_t lane) { return pack.field[FlatJointPack::normal][lane] > 0; }
inline bool lives(const ParallelBondPack& pack, std::size_t lane) {
  return pack.field[ParallelBondPack::normal][lane] > 0 || pack.field[ParallelBondPack::linear_normal][lane] > 0;
}

template <class Pack>
void copy_lane(Pack& to, std::size_t place, const Pack& from, std::size_t lane) {
  for (int f = 0; f < Pack::fields; ++f) to.field[f][place] = from.field[f][lane];
  to.first[place] = from.first[lane];
  to.second[place] = from.second[lane];
}

/// Fills the last pack up behind the `contact.size()` slots in use: a padding lane repeats the particles of a real one and does
/// nothing. `contact` holds the contact of each slot, -1 for padding.
template <class Pack>
void pad(std::vector<Pack>& packs, std::vector<std::int32_t>& contact) {
  for (std::size_t slot = contact.size(); slot < packs.size() * pack_width; ++slot) {
    const std::size_t lane = slot % pack_width;
    copy_lane(packs.back(), lane, packs.back(), lane - 1);
    retire(packs.back(), lane);
    if constexpr (requires { Pack::linear_normal; }) packs.back().field[Pack::linear_normal][lane] = 0;
  }
  contact.resize(packs.size() * pack_width, -1);
}

/// Takes lanes that are out of use out of the packs, where that saves an eighth of them. The others keep their order, and
/// with it forces keep their bits.
template <class Pack>
void close_ranks(std::vector<Pack>& packs, std::vector<std::int32_t>& contact) {
  std::size_t living = 0;
  for (std::size_t slot = 0; slot < contact.size(); ++slot)
    living += lives(packs[slot / pack_width], slot % pack_width);
  const std::size_t enough = (living + pack_width - 1) / pack_width;
  if (8 * (packs.size() - enough) < std::max<std::size_t>(packs.size(), 1)) return;
  std::size_t to = 0;
  for (std::size_t slot = 0; slot < contact.size(); ++slot) {
    const Pack& pack = packs[slot / pack_width];
    if (!lives(pack, slot % pack_width)) continue;
    copy_lane(packs[to / pack_width], to % pack_width, pack, slot % pack_width);
    contact[to++] = contact[slot];
  }
  packs.resize(enough);
  contact.resize(living);
  pad(packs, contact);
}

}  // namespace dem::texture
