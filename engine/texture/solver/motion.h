#pragma once
// The motion of the particles: the time step, and the leapfrog with local damping, which puts a force -alpha |F|
// sign(v) on each component of translation, and the same for moments (Potyondy & Cundall 2004).
#include "engine/texture/solver/account.h"
#include "engine/texture/solver/kernels.h"
#include "engine/texture/solver/particles.h"

namespace dem::texture {

class Walls;

/// The particles of the input at rest, in their order; the time step is left at nothing.
Particles particles_of(const AssemblyInput& input);

/// Potyondy & Cundall 2004, Eqs. 13-14: the smallest sqrt(m/k) over the particles (s), with k the diagonal of the
/// particle's stiffness (sums over its contacts), for translation and for rotation. Throws std::logic_error when
/// nothing touches.
double critical_step(const AssemblyInput& input, const Particles& particles, const Walls& walls);

/// Steps of `step` seconds from now on.
void set_step(Particles& particles, double step);

/// Moves the particles from `begin` up to `end` (one slab) on by a step, and forgets the forces on them.
/// `held_kinetic`: twice the kinetic energy (J) of those that a grip leads, which is not theirs.
void integrate(Particles& particles, std::int32_t begin, std::int32_t end, double damping, double held_kinetic,
               const Kernels& kernels, MotionAccount& account);

}  // namespace dem::texture
