// What pictures are as files: stable bytes, facts inside, sound SVG, bad input refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "render/compare.h"
#include "render/png.h"
#include "tests/support/golden.h"

namespace {

namespace fs = std::filesystem;

const render::Provenance facts{{"Title", "Stress & strain"},
                               {"Description", "σ₁ < 200 MPa"},
                               {"Scenario", "4f6a"},
                               {"Source", "Zhao et al. 2021 – Fig. 14"}};

render::Chart chart_of(int points) {
  render::Chart chart;
  chart.x.title = "Axial strain ε₁ (%)";
  chart.left.title = "Stress <MPa> & more";
  render::Series series;
  series.label = "σ_{1}";
  for (int i = 0; i < points; ++i) {
    series.x.push_back(0.31 * i / (points - 1));
    series.y.push_back(200 * std::sin(3.0 * i / points) + (i * 7919 % 100) * 0.01);
  }
  chart.series.push_back(series);
  chart.width = 360;
  chart.height = 240;
  return chart;
}

render::Scene scene_of_one() {
  render::Scene scene;
  scene.spheres.push_back({{{0, 0, 0}}, {1e-3}, {{0.8, 0.2, 0.2}}, 1});
  scene.width = 120;
  scene.height = 80;
  return scene;
}

/// Names of elements in order; throws when tags do not nest or an entity is unknown.
std::vector<std::string> elements(const std::string& xml) {
  std::vector<std::string> names, open;
  for (std::size_t at = 0; at < xml.size();) {
    const std::size_t tag = xml.find('<', at);
    for (std::size_t i = xml.find('&', at); i < tag && i != std::string::npos; i = xml.find('&', i + 1)) {
      const std::string entity = xml.substr(i + 1, xml.find(';', i) - i - 1);
      if (entity != "amp" && entity != "lt" && entity != "gt" && entity != "quot")
        throw std::runtime_error("entity " + entity);
    }
    if (tag == std::string::npos) break;
    const std::size_t end = xml.find('>', tag);
    if (end == std::string::npos) throw std::runtime_error("a tag does not end");
    const std::string body = xml.substr(tag + 1, end - tag - 1);
    at = end + 1;
    if (body[0] == '?') continue;
    const std::string name =
        body.substr(body[0] == '/' ? 1 : 0, body.find_first_of(" /", 1) - (body[0] == '/' ? 1 : 0));
    if (body[0] == '/') {
      if (open.empty() || open.back() != name) throw std::runtime_error("</" + name + "> closes nothing");
      open.pop_back();
    } else {
      names.push_back(name);
      if (body.back() != '/') open.push_back(name);
    }
  }
  if (!open.empty()) throw std::runtime_error("<" + open.back() + "> stays open");
  return names;
}

}  // namespace

TEST_CASE("the same chart and scene give the same bytes, also after pictures of other sizes") {
  const fs::path& folder = golden::scratch();
  auto& canvas = golden::canvas();
  canvas.draw(chart_of(500), folder / "a.png", folder / "a.svg", facts);
  canvas.draw(scene_of_one(), folder / "s.png", facts);
  render::Chart other = chart_of(20);
  other.width = 250;
  canvas.draw(other, folder / "other.png", {}, facts);
  canvas.draw(chart_of(500), folder / "b.png", folder / "b.svg", facts);
  canvas.draw(scene_of_one(), folder / "t.png", facts);
  CHECK(dem::read_file(folder / "a.png") == dem::read_file(folder / "b.png"));
  CHECK(dem::read_file(folder / "a.svg") == dem::read_file(folder / "b.svg"));
  CHECK(dem::read_file(folder / "s.png") == dem::read_file(folder / "t.png"));
}

TEST_CASE("a PNG carries its facts, also those beyond ASCII") {
  const fs::path png = golden::scratch() / "facts.png";
  golden::canvas().draw(scene_of_one(), png, facts);
  CHECK(render::read_png_facts(png) == facts);
  const render::Image image = render::read_png(png);
  CHECK(image.width == 120);
  CHECK(image.height == 80);
}

TEST_CASE("an SVG is well-formed and holds title, description, facts and the data's extent") {
  const fs::path svg = golden::scratch() / "sound.svg";
  golden::canvas().draw(chart_of(50), {}, svg, facts);
  const std::string text = dem::read_file(svg);
  std::vector<std::string> names;
  REQUIRE_NOTHROW(names = elements(text));
  CHECK(names.at(0) == "svg");
  CHECK(names.at(1) == "title");
  CHECK(names.at(2) == "desc");
  CHECK(text.find("<title>Stress &amp; strain</title>") != std::string::npos);
  CHECK(text.find("<fact name=\"Scenario\">4f6a</fact>") != std::string::npos);
  CHECK(text.find("<fact name=\"Extent x\">0 to 0.31</fact>") != std::string::npos);
  CHECK(text.find("Stress &lt;MPa&gt; &amp; more") != std::string::npos);
  CHECK(text.find(golden::scratch().string()) == std::string::npos);
}

TEST_CASE("every point of an SVG lies on its page, also with data far outside the axes") {
  render::Chart chart = chart_of(400);
  chart.left.low = 50;
  chart.left.high = 60;
  chart.x.high = 0.1;
  render::Band band;
  band.x = {0, 0.05, 0.3};
  band.low = {-1e6, 55, 1e3};
  band.high = {1e6, 57, 1e6};
  chart.bands.push_back(band);
  const fs::path svg = golden::scratch() / "clipped.svg";
  golden::canvas().draw(chart, {}, svg, facts);
  const std::string text = dem::read_file(svg);
  int seen = 0;
  for (std::size_t at = text.find(" points=\""); at != std::string::npos; at = text.find(" points=\"", at + 1)) {
    const char* p = text.c_str() + at + 9;
    while (*p != '"') {
      char* end = nullptr;
      const double x = std::strtod(p, &end), y = std::strtod(end + 1, &end);
      REQUIRE(x >= 0);
      REQUIRE(x <= chart.width);
      REQUIRE(y >= 0);
      REQUIRE(y <= chart.height);
      p = *end == ' ' ? end + 1 : end;
      ++seen;
    }
  }
  CHECK(seen > 50);
}

TEST_CASE("a curve of 20,000 points gives a small SVG that keeps its ends") {
  const fs::path svg = golden::scratch() / "long.svg";
  golden::canvas().draw(chart_of(20000), {}, svg, facts);
  CHECK(fs::file_size(svg) < 60000);
}

TEST_CASE("pictures are compared by pixels") {
  const fs::path& folder = golden::scratch();
  render::Scene scene = scene_of_one();
  golden::canvas().draw(scene, folder / "one.png", {});
  scene.spheres[0].colour[0] = {0.2, 0.2, 0.8};
  golden::canvas().draw(scene, folder / "two.png", {});
  const auto none = render::compare_png(folder / "one.png", folder / "one.png");
  CHECK(none.mean == 0);
  CHECK(none.worst == 0);
  const auto some = render::compare_png(folder / "one.png", folder / "two.png");
  CHECK(some.mean > 0.01);
  CHECK(some.worst > 0.2);
  scene.width = 60;
  golden::canvas().draw(scene, folder / "small.png", {});
  CHECK_FALSE(render::compare_png(folder / "one.png", folder / "small.png").same_size);
  CHECK_THROWS_AS(render::compare_png(folder / "one.png", folder / "missing.png"), dem::EnvironmentError);
}

TEST_CASE("columns of unequal length are refused") {
  render::Chart chart = chart_of(5);
  chart.series[0].y.pop_back();
  CHECK_THROWS_AS(golden::canvas().draw(chart, golden::scratch() / "bad.png", {}, {}), std::invalid_argument);
  render::Scene scene = scene_of_one();
  scene.spheres[0].radius.clear();
  CHECK_THROWS_AS(golden::canvas().draw(scene, golden::scratch() / "bad.png", {}), std::invalid_argument);
  CHECK_FALSE(fs::exists(golden::scratch() / "bad.png"));
}

TEST_CASE("a scene says its scale: a sphere of known size covers as many pixels") {
  render::Scene scene = scene_of_one();
  const render::SceneResult result = golden::canvas().draw(scene, golden::scratch() / "scale.png", {});
  const render::Image image = render::read_png(golden::scratch() / "scale.png");
  int covered = 0;
  for (int column = 0; column < image.width; ++column)
    if (image.rgb[image.at(column, image.height / 2) + 1] < 200) ++covered;
  CHECK(covered * result.metres_per_pixel == doctest::Approx(2e-3).epsilon(0.03));
}

TEST_CASE("cut faces without edges have no colour but their own: fields match their legend") {
  render::Scene scene = scene_of_one();
  scene.spheres[0].colour[0] = {1, 0, 0};
  scene.camera.direction = {0, 1, 0};
  scene.cuts.push_back({{0, 0, 0}, {0, -1, 0}});
  const auto darkest_red = [&](bool edges) {
    scene.spheres[0].cut_edges = edges;
    golden::canvas().draw(scene, golden::scratch() / "edges.png", {});
    const render::Image image = render::read_png(golden::scratch() / "edges.png");
    int least = 255;
    for (int row = 0; row < image.height; ++row)
      for (int column = 0; column < image.width; ++column)
        least = std::min<int>(least, image.rgb[image.at(column, row)]);
    return least;
  };
  CHECK(darkest_red(false) == 255);  // red on white
  CHECK(darkest_red(true) < 240);
}

TEST_CASE("a cut shows the inside: colours of cut faces are those given, and the cut half is gone") {
  render::Scene scene = scene_of_one();
  scene.spheres[0].colour[0] = {1, 0, 0};
  scene.camera.direction = {0, 1, 0};
  scene.cuts.push_back({{0, -5e-4, 0}, {0, -1, 0}});
  golden::canvas().draw(scene, golden::scratch() / "cut.png", {});
  const render::Image image = render::read_png(golden::scratch() / "cut.png");
  const std::size_t middle = image.at(image.width / 2, image.height / 2);
  CHECK(image.rgb[middle] == 255);  // flat and unlit
  CHECK(image.rgb[middle + 1] == 0);
  scene.cuts = {{{0, 2e-3, 0}, {0, -1, 0}}};  // beyond the sphere: nothing is left
  golden::canvas().draw(scene, golden::scratch() / "cut.png", {});
  const render::Image empty = render::read_png(golden::scratch() / "cut.png");
  CHECK(empty.rgb[middle] == 255);
  CHECK(empty.rgb[middle + 1] == 255);
}
