// Bending of half discs: how they are loaded and crack, load against deflection and against the opening of the notch, and
// fracture toughness.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/analysis/fits.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

constexpr render::Colour steel{0.35, 0.38, 0.42};
constexpr int curves_height = 320, picture_width = 900;

/// A roller as its circle, `x` and the line where it touches (m), above (1) or below (-1) the specimen.
void add_roller(render::Scene& scene, double x, double z, double radius, double side) {
  render::Polyline line{{}, steel, 3, render::Line::solid, false};
  for (int i = 0; i <= 48; ++i) {
    const double angle = 2 * std::numbers::pi * i / 48;
    line.points.push_back({x + radius * std::cos(angle), 0, z + side * radius + radius * std::sin(angle)});
  }
  scene.lines.push_back(line);
}

// The picture holds the rollers too.
void widen(render::Scene& scene, const Size& size, double below, double above) {
  const double half = 0.5 * size.diameter, high = size.height + above;
  scene.camera.frame = {{{-half, -half, -below}, {half, half, high}}};
  scene.height = static_cast<int>(std::lround(scene.width * (below + high) / size.diameter));
}

void add_notch(render::Scene& scene, double depth) {
  if (depth > 0) scene.lines.push_back({{{0, 0, 0}, {0, 0, depth}}, {0, 0, 0}, 2.5, render::Line::solid, true});
}

render::Chart curves_of(const std::vector<SeriesCase>& cases, const CurveOf& of, const std::string& x_title) {
  render::Chart chart;
  chart.x.title = x_title;
  chart.left.title = "P/(2RB) (MPa)";
  chart.left.low = 0;
  add_curves(chart, cases, of);
  chart.legend = render::Chart::Legend::below;
  chart.height = curves_height;
  return chart;
}

analysis::Estimate mean_over(const SeriesCase& item, const dem::Quantity& quantity) {
  std::vector<double> values;
  for (const dem::Record* record : item.repeats) {
    const double value = quantity.factor * record->value_or_nan(quantity);
    if (std::isfinite(value)) values.push_back(value);
  }
  return analysis::mean_of(values);
}

std::string cell(const SeriesCase& item, const dem::Quantity& quantity) {
  const analysis::Estimate mean = mean_over(item, quantity);
  return std::isfinite(mean.value) ? estimate_text(mean, 3, true) : "–";
}

}  // namespace

FigureContent half_disc_test(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_half_disc)) content.panels.push_back(*missing);
  std::vector<SeriesCase> cases = series_of(of_mineral(study, ""), test_half_disc, parameter::aspect_ratio);
  if (cases.empty() || !study.scenario) return content;
  const double notch = study.scenario->real("semicircular_bending.notch"),
               span = study.scenario->real("semicircular_bending.span");
  TextTable table{{"Half disc", "Specimens", "K_Ic (MPa√m)", "Opening at the largest load (µm)"}, {}};
  for (SeriesCase& item : cases) {
    const Size size = size_of(*item.record);
    const double radius = size.height, roller = 0.1 * radius;  // semicircular_bending.cpp of the model
    Picture picture = section_cracks(study, *item.record, all_cracks, item.label, picture_width);
    add_roller(picture.scene, -span * radius, 0, roller, -1);
    add_roller(picture.scene, span * radius, 0, roller, -1);
    picture.scene.lines.push_back(
        {{{-0.3 * radius, 0, radius}, {0.3 * radius, 0, radius}}, steel, 3, render::Line::solid, false});
    add_notch(picture.scene, notch * radius);
    widen(picture.scene, size, 2.2 * roller, 0.05 * radius);
    content.panels.push_back({.id = "half_disc_" + item.id,
                              .caption = "The half disc on its rollers, with the cracks near the section at the end.",
                              .alt = "Cracks at the end: " + crack_words(crack_numbers(*item.record, all_cracks)) + ".",
                              .content = std::move(picture),
                              .per_row = 2});
    table.rows.push_back({item.label, std::to_string(item.repeats.size()), cell(item, quantity::fracture_toughness),
                          cell(item, quantity::mouth_opening)});
  }
  content.panels.push_back(
      {.id = "deflection",
       .caption = "Load, as the stress P/(2RB), against the approach of the rollers.",
       .alt = "Curves of load against deflection.",
       .content = curves_of(cases, {"platen_strain", "axial_stress", 100, 1e-6}, "Approach of the rollers (% of R)")});
  content.panels.push_back({.id = "opening",
                            .caption = "Load against the opening of the notch at the lower face.",
                            .alt = "Curves of load against opening.",
                            .content = curves_of(cases, {"opening", "axial_stress", 1e6, 1e-6}, "Opening (µm)")});
  content.panels.push_back({.id = "table",
                            .caption = "Means over specimens, with their 95 % intervals.",
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  const analysis::Estimate toughness = mean_over(cases.front(), quantity::fracture_toughness);
  if (std::isfinite(toughness.value)) {
    content.finding =
        fmt::format("K_Ic by the suggested method of Kuruppu et al. 2014 is {} MPa√m.", estimate_text(toughness, 3));
  }
  return content;
}

}  // namespace reports::texture
