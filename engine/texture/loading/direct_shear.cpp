#include "engine/texture/loading/direct_shear.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/texture/loading/outcome.h"
#include "engine/texture/solver/assembly.h"

namespace dem::texture {
namespace {

constexpr std::string_view name = "direct_shear";
constexpr std::int64_t settling_steps = 1500;  // at the full normal stress, before the test proper

std::vector<Key> keys() {
  std::vector<Key> own = {
      {.path = "direct_shear.edge",
       .unit = "mm",
       .low = 1,
       .high = 1000,
       .otherwise = "specimen.diameter",
       .affects = Affects::specimen,
       .when = {"direct_shear"},
       .help = "edge of the block, a cube"},
      {.path = "direct_shear.grip",
       .low = 0.02,
       .high = 0.3,
       .standard = "0.12",
       .affects = Affects::test,
       .when = {"direct_shear"},
       .help = "depth over the edge, below the faces, in which particles are held"},
      {.path = "direct_shear.gap",
       .low = 0.02,
       .high = 0.5,
       .standard = "0.2",
       .affects = Affects::test,
       .when = {"direct_shear"},
       .help = "height of the gap between both halves over the edge: nothing is held in it"},
      {.path = "direct_shear.normal_stress",
       .unit = "MPa",
       .low = 0,
       .high = 1000,
       .standard = "\"10 MPa\"",
       .affects = Affects::test,
       .when = {"direct_shear"},
       .help = "sigma_n on the upper half"},
      {.path = "direct_shear.normal_step",
       .unit = "kPa",
       .low = 1e-3,
       .high = 1000,
       .standard = "\"5 kPa\"",
       .affects = Affects::test,
       .when = {"direct_shear"},
       .help = "rise of the normal stress a step, before the test"},
      {.path = "direct_shear.displacement",
       .low = 0,
       .high = 1,
       .standard = "0.03",
       .affects = Affects::test,
       .when = {"direct_shear"},
       .help = "shear displacement over the edge to which all tests go on after their end: the strength after the peak "
               "is the mean over its last fifth"},
      {.path = "sweep.normal_stress",
       .type = KeyType::reals,
       .unit = "MPa",
       .low = 0,
       .high = 1000,
       .standard = "[]",
       .affects = Affects::cases,
       .help = "normal stresses of the direct shear tests; empty: direct_shear.normal_stress"}};
  const std::vector<Key> pace = pace_keys({.test = name,
                                           .moved = "shear",
                                           .rate = "2e-7",
                                           .ramp_strain = "1e-4",
                                           .stop = "0.8",
                                           .largest_strain = "0.1",
                                           .sample_strain = "2e-5"});
  own.insert(own.end(), pace.begin(), pace.end());
  return own;
}

Section sheared_section(const Body& body) { return {body.size[0] * body.size[1], body.size[0]}; }

bool in_gap(const Body& body, double length, const Vec3& at) {
  return std::abs(at[2] - body.size[2] / 2) <= length * body.size[2] / 2;
}

std::int8_t shell(const Test& test, const Body& body, const Vec3& at) {
  const auto& [length, width, height] = body.size;
  const double depth = test.grip * height, above = at[2] - height / 2;
  const bool near_side = std::abs(at[0]) > length / 2 - depth || std::abs(at[1]) > width / 2 - depth ||
                         std::abs(above) > height / 2 - depth;
  if (!near_side || std::abs(above) < test.gap * height / 2) return 0;
  return above < 0 ? std::int8_t{1} : std::int8_t{2};
}

std::int64_t begin_pressing(const Test& test, Assembly& assembly) {
  const auto ramp = static_cast<std::int64_t>(test.normal_stress / test.confining_step) + 1;
  const Section section = test.section(*test.body);
  assembly.press(test.normal_stress * section.area, ramp);
  return ramp + settling_steps;
}

void read_off(const Test& test, const Outcome& of, Record& record) {
  if (!of.failed()) return;
  record.put(quantity::dilation_at_peak, 1e6 * of.peak().opening);
  const std::vector<HistoryRow>& h = of.history();
  if (!limit_reached(h, test.ending).empty()) return;
  double sum = 0, count = 0;
  for (const HistoryRow& row : h) {
    if (row.platen_strain < 0.8 * h.back().platen_strain) continue;
    sum += row.axial_stress;
    count += 1;
  }
  record.put(quantity::residual_shear, 1e-6 * sum / count);
}

Test read(const Scenario& scenario) {
  Test test = direct_shear(scenario.real("direct_shear.edge"), scenario.real("direct_shear.normal_stress"));
  read_pace(scenario, "direct_shear.", test);
  test.grip = scenario.real("direct_shear.grip");
  test.gap = scenario.real("direct_shear.gap");
  const double edge = test.body->size[2], gap = test.gap * edge, radius = scenario.real("packing.minimum_radius"),
               largest = 2 * radius * scenario.real("packing.radius_ratio");
  const bool is_block = edge > 4 * largest;  // a smaller one is refused by its edge
  if (is_block && gap < largest) {
    throw scenario.error(
        "direct_shear.gap",
        fmt::format("it is {:.3g} mm, and particles are up to {:.3g} mm wide: the halves would hold each other",
                    1e3 * gap, 1e3 * largest),
        fmt::format("write at least {:.2g}", std::ceil(100 * largest / edge) / 100));
  }
  const double depth = test.grip * edge;
  if (is_block && depth < radius) {
    throw scenario.error(
        "direct_shear.grip",
        fmt::format("particles are held to a depth of {:.3g} mm, and the smallest have a radius of {:.3g} mm",
                    1e3 * depth, 1e3 * radius),
        fmt::format("write at least {:.2g}", std::ceil(100 * radius / edge) / 100));
  }
  test.confining_step = scenario.real("direct_shear.normal_step");
  test.ending.follow_strain = scenario.real("direct_shear.displacement");
  if (test.ending.follow_strain >= test.ending.largest_strain) {
    throw scenario.error("direct_shear.displacement", "the test is given up before, at direct_shear.largest_strain",
                         fmt::format("write less than {:g}, or raise that key", test.ending.largest_strain));
  }
  return test;
}

}  // namespace

TestEntry direct_shear_entry() { return {name, &keys, &read, Sweep{"normal_stress", parameter::normal_stress}}; }

Test direct_shear(double edge, double normal_stress) {
  return {
      .name = name,
      .words = "direct shear",
      .hold = Hold::grips,
      .body = Body{Body::Shape::bar, {edge, edge, edge}},
      .size_key = "direct_shear.edge",
      .grip = 0.12,
      .gap = 0.2,
      .gripped = shell,
      .normal_stress = normal_stress,
      .confining_step = 5e3,
      .before = Stage{"normal stress", &begin_pressing, nullptr},
      .motion = Axis::x,
      .sense = 1,
      .rate = 2e-7,
      .ramp_strain = 1e-4,
      .section = sheared_section,
      .in_gauge = in_gap,
      .sample_strain = 2e-5,
      .ending = {.stop = 0.8, .strain_limit = 3, .follow_strain = 0.03, .largest_strain = 0.1, .most_steps = 10000000},
      .typical_strain = 8e-3,
      .strength = quantity::shear_strength,
      .rate_sensitivity = 1.3,
      .stretched = false,
      .read_off = read_off,
  };
}

}  // namespace dem::texture
