#pragma once
// No test: the specimen is made and not loaded.
#include "engine/texture/loading/test.h"

namespace dem::texture {

/// It has no keys of its own.
TestEntry genesis_entry();

}  // namespace dem::texture
