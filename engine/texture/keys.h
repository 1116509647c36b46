#pragma once
#include <span>

#include "engine/scenario/scenario.h"

namespace dem::texture {

/// The scenario keys of the grain texture model, beside the common ones.
std::span<const Key> keys();

}  // namespace dem::texture
