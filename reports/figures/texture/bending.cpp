// Bending of bars and of half discs: how they are loaded and crack, load against the opening of the notch and against
// deflection, modulus of rupture and fracture toughness.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "engine/analysis/fits.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

constexpr int picture_width = 900;
constexpr double least_diameter = 76e-3;  // m, of a half disc (Kuruppu et al. 2014), beside ten grains

// K_Ic of four granites along planes of several directions, MPa√m (Nasseri & Mohanty 2008, abstract). None is Lac du Bonnet's.
constexpr double least_toughness = 0.71, largest_toughness = 1.89;

/// Beside the published range. `toughness`: of one geometry each.
void compare_toughness(FigureContent& content, const std::vector<analysis::Estimate>& toughness) {
  content.statement = fmt::format(
      "Granite has a fracture toughness K_Ic of {:g} to {:g} MPa√m (four granites, none Lac du Bonnet’s, as notched "
      "discs).",
      least_toughness, largest_toughness);
  std::optional<Agreement> all;
  for (const analysis::Estimate& one : toughness) {
    if (!std::isfinite(one.value)) continue;
    const Agreement its = agreement_within(one, least_toughness, largest_toughness);
    if (!all || its == Agreement::disagrees || (its == Agreement::undecided && *all == Agreement::agrees)) all = its;
  }
  content.agreement = all;
}

/// What bends: where it bears, its notch, and the area that turns its stress into the load.
struct Bent {
  double half_span = 0, notch = 0;  ///< m
  double area = 0;                  ///< m^2
};

/// A notch is drawn as the slot that it stands for: white between dark edges, as no crack and no mineral is.
constexpr render::Colour notch_colour{1, 1, 1}, notch_edge{0.15, 0.15, 0.15};

/// `across`: of the picture, m.
void add_notch(render::Scene& scene, double depth, double across) {
  const auto add = [&](double nearer, const render::Colour& colour, double width) {
    scene.lines.push_back({{{0, nearer, 0}, {0, nearer, depth}}, colour, width, render::Line::solid, false});
  };
  add(-0.3 * across / scene.width, notch_edge, 5.5);  // a fraction of a pixel behind
  add(0, notch_colour, 3);
}

/// A strip that pushes, above (1) or below (-1) the body.
void add_strip(render::Scene& scene, double x, double z, double half, double side) {
  const double back = z + side * half;
  scene.lines.push_back(
      {{{x - half, 0, z}, {x + half, 0, z}, {x + half, 0, back}, {x - half, 0, back}, {x - half, 0, z}},
       steel,
       3,
       render::Line::solid,
       false});
}

// Where a strip meets the body, whose face is rough: the outermost particle over it.
double bed_of(const dem::Record& record, double x, double half, double side, double otherwise) {
  const dem::Table& particles = record.table("particles");
  const auto position = particles.real("position"), radius = particles.real("radius");
  double bed = otherwise;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const double face = position[3 * i + 2] + side * radius[i];
    if (std::abs(position[3 * i] - x) < half + radius[i] && side * (face - bed) > 0) bed = face;
  }
  return bed;
}

/// `notched`: some body of the figure has a notch, so that all pictures have one caption.
Panel cracks_panel(const StudyResult& study, const SeriesCase& item, const Bent& bent, const std::string& what,
                   bool notched) {
  const Size size = size_of(*item.record);
  const double strip = std::max(0.05 * size.height, 0.5 * mean_diameter(*item.record));  // bending.h of the model
  const auto load = [&](render::Scene& scene) {
    for (const auto& [x, face, side] : {std::tuple{-bent.half_span, 0.0, -1.0}, std::tuple{bent.half_span, 0.0, -1.0},
                                        std::tuple{0.0, size.height, 1.0}}) {
      add_strip(scene, x, bed_of(*item.record, x, strip, side, face), strip, side);
    }
    if (bent.notch > 0) add_notch(scene, bent.notch, size.diameter);
    // The picture holds the strips too.
    const double half = 0.5 * size.diameter, room = 1.5 * strip + 0.5 * mean_diameter(*item.record);
    scene.camera.frame = {{{-half, -half, -room}, {half, half, size.height + room}}};
    scene.height = static_cast<int>(std::lround(scene.width * (size.height + 2 * room) / size.diameter));
  };
  return cracks_at_end(study, item,
                       "The " + what +
                           " on its strips, cut along its middle plane, with the cracks near it at the "
                           "end of loading" +
                           first_seed({item}) + (notched ? "; the white slot is the notch." : "."),
                       picture_width, load);
}

constexpr const char* load_title = "Load P (kN)";

// `depth`: "the depth W".
void add_loads(FigureContent& content, const std::vector<SeriesCase>& cases, double area, const std::string& depth) {
  std::vector<SeriesCase> notched;
  for (const SeriesCase& item : cases) {
    if (item.record->table("history").has("opening")) notched.push_back(item);
  }
  if (!notched.empty()) {
    render::Chart chart =
        load_curves(notched, {"opening", "axial_stress", 1e6, 1e-3 * area}, "Opening of the notch (µm)", load_title);
    // The first load may close the notch by a hair.
    double least = 0, most = 0;
    for (const render::Series& one : chart.series) {
      for (const double x : one.x) least = std::min(least, x), most = std::max(most, x);
    }
    if (least > -0.02 * most) chart.x.low = 0;
    const bool one_of_some = notched.size() == 1 && cases.size() > 1;
    content.panels.push_back({.id = "opening",
                              .caption = "Load against the opening of the notch at the lower face" +
                                         (one_of_some ? ", " + notched.front().label : std::string()) +
                                         first_seed(notched) + ".",
                              .alt = "Curves of load against opening.",
                              .content = std::move(chart),
                              .per_row = 2});
  }
  content.panels.push_back(
      {.id = "deflection",
       .caption = "Load against the approach of the strips over " + depth + first_seed(cases) + ".",
       .alt = "Curves of load against deflection.",
       .content = load_curves(cases, {"platen_strain", "axial_stress", 100, 1e-3 * area},
                              "Approach (% of " + depth.substr(depth.rfind(' ') + 1) + ")", load_title),
       .per_row = 2});
}

analysis::Estimate mean_over(const SeriesCase& item, const dem::Quantity& quantity) {
  std::vector<double> values;
  for (const dem::Record* record : item.repeats) {
    const double value = quantity.factor * record->value_or_nan(quantity);
    if (std::isfinite(value)) values.push_back(value);
  }
  return analysis::mean_of(values);
}

// In a sentence: with its interval, where several specimens give one.
std::string said_of(const SeriesCase& item, const analysis::Estimate& mean, const std::string& unit) {
  return item.repeats.size() > 1 ? told(mean, 3, unit) : number(mean.value, 3) + " " + unit;
}

std::string cell(const SeriesCase& item, const dem::Quantity& quantity) {
  const analysis::Estimate mean = mean_over(item, quantity);
  return std::isfinite(mean.value) ? estimate_text(mean, 3, true) : "–";
}

Panel table_panel(const std::vector<SeriesCase>& cases, TextTable table) {
  std::size_t most = 0;
  for (const SeriesCase& item : cases) most = std::max(most, item.repeats.size());
  return {.id = "table",
          .caption = most < 2   ? "Of one specimen each."
                     : most < 3 ? "Means over specimens."
                                : "Means over specimens; 95 % confidence intervals in brackets, where there are three "
                                  "specimens or more.",
          .alt = "",
          .content = std::move(table),
          .per_row = 1};
}

}  // namespace

FigureContent bending_test(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_bending)) content.panels.push_back(*missing);
  std::vector<SeriesCase> cases = series_of(of_mineral(study, ""), test_bending, parameter::notch);
  if (cases.empty() || !study.scenario) return content;
  const double depth = study.scenario->real("bending.depth"), width = study.scenario->real("bending.width");
  const double area = (width > 0 ? width : 0.6 * depth) * depth / 6;  // 2bW²/(3S), S = 4W
  TextTable table{
      {"Bar", "Specimens", "Modulus of rupture (MPa)", "K_Ic (MPa√m)", "Notch opening at the largest load (µm)"}, {}};
  const bool notched = std::ranges::any_of(cases, [](const SeriesCase& item) { return item.value > 0; });
  std::vector<std::string> said;
  std::vector<analysis::Estimate> toughnesses;
  for (const SeriesCase& item : cases) {
    content.panels.push_back(cracks_panel(study, item, {2 * depth, item.value * depth, area}, "bar", notched));
    content.panels.back().per_row = std::min(2, static_cast<int>(cases.size()));
    table.rows.push_back({item.label, std::to_string(item.repeats.size()), cell(item, quantity::modulus_of_rupture),
                          cell(item, quantity::fracture_toughness), cell(item, quantity::mouth_opening)});
    const analysis::Estimate rupture = mean_over(item, quantity::modulus_of_rupture),
                             toughness = mean_over(item, quantity::fracture_toughness);
    toughnesses.push_back(toughness);
    if (std::isfinite(rupture.value))
      said.push_back("the modulus of rupture is " + said_of(item, rupture, "MPa") + " without a notch");
    if (std::isfinite(toughness.value))
      said.push_back("with a " + item.label + ", K_Ic by ASTM E399 is " + said_of(item, toughness, "MPa√m"));
  }
  if (notched) compare_toughness(content, toughnesses);
  add_loads(content, cases, area, "the depth W");
  content.panels.push_back(table_panel(cases, std::move(table)));
  if (!said.empty())
    content.finding = "In three-point bending over a span of four depths W, " + joined(said, "; ") + ".";
  return content;
}

FigureContent half_disc_test(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_half_disc)) content.panels.push_back(*missing);
  std::vector<SeriesCase> cases = series_of(of_mineral(study, ""), test_half_disc, parameter::aspect_ratio);
  if (cases.empty() || !study.scenario) return content;
  const double diameter = study.scenario->real("semicircular_bending.diameter"),
               thickness = study.scenario->real("semicircular_bending.thickness"),
               span = study.scenario->real("semicircular_bending.span") * diameter,
               notch = study.scenario->real("semicircular_bending.notch") * diameter / 2;
  const double area = diameter * (thickness > 0 ? thickness : 0.4 * diameter);
  TextTable table{{"Half disc", "Specimens", "K_Ic (MPa√m)", "Notch opening at the largest load (µm)"}, {}};
  if (cases.size() == 1) cases.front().label = "notch of " + shortest(notch / (diameter / 2)) + " R";
  for (const SeriesCase& item : cases) {
    content.panels.push_back(cracks_panel(study, item, {span / 2, notch, area}, "half disc", true));
    content.panels.back().per_row = std::min(2, static_cast<int>(cases.size()));
    table.rows.push_back({item.label, std::to_string(item.repeats.size()), cell(item, quantity::fracture_toughness),
                          cell(item, quantity::mouth_opening)});
  }
  add_loads(content, cases, area, "the radius R");
  content.panels.push_back(table_panel(cases, std::move(table)));
  const analysis::Estimate toughness = mean_over(cases.front(), quantity::fracture_toughness);
  compare_toughness(content, {toughness});
  if (std::isfinite(toughness.value)) {
    content.finding = fmt::format("K_Ic by the ISRM suggested method (Kuruppu et al. 2014) is {}.",
                                  said_of(cases.front(), toughness, "MPa√m"));
    if (diameter < least_diameter) {
      content.finding += fmt::format(
          " The half disc has a diameter of {} mm; the method requires {:g} mm or more, so this is the K_Ic of an "
          "undersized specimen.",
          shortest(1e3 * diameter), 1e3 * least_diameter);
    }
  }
  return content;
}

}  // namespace reports::texture
