#pragma once
// Direct tension between two grips.
#include "engine/texture/loading/test.h"

namespace dem::texture {

/// Keys "direct_tension.".
TestEntry direct_tension_entry();

/// With standard settings.
Test direct_tension();

}  // namespace dem::texture
