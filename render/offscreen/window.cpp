#include "render/offscreen/window.h"

#include <malloc.h>
#include <vtkCameraPass.h>
#include <vtkFloatArray.h>
#include <vtkLightsPass.h>
#include <vtkOpaquePass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkSequencePass.h>
#include <vtkSmartPointer.h>
#include <vtkTranslucentPass.h>
#include <vtkUnsignedCharArray.h>
#include <vtk_glew.h>

#include <cstdlib>
#include <limits>

#include "engine/core/errors.h"

namespace render {

void prepare_environment() {
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  // Frames of tens of MB come and go with every picture. By default each is given back to the system and taken anew as pages
  // that have to be zeroed: half the time of drawing. They stay with the process instead, which takes 40 % more memory.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

std::string environment_settings() {
  std::string text;
  for (const char* name : {"GALLIUM_DRIVER", "MESA_GL_VERSION_OVERRIDE", "MESA_GLSL_VERSION_OVERRIDE",
                           "MESA_EXTENSION_OVERRIDE", "MESA_LOADER_DRIVER_OVERRIDE", "LIBGL_DRIVERS_PATH",
                           "LP_NUM_THREADS", "LP_NATIVE_VECTOR_WIDTH", "LD_PRELOAD"}) {
    if (const char* value = std::getenv(name)) text += (text.empty() ? "" : ", ") + std::string(name) + "=" + value;
  }
  return text.empty() ? text : "; set here, and perhaps the reason: " + text;
}

// Never vtkRenderWindow::New(): Debian's VTK would open an X display and abort.
void adopt_current_context(vtkGenericOpenGLRenderWindow& window) {
  window.SetIsDirect(1);
  window.SetSupportsOpenGL(1);
  window.SetIsCurrent(true);
  window.SetMapped(1);
  window.SetReadyForRendering(true);
  window.SetOwnContext(0);
  window.SetMultiSamples(0);  // smooth edges come from drawing larger; samples differ between drivers
  window.SetFrameBlitModeToNoBlit();
  window.SetAlphaBitPlanes(1);
  window.SetSize(64, 64);
  if (!window.InitializeFromCurrentContext())
    throw dem::EnvironmentError(
        std::string("VTK cannot draw with the off-screen OpenGL context; it needs OpenGL 3.2 or later") +
        environment_settings());
}

std::string Offscreen::renderer() const {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name == nullptr ? "unknown" : reinterpret_cast<const char*>(name);
}

namespace {

// VTK's own choice for see-through shapes weighs colours by depth; here they are blended in the order they are given.
vtkSmartPointer<vtkRenderPass> passes() {
  vtkNew<vtkRenderPassCollection> order;
  order->AddItem(vtkNew<vtkLightsPass>());
  order->AddItem(vtkNew<vtkOpaquePass>());
  order->AddItem(vtkNew<vtkTranslucentPass>());
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(order);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  return camera;
}

}  // namespace

Image Offscreen::frame(vtkRenderer& scene, int width, int height, std::vector<float>* depth) {
  window_->SetSize(width, height);
  scene.SetPass(passes());
  window_->AddRenderer(&scene);
  window_->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  const bool read = window_->GetPixelData(0, 0, width - 1, height - 1, 0, pixels, 0) != 0;
  vtkNew<vtkFloatArray> z;
  if (depth != nullptr) window_->GetZbufferData(0, 0, width - 1, height - 1, z.Get());
  scene.ReleaseGraphicsResources(window_);
  window_->RemoveRenderer(&scene);
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  if (!read || pixels->GetNumberOfValues() != static_cast<vtkIdType>(3 * w * h))
    throw dem::EnvironmentError("the GL context gave no pixels back (picture of " + std::to_string(width) + " x " +
                                std::to_string(height) + ")");
  Image image(width, height);
  if (depth != nullptr) depth->resize(w * h);
  for (std::size_t row = 0; row < h; ++row) {  // GL counts rows from the bottom
    const std::size_t from = h - 1 - row;
    std::copy_n(pixels->GetPointer(static_cast<vtkIdType>(3 * w * from)), 3 * w, &image.rgb[3 * w * row]);
    if (depth != nullptr) std::copy_n(z->GetPointer(static_cast<vtkIdType>(w * from)), w, &(*depth)[w * row]);
  }
  return image;
}

}  // namespace render
