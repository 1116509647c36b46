#include "engine/texture/loading/bending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/texture/loading/outcome.h"

namespace dem::texture {
namespace {

constexpr std::string_view name = "bending";
constexpr double span_ratio = 4;      // S / W, of ASTM E399
constexpr double length_ratio = 4.4;  // of the bar, over its depth
constexpr double width_ratio = 0.6;   // where none is given
constexpr double mouth_ratio = 1.0 / 6;

std::vector<Key> keys() {
  std::vector<Key> own = {{.path = "bending.depth",
                           .unit = "mm",
                           .low = 1,
                           .high = 1000,
                           .otherwise = "specimen.diameter",
                           .affects = Affects::specimen,
                           .when = {"bending"},
                           .help = "W, depth of the bar, along the load; the span is 4 W, the bar 4.4 W long"},
                          {.path = "bending.width",
                           .unit = "mm",
                           .low = 0,
                           .high = 1000,
                           .standard = "\"0 mm\"",
                           .affects = Affects::specimen,
                           .when = {"bending"},
                           .help = "b, width of the bar, at least 13 times packing.minimum_radius; 0: 0.6 W"},
                          {.path = "bending.notch",
                           .low = 0,
                           .high = 0.7,
                           .standard = "0.5",
                           .affects = Affects::specimen,
                           .when = {"bending"},
                           .help = "a/W, depth of the notch over that of the bar (ASTM E399: 0.45 to 0.55); 0: none, "
                                   "for the modulus of rupture"},
                          {.path = "sweep.notch",
                           .type = KeyType::reals,
                           .low = 0,
                           .high = 0.7,
                           .standard = "[]",
                           .affects = Affects::cases,
                           .help = "notches of the bending tests; empty: bending.notch"}};
  const std::vector<Key> pace = pace_keys({.test = name,
                                           .moved = "strip",
                                           .rate = "1.5e-8",
                                           .ramp_strain = "2e-4",
                                           .stop = "0.7",
                                           .largest_strain = "0.02",
                                           .sample_strain = "1e-6"});
  own.insert(own.end(), pace.begin(), pace.end());
  return own;
}

// Stress 3 P S / (2 b W^2) of a bar without a notch.
Section outer_fibre(const Body& body) {
  const auto& [length, width, depth] = body.size;
  return {2 * width * depth / (3 * span_ratio), depth};
}

void read_off(const Test& test, const Outcome& of, Record& record) {
  if (!of.failed()) return;
  if (test.body->notch <= 0) return;
  record.put(quantity::mouth_opening, 1e6 * of.peak().opening);
  const double depth = test.body->size[2];
  // P S / (b W^1.5) is two thirds of the stress of the outer fibre times the root of the depth.
  const double k = of.peak().axial_stress * std::sqrt(depth) * 2 / 3 * bar_factor(test.body->notch / depth);
  record.put(quantity::fracture_toughness, 1e-6 * k);
}

Test read(const Scenario& scenario) {
  const double depth = scenario.real("bending.depth"), width = scenario.real("bending.width");
  Test test =
      bending(depth, width > 0 ? width : width_ratio * depth, scenario.real("bending.notch"), mean_particle(scenario));
  read_pace(scenario, "bending.", test);
  check_notch(scenario, "bending.notch", *test.body);
  if (width == 0) test.size_key = "bending.depth";
  return test;
}

}  // namespace

double strip_on(double depth, double particle) { return std::max(0.05 * depth, 0.5 * particle); }

double mean_particle(const Scenario& scenario) {
  return scenario.real("packing.minimum_radius") * (1 + scenario.real("packing.radius_ratio"));
}

double bar_factor(double r) {
  return 3 * std::sqrt(r) * (1.99 - r * (1 - r) * (2.15 - 3.93 * r + 2.7 * r * r)) /
         (2 * (1 + 2 * r) * std::pow(1 - r, 1.5));
}

void check_notch(const Scenario& scenario, const std::string& key, const Body& body) {
  constexpr double fewest = 2;
  const double particle = mean_particle(scenario);
  const double depth = body.size[2], least = fewest * particle, left = depth - body.notch;
  if (body.notch <= 0 || std::min(body.notch, left) >= least) return;
  const bool is_short = body.notch < least;
  throw scenario.error(
      key,
      fmt::format("the {} is {:.3g} mm {}, and the mean particle diameter {:.3g} mm", is_short ? "notch" : "ligament",
                  1e3 * (is_short ? body.notch : left), is_short ? "deep" : "high", 1e3 * particle),
      2 * least < depth
          ? fmt::format("write {:.2g} to {:.2g}: both are {:g} particles then", std::ceil(100 * least / depth) / 100,
                        std::floor(100 * (1 - least / depth)) / 100, fewest)
          : fmt::format("the specimen needs a depth of {:.3g} mm for a notch and a ligament of {:g} particles each",
                        2e3 * least, fewest));
}

TestEntry bending_entry() { return {name, &keys, &read, Sweep{"notch", parameter::notch}}; }

Test bending(double depth, double width, double notch, double particle) {
  const double strip = strip_on(depth, particle), half_span = span_ratio * depth / 2;
  return {
      .name = name,
      .words = "three-point bending",
      .hold = Hold::platens,
      .body = Body{Body::Shape::bar, {length_ratio * depth, width, depth}, notch * depth},
      .size_key = "bending.width",
      .faces = {{{{.x = -half_span, .strip = strip}, {.x = half_span, .strip = strip}}, {{.strip = strip}}}},
      .sense = -1,
      .rate = 1.5e-8,
      .ramp_strain = 2e-4,
      .section = outer_fibre,
      .mouth = notch > 0 ? mouth_ratio * depth : 0,
      .sample_strain = 1e-6,
      .ending = {.stop = 0.7, .largest_strain = 0.02, .most_steps = 10000000},
      .typical_strain = 1e-3,
      .strength = notch > 0 ? Quantity{} : quantity::modulus_of_rupture,
      .rate_sensitivity = 1.8,
      .stretched = false,
      .read_off = read_off,
  };
}

}  // namespace dem::texture
