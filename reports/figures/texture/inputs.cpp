// What a specimen is made of and how it is tested: the turn of its ellipsoids (Zhao et al. 2021, Fig. 4), the tests
// (Fig. 7), the input parameters (Tables 1, 2 and 4), and what the texture owes to the seed and the aspect ratio
// (section 5, Eq. 14).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

constexpr int narrow = 320;                           // px, of pictures beside each other
const render::Colour platen{0.05, 0.52, 0.58};        // as no mineral is
const render::Colour frame_colour{0.24, 0.24, 0.24};  // axes of the specimen
const render::Colour seed_colour{0.30, 0.76, 0.82};

render::Point turned(const render::Point& p, double dip_direction, double dip) {
  // R_z(dip direction) R_y(-dip): the long axis x goes to (cos dip cos dd, cos dip sin dd, sin dip).
  const double c = std::cos(dip), s = std::sin(dip), cd = std::cos(dip_direction), sd = std::sin(dip_direction);
  const double x = c * p[0] - s * p[2], z = s * p[0] + c * p[2];
  return {cd * x - sd * p[1], sd * x + cd * p[1], z};
}

// Principal ellipses and axes of an ellipsoid of radius 1 and aspect ratio `ar`, turned and moved.
render::Scene ellipsoid_scene(double ar, double dip_direction, double dip, const render::Point& centre) {
  const double lambda = std::cbrt(ar), a = lambda * lambda, b = 1 / lambda;
  const auto place = [&](const render::Point& p) {
    const render::Point t = turned(p, dip_direction, dip);
    return render::Point{t[0] + centre[0], t[1] + centre[1], t[2] + centre[2]};
  };
  render::Scene scene;
  const render::Colour shell{0.45, 0.55, 0.65};
  const auto ellipse = [&](auto at, const render::Colour& colour, double width) {
    render::Polyline line{{}, colour, width};
    for (int k = 0; k <= 96; ++k) line.points.push_back(place(at(2 * std::numbers::pi * k / 96)));
    scene.lines.push_back(std::move(line));
  };
  for (const double h : {-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75}) {  // circles of latitude about the long axis
    const double r = b * std::sqrt(1 - h * h);
    ellipse(
        [&](double t) {
          return render::Point{a * h, r * std::cos(t), r * std::sin(t)};
        },
        shell, h == 0 ? 1.6 : 0.8);
  }
  for (int k = 0; k < 6; ++k) {  // meridians
    const double angle = std::numbers::pi * k / 6;
    ellipse(
        [&](double t) {
          return render::Point{a * std::cos(t), b * std::sin(t) * std::cos(angle), b * std::sin(t) * std::sin(angle)};
        },
        shell, k % 3 == 0 ? 1.6 : 0.8);
  }
  const auto axis = [&](const render::Point& end, const render::Colour& colour, bool own) {
    const render::Point from = own ? place({-end[0], -end[1], -end[2]}) : render::Point{0, 0, 0};
    scene.lines.push_back(
        {{from, own ? place(end) : end}, colour, own ? 2.2 : 1.4, own ? render::Line::dash : render::Line::solid});
  };
  axis({a, 0, 0}, {0.75, 0.05, 0.05}, true);
  axis({0, b, 0}, {0.74, 0.52, 0.0}, true);
  axis({0, 0, b}, {0.74, 0.52, 0.0}, true);
  const double reach = 2.1;
  for (const render::Point& end : {render::Point{reach, 0, 0}, {0, reach, 0}, {0, 0, reach}})
    axis(end, frame_colour, false);
  scene.axes = true;
  scene.camera.direction = {-0.32, 0.87,
                            -0.37};  // across the long axis, along x as well as turned by a few tens of degrees
  scene.camera.frame = {{{-1.3, -1.3, -1.1}, {1.6, 1.6, 1.7}}};
  scene.width = 400;
  scene.height = 360;
  return scene;
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

// A solid cylinder as a stack of discs.
render::Discs cylinder(double radius, double low, double high, const render::Colour& colour) {
  render::Discs discs;
  constexpr int layers = 40;
  for (int k = 0; k <= layers; ++k) {
    discs.centre.push_back({0, 0, low + (high - low) * k / layers});
    discs.normal.push_back({0, 0, 1});
    discs.radius.push_back(radius);
    discs.colour.push_back(colour);
  }
  return discs;
}

render::Scene setup_scene(const StudyResult& study, const dem::Record& record, bool section) {
  render::Scene scene = section ? section_scene(study, record, narrow) : specimen_scene(study, record, narrow);
  const Size size = size_of(record);
  const double half = 0.72 * size.diameter, margin = 0.16 * size.height;
  scene.camera.frame = {{{-half, -half, size.z_low - margin}, {half, half, size.z_low + size.height + margin}}};
  if (!section) scene.camera.direction = {0, -0.97, -0.24};
  return scene;
}

/// Specimens alike in all but their seed.
struct Group {
  std::string label;
  std::vector<const dem::Record*> records;
};
std::vector<Group> groups_of(const StudyResult& study) {
  std::vector<Group> groups;
  for (const CaseResult& one : study.cases) {
    if (!one.record || one.record->text("test") != test_genesis) continue;
    const dem::Record& r = *one.record;
    std::string label = "AR " + shortest(r.number("aspect_ratio"));
    if (r.number("dip") != 0) label += ", dip " + shortest(r.number("dip")) + "°";
    const std::string reading = reading_of(r, study);
    if (!reading.empty()) label += ", " + reading;
    const auto found = std::ranges::find(groups, label, &Group::label);
    if (found == groups.end())
      groups.push_back({label, {&r}});
    else
      found->records.push_back(&r);
  }
  return groups;
}

std::string spread_text(const Group& group, const dem::Quantity& of, int places) {
  std::vector<double> values;
  for (const dem::Record* r : group.records) values.push_back(of.factor * r->value_or_nan(of));
  const Spread spread = analysis::spread(values);
  const bool same = spread.count < 2 || spread.deviation == 0;
  if (same && std::floor(spread.mean) == spread.mean) return count(spread.mean);
  return fixed(spread.mean, places) + (same ? "" : " ± " + fixed(spread.deviation, places));
}

// Surface of an ellipsoid of revolution over that of the sphere of its volume; and what Eq. 14 gives for it.
double exact_surface(double ar) {
  if (ar < 1 + 1e-9) return 1;
  const double lambda = std::cbrt(ar), a = lambda * lambda, b = 1 / lambda, e = std::sqrt(1 - b * b / (a * a));
  return 0.5 * b * b * (1 + a / (b * e) * std::asin(e));
}
double published_surface(double ar) {
  const double lambda = std::cbrt(ar);
  return 2.0 / 3 * lambda + 1.0 / 3 / (lambda * lambda);
}

}  // namespace

FigureContent ellipsoid_turns(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "An ellipsoid is rotated about z by the dip direction and about y by the dip, and translated to its seed (Fig. "
      "4).";
  const dem::Record* record = first_specimen(study);
  if (!record || !study.scenario) return content;
  double dip = study.scenario->real("texture.dip"), direction = study.scenario->real("texture.dip_direction");
  const bool example = dip == 0 && direction == 0;
  if (example) dip = 35 * std::numbers::pi / 180, direction = 40 * std::numbers::pi / 180;
  constexpr double ar = 2;
  const std::vector<LegendEntry> legend{{{0.75, 0.05, 0.05}, "long axis, 2a"},
                                        {{0.74, 0.52, 0.0}, "short axes, 2b = 2c"},
                                        {frame_colour, "axes of the specimen"},
                                        {seed_colour, "place of the seed"}};
  const render::Point seed{0.6, 0.4, 0.7};
  const auto add = [&](const char* id, const std::string& caption, double dd, double d, const render::Point& centre) {
    render::Scene scene = ellipsoid_scene(ar, dd, d, centre);
    scene.spheres.push_back({.centre = {seed}, .radius = {0.12}, .colour = {seed_colour}});
    content.panels.push_back(
        {.id = id,
         .caption = caption,
         .alt = caption,
         .content = Picture{.scene = std::move(scene), .label = "", .legend = legend, .scale_bar = false},
         .per_row = 4});
  };
  const std::string about_z = shortest(degrees(direction)) + "°", about_y = shortest(degrees(dip)) + "°";
  add("made", "Along x.", 0, 0, {0, 0, 0});
  add("dip_direction", "Rotated about z by " + about_z + ".", direction, 0, {0, 0, 0});
  add("dip", "Rotated by the dip of " + about_y + ".", direction, dip, {0, 0, 0});
  add("moved", "Translated to the seed.", direction, dip, seed);
  // The same turn as the genesis makes it.
  const auto axis = record->table("grains").real("axis");
  const render::Point ours =
      turned({1, 0, 0}, study.scenario->real("texture.dip_direction"), study.scenario->real("texture.dip"));
  double apart = 0;
  for (std::size_t i = 0; i < 3 && axis.size() >= 3; ++i) apart = std::max(apart, std::abs(axis[i] - ours[i]));
  content.agreement = apart < 1e-12 ? Agreement::agrees : Agreement::disagrees;
  content.finding = fmt::format(
      "{}The long axes of the specimen’s grains point where this rotation puts them{}. Eq. 4 as printed differs from "
      "it unless the dip direction is 0°.",
      example ? "The angles drawn are an example, with aspect ratio 2. " : "",
      apart < 1e-12 ? "" : ", but for " + number(apart, 2) + " of a unit vector");
  return content;
}

FigureContent test_setups(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Models of compression and of direct tension; in tension the discs at both ends, 2.5 mm thick in a specimen of "
      "50 mm, keep their contacts.";
  const dem::Record* record = first_specimen(study);
  if (!record || !study.scenario) return content;
  const Size size = size_of(*record);
  const double thickness = 0.04 * size.height, radius = 0.62 * size.diameter;
  const double grip = study.scenario->real("direct_tension.grip") * size.height;
  render::Scene pressed = setup_scene(study, *record, false);
  pressed.discs.push_back(cylinder(radius, size.z_low - thickness, size.z_low, platen));
  pressed.discs.push_back(cylinder(radius, size.z_low + size.height, size.z_low + size.height + thickness, platen));
  std::vector<LegendEntry> with_platens = mineral_legend(study, *record), with_grips = with_platens;
  with_platens.push_back({platen, "platens"});
  content.panels.push_back(
      {.id = "compression",
       .caption = "Between two platens.",
       .alt = "The specimen between two platens.",
       .content = Picture{.scene = std::move(pressed), .label = "compression", .legend = with_platens},
       .per_row = 4});
  render::Scene pulled = setup_scene(study, *record, false);
  std::size_t gripped = 0;
  for (std::size_t i = 0; i < pulled.spheres[0].centre.size(); ++i) {
    const double z = pulled.spheres[0].centre[i][2] - size.z_low;
    if (z > grip && z < size.height - grip) continue;
    pulled.spheres[0].colour[i] = platen;
    ++gripped;
  }
  with_grips.push_back({platen, "gripped discs"});
  content.panels.push_back(
      {.id = "direct_tension",
       .caption = "By gripped ends.",
       .alt = fmt::format("Discs of {:.2f} mm at both ends, {} particles, are gripped.", 1e3 * grip, gripped),
       .content = Picture{.scene = std::move(pulled), .label = "direct tension", .legend = with_grips},
       .per_row = 4});
  content.panels.push_back({.id = "section",
                            .caption = "Cut along its axis.",
                            .alt = "The specimen cut along its axis.",
                            .content = Picture{.scene = setup_scene(study, *record, true),
                                               .label = "section",
                                               .legend = mineral_legend(study, *record)},
                            .per_row = 4});
  constexpr double published_grip = 2.5 / 50;  // of the height
  content.agreement = std::abs(grip / size.height - published_grip) < 1e-9 ? Agreement::agrees : Agreement::disagrees;
  content.finding =
      fmt::format("The specimen is {:g} mm × {:g} mm; the gripped discs are {:g} mm thick and hold {} particles.",
                  1e3 * size.diameter, 1e3 * size.height, 1e3 * grip, count(static_cast<double>(gripped)));
  return content;
}

FigureContent input_parameters(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Four groups of parameters: grain seeds, sub-grains, materials and their interaction (Table 1). The density of "
      "the granite is 2640 kg/m³ (Table 2).";
  if (!study.scenario) return content;
  const dem::Scenario& s = *study.scenario;
  const std::size_t minerals = s.count("mineral");
  const auto mineral = [&](std::size_t m, const char* name) { return s.real(fmt::format("mineral[{}].{}", m, name)); };
  TextTable common{{"Group", "Parameter", "Symbol", "Value"}, {}};
  const auto row = [&](const char* group, const char* name, const char* symbol, const std::string& value) {
    common.rows.push_back({group, name, symbol, value});
  };
  std::vector<std::string> aspect;
  for (const SeriesCase& item : swept(study, test_genesis))
    aspect.push_back(shortest(item.record->number("aspect_ratio")));
  row("grain seeds", "number of minerals", "Nₘ", std::to_string(minerals));
  row("grain seeds", "factor on their diameters", "", shortest(s.real("texture.seed_scale")));
  row("grain seeds", "aspect ratios of grains", "AR = λ³",
      aspect.empty() ? shortest(s.real("texture.aspect_ratio")) : joined(aspect, ", "));
  row("grain seeds", "dip direction", "θ_z", shortest(degrees(s.real("texture.dip_direction"))) + "°");
  row("grain seeds", "dip", "θ_y", shortest(degrees(s.real("texture.dip"))) + "°");
  row("sub-grains", "smallest radius", "R_min", shortest(1e3 * s.real("packing.minimum_radius")) + " mm");
  row("sub-grains", "largest over smallest radius", "R_max/R_min", shortest(s.real("packing.radius_ratio")));
  row("sub-grains", "modulus while packing", "E*", shortest(1e-9 * s.real("packing.modulus")) + " GPa");
  row("sub-grains",
      study.of_a_paper ? "material pressure over modulus (not in the paper)" : "material pressure over modulus", "",
      shortest(s.real("packing.pressure_ratio")));
  row("interaction", "modulus", "α_E", shortest(s.real("interaction.modulus")));
  row("interaction", "stiffness ratio", "α_k", shortest(s.real("interaction.stiffness_ratio")));
  row("interaction", "friction", "α_μ", shortest(s.real("interaction.friction")));
  row("interaction", "tensile strength", "α_t", shortest(s.real("interaction.tensile_strength")));
  row("interaction", "cohesion", "α_C", shortest(s.real("interaction.cohesion")));
  row("interaction", "friction angle", "α_φ", shortest(s.real("interaction.friction_angle")));
  content.panels.push_back(
      {.id = "common",
       .caption = study.of_a_paper ? "Parameters of the specimen (Tables 1 and 4)." : "Parameters of the specimen.",
       .alt = "",
       .content = common,
       .per_row = 1});

  TextTable by_mineral{{"Material"}, {}};
  for (std::size_t m = 0; m < minerals; ++m) by_mineral.head.push_back(s.text(fmt::format("mineral[{}].name", m)));
  const auto add = [&](const char* name, const char* key, double factor) {
    std::vector<std::string> cells{name};
    for (std::size_t m = 0; m < minerals; ++m) cells.push_back(shortest(factor * mineral(m, key)));
    by_mineral.rows.push_back(std::move(cells));
  };
  add("share Cₘ (%)", "share", 100);
  add("D_min (mm)", "diameter_min", 1e3);
  add("D_max (mm)", "diameter_max", 1e3);
  add("density ρ (kg/m³)", "density", 1);
  add("modulus E_c (GPa)", "modulus", 1e-9);
  add("stiffness ratio k_c", "stiffness_ratio", 1);
  add("friction μ_c", "friction", 1);
  add("bonded modulus E_b (GPa)", "bond_modulus", 1e-9);
  add("bonded stiffness ratio k_b", "bond_stiffness_ratio", 1);
  add("tensile strength σ_t,b (MPa)", "tensile_strength", 1e-6);
  add("cohesion C_b (MPa)", "cohesion", 1e-6);
  add("friction angle φ_b (°)", "friction_angle", 180 / std::numbers::pi);
  content.panels.push_back({.id = "minerals",
                            .caption = study.of_a_paper ? "Materials (Table 4)." : "Materials.",
                            .alt = "",
                            .content = by_mineral,
                            .per_row = 1});

  // Table 2: what laboratories measured; the calibration aims at it, nothing here is fitted to it.
  TextTable laboratory{{"Lac du Bonnet granite in the laboratory", "Value"}, {}};
  for (const PublishedNumber& one : study.published) {
    if (one.source != "Table 2") continue;
    laboratory.rows.push_back({one.quantity + (one.unit.empty() ? "" : " (" + one.unit + ")"),
                               shortest(one.low) + (one.high > one.low ? "–" + shortest(one.high) : "")});
  }
  if (!laboratory.rows.empty()) {
    content.panels.push_back({.id = "laboratory",
                              .caption = "Targets of the calibration (Table 2), as published.",
                              .alt = "",
                              .content = laboratory,
                              .per_row = 1});
  }
  double density = 0;
  for (std::size_t m = 0; m < minerals; ++m) density += mineral(m, "share") * mineral(m, "density");
  constexpr double near = 0.01;  // a tolerance of ours
  const double published = study.published_value("laboratory_density");
  if (std::isfinite(published)) {
    content.agreement = std::abs(density / published - 1) < near ? Agreement::agrees : Agreement::disagrees;
  }
  content.finding =
      fmt::format("The densities of the minerals, weighted by their shares, give {} kg/m³", number(density, 4));
  content.finding += std::isfinite(published) ? fmt::format(", {} {}; the tolerance of {} is ours.",
                                                            percent(std::abs(density / published - 1)),
                                                            density < published ? "lower" : "higher", percent(near, 0))
                                              : ".";
  return content;
}

FigureContent texture_by_seed(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "From aspect ratio 1 to 3 the share of inter-grain contacts rises from 55 to 60 % (Fig. 18), because an "
      "ellipsoid "
      "has more surface than the sphere of its volume (Eq. 14).";
  content.rows = {"texture_inter_grain_share_ar_1", "texture_inter_grain_share_ar_3",
                  "texture_trend_inter_grain_share"};
  if (auto missing = missing_cases(study, test_genesis)) content.panels.push_back(*missing);
  const auto cases = swept(study, test_genesis);
  if (cases.empty()) return content;
  const ValueOf share = shown(quantity::inter_grain_share);
  const ValueOf grown = shown(quantity::realised_ar);
  TextTable table{{"Specimen", "Random seeds", "AR of the grown grains", "Inter-grain contacts (%)",
                   "Coordination number", "Porosity", "Particles", "Grains", "Gap particles (%)", "Rounds"},
                  {}};
  for (const Group& group : groups_of(study)) {
    table.rows.push_back({group.label, std::to_string(group.records.size()),
                          spread_text(group, quantity::realised_ar, 3),
                          spread_text(group, quantity::inter_grain_share, 2),
                          spread_text(group, quantity::coordination, 2), spread_text(group, quantity::porosity, 3),
                          spread_text(group, quantity::particles, 1), spread_text(group, quantity::grains, 1),
                          spread_text(group, quantity::gap_share, 1), spread_text(group, quantity::growth_rounds, 1)});
  }
  if (swept_axis(study).id == "aspect_ratio" && cases.size() > 1) {
    render::Chart chart;
    chart.x.title = axis_title(parameter::aspect_ratio);
    chart.x.low = cases.front().value - 0.2;
    chart.x.high = cases.back().value + 0.2;
    chart.left.title = "Inter-grain contacts (%)";
    render::Series ours = means(cases, share);
    render::Series by_grown = ours;
    ours.label = "by the AR of the ellipsoids";
    chart.series.push_back(ours);
    for (std::size_t i = 0; i < by_grown.x.size() && i < cases.size(); ++i)
      by_grown.x[i] = analysis::spread(cases[i], grown).mean;
    by_grown.label = "by the AR of the grown grains";
    by_grown.colour = render::palette(3);
    by_grown.marker = render::Marker::square;
    chart.series.push_back(by_grown);
    add_published(
        chart, published_points(study, {{1, "texture_inter_grain_share_ar_1"}, {3, "texture_inter_grain_share_ar_3"}}),
        "published (Fig. 18)");
    const double base = analysis::spread(cases.front(), share).mean;
    const auto line = [&](const char* label, double (*surface)(double), render::Line kind, std::size_t colour) {
      const double first = cases.front().value;
      render::Series series = line_of(
          first, cases.back().value, [&](double ar) { return base * surface(ar) / surface(first); }, 40);
      series.label = label;
      series.colour = render::palette(colour);
      series.line = kind;
      chart.series.push_back(series);
    };
    line("in proportion to the surface of the ellipsoid", exact_surface, render::Line::dash, 1);
    line("in proportion to Eq. 14", published_surface, render::Line::dot, 2);
    chart.legend = render::Chart::Legend::below;
    content.panels.push_back(
        {.id = "share",
         .caption = "Share of inter-grain contacts (mean and standard deviation over random seeds) against the aspect "
                    "ratio: of the ellipsoids, which is that of the paper, and of the grains that growth makes of "
                    "them, by second "
                    "moments.",
         .alt = by_case(cases, share, 3, "%"),
         .content = chart,
         .per_row = 1});
    const double last = cases.back().value;
    content.finding = fmt::format(
        "The share {}. From AR {} to {} it grows by a factor of {}; the surface of the ellipsoid by one of {}, or {} "
        "by "
        "Eq. 14, which is an approximation. ",
        trend_words(cases, share, "points", swept_axis(study)), shortest(cases.front().value), shortest(last),
        number(analysis::spread(cases.back(), share).mean / base, 4),
        number(exact_surface(last) / exact_surface(cases.front().value), 4),
        number(published_surface(last) / published_surface(cases.front().value), 4));
    content.finding += fmt::format("The grown grains have aspect ratios of {}. ", by_case(cases, grown, 3, ""));
  }
  content.panels.push_back({.id = "table",
                            .caption = "Mean and standard deviation over random seeds.",
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  const Spread at_base = analysis::spread(cases.front(), share);
  if (at_base.count > 1) {
    content.finding += fmt::format(
        "Standard deviations over {} random seeds at {}: share {} points, coordination number {}, porosity {}.",
        at_base.count, cases.front().label, number(at_base.deviation, 2),
        number(analysis::spread(cases.front(), shown(quantity::coordination)).deviation, 2),
        number(analysis::spread(cases.front(), shown(quantity::porosity)).deviation, 2));
  }
  return content;
}

}  // namespace reports::texture
