#include <cmath>
#include <numbers>

#include "engine/texture/loading/bending.h"
#include "engine/texture/loading/outcome.h"

namespace dem::texture {
namespace {

constexpr std::string_view name = "semicircular_bending";
constexpr double thickness_ratio = 0.4;  // of the diameter: the least that is suggested
constexpr double mouth_ratio = 0.15;     // of the radius

std::vector<Key> keys() {
  std::vector<Key> own = {
      {.path = "semicircular_bending.diameter",
       .unit = "mm",
       .low = 1,
       .high = 1000,
       .otherwise = "specimen.height",
       .affects = Affects::specimen,
       .when = {"semicircular_bending"},
       .help = "2R, diameter of the disc that is halved"},
      {.path = "semicircular_bending.thickness",
       .unit = "mm",
       .low = 0,
       .high = 1000,
       .standard = "\"0 mm\"",
       .affects = Affects::specimen,
       .when = {"semicircular_bending"},
       .help = "B, thickness, at least 13 times packing.minimum_radius; 0: 0.4 of the diameter"},
      {.path = "semicircular_bending.notch",
       .low = 0.4,
       .high = 0.6,
       .standard = "0.5",
       .affects = Affects::specimen,
       .when = {"semicircular_bending"},
       .help = "a/R, depth of the notch over the radius"},
      {.path = "semicircular_bending.span",
       .low = 0.5,
       .high = 0.8,
       .standard = "0.6",
       .affects = Affects::test,
       .when = {"semicircular_bending"},
       .help = "s/2R, distance of the supports over the diameter"},
  };
  const std::vector<Key> pace = pace_keys({.test = name,
                                           .moved = "strip",
                                           .rate = "1.5e-8",
                                           .ramp_strain = "1e-4",
                                           .stop = "0.7",
                                           .largest_strain = "0.02",
                                           .sample_strain = "1e-6"});
  own.insert(own.end(), pace.begin(), pace.end());
  return own;
}

// Stress P / (2 R B).
Section flat_face(const Body& body) { return {body.size[0] * body.size[1], body.size[2]}; }

void read_off(const Test& test, const Outcome& of, Record& record) {
  if (!of.failed()) return;
  const Body& body = *test.body;
  const double span = (test.faces[0][1].x - test.faces[0][0].x) / body.size[0];
  const double k = half_disc_factor(span, body.notch / body.size[2]) * of.peak().axial_stress *
                   std::sqrt(std::numbers::pi * body.notch);
  record.put(quantity::fracture_toughness, 1e-6 * k);
  record.put(quantity::mouth_opening, 1e6 * of.peak().opening);
}

Test read(const Scenario& scenario) {
  const double diameter = scenario.real("semicircular_bending.diameter"),
               thickness = scenario.real("semicircular_bending.thickness");
  Test test = semicircular_bending(diameter, thickness > 0 ? thickness : thickness_ratio * diameter,
                                   scenario.real("semicircular_bending.notch"),
                                   scenario.real("semicircular_bending.span"), mean_particle(scenario));
  read_pace(scenario, "semicircular_bending.", test);
  check_notch(scenario, "semicircular_bending.notch", *test.body);
  if (thickness == 0) test.size_key = "semicircular_bending.diameter";
  return test;
}

}  // namespace

double half_disc_factor(double q, double r) {
  return -1.297 + 9.516 * q - (0.47 + 16.457 * q) * r + (1.071 + 34.401 * q) * r * r;
}

TestEntry semicircular_bending_entry() { return {name, &keys, &read}; }

Test semicircular_bending(double diameter, double thickness, double notch, double span, double particle) {
  const double radius = diameter / 2, strip = strip_on(radius, particle), half_span = span * radius;
  return {
      .name = name,
      .words = "bending of a half disc",
      .hold = Hold::platens,
      .body = Body{Body::Shape::half_disc, {diameter, thickness, radius}, notch * radius},
      .size_key = "semicircular_bending.thickness",
      .faces = {{{{.x = -half_span, .strip = strip}, {.x = half_span, .strip = strip}}, {{.strip = strip}}}},
      .sense = -1,
      .rate = 1.5e-8,
      .ramp_strain = 1e-4,
      .section = flat_face,
      .mouth = mouth_ratio * radius,
      .sample_strain = 1e-6,
      .ending = {.stop = 0.7, .largest_strain = 0.02, .most_steps = 10000000},
      .typical_strain = 1e-3,
      .rate_sensitivity = 1.8,
      .stretched = false,
      .read_off = read_off,
  };
}

}  // namespace dem::texture
