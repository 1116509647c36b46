// The context for machines with a GPU (configure with -DDEM_GL=EGL): EGL without a surface.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>

#include "engine/core/errors.h"
#include "render/offscreen/window.h"

namespace render {

struct Offscreen::Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext handle = EGL_NO_CONTEXT;
  Context() {
    prepare_environment();
    const auto platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    display = platform_display != nullptr
                  ? platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)
                  : EGL_NO_DISPLAY;
    if (display == EGL_NO_DISPLAY) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    const EGLint version[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    const bool made = eglInitialize(display, nullptr, nullptr) == EGL_TRUE && eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
                      eglChooseConfig(display, wanted, &config, 1, &found) == EGL_TRUE && found > 0 &&
                      (handle = eglCreateContext(display, config, EGL_NO_CONTEXT, version)) != EGL_NO_CONTEXT &&
                      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, handle) == EGL_TRUE;
    if (!made) throw dem::EnvironmentError("no off-screen OpenGL 3.3 context from EGL; configure with -DDEM_GL=OSMESA");
  }
  ~Context() {
    if (handle != EGL_NO_CONTEXT) eglDestroyContext(display, handle);
    if (display != EGL_NO_DISPLAY) eglTerminate(display);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

Offscreen::Offscreen() : context_(std::make_unique<Context>()) { adopt_current_context(*window_); }
Offscreen::~Offscreen() { window_->Finalize(); }

}  // namespace render
