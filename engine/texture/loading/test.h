#pragma once
// What a test is. Each test has a file of its own (compression.h, direct_tension.h, genesis.h): it declares the
// scenario keys of the test and reads them into a Test, plain values by which the specimen is held (assembly_input in
// setup.h), moved, sampled and followed to its end (loading.h), and by which results are read off (results.h). tests()
// is the table of all.
//
// A new test is one such file and one line in table.cpp.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scenario/scenario.h"
#include "engine/texture/genesis/specimen.h"
#include "engine/texture/loading/ending.h"
#include "engine/texture/quantities.h"

namespace dem::texture {

class Assembly;
struct Test;

/// How the ends of the specimen are held.
enum class Hold {
  nothing,  ///< they are not: the specimen is made and not loaded
  platens,  ///< between frictionless platens, and under confining pressure in a frictionless jacket
  grips     ///< in two grips, whose particles move as one
};

/// What forces and displacements are divided by.
struct Section {
  double area = 0;    ///< m^2: stress = mean force of the two ends over it
  double length = 0;  ///< m: platen strain = change of the distance of the ends over it
};

/// Section and height of a cylinder, for tests along its axis.
Section cross_section(const Cylinder& vessel);

/// What is done to the specimen before the test proper. It has no samples; strains count from its end.
struct Stage {
  std::string_view words;                         ///< what progress calls it
  std::int64_t (*begin)(const Test&, Assembly&);  ///< starts it; returns its steps, at least one
  Section (*end)(const Sample&);                  ///< the specimen after it, from its last step
};

/// One test with its settings. SI units.
struct Test {
  std::string_view name = {};   ///< as in the scenario's `tests`
  std::string_view words = {};  ///< what progress calls it

  // how the specimen is held
  Hold hold = Hold::nothing;
  double grip = 0;                   ///< thickness of a gripped disc over the height
  double confining_pressure = 0;     ///< Pa; 0: no jacket
  double confining_step = 0;         ///< Pa a step, while the confining pressure is raised
  std::optional<Stage> before = {};  ///< none: the test begins at once

  // the motion of the ends: both at the same speed, in opposite directions
  double sense = 1;           ///< 1: apart, tension counts positive; -1: towards each other, compression does
  double rate = 1e-7;         ///< strain a step
  double ramp_strain = 2e-5;  ///< they reach their speed over this strain

  // samples and the end
  Section (*section)(const Cylinder& vessel) = cross_section;
  double sample_strain = 1e-5;  ///< between samples
  Ending ending = {};
  double typical_strain = 1e-3;  ///< at the end of such tests; only the estimate of time left hangs on it

  // what is read off
  Quantity strength = {};       ///< what the largest stress (MPa) is
  double rate_sensitivity = 1;  ///< how its strength follows the rate, for rate_bias() (characteristics.h)
  bool crack_stages = false;  ///< the stages of cracking too: initiation and damage, Poisson's ratio, residual strength

  [[nodiscard]] bool loads() const { return hold != Hold::nothing; }
};

/// One line of the table of tests.
struct TestEntry {
  std::string_view name;          ///< as in the scenario's `tests`
  std::vector<Key> (*keys)();     ///< its scenario keys
  Test (*read)(const Scenario&);  ///< the test of one case; throws InputError for values that are wrong together
  bool confined = false;          ///< a case of it for each confining pressure of the scenario; others have none
  /// The scenario of a case with the values that the case runs at, where other keys stand in for them; none: as it is.
  Scenario (*resolve)(const Scenario&) = nullptr;
};

/// All tests, in the order of reports (table.cpp).
std::span<const TestEntry> tests();
/// The test of that name. Throws InputError that names the known ones.
const TestEntry& test_entry(std::string_view name);

/// Reads what every test has from the keys of its group ("compression."): rate, ramp_strain, sample_strain, stop,
/// largest_strain, most_steps.
/// Throws InputError when samples are closer than steps.
void read_pace(const Scenario& scenario, const std::string& group, Test& test);

}  // namespace dem::texture
