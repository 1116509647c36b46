#pragma once
// Pairs of particles that are near each other without a contact: candidates for contacts that form later.
#include "engine/texture/solver/block.h"
#include "engine/texture/solver/particles.h"
#include "engine/texture/solver/slabs.h"

namespace dem::texture {

class Neighbours {
 public:
  Neighbours() = default;
  /// Pairs up to `skin` (m) apart are near; they are good until particles have moved by some 0.4 of it.
  explicit Neighbours(double skin) : skin_(skin) {}

  [[nodiscard]] double skin() const { return skin_; }
  [[nodiscard]] bool due(const Particles& particles) const;
  /// Gives each block the near pairs that belong to it.
  void find(const Particles& particles, const Slabs& slabs, std::vector<Block>& blocks);

  template <class Archive>
  void archive(Archive& a) {
    a(found_at_);
  }

 private:
  double skin_ = 0;
  std::vector<Row8> found_at_;  ///< poses when the near pairs were last found
};

/// Candidates of the block that touch become contacts of spheres, free of stress where they are: the motion of the few
/// steps since the last look costs no energy.
void form_contacts(Block& block, const Particles& particles, const ContactRules& rules);

}  // namespace dem::texture
