#include "engine/texture/loading/direct_tension.h"

namespace dem::texture {
namespace {

constexpr std::string_view name = "direct_tension";

std::vector<Key> keys() {
  return {
      {.path = "direct_tension.rate",
       .low = 1e-10,
       .high = 1e-4,
       .standard = "1e-8",
       .affects = Affects::test,
       .when = {"direct_tension"},
       .help = "grip strain a step"},
      {.path = "direct_tension.ramp_strain",
       .low = 1e-9,
       .high = 1e-2,
       .standard = "2e-6",
       .affects = Affects::test,
       .when = {"direct_tension"},
       .help = "strain over which the grips reach their speed"},
      {.path = "direct_tension.stop",
       .low = 0.05,
       .high = 0.999,
       .standard = "0.5",
       .affects = Affects::test,
       .when = {"direct_tension"},
       .help = "the test ends at this share of the peak, after it"},
      {.path = "direct_tension.largest_strain",
       .low = 1e-6,
       .high = 0.5,
       .standard = "0.005",
       .affects = Affects::test,
       .when = {"direct_tension"},
       .help = "grip strain at which a test that does not end is given up: no strength was found"},
      {.path = "direct_tension.most_steps",
       .type = KeyType::integer,
       .low = 1,
       .high = 1e9,
       .standard = "10000000",
       .affects = Affects::test,
       .when = {"direct_tension"},
       .help = "steps after which it is given up"},
      {.path = "direct_tension.sample_strain",
       .low = 1e-8,
       .high = 1e-3,
       .standard = "1e-6",
       .affects = Affects::test,
       .when = {"direct_tension"},
       .help = "strain between samples"},
      {.path = "direct_tension.grip",
       .low = 0.01,
       .high = 0.3,
       .standard = "0.05",
       .affects = Affects::test,
       .when = {"direct_tension"},
       .help = "thickness of each gripped disc over the height"},
  };
}

// A disc at each end.
std::int8_t at_ends(const Test& test, const Body& body, const Vec3& at) {
  const double height = body.size[2], thickness = test.grip * height;
  return at[2] < thickness ? std::int8_t{1} : at[2] > height - thickness ? std::int8_t{2} : std::int8_t{0};
}

Test read(const Scenario& scenario) {
  Test test = direct_tension();
  read_pace(scenario, "direct_tension.", test);
  test.grip = scenario.real("direct_tension.grip");
  // Where compressions are followed after their end, tension is followed as far.
  test.ending.follow = scenario.real("compression.follow");
  return test;
}

}  // namespace

TestEntry direct_tension_entry() { return {name, &keys, &read}; }

Test direct_tension() {
  return {
      .name = name,
      .words = "direct tension",
      .hold = Hold::grips,
      .grip = 0.05,
      .gripped = at_ends,
      .sense = 1,
      .rate = 1e-8,
      .ramp_strain = 2e-6,
      .sample_strain = 1e-6,
      .ending = {.stop = 0.5, .largest_strain = 0.005, .most_steps = 10000000},
      .typical_strain = 2.5e-4,
      .strength = quantity::tensile_strength,
      .rate_sensitivity = 0.9,
  };
}

}  // namespace dem::texture
