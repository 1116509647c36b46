#pragma once
// Uniaxial compression with loops: at regular strains the load is taken off and brought back. Damage is the loss of modulus
// from the first loop on: D = 1 - E / E1, E the secant of a loop's unloading.
#include "engine/texture/loading/test.h"

namespace dem::texture {

/// Keys "unloading_loops.".
TestEntry unloading_loops_entry();

/// With standard settings.
Test unloading_loops();

}  // namespace dem::texture
