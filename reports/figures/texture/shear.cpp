// Direct shear: stress and rise against displacement, and the line of Mohr and Coulomb through peaks and residuals.
#include <fmt/format.h>

#include <algorithm>
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

// With its interval: that zero lies inside it says nothing here.
std::string amount(const analysis::Estimate& estimate, std::string_view unit) {
  const std::string value = number(estimate.value, 3) + (unit == "°" ? "" : " ") + std::string(unit);
  if (!estimate.has_interval()) return value + " (no interval from so few points)";
  return fmt::format("{} (95 % interval {} to {})", value, number(estimate.low, 3), number(estimate.high, 3));
}

// Where a residual was read: over the last fifth of the shear displacement (quantity::residual_shear). Tests go to a multiple
// of the displacement of their peak, so that each has another place.
struct ResidualPlace {
  double from = 0, to = 0;  ///< % of the edge
  double rise = 0;          ///< of the upper half in between, µm
};

ResidualPlace place_of_residual(const dem::Record& record) {
  const dem::Table& history = record.table("history");
  const auto strain = history.real("platen_strain"), opening = history.real("opening");
  const double from = 0.8 * strain.back();
  const auto first =
      static_cast<std::size_t>(std::ranges::find_if(strain, [&](double at) { return at >= from; }) - strain.begin());
  return {100 * from, 100 * strain.back(), 1e6 * (opening.back() - opening[first])};
}

// Peak and residual of each case with their places; a case that was not sheared to the end has no residual.
TextTable strengths_table(const std::vector<SeriesCase>& cases) {
  TextTable table{{"Case", "Peak (MPa)", "Displacement at the peak (% of the edge)", "Residual (MPa)",
                   "Displacement at the residual (% of the edge)", "Rise over that stretch (µm)"},
                  {}};
  for (const SeriesCase& item : cases) {
    const dem::Record& record = *item.record;
    const render::Series stress = curve(record.table("history"), {"platen_strain", "axial_stress", 100, 1e-6});
    if (stress.y.empty()) continue;
    const auto peak = static_cast<std::size_t>(std::ranges::max_element(stress.y) - stress.y.begin());
    std::vector<std::string> row{item.label, number(stress.y[peak], 3), number(stress.x[peak], 2), "–", "–", "–"};
    if (record.has(quantity::residual_shear)) {
      const ResidualPlace place = place_of_residual(record);
      row[3] = number(record.value(quantity::residual_shear), 3);
      row[4] = number(place.from, 2) + " to " + number(place.to, 2);
      row[5] = number(place.rise, 2);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// The two halves of the box round the block, with the gap between them; the picture holds them too.
void add_box(render::Scene& scene, const dem::Record& record, double gap) {
  const Size size = size_of(record);
  const double half = 0.5 * size.diameter, room = mean_diameter(record), beside = half + 0.6 * room;
  const double middle = size.z_low + 0.5 * size.height;
  for (const double side : {-1.0, 1.0}) {
    const double edge = middle + side * 0.5 * gap * size.height, end = middle + side * (0.5 * size.height + 0.6 * room);
    scene.lines.push_back({{{-beside, 0, edge}, {-beside, 0, end}, {beside, 0, end}, {beside, 0, edge}},
                           steel,
                           3,
                           render::Line::solid,
                           false});
  }
  scene.camera.frame = {
      {{-half - room, -half, size.z_low - room}, {half + room, half, size.z_low + size.height + room}}};
  scene.height = static_cast<int>(std::lround(scene.width * (size.height + 2 * room) / (size.diameter + 2 * room)));
}

// "Each residual is the mean over the last fifth of its test, ..."
std::string residual_words(const std::vector<SeriesCase>& cases) {
  std::vector<std::string> places, rises;
  double least = 1e300;
  for (const SeriesCase& item : cases) {
    if (!item.record->has(quantity::residual_shear)) continue;
    const ResidualPlace place = place_of_residual(*item.record);
    places.push_back(number(place.from, 2) + " to " + number(place.to, 2));
    rises.push_back(number(place.rise, 2));
    least = std::min(least, place.rise);
  }
  if (places.empty()) return {};
  return " Each residual is the mean over the last fifth of its test, at displacements of " + listed(places) +
         " % of the edge; over that stretch the upper half " +
         (least > 0 ? "rises by another " + listed(rises) + " µm, so that none is at constant volume yet."
                    : "moves by " + listed(rises) + " µm.");
}

}  // namespace

FigureContent direct_shear_test(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_shear)) content.panels.push_back(*missing);
  const auto cases = blocks(study);
  if (cases.empty()) return content;
  const std::string peaks = by_case(cases, quantity::shear_strength, 3);
  content.panels.push_back({.id = "stress",
                            .caption = "Shear stress against shear displacement" + first_seed(cases) + ".",
                            .alt = "Curves of shear stress; peaks of " + peaks + ".",
                            .content = load_curves(cases, {"platen_strain", "axial_stress", 100, 1e-6}, displacement,
                                                   "Shear stress τ (MPa)")});
  render::Chart rise =
      load_curves(cases, {"platen_strain", "opening", 100, 1e6}, displacement, "Rise of the upper half (µm)");
  rise.left.low.reset();  // it may settle at first
  content.panels.push_back(
      {.id = "rise",
       .caption = "Rise of the upper half above its place under the normal stress alone" + first_seed(cases) + ".",
       .alt = "Curves of the rise; at the peak " + by_case(cases, quantity::dilation_at_peak, 2) + ".",
       .content = std::move(rise)});
  for (const SeriesCase& item : cases) {
    content.panels.push_back(cracks_at_end(
        study, item,
        "Cracks near the middle section at the end of loading, between the two halves of the box, which slide along x" +
            first_seed(cases) + ".",
        picture_width,
        [&](render::Scene& scene) { add_box(scene, *item.record, study.scenario->real("direct_shear.gap")); }));
    content.panels.back().per_row = 3;
  }
  std::vector<std::string> stresses;
  for (const SeriesCase& item : cases) stresses.push_back(shortest(item.value));
  content.finding = "The shear strength is " + peaks + " at σₙ of " + listed(stresses) + " MPa.";
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
    said.push_back(fmt::format("{}, c {} and φ {}", label, amount(found.fit->intercept, "MPa"), amount(angle, "°")));
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
  content.panels.push_back({.id = "strengths",
                            .caption = "Strengths and where they were read" + first_seed(cases) +
                                       ". The residual is the mean over the last fifth of each test, which ends at " +
                                       shortest(study.scenario->real("direct_shear.follow")) +
                                       " times the displacement of its peak.",
                            .alt = "",
                            .content = strengths_table(cases),
                            .per_row = 1});
  content.finding = "Mohr-Coulomb lines through the strengths: " + joined(said, "; ") + "." + residual_words(cases);
  return content;
}

}  // namespace reports::texture
