#pragma once
// Drawing without a display. One Canvas a program; not thread-safe. VTK stays behind this header.
// The same input gives the same bytes (PNG and SVG), with any number of threads.
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/chart/chart.h"
#include "render/scene/scene.h"

namespace render {

class Canvas {
 public:
  Canvas();  ///< throws dem::EnvironmentError when no off-screen GL context can be made
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Draws a chart as PNG and as SVG (text is text, in DejaVu Sans); an empty path leaves that file out. `dpi` of the
  /// PNG where a chart of column_width is column_mm wide.
  /// Files are written aside, then renamed. Throws std::invalid_argument when columns of the chart differ in length.
  void draw(const Chart& chart, const std::filesystem::path& png, const std::filesystem::path& svg,
            const Provenance& facts, double dpi = 300);
  /// `dpi` is noted in the file; the scene says how many pixels it has. A scene without spheres in parallel view is also
  /// drawn as vectors where `svg` names a file.
  SceneResult draw(const Scene& scene, const std::filesystem::path& png, const Provenance& facts, double dpi = 0,
                   const std::filesystem::path& svg = {});
  [[nodiscard]] std::string gl_renderer() const;  ///< for run.json
  /// A process that was forked after this became true cannot draw: the threads of the GL driver stayed behind.
  [[nodiscard]] static bool any_made();
  /// Throws dem::EnvironmentError when a font that charts need is missing.
  static void check_fonts();
  /// The variables of the environment that bear on drawing, "; set here: GALLIUM_DRIVER=softpipe": for messages. "": none.
  [[nodiscard]] static std::string settings();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
