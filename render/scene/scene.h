#pragma once
// Scenes: a specimen drawn as spheres, discs (cracks) and lines (axes), in one camera view. Lengths in metres.
// Legends and scale bars are not part of the raster: the page composes them (render::SceneResult tells the scale). What
// belongs to the picture wherever it goes stands in a strip below it: the directions of the axes and the bar of colours.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "render/style.h"

namespace render {

using Point = std::array<double, 3>;

/// Spheres with a colour each. Drawn as impostors: one frame of 36,528 takes well under a second.
struct Spheres {
  std::vector<Point> centre;
  std::vector<double> radius;
  std::vector<Colour> colour;
  double opacity = 1.0;
  bool cut_edges = true;  ///< a fine dark line around cut faces; false where colours stand for values
};

/// Flat discs (cracks).
struct Discs {
  std::vector<Point> centre, normal;
  std::vector<double> radius;
  std::vector<Colour> colour;
  bool over = false;  ///< drawn over everything and never cut: cracks near a section, on its face
};

struct Polyline {
  std::vector<Point> points;
  Colour colour;
  double width = 2;  ///< px of the page
  Line line = Line::solid;
  bool cased = false;  ///< with a white seam, to be seen on any ground
};

/// A surface outline of the specimen: a transparent cylinder or box.
struct Outline {
  enum class Shape { none, cylinder, disc, box } shape = Shape::none;
  Point low{}, high{};  ///< bounds; a cylinder stands along z, a disc has its axis along y
  Colour colour{0.6, 0.6, 0.6};
  double opacity = 0.15;
};

struct Camera {
  Point direction{0, -1, 0};  ///< from the eye into the scene
  Point up{0, 0, 1};
  bool parallel = true;  ///< parallel projection: lengths can be read with the scale bar
  double zoom = 1.0;
  /// Bounds to fit into the picture, so that several pictures share one scale; absent: all that is drawn.
  std::optional<std::array<Point, 2>> frame;
};

/// What colours that stand for values mean.
struct ColourBar {
  std::string title;  ///< with the unit: "Mean stress (10⁻³ k)"
  double low = 0, high = 1;
  std::vector<Colour> colours;  ///< from low to high, in equal steps
};

struct Scene {
  std::vector<Spheres> spheres;
  std::vector<Discs> discs;
  std::vector<Polyline> lines;
  Outline outline;
  Camera camera;
  /// Cuts everything with (p - point) . normal > 0 away; spheres show their cut faces flat.
  struct Cut {
    Point point{}, normal{0, 1, 0};
  };
  std::vector<Cut> cuts;
  int width = 800, height = 1200;  ///< px, without the strip below
  Colour background{1, 1, 1};
  bool axes = false;               ///< the directions of x, y and z in the strip
  std::optional<ColourBar> bar{};  ///< in the strip
  /// Width of the picture on the page (px there, see render::page_width): for text, and lines as wide as in charts. 0:
  /// width.
  double shown = 0;
  [[nodiscard]] double pen() const { return shown > 0 ? width / shown : 1; }  ///< pixels to one of the page
};

/// What the page must know about a drawn scene.
struct SceneResult {
  double metres_per_pixel = 0;  ///< parallel projection only
  int width = 0, height = 0;    ///< the strip included
  Point centre{};               ///< the point in the middle of the picture, without the strip
  Point right{}, up{};          ///< unit vectors along the picture's sides: a point p is drawn (p - centre) . right /
                                ///< metres_per_pixel to the right of the middle
};

}  // namespace render
