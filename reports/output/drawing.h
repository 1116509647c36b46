#pragma once
// Figures of a study, drawn: contents made by the figures, pictures and data written as files.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "render/draw.h"
#include "reports/drawn.h"
#include "reports/options.h"

namespace reports {

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

/// Throws dem::EnvironmentError when this machine cannot draw (fonts, GL context): to be known before anything is simulated.
void check_drawing(const std::function<bool()>& stopped = [] { return false; });

}  // namespace reports
