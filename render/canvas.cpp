#include <atomic>

#include "engine/core/files.h"
#include "render/chart/layout.h"
#include "render/draw.h"
#include "render/offscreen/offscreen.h"
#include "render/paper/pixels.h"
#include "render/paper/text.h"
#include "render/png.h"
#include "render/scene/draw.h"

namespace render {

struct Canvas::Impl {
  Offscreen offscreen;
};

namespace {
std::atomic<bool> made = false;
}

Canvas::Canvas() {
  made = true;
  impl_ = std::make_unique<Impl>();
}
Canvas::~Canvas() = default;

SceneResult Canvas::draw(const Scene& scene, const std::filesystem::path& png, const Provenance& facts) {
  SceneResult result;
  write_png(draw_scene(impl_->offscreen, scene, result), png, facts, Content::photograph);
  return result;
}

void Canvas::draw(const Chart& chart, const std::filesystem::path& png, const std::filesystem::path& svg,
                  const Provenance& facts) {
  const Paper paper = paper_of(chart);
  Provenance with_extents = facts;
  for (const auto& fact : extents(chart)) with_extents.push_back(fact);
  constexpr int scale = 2;
  if (!png.empty()) write_png(to_image(impl_->offscreen, paper, scale), png, facts, Content::drawing);
  if (!svg.empty()) dem::write_file(svg, to_svg(paper, with_extents));
}

bool Canvas::any_made() { return made; }

void Canvas::check_fonts() {
  for (const bool bold : {false, true}) (void)font_file(bold);
}

std::string Canvas::settings() { return environment_settings(); }

std::string Canvas::gl_renderer() const { return impl_->offscreen.renderer(); }

}  // namespace render
