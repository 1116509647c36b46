#include "engine/texture/loading/brazilian.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/texture/loading/outcome.h"

namespace dem::texture {
namespace {

constexpr std::string_view name = "brazilian";

std::vector<Key> keys() {
  std::vector<Key> own = {
      {.path = "brazilian.diameter",
       .unit = "mm",
       .low = 1,
       .high = 1000,
       .otherwise = "specimen.height",
       .affects = Affects::specimen,
       .when = {"brazilian"},
       .help = "D, diameter of the disc"},
      {.path = "brazilian.thickness",
       .unit = "mm",
       .low = 0,
       .high = 1000,
       .standard = "\"0 mm\"",
       .affects = Affects::specimen,
       .when = {"brazilian"},
       .help = "t, thickness of the disc, at least 13 times packing.minimum_radius; 0: D / 2"},
      {.path = "brazilian.jaw_ratio",
       .low = 0,
       .high = 20,
       .standard = "1.5",
       .affects = Affects::test,
       .when = {"brazilian"},
       .help = "radius of the curved jaws over that of the disc (ISRM: 1.5); 0: flat platens"},
      {.path = "brazilian.split",
       .low = 0,
       .high = 1,
       .standard = "0.25",
       .affects = Affects::test,
       .when = {"brazilian"},
       .help =
           "fewest cracks at which the disc counts as split, as a share of the joint elements that fill the "
           "section D t; a fall of the load with fewer is a local one and ends no test, unless to half of the peak"},
      {.path = "sweep.jaw_ratio",
       .type = KeyType::reals,
       .low = 0,
       .high = 20,
       .standard = "[]",
       .affects = Affects::cases,
       .help = "jaw ratios of the Brazilian tests; empty: brazilian.jaw_ratio"}};
  const std::vector<Key> pace = pace_keys({.test = name,
                                           .moved = "platen",
                                           .rate = "5e-8",
                                           .ramp_strain = "2e-5",
                                           .stop = "0.97",
                                           .largest_strain = "0.02",
                                           .sample_strain = "2e-6"});
  own.insert(own.end(), pace.begin(), pace.end());
  return own;
}

// Stress 2 P / (pi D t).
Section splitting_section(const Body& body) {
  const auto& [diameter, thickness, height] = body.size;
  return {std::numbers::pi / 2 * diameter * thickness, height};
}

// A round gauge at the middle of the faces, through the disc.
bool in_centre(const Body& body, double length, const Vec3& at) {
  return std::hypot(at[0], at[2] - body.size[2] / 2) <= length * body.size[2] / 4;
}

// Where failure starts.
void read_off(const Test& test, const Outcome& of, Record& record) {
  if (!of.failed()) return;
  constexpr double share = 0.01, fewest = 10;
  const auto first = static_cast<std::size_t>(std::max(share * of.peak().all_cracks(), fewest));
  const std::vector<Crack>& cracks = of.loading.assembly().cracks();
  if (cracks.size() < first) return;
  const double radius = test.body->size[2] / 2;
  double middle = 0, band = 0;
  for (std::size_t i = 0; i < first; ++i) {
    const Vec3& at = cracks[i].position;
    middle += std::hypot(at[0], at[2] - radius) < radius / 2 ? 1 : 0;
    band += std::abs(at[0]) < radius / 4 ? 1 : 0;
  }
  record.put(quantity::first_cracks_middle, middle / static_cast<double>(first));
  record.put(quantity::first_cracks_band, band / static_cast<double>(first));
}

Test read(const Scenario& scenario) {
  const double diameter = scenario.real("brazilian.diameter"), thickness = scenario.real("brazilian.thickness"),
               jaws = scenario.real("brazilian.jaw_ratio");
  if (jaws > 0 && jaws < 1.05) {
    throw scenario.error("brazilian.jaw_ratio", "jaws that are no wider than the disc hold it all round",
                         "write 1.5 (ISRM), another number above 1.05, or 0 for flat platens");
  }
  if (thickness > diameter) {
    throw scenario.error("brazilian.thickness", "the disc is thicker than wide", "write D / 2 or so; 0 stands for it");
  }
  Test test = brazilian(diameter, thickness > 0 ? thickness : diameter / 2, jaws);
  read_pace(scenario, "brazilian.", test);
  const double radius = scenario.real("packing.minimum_radius") * (1 + scenario.real("packing.radius_ratio")) / 2,
               element = std::numbers::pi * radius * radius / 3;
  test.ending.least_cracks = scenario.real("brazilian.split") * diameter * test.body->size[1] / element;
  if (thickness == 0) test.size_key = "brazilian.diameter";
  return test;
}

}  // namespace

TestEntry brazilian_entry() { return {name, &keys, &read, Sweep{"jaw_ratio", parameter::jaw_ratio}}; }

Test brazilian(double diameter, double thickness, double jaw_ratio) {
  Test test = {
      .name = name,
      .words = "Brazilian test",
      .hold = Hold::platens,
      .body = Body{Body::Shape::disc, {diameter, thickness, diameter}},
      .size_key = "brazilian.thickness",
      .sense = -1,
      .rate = 5e-8,
      .ramp_strain = 2e-5,
      .section = splitting_section,
      .gauge = Gauge::across,
      .in_gauge = in_centre,
      .sample_strain = 2e-6,
      .ending = {.stop = 0.97, .largest_strain = 0.02, .most_steps = 10000000},
      .typical_strain = 1e-3,
      .strength = quantity::brazilian_strength,
      .rate_sensitivity = 6.0,
      .stretched = false,
      .read_off = read_off,
  };
  if (jaw_ratio > 0) {
    for (std::vector<Face>& faces : test.faces) faces = {{.jaw = jaw_ratio * diameter / 2}};
  }
  return test;
}

}  // namespace dem::texture
