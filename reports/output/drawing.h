#pragma once
// Figures of a study, drawn: contents made by the figures, pictures and data written as files.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "render/draw.h"
#include "reports/figure.h"
#include "reports/options.h"

namespace reports {

/// A bar below a picture that tells its scale.
struct ScaleBar {
  std::string text;    ///< "5 mm"
  double percent = 0;  ///< of the picture's width; 0: none
};

/// A panel with what the page needs to show it.
struct DrawnPanel {
  std::string letter{};  ///< "a"; "" when the figure has one panel only
  std::string caption{}, alt{}, label{};
  std::string image{};  ///< file to show, relative to the output folder: "figures/x.svg"; "" for tables
  std::vector<LegendEntry> legend{};
  ScaleBar bar{};
  TextTable table{};  ///< when the panel is a table
  int per_row = 1;
  bool whole_width = false;          ///< see Panel
  std::string note{};                ///< "Drawn from 10 000 of 48 211 points; the CSV has all."
  std::vector<std::string> files{};  ///< relative to the output folder
  int width = 0, height = 0;         ///< of the image, px
};

struct DrawnFigure {
  const Figure* figure = nullptr;
  int number = 0;  ///< from 1, in report order
  std::string statement{}, finding{};
  std::string problem{};  ///< why it could not be made: "" when it could
  std::vector<DrawnPanel> panels{};
  std::vector<std::string> files{};
};

/// The figures that belong to the study's scenario: those of its key `figures`, else
/// every one of its model: then those that have nothing to draw are left out.
struct ChosenFigures {
  std::vector<const Figure*> figures;
  bool whole_model = false;
};
/// Throws dem::InputError when `only` is no figure of this model.
ChosenFigures chosen_figures(const StudyResult& study, const std::string& only);

/// The canvas of this process, made when first asked for: processes forked to draw must not inherit one.
using CanvasSource = std::function<render::Canvas&()>;

struct Drawings {
  std::vector<DrawnFigure> figures;
  std::string gl_renderer;  ///< "" when nothing was drawn
};

/// Draws them into options.folder, in options.workers processes, or in this one with the canvas. Same bytes either way.
Drawings draw_figures(const StudyResult& study, const ChosenFigures& chosen, const ReportOptions& options,
                      const CanvasSource& canvas);

/// The chart with no more than `points` points in all its curves: of each stretch of a curve the first, lowest, highest
/// and last point stay, so that no peak is lost. Unchanged when it has no more.
struct Sampled {
  render::Chart chart;
  std::size_t drawn = 0, all = 0;
};
Sampled sampled(render::Chart chart, std::size_t points);

/// A round length of 15 to 40 % of the picture's width.
ScaleBar scale_bar(const render::SceneResult& drawn);

}  // namespace reports
