#pragma once
// Compression between frictionless platens, with or without confining pressure.
//
// A confined test begins with the rise of an isotropic pressure on platens and jacket; strains count from its end,
// stresses are forces over the section at that time, and the history begins there. The energy account counts from the
// beginning.
#include "engine/texture/loading/test.h"

namespace dem::texture {

/// Keys "compression." and "confined_compression.".
TestEntry compression_entry();

/// With standard settings, under a confining pressure (Pa) or none.
Test compression(double confining_pressure = 0);

}  // namespace dem::texture
