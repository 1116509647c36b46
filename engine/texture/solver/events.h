#pragma once
// What happens to bonds: joints and bonds that break, and broken ones that roll on as contacts of spheres. The kernels
// flag them; here they are looked at one by one. All of it in the step at whose end the particles stand where they are.
#include <cstdint>

#include "engine/texture/solver/block.h"
#include "engine/texture/solver/particles.h"

namespace dem::texture {

/// Intact joints (the first `count` of block.flagged, by slot) in which an element breaks leave the packs for good, for
/// the partly broken ones: there they are evaluated in this same step. What the pack added for them is taken back.
void take_breaking_joints(Block& block, Particles& particles, const ContactRules& rules, std::int32_t count);

/// Partly broken joints (by number) in which elements break, or that roll.
void break_elements(Block& block, Particles& particles, std::int64_t step, std::int32_t count);

/// Parallel bonds (by slot) that break, and broken ones that roll.
void break_bonds(Block& block, Particles& particles, std::int64_t step, std::int32_t count);

}  // namespace dem::texture
