#pragma once
// Paper as pixels.
#include "render/offscreen/offscreen.h"
#include "render/paper/paper.h"

namespace render {

Image to_image(Offscreen& offscreen, const Paper& paper, int scale);  ///< at `scale` times its size

}  // namespace render
