// One picture of each kind against its baseline.
#include <doctest/doctest.h>

#include <cmath>

#include "engine/core/random.h"
#include "tests/support/golden.h"

namespace {

using render::Chart;
using render::Colour;
using render::Mark;
using render::Scene;
using render::Series;

Chart empty_chart(const char* x, const char* left) {
  Chart chart;
  chart.width = 380;
  chart.height = 260;
  chart.x.title = x;
  chart.left.title = left;
  return chart;
}

Series curve(const char* label, std::size_t colour, double (*f)(double), double to, int points = 200) {
  Series series;
  series.label = label;
  series.colour = render::palette(colour);
  for (int i = 0; i <= points; ++i) {
    series.x.push_back(to * i / points);
    series.y.push_back(f(series.x.back()));
  }
  return series;
}

double stress(double strain) {
  return strain < 0.28 ? 700 * strain * (1 - 0.3 * strain) : 180 - 4000 * (strain - 0.28);
}
double cracks(double strain) { return 9000 * std::pow(strain / 0.32, 5); }

Chart curves() {
  Chart chart = empty_chart("Axial strain ε₁ (%)", "Axial stress σ₁ (MPa)");
  chart.right.title = "Cracks (–)";
  chart.series.push_back(curve("stress", 0, stress, 0.32));
  Series second = curve("cracks", 1, cracks, 0.32);
  second.side = render::Side::right;
  second.line = render::Line::dash;
  chart.series.push_back(second);
  for (auto [x, label] : {std::pair{0.1, "A1"}, std::pair{0.2, "A2"}, std::pair{0.279, "A3"}}) {
    Mark mark;
    mark.x = x;
    mark.y = stress(x);
    mark.label = label;
    chart.marks.push_back(mark);
  }
  Mark level;
  level.kind = Mark::Kind::horizontal;
  level.y = 200;
  level.label = "published 200 MPa";
  level.colour = {0.4, 0.4, 0.4};
  chart.marks.push_back(level);
  Mark onset = level;
  onset.kind = Mark::Kind::vertical;
  onset.x = 0.15;
  onset.label = "σ_{ci}";
  chart.marks.push_back(onset);
  return chart;
}

Chart log_chart() {
  Chart chart = empty_chart("Seed scale (–)", "Cracks (–)");
  chart.left.logarithmic = true;
  chart.legend = Chart::Legend::below;
  const char* names[] = {"circles", "squares", "diamonds", "triangles", "crosses"};
  for (int k = 0; k < 5; ++k) {
    Series series;
    series.label = names[k];
    series.colour = render::palette(static_cast<std::size_t>(k));
    series.marker = static_cast<render::Marker>(k + 1);
    for (int i = 1; i <= 6; ++i) {
      series.x.push_back(0.1 * i);
      series.y.push_back(std::pow(10, 0.7 * k + 0.1 * i));
      series.y_error.push_back(0.25 * series.y.back());
    }
    chart.series.push_back(series);
  }
  return chart;
}

Chart bars(bool stacked) {
  Chart chart = empty_chart("", "Share of cracks (%)");
  chart.bars = render::Bars{};
  chart.bars->categories = {"AR 1", "AR 2", "AR 3", "Published, 2021"};
  chart.bars->labels = {"intra tension", "intra shear", "inter tension"};
  chart.bars->values = {{20, 25, 30, 22}, {12, 10, 8, std::nan("")}, {68, 65, 62, 66}};
  if (!stacked) chart.bars->errors = {{2, 2, 3, 0}, {1, 1, 14, 0}, {4, 3, 2, 0}};
  for (std::size_t k = 0; k < 3; ++k) chart.bars->colours.push_back(render::palette(k));
  chart.bars->stacked = stacked;
  chart.bars->print_values = true;
  chart.legend = stacked ? Chart::Legend::outside_right : Chart::Legend::top_left;
  return chart;
}

Chart band_and_inset() {
  Chart chart = empty_chart("Confinement σ₃ (MPa)", "Peak strength σ₁ (MPa)");
  const auto envelope = [](double s3) { return s3 + 200 * std::sqrt(28.9 * s3 / 200 + 1); };
  Series fit = curve("Hoek–Brown, m_{i} = 28.9", 0, +envelope, 60, 60);
  fit.y[30] = std::nan("");
  render::Band band;
  band.label = "± 7 %";
  band.colour = render::palette(0);
  Series runs;
  runs.label = "simulated";
  runs.line = render::Line::none;
  runs.marker = render::Marker::diamond;
  runs.colour = render::palette(1);
  for (int i = 0; i <= 60; ++i) {
    band.x.push_back(i);
    band.low.push_back(0.93 * envelope(i));
    band.high.push_back(1.07 * envelope(i));
    if (i % 10 != 0) continue;
    runs.x.push_back(i);
    runs.y.push_back(envelope(i) * (1 + 0.04 * std::sin(i)));
  }
  chart.bands.push_back(band);
  chart.series = {fit, runs};
  chart.left.low = 0;
  chart.left.high = 650;
  Chart inner = empty_chart("t (ms)", "E_{k} (J)");
  inner.series.push_back(curve(
      "", 2, [](double t) { return 1e-6 * std::sin(10 * t); }, 1));
  chart.insets.push_back({{inner}, {0.46, 0.06, 0.5, 0.55}});
  return chart;
}

render::Spheres packing() {
  render::Spheres spheres;
  const Colour minerals[] = {{0.96, 0.91, 0.62}, {0.82, 0.65, 0.25}, {0.8, 0.8, 0.8}, {0.33, 0.33, 0.35}};
  dem::RandomStream random(7, dem::Purpose::test_data);
  for (int k = 0; k < 16; ++k)
    for (int j = -4; j <= 4; ++j)
      for (int i = -4; i <= 4; ++i) {
        const double step = 1e-3;
        const render::Point p{step * (i + 0.5 * (k % 2)), step * (j + 0.5 * (k % 2)), step * (0.75 * k + 0.5)};
        if (std::hypot(p[0], p[1]) > 4.0e-3) continue;
        spheres.centre.push_back(p);
        spheres.radius.push_back(random.uniform(0.42e-3, 0.56e-3));
        spheres.colour.push_back(minerals[random.below(4)]);
      }
  return spheres;
}

/// Cracks of four classes.
render::Discs crack_discs() {
  render::Discs discs;
  dem::RandomStream random(8, dem::Purpose::test_data);
  for (int i = 0; i < 120; ++i) {
    discs.centre.push_back({random.uniform(-3e-3, 3e-3), random.uniform(-3e-3, 3e-3), random.uniform(1e-3, 11e-3)});
    discs.normal.push_back({random.normal(), random.normal(), 0.3 * random.normal()});
    discs.radius.push_back(random.uniform(3e-4, 5e-4));
    discs.colour.push_back(render::palette(random.below(4)));
  }
  return discs;
}

Scene specimen() {
  Scene scene;
  scene.width = 150;
  scene.height = 200;
  scene.outline = {
      render::Outline::Shape::cylinder, {-4.6e-3, -4.6e-3, 0}, {4.6e-3, 4.6e-3, 12.5e-3}, {0.6, 0.6, 0.6}, 0.15};
  scene.camera.direction = {0.4, 1, -0.3};
  return scene;
}

}  // namespace

TEST_CASE("curves on two axes, labelled points, reference lines") { golden::picture("chart_curves", curves()); }
TEST_CASE("log axis, all markers, error bars, legend below") { golden::picture("chart_log", log_chart()); }
TEST_CASE("grouped bars with values and errors") { golden::picture("chart_bars", bars(false)); }
TEST_CASE("stacked bars, legend outside") { golden::picture("chart_stacked", bars(true)); }
TEST_CASE("band, gap, points, inset") { golden::picture("chart_band_inset", band_and_inset()); }

TEST_CASE("nothing to show, one point, one value") {
  Chart chart = empty_chart("Time (s)", "Residual (–)");
  chart.series = {curve(
                      "constant", 0, [](double) { return 3e-7; }, 1, 5),
                  Series{}, Series{}};
  chart.series[1].label = "one point";
  chart.series[1].colour = render::palette(1);
  chart.series[1].x = {0.5};
  chart.series[1].y = {3.1e-7};
  chart.series[2].label = "no data";
  golden::picture("chart_sparse", chart);
}

TEST_CASE("spheres in a transparent cylinder") {
  Scene scene = specimen();
  scene.spheres.push_back(packing());
  golden::picture("scene_spheres", scene);
}

TEST_CASE("longitudinal section: cut faces flat, cracks and axes over them") {
  Scene scene = specimen();
  scene.camera.direction = {0, 1, 0};
  scene.outline.shape = render::Outline::Shape::none;
  scene.spheres.push_back(packing());
  render::Discs all = crack_discs(), near_plane;
  for (std::size_t i = 0; i < all.centre.size(); ++i) {
    if (std::abs(all.centre[i][1]) > 8e-4) continue;
    near_plane.centre.push_back(all.centre[i]);
    near_plane.normal.push_back(all.normal[i]);
    near_plane.radius.push_back(all.radius[i]);
    near_plane.colour.push_back(all.colour[i]);
  }
  near_plane.over = true;
  scene.discs.push_back(near_plane);
  scene.lines.push_back({{{-4e-3, 0, 6e-3}, {4e-3, 0, 6e-3}}, {0.8, 0, 0}, 2, render::Line::dash});
  scene.cuts.push_back({{0, 0, 0}, {0, -1, 0}});
  golden::picture("scene_section", scene);
}

TEST_CASE("crack discs in the specimen's outline, spheres as a ghost, perspective") {
  Scene scene = specimen();
  scene.camera.parallel = false;
  scene.discs.push_back(crack_discs());
  scene.spheres.push_back(packing());
  scene.spheres[0].opacity = 0.3;
  golden::picture("scene_ghost", scene);
}

TEST_CASE("two cuts, a box, dotted and dash-dotted lines") {
  Scene scene = specimen();
  scene.outline = {render::Outline::Shape::box, {-5e-3, -5e-3, 0}, {5e-3, 5e-3, 12.5e-3}, {0.3, 0.4, 0.6}, 0.2};
  scene.spheres.push_back(packing());
  scene.cuts = {{{0, 0, 0}, {0, -1, 0}}, {{0, 0, 6e-3}, {0.5, 0, 1}}};
  scene.lines.push_back({{{-5e-3, -5e-3, 13e-3}, {5e-3, 5e-3, 1e-3}}, {0, 0, 0}, 2, render::Line::dot});
  scene.lines.push_back({{{-5e-3, -5e-3, 2e-3}, {5e-3, -5e-3, 2e-3}}, {0.8, 0, 0}, 2, render::Line::dash_dot});
  scene.camera.direction = {0.5, 1, -0.5};
  golden::picture("scene_cuts", scene);
}
