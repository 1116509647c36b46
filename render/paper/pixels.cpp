// Paper as pixels: shapes are triangles drawn by VTK in their order, text comes from VTK's FreeType renderer; both at
// several times the size, then shrunk.
#include "render/paper/pixels.h"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/errors.h"
#include "render/dashes.h"
#include "render/paper/text.h"
#include "render/scene/vtk_triangles.h"

namespace render {
namespace {

/// Paper pixels to view coordinates: origin in the middle, y up.
struct Mapper {
  double scale, width, height;
  [[nodiscard]] Point operator()(const Vec2& p) const {
    return {scale * (p.x - width / 2), scale * (height / 2 - p.y), 0};
  }
};

void add(Triangles& out, const Mapper& map, const std::vector<Vec2>& convex, const Colour& colour, double opacity) {
  for (std::size_t i = 1; i + 1 < convex.size(); ++i)
    for (std::size_t k : {std::size_t{0}, i, i + 1}) out.add(map(convex[k]), colour, opacity);
}

void add(Triangles& out, const Mapper& map, const Fill& fill) {
  if (fill.lower.empty()) return add(out, map, fill.edge, fill.colour, fill.opacity);
  for (std::size_t i = 0; i + 1 < fill.edge.size(); ++i)
    add(out, map, {fill.edge[i], fill.edge[i + 1], fill.lower[i + 1], fill.lower[i]}, fill.colour, fill.opacity);
}

/// The wedge that rounds the joint of two pieces of a line.
void add_joint(Triangles& out, const Mapper& map, const Vec2& at, double radius, const Colour& colour) {
  std::vector<Vec2> circle;
  const int corners = std::clamp(static_cast<int>(6 * radius), 8, 24);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    circle.push_back({at.x + radius * std::cos(angle), at.y + radius * std::sin(angle)});
  }
  add(out, map, circle, colour, 1);
}

void add(Triangles& out, const Mapper& map, const Path& path) {
  std::vector<std::array<double, 2>> flat;
  for (const Vec2& p : path.points) flat.push_back({p.x, p.y});
  const double half = path.stroke.width / 2;
  for (const DashPiece& piece : dashes(flat, path.stroke.line, path.stroke.width)) {
    const Vec2 &a = path.points[piece.segment], &b = path.points[piece.segment + 1];
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    if (!(length > 0)) continue;
    const double nx = -dy / length * half, ny = dx / length * half;
    const Vec2 from{a.x + piece.from * dx, a.y + piece.from * dy}, to{a.x + piece.to * dx, a.y + piece.to * dy};
    add(out, map,
        {{from.x + nx, from.y + ny}, {to.x + nx, to.y + ny}, {to.x - nx, to.y - ny}, {from.x - nx, from.y - ny}},
        path.stroke.colour, 1);
    if (piece.from == 0 && piece.segment > 0) add_joint(out, map, a, half, path.stroke.colour);
  }
}

void add(Triangles&, const Mapper&, const Run&) {}  // text is drawn by write()

Image shapes(Offscreen& offscreen, const Paper& paper, double scale, int width, int height) {
  const Mapper map{scale, static_cast<double>(paper.width()), static_cast<double>(paper.height())};
  Triangles triangles;
  for (const auto& item : paper.items()) std::visit([&](const auto& it) { add(triangles, map, it); }, item);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  if (!triangles.xyz.empty()) renderer->AddActor(triangle_actor(triangles, true));
  vtkCamera& camera = *renderer->GetActiveCamera();
  camera.SetPosition(0, 0, 10);
  camera.SetFocalPoint(0, 0, 0);
  camera.SetParallelProjection(1);
  camera.SetParallelScale(height / 2.0);
  camera.SetClippingRange(1, 20);
  return offscreen.frame(*renderer, width, height);
}

/// Writes a run of text into the image, whose pixels are `scale` to one of the paper's.
void write(Image& image, const Run& run, double scale) {
  if (run.text.empty()) return;
  const TextStyle& style = run.style;
  vtkNew<vtkTextProperty> property;
  property->SetFontFamily(VTK_FONT_FILE);
  property->SetFontFile(font_file(style.bold).c_str());
  property->SetFontSize(static_cast<int>(std::lround(style.size * scale)));
  property->SetColor(style.colour.red, style.colour.green, style.colour.blue);
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
  property->SetOrientation(style.upward ? 90 : 0);
  constexpr int points_are_pixels = 72;
  vtkTextRenderer& renderer = *vtkTextRenderer::GetInstance();
  vtkTextRenderer::Metrics metrics;
  vtkNew<vtkImageData> glyphs;
  int size[2] = {0, 0};
  if (!renderer.GetMetrics(property.Get(), vtkStdString(run.text), metrics, points_are_pixels,
                           vtkTextRenderer::FreeType) ||
      !renderer.RenderString(property.Get(), vtkStdString(run.text), glyphs.Get(), size, points_are_pixels,
                             vtkTextRenderer::FreeType))
    throw dem::EnvironmentError("cannot write text with " + font_file(style.bold));

  const double width = run_width(run.text, style.size, style.bold) * scale;
  const double back = style.anchor == Anchor::start ? 0 : style.anchor == Anchor::middle ? width / 2 : width;
  // The anchor of the glyphs is the lower end of the descent; ours is on the base line. In the image y goes up.
  const double x = run.at.x * scale - (style.upward ? 0 : back) + metrics.Descent.GetX();
  const double y = run.at.y * scale + (style.upward ? back : 0) - metrics.Descent.GetY();
  int extent[6];
  glyphs->GetExtent(extent);
  const auto* pixels = static_cast<const unsigned char*>(glyphs->GetScalarPointer());
  const int columns = extent[1] - extent[0] + 1;
  for (int gy = 0; gy < size[1]; ++gy)
    for (int gx = 0; gx < size[0]; ++gx) {
      const int column = static_cast<int>(std::lround(x)) + extent[0] + gx;
      const int row = static_cast<int>(std::lround(y)) - (extent[2] + gy);
      if (column < 0 || row < 0 || column >= image.width || row >= image.height) continue;
      const unsigned char* from = pixels + 4 * (static_cast<std::ptrdiff_t>(gy) * columns + gx);
      std::uint8_t* to = &image.rgb[image.at(column, row)];
      for (int c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>((to[c] * (255 - from[3]) + from[c] * from[3] + 127) / 255);
    }
}

}  // namespace

Image to_image(Offscreen& offscreen, const Paper& paper, double scale) {
  constexpr int smoothing = 3;
  const int width = smoothing * static_cast<int>(std::lround(scale * paper.width()));
  const int height = smoothing * static_cast<int>(std::lround(scale * paper.height()));
  Image large = shapes(offscreen, paper, scale * smoothing, width, height);
  for (const auto& item : paper.items())
    if (const Run* run = std::get_if<Run>(&item)) write(large, *run, scale * smoothing);
  return shrink(large, smoothing);
}

}  // namespace render
