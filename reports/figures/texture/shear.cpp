// Direct shear: stress and rise against displacement, and the Mohr-Coulomb fits of the peaks and of what is left after them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// Whether an interval says something of a cohesion or of a slope: few tests leave even the sign open.
bool is_useful(const analysis::LineFit& fit) {
  return fit.slope.has_interval() && fit.intercept.low > 0 && fit.slope.low > 0;
}

std::string with_interval(const analysis::Estimate& estimate, std::string_view unit, bool useful) {
  const std::string value = number(estimate.value, 3) + (unit == "°" ? "" : " ") + std::string(unit);
  if (!useful) return value;
  return fmt::format("{} (95 % interval {} to {})", value, number(estimate.low, 3), number(estimate.high, 3));
}

/// "three", for the beginning of sentences in small letters.
std::string in_letters(std::size_t n) {
  constexpr std::array<std::string_view, 10> small{"no",   "one", "two",   "three", "four",
                                                   "five", "six", "seven", "eight", "nine"};
  return n < small.size() ? std::string(small[n]) : std::to_string(n);
}

// Where the strength after the peak was read: over the last fifth of the shear displacement (quantity::residual_shear). Tests
// go to the same displacement, but for one that has not failed by then.
struct ResidualPlace {
  double from = 0, to = 0;  ///< % of the edge
  double rise = 0;          ///< of the upper half in between, µm
  bool dilates = false;     ///< the upper half still rises: no residual strength yet
};

ResidualPlace place_of_residual(const dem::Record& record) {
  const dem::Table& history = record.table("history");
  const auto strain = history.real("platen_strain"), opening = history.real("opening");
  const double from = 0.8 * strain.back();
  const auto first =
      static_cast<std::size_t>(std::ranges::find_if(strain, [&](double at) { return at >= from; }) - strain.begin());
  constexpr double constant_volume = 0.02;  // rise over displacement: below it the volume counts as constant
  const double rise = opening.back() - opening[first], sheared = (strain.back() - from) * size_of(record).height;
  return {100 * from, 100 * strain.back(), 1e6 * rise, rise > constant_volume * sheared};
}

/// Whether any of the blocks still dilates where its strength after the peak is read.
bool any_dilates(const std::vector<SeriesCase>& cases) {
  return std::ranges::any_of(cases, [](const SeriesCase& item) {
    return std::ranges::any_of(item.repeats, [](const dem::Record* record) {
      return record->has(quantity::residual_shear) && place_of_residual(*record).dilates;
    });
  });
}

/// What the strength after the peak is called.
std::string after_peak(const std::vector<SeriesCase>& cases) {
  return any_dilates(cases) ? "after the peak, still dilating" : "residual";
}

// Both strengths of each case with their places; a case that was not sheared to the end has no second one.
TextTable strengths_table(const std::vector<SeriesCase>& cases) {
  // Units are not broken from their line.
  constexpr const char* unit = "(%\u00a0of\u00a0the\u00a0edge)";
  TextTable table{{"Case", "Peak (MPa)", fmt::format("Displacement at the peak {}", unit),
                   any_dilates(cases) ? "After the peak (MPa)" : "Residual (MPa)",
                   fmt::format("Read at a displacement {}", unit), "Rise over that stretch (µm)"},
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

/// An arrow in the plane of the section, from a place along x or z.
void add_arrow(render::Scene& scene, double x, double z, double along_x, double along_z) {
  const double tip_x = x + along_x, tip_z = z + along_z, back = 0.4, side = 0.25;
  const auto barb = [&](double turn) {
    return render::Point{tip_x - back * along_x + turn * side * along_z, 0,
                         tip_z - back * along_z + turn * side * along_x};
  };
  const render::Point tip{tip_x, 0, tip_z};
  scene.lines.push_back({{{x, 0, z}, tip}, steel, 3, render::Line::solid, false});
  scene.lines.push_back({{barb(1), tip, barb(-1)}, steel, 3, render::Line::solid, false});
}

// The two halves of the box on the block, with the gap between them, and arrows for what they do; the picture holds them too.
void add_box(render::Scene& scene, const dem::Record& record, double gap) {
  const Size size = size_of(record);
  const double room = 0.18 * size.height, middle = size.z_low + 0.5 * size.height;
  // Particles of the surface reach a little beyond the nominal faces; the box is on them.
  const dem::Table& particles = record.table("particles");
  const auto position = particles.real("position"), radius = particles.real("radius");
  double half = 0.5 * size.diameter, tall = 0.5 * size.height;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    half = std::max(half, std::abs(position[3 * i]) + radius[i]);
    tall = std::max(tall, std::abs(position[3 * i + 2] - middle) + radius[i]);
  }
  for (const double side : {-1.0, 1.0}) {
    const double edge = middle + side * 0.5 * gap * size.height, end = middle + side * tall;
    scene.lines.push_back(
        {{{-half, 0, edge}, {-half, 0, end}, {half, 0, end}, {half, 0, edge}}, steel, 3, render::Line::solid, false});
    add_arrow(scene, side * (half + 0.15 * room), 0.5 * (edge + end), side * 0.75 * room, 0);  // upper half along x
    add_arrow(scene, 0, end + side * 0.9 * room, 0, -side * 0.75 * room);                      // normal stress
  }
  scene.camera.frame = {{{-half - room, -half, middle - tall - room}, {half + room, half, middle + tall + room}}};
  scene.height = static_cast<int>(std::lround(scene.width * (tall + room) / (half + room)));
}

// "The strength after the peak is the mean over the last fifth of each test, ..."
std::string residual_words(const std::vector<SeriesCase>& cases) {
  std::vector<std::string> places, rises;
  for (const SeriesCase& item : cases) {
    if (!item.record->has(quantity::residual_shear)) continue;
    const ResidualPlace place = place_of_residual(*item.record);
    places.push_back(number(place.from, 2) + " to " + number(place.to, 2));
    rises.push_back(number(place.rise, 2));
  }
  if (places.empty()) return {};
  if (std::ranges::all_of(places, [&](const std::string& place) { return place == places.front(); })) places.resize(1);
  const bool all = std::ranges::all_of(cases, [](const SeriesCase& item) {
    return !item.record->has(quantity::residual_shear) || place_of_residual(*item.record).dilates;
  });
  return " The strength after the peak is the mean over the last fifth of each test, at displacements of " +
         listed(places) + " % of the edge" + first_seed(cases) + "; over that stretch the upper half " +
         (all ? "rises by another " + listed(rises) +
                    " µm, so none has reached constant volume, and the fit after the peak is not one "
                    "of residual strengths."
          : any_dilates(cases) ? "moves by " + listed(rises) +
                                     " µm: not all have reached constant volume, and the fit after the peak is not one "
                                     "of residual strengths."
                               : "moves by " + listed(rises) + " µm: all have reached constant volume.");
}

}  // namespace

FigureContent direct_shear_test(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_shear)) content.panels.push_back(*missing);
  const auto cases = blocks(study);
  if (cases.empty()) return content;
  const std::string peaks = by_case(cases, quantity::shear_strength, 3);
  const CurveOf stress{"platen_strain", "axial_stress", 100, 1e-6}, opening{"platen_strain", "opening", 100, 1e6};
  render::Chart shear = load_curves(cases, stress, displacement, "Shear stress τ (MPa)");
  const bool followed = mark_end_of_loading(shear, cases, stress);
  content.panels.push_back(
      {.id = "stress",
       .caption = "Shear stress against shear displacement" + first_seed(cases) + "." +
                  (followed ? " Crosses: the end of loading; cracks and energies are those of that "
                              "moment."
                            : ""),
       .alt = "Curves of shear stress; peaks of " + peaks + ".",
       .content = std::move(shear)});
  render::Chart rise = load_curves(cases, opening, displacement, "Rise of the upper half (µm)");
  rise.left.low.reset();  // it may settle at first
  double lowest = 0, highest = 0;
  for (const render::Series& one : rise.series) {
    for (const double y : one.y) lowest = std::min(lowest, y), highest = std::max(highest, y);
  }
  if (lowest > -0.02 * highest) rise.left.low = 0;
  mark_end_of_loading(rise, cases, opening);
  content.panels.push_back(
      {.id = "rise",
       .caption = "Rise of the upper half from its position under the normal stress alone" + first_seed(cases) + ".",
       .alt = "Curves of the rise; at the peak " + by_case(cases, quantity::dilation_at_peak, 2) + ".",
       .content = std::move(rise)});
  for (const SeriesCase& item : cases) {
    content.panels.push_back(cracks_at_end(
        study, item,
        "Cracks near the middle section at the end of loading, where they formed in the block, with the two halves of "
        "the box, which touches the outermost particles; these reach beyond the nominal faces. Vertical arrows: normal "
        "stress; horizontal arrows: motion of the two halves along x" +
            first_seed(cases) + ".",
        picture_width,
        [&](render::Scene& scene) { add_box(scene, *item.record, study.scenario->real("direct_shear.gap")); }));
    content.panels.back().per_row = 3;
  }
  std::vector<std::string> stresses;
  for (const SeriesCase& item : cases) stresses.push_back(shortest(item.value));
  content.finding = "The peak shear strength is " + peaks + " at σₙ of " + listed(stresses) + " MPa.";
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
  TextTable table{{"Strength", "Cohesion c (MPa)", "Friction angle φ (°)", "Specimens"}, {}};
  std::vector<std::string> said;
  std::size_t tests = 0;
  bool useful = true;
  const auto add = [&](const dem::Quantity& quantity, const std::string& label, std::size_t look) {
    Envelope found = envelope(cases, quantity, label, look);
    if (found.points.x.empty()) return;
    const std::size_t n = found.points.x.size();
    chart.series.push_back(found.points);
    if (!found.fit) return;
    render::Series line = line_of(0, cases.back().value, [&](double x) { return found.fit->at(x); });
    line.colour = render::palette(look);
    line.line = render::line_style(look);
    line.label = look == 0 ? "fit of the peaks" : "fit after the peak";
    chart.series.push_back(line);
    const analysis::Estimate angle = angle_of(found.fit->slope);
    table.rows.push_back(
        {label, estimate_text(found.fit->intercept, 3, true), estimate_text(angle, 3, true), std::to_string(n)});
    const bool own = is_useful(*found.fit);
    useful = useful && own;
    tests = std::max(tests, n);
    said.push_back(fmt::format("{}, c = {} and φ = {}", label, with_interval(found.fit->intercept, "MPa", own),
                               with_interval(angle, "°", own)));
  };
  add(quantity::shear_strength, "peak", 0);
  add(quantity::residual_shear, after_peak(cases), 1);
  chart.legend = render::Chart::Legend::below;
  content.panels.push_back({.id = "envelope",
                            .caption = "Strengths against the normal stress, and the Mohr–Coulomb fits.",
                            .alt = "Mohr–Coulomb fits: " + joined(said, "; ") + ".",
                            .content = chart});
  content.panels.push_back({.id = "table",
                            .caption = std::string("τ = c + σₙ tan φ by least squares over all specimens") +
                                       (tests > 2 ? ", with 95 % intervals." : "."),
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  content.panels.push_back(
      {.id = "strengths",
       .caption = "Strengths and where they were read" + first_seed(cases) +
                  ". The strength after the peak is the mean over the last fifth of each test, which goes on to a "
                  "displacement of " +
                  percent(study.scenario->real("direct_shear.displacement"), 1) + " of the edge.",
       .alt = "",
       .content = strengths_table(cases),
       .per_row = 1});
  if (said.empty()) return content;
  content.headline = "Mohr–Coulomb fits: " + joined(said, "; ") + "." +
                     (useful ? "" : " " + capital(in_letters(tests)) + " tests give no useful interval.");
  content.finding = content.headline + residual_words(cases);
  return content;
}

}  // namespace reports::texture
