// The default context: Mesa's software renderer, into memory, without a display. See gl_glue.cpp for the other half.
#include <GL/osmesa.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "engine/core/errors.h"
#include "engine/core/limits.h"
#include "render/offscreen/window.h"

namespace render {

namespace {

// OSMesa crashes when it is told to use a driver that it does not have.
void check_driver() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (!driver || driver == std::string("llvmpipe") || driver == std::string("softpipe")) return;
  throw dem::EnvironmentError("pictures cannot be drawn: the environment variable GALLIUM_DRIVER is '" +
                              std::string(driver) +
                              "', and OSMesa, which draws them, has llvmpipe and softpipe; unset it");
}

// A limit on memory is the likelier reason: a process that has come so far has a library that loads.
std::string reason() {
  if (!environment_settings().empty()) return environment_settings();
  const std::string limit = dem::memory_limit();
  return limit.empty() ? "; install the package libosmesa6 again" : ", which gets no memory: " + limit;
}

}  // namespace

struct Offscreen::Context {
  OSMesaContext handle = nullptr;
  std::vector<unsigned char> pixels;  // OSMesa's own frame; VTK draws into frame buffers of its own
  Context() {
    prepare_environment();
    check_driver();
    const int wanted[] = {OSMESA_FORMAT,
                          OSMESA_RGBA,
                          OSMESA_DEPTH_BITS,
                          24,
                          OSMESA_STENCIL_BITS,
                          8,
                          OSMESA_PROFILE,
                          OSMESA_CORE_PROFILE,
                          OSMESA_CONTEXT_MAJOR_VERSION,
                          3,
                          OSMESA_CONTEXT_MINOR_VERSION,
                          3,
                          0};
    handle = OSMesaCreateContextAttribs(wanted, nullptr);
    constexpr int side = 64;
    pixels.resize(4 * side * side);
    if (handle == nullptr || OSMesaMakeCurrent(handle, pixels.data(), GL_UNSIGNED_BYTE, side, side) == GL_FALSE)
      throw dem::EnvironmentError("no off-screen OpenGL 3.3 context from OSMesa, Mesa's software renderer" + reason());
  }
  ~Context() {
    if (handle != nullptr) OSMesaDestroyContext(handle);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

Offscreen::Offscreen() : context_(std::make_unique<Context>()) { adopt_current_context(*window_); }
Offscreen::~Offscreen() { window_->Finalize(); }

}  // namespace render
