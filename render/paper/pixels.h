#pragma once
// Paper as pixels.
#include "render/offscreen/offscreen.h"
#include "render/paper/paper.h"

namespace render {

/// At `scale` times its size, rounded to whole pixels.
Image to_image(Offscreen& offscreen, const Paper& paper, double scale);

}  // namespace render
