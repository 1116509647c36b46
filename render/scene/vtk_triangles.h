#pragma once
// Triangles as a VTK actor, unlit.
#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include "render/scene/shapes.h"

namespace render {

/// `translucent`: drawn after all opaque actors, in the order of the triangles, with their opacity.
vtkSmartPointer<vtkActor> triangle_actor(const Triangles& triangles, bool translucent);

}  // namespace render
