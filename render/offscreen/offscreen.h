#pragma once
// An off-screen OpenGL context with a VTK render window on it. One a program.
#include <vtkNew.h>

#include <memory>
#include <string>

#include "render/image.h"

class vtkGenericOpenGLRenderWindow;
class vtkRenderer;

namespace render {

/// See Canvas::settings().
std::string environment_settings();

class Offscreen {
 public:
  Offscreen();  ///< throws dem::EnvironmentError
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  [[nodiscard]] std::string renderer() const;  ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
  /// One frame of `scene` at width x height (px). The frame's depth, 0 (near) ... 1 (far), is returned when asked for.
  Image frame(vtkRenderer& scene, int width, int height, std::vector<float>* depth = nullptr);

 private:
  struct Context;  // of OSMesa or EGL, chosen at configure time
  std::unique_ptr<Context> context_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
};

}  // namespace render
