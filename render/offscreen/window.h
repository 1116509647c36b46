#pragma once
// What the two kinds of context share: environment, and VTK's window on the current context.
#include <vtkGenericOpenGLRenderWindow.h>

#include "render/offscreen/offscreen.h"

namespace render {

/// Mesa must not write shaders to the user's home folder. Set before the context is made.
void prepare_environment();

/// Makes VTK draw with the context that is current in this thread.
void adopt_current_context(vtkGenericOpenGLRenderWindow& window);

}  // namespace render
