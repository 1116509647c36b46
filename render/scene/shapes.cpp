#include "render/scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/dashes.h"

namespace render {

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point unit(const Point& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? (1 / length) * a : a;
}

namespace {

using std::numbers::pi;

/// Two unit vectors that make a right-handed frame with the unit vector n.
std::array<Point, 2> across(const Point& n) {
  const Point helper = std::abs(n[2]) < 0.9 ? Point{0, 0, 1} : Point{1, 0, 0};
  const Point u = unit(cross(helper, n));
  return {u, cross(n, u)};
}

/// Corners of a regular polygon for a disc.
std::vector<Point> ring(const Point& centre, const Point& normal, double radius, int corners) {
  const auto [u, v] = across(unit(normal));
  std::vector<Point> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * pi * i / corners;
    points.push_back(centre + (radius * std::cos(angle)) * u + (radius * std::sin(angle)) * v);
  }
  return points;
}

int corners_for(double radius_px) { return std::clamp(static_cast<int>(8 + 2 * radius_px), 10, 96); }

/// The part of a convex polygon that no cut removes (Sutherland & Hodgman 1974). `skip` is a cut it lies in.
std::vector<Point> kept(std::vector<Point> polygon, const std::vector<Scene::Cut>& cuts, std::size_t skip) {
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    if (k == skip) continue;
    std::vector<Point> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double da = dot(a - cuts[k].point, cuts[k].normal), db = dot(b - cuts[k].point, cuts[k].normal);
      if (da <= 0) inside.push_back(a);
      if ((da <= 0) != (db <= 0)) inside.push_back(a + (da / (da - db)) * (b - a));
    }
    polygon = std::move(inside);
  }
  return polygon;
}

/// The runs of a line of points that no cut removes.
std::vector<std::vector<Point>> kept_runs(const std::vector<Point>& points, const std::vector<Scene::Cut>& cuts) {
  std::vector<std::vector<Point>> runs;
  bool open = false;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    double from = 0, to = 1;
    for (const auto& cut : cuts) {
      const double a = dot(points[i] - cut.point, cut.normal), b = dot(points[i + 1] - cut.point, cut.normal);
      if (a > 0 && b > 0) to = -1;
      if (a > 0 && b <= 0) from = std::max(from, a / (a - b));
      if (a <= 0 && b > 0) to = std::min(to, a / (a - b));
    }
    if (from >= to) {
      open = false;
      continue;
    }
    const Point step = points[i + 1] - points[i];
    if (!open || from > 0) runs.push_back({points[i] + from * step});
    runs.back().push_back(points[i] + to * step);
    open = to >= 1;
  }
  return runs;
}

/// A line of constant width on the screen, at the depth of its points, `lift` px nearer to the eye.
void ribbon(Triangles& out, const View& view, const std::vector<Point>& line, const Polyline& style, double lift) {
  std::vector<std::array<double, 2>> flat;
  for (const Point& p : line) flat.push_back({p[0] * view.magnification(p[2]), p[1] * view.magnification(p[2])});
  for (const DashPiece& piece : dashes(flat, style.line, view.pen * style.width)) {
    const Point step = line[piece.segment + 1] - line[piece.segment];
    const Point a = line[piece.segment] + piece.from * step, b = line[piece.segment] + piece.to * step;
    const auto &fa = flat[piece.segment], &fb = flat[piece.segment + 1];
    const double dx = fb[0] - fa[0], dy = fb[1] - fa[1], length = std::hypot(dx, dy);
    if (length <= 0) continue;
    const double half = view.pen * style.width / 2;
    const double ex = dx / length * half, ey = dy / length * half;  // half a width along the line
    const auto corner = [&](const Point& p, double along, double side) {
      const double scale = 1 / view.magnification(p[2]);
      return Point{p[0] + scale * (along * ex - side * ey), p[1] + scale * (along * ey + side * ex), p[2] + lift};
    };
    // Solid lines reach a little over their ends, so that corners close.
    const double over = style.line == Line::solid ? 0.5 : 0.0;
    out.polygon({corner(a, -over, -1), corner(b, over, -1), corner(b, over, 1), corner(a, -over, 1)}, style.colour);
  }
}

void world_line(Triangles& out, const Scene& scene, const View& view, const Polyline& line, double lift) {
  for (const auto& run : kept_runs(line.points, scene.cuts)) {
    std::vector<Point> seen;
    for (const Point& p : run) seen.push_back(view.to_view(p));
    ribbon(out, view, seen, line, lift);
  }
}

std::vector<Point> to_view(const View& view, const std::vector<Point>& points) {
  std::vector<Point> seen;
  for (const Point& p : points) seen.push_back(view.to_view(p));
  return seen;
}

Colour shade(const Colour& c, double light) { return {c.red * light, c.green * light, c.blue * light}; }

/// The same place on the screen, nearer to the eye than anything else.
std::vector<Point> lifted(const View& view, std::vector<Point> points) {
  for (Point& p : points) {
    const double scale = view.magnification(p[2]) / view.magnification(p[2] + view.over_z);
    p = {scale * p[0], scale * p[1], p[2] + view.over_z};
  }
  return points;
}

/// Cracks: lit from both sides, with a thin dark edge that also shows a disc seen from its side.
void add_discs(Triangles& out, const Scene& scene, const View& view, const Discs& discs) {
  for (std::size_t i = 0; i < discs.centre.size(); ++i) {
    const Point normal = unit(discs.normal[i]);
    const double radius_px = discs.radius[i] * view.pixels_per_metre;
    auto face = ring(discs.centre[i], normal, discs.radius[i], corners_for(radius_px));
    if (!discs.over) face = kept(std::move(face), scene.cuts, scene.cuts.size());
    if (face.size() < 3) continue;
    face = to_view(view, face);
    if (discs.over) face = lifted(view, std::move(face));
    const double facing = std::abs(dot(normal, view.back));
    out.polygon(face, shade(discs.colour[i], 0.78 + 0.22 * facing));
    face.push_back(face.front());
    const double radius_seen = radius_px / view.pen;
    const double width = std::clamp(0.18 * radius_seen, 0.4, 1.0);
    // Around a small disc a dark edge would be most of what is seen.
    const double tone = std::clamp(1.05 - 0.1 * radius_seen, 0.45, 0.85);
    ribbon(out, view, face, Polyline{{}, shade(discs.colour[i], tone), width, Line::solid}, 0.4);
  }
}

/// Flat faces where cuts cross spheres, with a fine edge in a darker tone.
void add_cut_faces(Triangles& out, const Scene& scene, const View& view, const Spheres& spheres) {
  for (std::size_t k = 0; k < scene.cuts.size(); ++k) {
    const Point normal = unit(scene.cuts[k].normal);
    if (dot(normal, view.back) <= 0) continue;  // the cut looks away from the eye
    for (std::size_t i = 0; i < spheres.centre.size(); ++i) {
      const double distance = dot(spheres.centre[i] - scene.cuts[k].point, normal);
      const double square = spheres.radius[i] * spheres.radius[i] - distance * distance;
      if (square <= 0) continue;
      const double radius = std::sqrt(square), radius_px = radius * view.pixels_per_metre;
      auto face =
          kept(ring(spheres.centre[i] - distance * normal, normal, radius, corners_for(radius_px)), scene.cuts, k);
      if (face.size() < 3) continue;
      out.polygon(to_view(view, face), spheres.colour[i]);
      face.push_back(face.front());
      if (spheres.cut_edges && radius_px > 2)
        ribbon(out, view, to_view(view, face), Polyline{{}, shade(spheres.colour[i], 0.72), 0.4, Line::solid}, 0.05);
    }
  }
}

bool is_round(const Outline& outline) {
  return outline.shape == Outline::Shape::cylinder || outline.shape == Outline::Shape::disc;
}

struct Cylinder {
  Point low{}, high{};  // centres of the two ends
  double radius = 0;
  std::array<std::size_t, 3> axes{};  // across, across and along
};

Cylinder cylinder_of(const Outline& outline) {
  Cylinder cylinder{.radius = (outline.high[0] - outline.low[0]) / 2, .axes = {0, 1, 2}};
  if (outline.shape == Outline::Shape::disc) cylinder.axes = {2, 0, 1};
  for (std::size_t k = 0; k < 3; ++k) cylinder.low[k] = cylinder.high[k] = (outline.low[k] + outline.high[k]) / 2;
  const std::size_t along = cylinder.axes[2];
  cylinder.low[along] = outline.low[along];
  cylinder.high[along] = outline.high[along];
  return cylinder;
}

Point rim(const Cylinder& cylinder, const Point& end, double angle) {
  Point at = end;
  at[cylinder.axes[0]] += cylinder.radius * std::cos(angle);
  at[cylinder.axes[1]] += cylinder.radius * std::sin(angle);
  return at;
}

constexpr int rim_steps = 180;

std::vector<Point> arc(const Cylinder& cylinder, const Point& end, double from, double to) {
  std::vector<Point> points;
  for (int i = 0; i <= rim_steps; ++i) points.push_back(rim(cylinder, end, from + (to - from) * i / rim_steps));
  return points;
}

/// Visible edges are drawn dark and solid, hidden ones light and dashed.
struct Edge {
  std::vector<Point> points;
  bool hidden = false;
};

std::vector<Edge> cylinder_edges(const Outline& outline, const View& view) {
  const Cylinder cylinder = cylinder_of(outline);
  const auto [u, v, along] = cylinder.axes;
  const double facing = std::atan2(view.back[v], view.back[u]);  // the side that looks at the eye
  const bool from_end = std::hypot(view.back[u], view.back[v]) < 1e-9;
  std::vector<Edge> edges;
  for (const Point& end : {cylinder.low, cylinder.high}) {
    const bool end_seen =
        (end[along] == cylinder.high[along]) == (view.back[along] > 0) && std::abs(view.back[along]) > 1e-9;
    edges.push_back({arc(cylinder, end, facing - pi / 2, facing + pi / 2), false});
    edges.push_back({arc(cylinder, end, facing + pi / 2, facing + 3 * pi / 2), !end_seen && !from_end});
  }
  if (!from_end)
    for (double side : {facing - pi / 2, facing + pi / 2})
      edges.push_back({{rim(cylinder, cylinder.low, side), rim(cylinder, cylinder.high, side)}, false});
  return edges;
}

Point box_corner(const Outline& outline, int code) {
  return {(code & 1) != 0 ? outline.high[0] : outline.low[0], (code & 2) != 0 ? outline.high[1] : outline.low[1],
          (code & 4) != 0 ? outline.high[2] : outline.low[2]};
}

std::vector<Edge> box_edges(const Outline& outline, const View& view) {
  std::vector<Edge> edges;
  for (int code = 0; code < 8; ++code)
    for (int axis = 0; axis < 3; ++axis) {
      if ((code & (1 << axis)) != 0) continue;
      bool hidden = true;  // unless one of the two faces that meet here looks at the eye
      for (int other = 0; other < 3; ++other) {
        const double outward = (code & (1 << other)) != 0 ? 1.0 : -1.0;
        if (other != axis && outward * view.back[static_cast<std::size_t>(other)] > 1e-9) hidden = false;
      }
      edges.push_back({{box_corner(outline, code), box_corner(outline, code | (1 << axis))}, hidden});
    }
  return edges;
}

void add_outline_edges(Triangles& out, const Scene& scene, const View& view) {
  const auto edges = is_round(scene.outline) ? cylinder_edges(scene.outline, view) : box_edges(scene.outline, view);
  const Colour seen = shade(scene.outline.colour, 0.55);
  for (const Edge& edge : edges) {
    const Polyline style{edge.points, edge.hidden ? scene.outline.colour : seen, edge.hidden ? 0.7 : 1.0,
                         edge.hidden ? Line::dash : Line::solid};
    world_line(out, scene, view, style, 0);
  }
}

using Quad = std::array<Point, 4>;

std::vector<Quad> outline_quads(const Outline& outline) {
  std::vector<Quad> quads;
  if (is_round(outline)) {
    const Cylinder c = cylinder_of(outline);
    for (int i = 0; i < rim_steps; ++i) {
      const double a = 2 * pi * i / rim_steps, b = 2 * pi * (i + 1) / rim_steps;
      quads.push_back({rim(c, c.low, a), rim(c, c.low, b), rim(c, c.high, b), rim(c, c.high, a)});
    }
    return quads;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3);
    for (int side : {0, 1 << axis}) {
      Quad quad{box_corner(outline, side), box_corner(outline, side | u), box_corner(outline, side | u | v),
                box_corner(outline, side | v)};
      if (side == 0) std::reverse(quad.begin(), quad.end());
      quads.push_back(quad);
    }
  }
  return quads;
}

struct Bounds {
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void take(const Point& p, double r) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i] - r);
      high[i] = std::max(high[i], p[i] + r);
    }
  }
};

}  // namespace

bool removed(const std::vector<Scene::Cut>& cuts, const Point& centre, double radius) {
  return std::any_of(cuts.begin(), cuts.end(),
                     [&](const auto& cut) { return dot(centre - cut.point, unit(cut.normal)) >= radius; });
}

bool untouched(const std::vector<Scene::Cut>& cuts, const Point& centre, double radius) {
  return std::all_of(cuts.begin(), cuts.end(),
                     [&](const auto& cut) { return dot(centre - cut.point, unit(cut.normal)) <= -radius; });
}

Point View::to_view(const Point& world) const {
  const Point p = world - centre;
  return {pixels_per_metre * dot(p, right), pixels_per_metre * dot(p, up), pixels_per_metre * dot(p, back)};
}

View fit_view(const Scene& scene) {
  View view;
  view.pen = scene.pen();
  const Point direction = unit(scene.camera.direction);
  view.back = -1.0 * (dot(direction, direction) > 0 ? direction : Point{0, -1, 0});
  Point right = cross(scene.camera.up, view.back);
  if (dot(right, right) < 1e-20) right = across(view.back)[0];
  view.right = unit(right);
  view.up = cross(view.back, view.right);

  const auto along = [&view](const Point& p) { return Point{dot(p, view.right), dot(p, view.up), dot(p, view.back)}; };
  Bounds all, fitted;
  for (const auto& spheres : scene.spheres)
    for (std::size_t i = 0; i < spheres.centre.size(); ++i)
      if (!removed(scene.cuts, spheres.centre[i], spheres.radius[i]))
        all.take(along(spheres.centre[i]), spheres.radius[i]);
  for (const auto& discs : scene.discs)
    for (std::size_t i = 0; i < discs.centre.size(); ++i)
      if (discs.over || !removed(scene.cuts, discs.centre[i], discs.radius[i]))
        all.take(along(discs.centre[i]), discs.radius[i]);
  for (const auto& line : scene.lines)
    for (const auto& run : kept_runs(line.points, scene.cuts))
      for (const Point& p : run) all.take(along(p), 0);
  if (scene.outline.shape != Outline::Shape::none)
    for (const Quad& quad : outline_quads(scene.outline))
      for (const Point& p : kept({quad.begin(), quad.end()}, scene.cuts, scene.cuts.size())) all.take(along(p), 0);
  if (scene.camera.frame)
    for (int code = 0; code < 8; ++code) {
      Point corner{};
      for (std::size_t i = 0; i < 3; ++i) corner[i] = (*scene.camera.frame)[(code >> i) & 1][i];
      fitted.take(along(corner), 0);
    }
  else
    fitted = all;
  if (all.low[0] > all.high[0]) all = fitted;
  if (fitted.low[0] > fitted.high[0]) {
    fitted.take({0, 0, 0}, 1);
    all = fitted;
  }

  const Point middle = 0.5 * (fitted.low + fitted.high);
  view.centre = middle[0] * view.right + middle[1] * view.up + middle[2] * view.back;
  constexpr double margin = 0.97;
  const double wide = std::max(fitted.high[0] - fitted.low[0], 1e-12),
               tall = std::max(fitted.high[1] - fitted.low[1], 1e-12);
  view.pixels_per_metre = margin * scene.camera.zoom * std::min(scene.width / wide, scene.height / tall);
  view.near_z = (all.high[2] - middle[2]) * view.pixels_per_metre;
  view.far_z = (all.low[2] - middle[2]) * view.pixels_per_metre;
  if (!scene.camera.parallel) {  // far enough to be calm, near enough to give depth; fitted at its near side
    view.eye = 2.5 * std::max(scene.width, scene.height) + 2 * (view.near_z - view.far_z) + std::max(0.0, view.near_z);
    const double shrunk = (view.eye - std::max(0.0, view.near_z)) / view.eye;
    view.pixels_per_metre *= shrunk;
    view.near_z *= shrunk;
    view.far_z *= shrunk;
  }
  view.over_z = view.near_z - view.far_z + 10;
  return view;
}

void Triangles::add(const Point& p, const Colour& colour, double opacity) {
  for (double v : p) xyz.push_back(static_cast<float>(v));
  for (double v : {colour.red, colour.green, colour.blue, opacity})
    rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0))));
}

void Triangles::polygon(const std::vector<Point>& corners, const Colour& colour) {
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    for (std::size_t k : {std::size_t{0}, i, i + 1}) add(corners[k], colour);
}

Triangles opaque_shapes(const Scene& scene, const View& view) {
  Triangles out;
  for (const auto& spheres : scene.spheres)
    if (spheres.opacity >= 1) add_cut_faces(out, scene, view, spheres);
  for (const auto& discs : scene.discs) add_discs(out, scene, view, discs);
  for (const auto& line : scene.lines)
    if (line.cased) world_line(out, scene, view, {line.points, {1, 1, 1}, line.width + 1.3, Line::solid}, 0.4);
  for (const auto& line : scene.lines) world_line(out, scene, view, line, 0.5);
  if (scene.outline.shape != Outline::Shape::none) add_outline_edges(out, scene, view);
  return out;
}

std::vector<FlatShape> flat_shapes(const Scene& scene, const View& view) {
  std::vector<FlatShape> shapes;
  const auto add_line = [&](const Polyline& line, double lift) {
    for (const auto& run : kept_runs(line.points, scene.cuts)) {
      const std::vector<Point> seen = to_view(view, run);
      double depth = lift;
      for (const Point& p : seen) depth += p[2] / static_cast<double>(seen.size());
      shapes.push_back(
          {.points = seen, .colour = line.colour, .edge = {}, .width = line.width, .line = line.line, .depth = depth});
    }
  };
  for (const auto& discs : scene.discs) {
    for (std::size_t i = 0; i < discs.centre.size(); ++i) {
      const Point normal = unit(discs.normal[i]);
      auto face = ring(discs.centre[i], normal, discs.radius[i], 12);
      if (!discs.over) face = kept(std::move(face), scene.cuts, scene.cuts.size());
      if (face.size() < 3) continue;
      const double facing = std::abs(dot(normal, view.back)), depth = view.to_view(discs.centre[i])[2];
      shapes.push_back({.points = to_view(view, face),
                        .face = true,
                        .colour = shade(discs.colour[i], 0.78 + 0.22 * facing),
                        .edge = shade(discs.colour[i], 0.6),
                        .width = 0.4,
                        .depth = discs.over ? depth + view.over_z : depth});
    }
  }
  for (const auto& line : scene.lines) add_line(line, 0.5);
  if (scene.outline.shape != Outline::Shape::none) {
    const auto edges = is_round(scene.outline) ? cylinder_edges(scene.outline, view) : box_edges(scene.outline, view);
    for (const Edge& edge : edges) {
      const double beyond = edge.hidden ? -view.over_z : view.over_z;  // hidden ones behind all, others before all
      add_line({edge.points, edge.hidden ? scene.outline.colour : shade(scene.outline.colour, 0.55),
                edge.hidden ? 0.7 : 1.0, edge.hidden ? Line::dash : Line::solid},
               beyond);
    }
  }
  std::ranges::stable_sort(shapes, {}, &FlatShape::depth);
  return shapes;
}

Triangles outline_surface(const Scene& scene, const View& view) {
  Triangles out;
  if (scene.outline.shape == Outline::Shape::none || scene.outline.opacity <= 0) return out;
  struct Seen {
    std::vector<Point> corners;
    double depth = 0, opacity = 0;
  };
  std::vector<Seen> faces;
  for (const Quad& quad : outline_quads(scene.outline)) {
    const auto world = kept({quad.begin(), quad.end()}, scene.cuts, scene.cuts.size());
    if (world.size() < 3) continue;
    const Point normal = unit(cross(quad[1] - quad[0], quad[3] - quad[0]));
    const double facing = std::abs(dot(normal, view.back));
    Seen seen{to_view(view, world), 0, scene.outline.opacity * (0.35 + 0.65 * (1 - facing))};
    for (const Point& p : seen.corners) seen.depth += p[2] / static_cast<double>(seen.corners.size());
    faces.push_back(std::move(seen));
  }
  std::stable_sort(faces.begin(), faces.end(), [](const Seen& a, const Seen& b) { return a.depth < b.depth; });
  for (const Seen& face : faces)
    for (std::size_t i = 1; i + 1 < face.corners.size(); ++i)
      for (std::size_t k : {std::size_t{0}, i, i + 1}) out.add(face.corners[k], scene.outline.colour, face.opacity);
  return out;
}

}  // namespace render
