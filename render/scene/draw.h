#pragma once
// Scenes through VTK: spheres as impostors, flat shapes as triangles.
#include "render/offscreen/offscreen.h"
#include "render/scene/scene.h"

namespace render {

/// Throws std::invalid_argument when columns of the scene differ in length.
Image draw_scene(Offscreen& offscreen, const Scene& scene, SceneResult& result);

}  // namespace render
