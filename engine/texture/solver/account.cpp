#include "engine/texture/solver/account.h"

#include <algorithm>

#include "engine/texture/solver/block.h"

namespace dem::texture {

void add_up(const std::vector<MotionAccount>& slabs, Ledger& ledger) {
  for (const MotionAccount& slab : slabs) {
    ledger.damping += slab.damping - slab.late_damping;
    ledger.kinetic += slab.kinetic;
  }
}

void add_up(const std::vector<Block>& blocks, Ledger& ledger) {
  for (const Block& block : blocks) {
    ledger.elastic += block.account.elastic;
    ledger.friction += block.account.friction;
    ledger.bond_tension += block.account.bond_tension;
    ledger.bond_shear += block.account.bond_shear;
  }
}

void collect_cracks(std::vector<Block>& blocks, std::vector<Crack>& cracks) {
  const auto older = static_cast<std::ptrdiff_t>(cracks.size());
  for (Block& block : blocks) {
    std::vector<Crack>& fresh = block.account.cracks;
    cracks.insert(cracks.end(), fresh.begin(), fresh.end());
    fresh.clear();
  }
  std::stable_sort(cracks.begin() + older, cracks.end(),
                   [](const Crack& a, const Crack& b) { return a.step < b.step; });
}

}  // namespace dem::texture
