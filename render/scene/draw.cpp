#include "render/scene/draw.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkSmartPointer.h>
#include <vtkUniforms.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "render/scene/culling.h"
#include "render/scene/shapes.h"
#include "render/scene/vtk_triangles.h"

namespace render {
namespace {

constexpr int smoothing = 2;  // drawn at this many times the size, then shrunk

void check_columns(const Scene& scene) {
  for (const auto& s : scene.spheres)
    if (s.radius.size() != s.centre.size() || s.colour.size() != s.centre.size())
      throw std::invalid_argument("scene: spheres need a centre, a radius and a colour each");
  for (const auto& d : scene.discs)
    if (d.normal.size() != d.centre.size() || d.radius.size() != d.centre.size() || d.colour.size() != d.centre.size())
      throw std::invalid_argument("scene: discs need a centre, a normal, a radius and a colour each");
  if (scene.width < 1 || scene.height < 1) throw std::invalid_argument("scene: the picture has no size");
}

std::uint8_t byte(double v) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0))); }

/// Fragments beyond a cut are thrown away; the cut faces that show instead are flat shapes.
void cut_spheres(vtkActor& actor, const Scene& scene, const View& view) {
  std::string test;
  for (std::size_t k = 0; k < scene.cuts.size(); ++k) {
    const Point normal = unit(scene.cuts[k].normal);
    const Point n{dot(normal, view.right), dot(normal, view.up), dot(normal, view.back)};
    // vertexVC is relative to the eye; planes are kept relative to the view's origin.
    const double offset = dot(view.to_view(scene.cuts[k].point), n);
    const float plane[4] = {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2]),
                            static_cast<float>(offset)};
    const std::string name = "cutPlane" + std::to_string(k);
    actor.GetShaderProperty()->GetFragmentCustomUniforms()->SetUniform4f(name.c_str(), plane);
    test += "  if (dot(vertexVC.xyz - vec3(0.0, 0.0, -eyeDistance), " + name + ".xyz) > " + name + ".w) discard;\n";
  }
  if (test.empty()) return;
  actor.GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true, test + "//VTK::Light::Impl",
                                                          false);
}

double eye_distance(const View& view) {
  return view.eye > 0 ? view.eye : std::max(view.near_z, 0.0) + view.over_z + 100;
}

/// A sphere in the view, and what it hides there: all behind it, behind its cut face, or (cut aslant) nothing.
ViewSphere placed_sphere(const Scene& scene, const View& view, const Point& centre, double radius) {
  ViewSphere sphere{view.to_view(centre), radius * view.pixels_per_metre, 0, 1e300};
  if (untouched(scene.cuts, centre, radius)) {
    sphere.hiding_radius = sphere.radius;
  } else if (scene.cuts.size() == 1 && dot(unit(scene.cuts[0].normal), view.back) > 1 - 1e-12) {
    sphere.top = view.to_view(scene.cuts[0].point)[2];
    const double above = sphere.centre[2] - sphere.top;  // px beyond the cut
    const double square = sphere.radius * sphere.radius - above * above;
    sphere.hiding_radius = above > 0 ? std::sqrt(std::max(0.0, square)) : sphere.radius;
  }
  return sphere;
}

vtkSmartPointer<vtkActor> sphere_actor(const Spheres& spheres, const Scene& scene, const View& view) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("colour");
  colours->SetNumberOfComponents(4);  // the mapper reads four, also where VTK would make do with three
  vtkNew<vtkCellArray> cells;         // without cells VTK takes the actor for empty and culls it
  std::vector<ViewSphere> placed;
  std::vector<std::size_t> from;
  for (std::size_t i = 0; i < spheres.centre.size(); ++i) {
    if (removed(scene.cuts, spheres.centre[i], spheres.radius[i])) continue;
    placed.push_back(placed_sphere(scene, view, spheres.centre[i], spheres.radius[i]));
    from.push_back(i);
  }
  const std::vector<bool> drawn =
      view.eye > 0 ? std::vector<bool>(placed.size(), true) : seen(placed, scene.width, scene.height);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!drawn[i]) continue;
    const vtkIdType index = points->InsertNextPoint(placed[i].centre.data());
    cells->InsertNextCell(1, &index);
    radii->InsertNextValue(static_cast<float>(placed[i].radius));
    const Colour& c = spheres.colour[from[i]];
    const std::uint8_t rgba[4] = {byte(c.red), byte(c.green), byte(c.blue), 255};
    colours->InsertNextTypedTuple(rgba);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells);
  data->GetPointData()->AddArray(radii);
  data->GetPointData()->SetScalars(colours);
  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScaleArray("radius");
  mapper->SetScalarModeToUsePointData();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->ForceOpaqueOn();
  actor->GetProperty()->SetAmbient(0.32);
  actor->GetProperty()->SetDiffuse(0.72);
  actor->GetProperty()->SetSpecular(0.06);
  actor->GetProperty()->SetSpecularPower(18);
  cut_spheres(*actor, scene, view);
  const float distance = static_cast<float>(eye_distance(view));
  actor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf("eyeDistance", distance);
  return actor;
}

/// A key light over the left shoulder and a weak fill from the right.
void light(vtkRenderer& renderer) {
  const auto lamp = [&renderer](double x, double y, double intensity) {
    vtkNew<vtkLight> one;
    one->SetLightTypeToCameraLight();
    one->SetPositional(false);
    one->SetPosition(x, y, 1);
    one->SetFocalPoint(0, 0, 0);
    one->SetIntensity(intensity);
    renderer.AddLight(one);
  };
  renderer.AutomaticLightCreationOff();
  lamp(-0.45, 0.65, 0.85);
  lamp(0.7, -0.2, 0.25);
}

Image render_pass(Offscreen& offscreen, const Scene& scene, const View& view, const Spheres* ghost) {
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(scene.background.red, scene.background.green, scene.background.blue);
  for (const Spheres& spheres : scene.spheres)
    if ((spheres.opacity >= 1 || &spheres == ghost) && !spheres.centre.empty())
      renderer->AddActor(sphere_actor(spheres, scene, view));
  const Triangles opaque = opaque_shapes(scene, view);
  if (!opaque.xyz.empty()) renderer->AddActor(triangle_actor(opaque, false));
  const Triangles surface = outline_surface(scene, view);
  if (!surface.xyz.empty()) renderer->AddActor(triangle_actor(surface, true));
  light(*renderer);

  const double eye = eye_distance(view);
  vtkCamera& camera = *renderer->GetActiveCamera();
  camera.SetPosition(0, 0, eye);
  camera.SetFocalPoint(0, 0, 0);
  camera.SetViewUp(0, 1, 0);
  camera.SetParallelProjection(view.eye > 0 ? 0 : 1);
  camera.SetParallelScale(scene.height / 2.0);
  camera.SetViewAngle(2 * std::atan2(scene.height / 2.0, eye) * 180 / 3.14159265358979323846);
  camera.SetClippingRange(std::max(1.0, eye - view.near_z - view.over_z - 50), eye - view.far_z + 50);
  return offscreen.frame(*renderer, scene.width * smoothing, scene.height * smoothing);
}

}  // namespace

Image draw_scene(Offscreen& offscreen, const Scene& scene, SceneResult& result) {
  check_columns(scene);
  const View view = fit_view(scene);
  Image image = shrink(render_pass(offscreen, scene, view, nullptr), smoothing);
  for (const Spheres& spheres : scene.spheres)  // see-through spheres: their front layer, mixed in
    if (spheres.opacity < 1 && spheres.opacity > 0)
      image = mix(image, shrink(render_pass(offscreen, scene, view, &spheres), smoothing), spheres.opacity);
  result.width = scene.width;
  result.height = scene.height;
  result.metres_per_pixel = view.eye > 0 ? 0 : 1 / view.pixels_per_metre;
  result.centre = view.centre;
  result.right = view.right;
  result.up = view.up;
  return image;
}

}  // namespace render
