#include <stdexcept>

#include "render/draw.h"
#include "render/offscreen.h"
#include "render/png.h"
#include "render/scene_draw.h"

namespace render {

struct Canvas::Impl {
  Offscreen offscreen;
};

Canvas::Canvas() : impl_(std::make_unique<Impl>()) {}
Canvas::~Canvas() = default;

SceneResult Canvas::draw(const Scene& scene, const std::filesystem::path& png, const Provenance& facts) {
  SceneResult result;
  write_png(draw_scene(impl_->offscreen, scene, result), png, facts, Content::photograph);
  return result;
}

std::string Canvas::gl_renderer() const { return impl_->offscreen.renderer(); }

}  // namespace render
