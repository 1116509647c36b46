// Debian's GLEW looks GL functions up through GLX and wants an X display, and there is none here. The executable
// defines and exports the functions below, which the dynamic linker then prefers to the ones of libGLX and libGLEW.
#ifndef _GNU_SOURCE
#define _GNU_SOURCE  // RTLD_NEXT
#endif
#ifdef DEM_GL_OSMESA
#include <GL/osmesa.h>
#endif
#include <dlfcn.h>

extern "C" {

unsigned glewInit();

#ifdef DEM_GL_OSMESA
using GlFunction = void (*)();

GlFunction glXGetProcAddressARB(const unsigned char* name);
GlFunction glXGetProcAddress(const unsigned char* name);

GlFunction glXGetProcAddressARB(const unsigned char* name) {
  return reinterpret_cast<GlFunction>(OSMesaGetProcAddress(reinterpret_cast<const char*>(name)));
}

GlFunction glXGetProcAddress(const unsigned char* name) { return glXGetProcAddressARB(name); }
#endif

// GLEW ends with "no GLX display" (4) after all GL functions are loaded: good enough, nothing here uses GLX.
unsigned glewInit() {
  static const auto real = reinterpret_cast<unsigned (*)()>(dlsym(RTLD_NEXT, "glewInit"));
  if (real == nullptr) return 1;
  const unsigned result = real();
  constexpr unsigned no_glx_display = 4;
  return result == no_glx_display ? 0 : result;
}
}
