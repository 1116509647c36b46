#include <atomic>

#include "engine/core/files.h"
#include "render/chart/layout.h"
#include "render/draw.h"
#include "render/offscreen/offscreen.h"
#include "render/paper/pixels.h"
#include "render/paper/strip.h"
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

SceneResult Canvas::draw(const Scene& scene, const std::filesystem::path& png, const Provenance& facts, double dpi,
                         const std::filesystem::path& svg) {
  SceneResult result;
  Image image = draw_scene(impl_->offscreen, scene, result);
  if (!svg.empty()) dem::write_file(svg, to_svg(paper_of(scene, result), facts));
  if (has_strip(scene)) {
    const Paper strip = strip_of(scene, result);
    image = stacked(image, to_image(impl_->offscreen, strip, static_cast<double>(scene.width) / strip.width()));
    result.height = image.height;
  }
  write_png(image, png, facts, Content::photograph, dpi);
  return result;
}

void Canvas::draw(const Chart& chart, const std::filesystem::path& png, const std::filesystem::path& svg,
                  const Provenance& facts, double dpi) {
  const Paper paper = paper_of(chart);
  Provenance with_extents = facts;
  for (const auto& fact : extents(chart)) with_extents.push_back(fact);
  const double scale = dpi * column_mm / 25.4 / column_width;
  if (!png.empty()) write_png(to_image(impl_->offscreen, paper, scale), png, facts, Content::drawing, dpi);
  if (!svg.empty()) dem::write_file(svg, to_svg(paper, with_extents));
}

bool Canvas::any_made() { return made; }

void Canvas::check_fonts() {
  for (const bool bold : {false, true}) (void)font_file(bold);
}

std::string Canvas::settings() { return environment_settings(); }

std::string Canvas::gl_renderer() const { return impl_->offscreen.renderer(); }

}  // namespace render
