#pragma once
// From metres to the picture: view coordinates in pixels (x right, y up, z towards the eye, origin in the middle), and
// flat shapes (lines, discs, outlines) as triangles in them. No VTK here.
#include <cstdint>
#include <vector>

#include "render/scene/scene.h"

namespace render {

Point operator+(const Point& a, const Point& b);
Point operator-(const Point& a, const Point& b);
Point operator*(double s, const Point& a);
double dot(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);
Point unit(const Point& a);  ///< the zero vector stays zero

/// Fitted to a scene's bounds.
struct View {
  Point centre{}, right{}, up{}, back{};  ///< of the world, back towards the eye
  double pixels_per_metre = 1;
  double eye = 0;                ///< perspective: distance of the eye from the origin (px); 0: parallel
  double near_z = 0, far_z = 0;  ///< z of the nearest and farthest point of the scene (px)
  double over_z = 0;             ///< added to z of what is drawn over everything
  double pen = 1;                ///< pixels to one of the page
  [[nodiscard]] Point to_view(const Point& world) const;
  /// Pixels of the picture a unit of length at depth z covers.
  [[nodiscard]] double magnification(double z) const { return eye > 0 ? eye / (eye - z) : 1.0; }
};

View fit_view(const Scene& scene);

/// True when the half spaces of `cuts` leave nothing of a sphere.
bool removed(const std::vector<Scene::Cut>& cuts, const Point& centre, double radius);

/// True when no cut takes anything of a sphere.
bool untouched(const std::vector<Scene::Cut>& cuts, const Point& centre, double radius);

/// Triangles with a colour and opacity at each corner.
struct Triangles {
  std::vector<float> xyz;
  std::vector<std::uint8_t> rgba;
  void add(const Point& p, const Colour& colour, double opacity = 1);
  void polygon(const std::vector<Point>& corners, const Colour& colour);  ///< convex
};

/// Lines, discs and cut faces of a scene: opaque.
Triangles opaque_shapes(const Scene& scene, const View& view);

/// A convex face with an edge, or a line, in view coordinates.
struct FlatShape {
  std::vector<Point> points;
  bool face = false;
  Colour colour;     ///< of the face, or of the line
  Colour edge;       ///< of the edge of a face
  double width = 0;  ///< of the line or edge, px of the page
  Line line = Line::solid;
  double depth = 0;  ///< the greater, the nearer to the eye
};

/// What a scene without spheres is made of, from back to front: for drawings that painters, not depth buffers, make.
std::vector<FlatShape> flat_shapes(const Scene& scene, const View& view);

/// The outline's see-through surface, from back to front; empty when there is none.
Triangles outline_surface(const Scene& scene, const View& view);

}  // namespace render
