#pragma once
// Direct shear of a block under a constant normal stress.
//
// The block is held as if it were cast in the two halves of a shear box: the particles near its faces, above and below a
// gap at half its height, move as one each. The upper ones are pushed along x against the lower ones, do not turn, and are
// free to rise under the normal force on them. Stresses are forces over the section of the block, which stays as it was.
#include "engine/texture/loading/test.h"

namespace dem::texture {

/// Keys "direct_shear.".
TestEntry direct_shear_entry();

/// With standard settings: edge of the cube (m), normal stress (Pa).
Test direct_shear(double edge, double normal_stress);

}  // namespace dem::texture
