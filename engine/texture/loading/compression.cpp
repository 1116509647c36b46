#include "engine/texture/loading/compression.h"

#include <numbers>

#include "engine/texture/solver/assembly.h"

namespace dem::texture {
namespace {

constexpr std::string_view name = "compression";
constexpr std::int64_t settling_steps = 1500;  // at the full confining pressure, before the test proper

std::vector<Key> keys() {
  return {
      {.path = "compression.rate",
       .low = 1e-10,
       .high = 1e-4,
       .standard = "1e-7",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "platen strain a step"},
      {.path = "compression.confined_rate",
       .low = 0,
       .high = 1e-4,
       .standard = "0.0",
       .affects = Affects::cases,
       .help = "platen strain a step under confining pressure; 0: compression.rate"},
      {.path = "compression.ramp_strain",
       .low = 1e-9,
       .high = 1e-2,
       .standard = "2e-5",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "strain over which the platens reach their speed"},
      {.path = "compression.stop",
       .low = 0.05,
       .high = 0.999,
       .standard = "0.8",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "the test ends at this share of the peak, after it"},
      {.path = "compression.strain_limit",
       .low = 1.05,
       .high = 20,
       .standard = "3.0",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "or at this multiple of the strain of the peak"},
      {.path = "compression.follow",
       .low = 0,
       .high = 20,
       .standard = "0.0",
       .affects = Affects::test,
       .when = {"compression", "direct_tension"},
       .help = "the test goes on after its end to this multiple of the strain of the peak, for the residual strength"},
      {.path = "compression.confining_pressure",
       .unit = "MPa",
       .low = 0,
       .high = 1000,
       .standard = "\"0 MPa\"",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "sigma_3 on the sides (compression.jacket); the test starts from this isotropic pressure"},
      {.path = "compression.jacket",
       .type = KeyType::text,
       .choices = {"rigid", "membrane"},
       .standard = "\"rigid\"",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "what carries the confining pressure: a frictionless rigid cylinder that keeps its mean, or a membrane: "
               "the pressure on each particle at the side"},
      {.path = "compression.confining_step",
       .unit = "kPa",
       .low = 1e-3,
       .high = 1000,
       .standard = "\"5 kPa\"",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "rise of the confining pressure a step, before the test"},
      {.path = "compression.largest_strain",
       .low = 1e-6,
       .high = 0.5,
       .standard = "0.1",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "platen strain at which a test that does not end is given up: no strength was found"},
      {.path = "compression.most_steps",
       .type = KeyType::integer,
       .low = 1,
       .high = 1e9,
       .standard = "10000000",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "steps after which it is given up"},
      {.path = "compression.sample_strain",
       .low = 1e-8,
       .high = 1e-3,
       .standard = "1e-5",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "strain between samples"},
  };
}

// The confined stage.
std::int64_t begin_confining(const Test& test, Assembly& assembly) {
  const auto ramp = static_cast<std::int64_t>(test.confining_pressure / test.confining_step) + 1;
  assembly.confine(test.confining_pressure, ramp);
  return ramp + settling_steps;
}

Section confined_section(const Sample& sample) {
  return {std::numbers::pi * sample.jacket_radius * sample.jacket_radius, sample.place[1] - sample.place[0]};
}

Test read(const Scenario& scenario) {
  Test test = compression(scenario.real("compression.confining_pressure"));
  read_pace(scenario, "compression.", test);
  test.confining_step = scenario.real("compression.confining_step");
  test.membrane = scenario.text("compression.jacket") == "membrane";
  test.ending.strain_limit = scenario.real("compression.strain_limit");
  test.ending.follow = scenario.real("compression.follow");
  return test;
}

// A confined case runs at its own rate, where there is one.
Scenario resolve(const Scenario& scenario) {
  const double rate = scenario.real("compression.confined_rate");
  const bool applies = scenario.real("compression.confining_pressure") > 0 && rate > 0;
  return applies ? scenario.with("compression.rate", rate, "compression.confined_rate") : scenario;
}

}  // namespace

TestEntry compression_entry() {
  return {name, &keys, &read, Sweep{"confining_pressure", parameter::confining_pressure}, &resolve};
}

Test compression(double confining_pressure) {
  const bool confined = confining_pressure > 0;
  const Stage stage = {"confining pressure", &begin_confining, &confined_section};
  return {
      .name = name,
      .words = "compression",
      .hold = Hold::platens,
      .confining_pressure = confining_pressure,
      .confining_step = 5e3,
      .before = confined ? std::optional(stage) : std::nullopt,
      .sense = -1,
      .ending = {.stop = 0.8, .strain_limit = 3, .largest_strain = 0.1, .most_steps = 10000000},
      .typical_strain = 4.5e-3,
      .strength = quantity::compressive_strength,
      .rate_sensitivity = 4.5,
      .crack_stages = true,
  };
}

}  // namespace dem::texture
