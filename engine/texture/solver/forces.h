#pragma once
// The forces of a block of contacts. The kernels work on packs of bonds; what they flag goes to the events.
#include <cstdint>

#include "engine/texture/solver/block.h"
#include "engine/texture/solver/kernels.h"
#include "engine/texture/solver/particles.h"

namespace dem::texture {

/// Adds what the contacts of the block do to their particles at the end of `step`: intact joints, parallel bonds,
/// broken joints, contacts of spheres, in this order. Contacts slip and break on the way.
void add_forces(Block& block, Particles& particles, const ContactRules& rules, const Kernels& kernels,
                std::int64_t step);

/// Energy that the contacts of the block store, J.
double stored_energy(const Block& block, const Particles& particles, const Kernels& kernels);

}  // namespace dem::texture
