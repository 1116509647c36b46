// Direct shear: stress and rise against displacement, and the line of Mohr and Coulomb through peaks and residuals.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/analysis/fits.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

constexpr int picture_width = 600;

std::vector<SeriesCase> blocks(const StudyResult& study) {
  return series_of(of_mineral(study, ""), test_shear, parameter::normal_stress);
}

constexpr const char* displacement = "Shear displacement (% of the edge)";

// A strength of every specimen against its normal stress, and the line through them.
struct Envelope {
  render::Series points;
  std::optional<analysis::LineFit> fit;
};

Envelope envelope(const std::vector<SeriesCase>& cases, const dem::Quantity& quantity, const std::string& label,
                  std::size_t look) {
  Envelope found{{.label = label,
                  .x = {},
                  .y = {},
                  .colour = render::palette(look),
                  .line = render::Line::none,
                  .marker = render::marker_style(look),
                  .y_error = {}},
                 {}};
  for (const SeriesCase& item : cases) {
    for (const dem::Record* record : item.repeats) {
      const double strength = record->value_or_nan(quantity);
      if (!std::isfinite(strength)) continue;
      found.points.x.push_back(item.value);
      found.points.y.push_back(strength);
    }
  }
  found.fit = analysis::fit_line(found.points.x, found.points.y);
  return found;
}

// The angle whose tangent a slope is, with its interval, in degrees.
analysis::Estimate angle_of(const analysis::Estimate& slope) {
  const auto degrees = [](double tangent) { return std::atan(tangent) * 180 / std::numbers::pi; };
  return {degrees(slope.value), degrees(slope.low), degrees(slope.high)};
}

}  // namespace

FigureContent direct_shear_test(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_shear)) content.panels.push_back(*missing);
  const auto cases = blocks(study);
  if (cases.empty()) return content;
  const std::string peaks = by_case(cases, quantity::shear_strength, 3);
  content.panels.push_back({.id = "stress",
                            .caption = "Shear stress against shear displacement.",
                            .alt = "Curves of shear stress; peaks of " + peaks + ".",
                            .content = load_curves(cases, {"platen_strain", "axial_stress", 100, 1e-6}, displacement,
                                                   "Shear stress τ (MPa)")});
  render::Chart rise =
      load_curves(cases, {"platen_strain", "opening", 100, 1e6}, displacement, "Rise of the upper half (µm)");
  rise.left.low.reset();  // it may settle at first
  content.panels.push_back(
      {.id = "rise",
       .caption = "Rise of the upper half above its place under the normal stress alone.",
       .alt = "Curves of the rise; at the peak " + by_case(cases, quantity::dilation_at_peak, 2) + ".",
       .content = std::move(rise)});
  for (const SeriesCase& item : cases) {
    content.panels.push_back(
        cracks_at_end(study, item, "Cracks near the middle section at the end of the test; the halves slide along x.",
                      picture_width));
    content.panels.back().per_row = 3;
  }
  content.finding = "The shear strength is " + peaks + " at " + listed(labels_of(cases)) + ".";
  return content;
}

FigureContent direct_shear_envelope(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_shear)) content.panels.push_back(*missing);
  const auto cases = blocks(study);
  if (cases.size() < 2) return content;
  render::Chart chart;
  chart.x.title = axis_title(parameter::normal_stress);
  chart.left.title = "Shear stress τ (MPa)";
  chart.left.low = 0;
  chart.x.low = 0;
  TextTable table{{"Strength", "Cohesion c (MPa)", "Friction angle φ (°)", "Tests"}, {}};
  std::vector<std::string> said;
  const auto add = [&](const dem::Quantity& quantity, const char* label, std::size_t look) {
    Envelope found = envelope(cases, quantity, label, look);
    if (found.points.x.empty()) return;
    const std::size_t n = found.points.x.size();
    chart.series.push_back(found.points);
    if (!found.fit) return;
    render::Series line = line_of(0, cases.back().value, [&](double x) { return found.fit->at(x); });
    line.colour = render::palette(look);
    line.line = render::line_style(look);
    chart.series.push_back(line);
    const analysis::Estimate angle = angle_of(found.fit->slope);
    table.rows.push_back(
        {label, estimate_text(found.fit->intercept, 3, true), estimate_text(angle, 3, true), std::to_string(n)});
    said.push_back(
        fmt::format("{}, c {} MPa and φ {}°", label, number(found.fit->intercept.value, 3), number(angle.value, 3)));
  };
  add(quantity::shear_strength, "peak", 0);
  add(quantity::residual_shear, "residual", 1);
  chart.legend = render::Chart::Legend::below;
  content.panels.push_back({.id = "envelope",
                            .caption = "Strengths against the normal stress, and the Mohr-Coulomb fits.",
                            .alt = "Mohr-Coulomb lines: " + joined(said, "; ") + ".",
                            .content = chart});
  content.panels.push_back({.id = "table",
                            .caption = "τ = c + σₙ tan φ by least squares over all specimens, with 95 % intervals.",
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  content.finding = "Mohr-Coulomb lines through the strengths: " + joined(said, "; ") + ".";
  return content;
}

}  // namespace reports::texture
