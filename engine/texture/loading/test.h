#pragma once
// What a test is. Each test has a file of its own (compression.h, direct_tension.h, genesis.h): it declares the
// scenario keys of the test and reads them into a Test, plain values by which the specimen is held (assembly_input in
// setup.h), moved, sampled and followed to its end (loading.h), and by which results are read off (results.h). tests()
// is the table of all.
//
// A new test is one such file and one line in table.cpp.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/record.h"
#include "engine/scenario/scenario.h"
#include "engine/texture/genesis/body.h"
#include "engine/texture/loading/ending.h"
#include "engine/texture/quantities.h"
#include "engine/texture/solver/input.h"

namespace dem::texture {

class Assembly;
struct Outcome;  // outcome.h
struct Settings;
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
Section cross_section(const Body& body);

/// Along which axis the ends move.
enum class Axis { x, z };

/// Loops of unloading and reloading.
struct Loops {
  double first = 0, every = 0;  ///< platen strain at which the first is turned down, and from one to the next; 0: none
  double low = 0;               ///< turned up at this share of the stress where it was turned down
};

/// Which strains the gauge reads.
enum class Gauge {
  along,  ///< axial: along z, lateral: the mean of x and y, both in the sense of the test
  across  ///< axial: along x, lateral: along z, both with tension positive
};
/// Whether a place is in the gauge of a cylinder along z: its length over the height.
bool in_middle(const Body& body, double length, const Vec3& at);

/// What is done to the specimen before the test proper. It has no samples; strains count from its end.
struct Stage {
  std::string_view words;                         ///< what progress calls it
  std::int64_t (*begin)(const Test&, Assembly&);  ///< starts it; returns its steps, at least one
  Section (*end)(const Sample&);                  ///< the specimen after it, from its last step; none: as it was
};

/// One test with its settings. SI units.
struct Test {
  std::string_view name = {};   ///< as in the scenario's `tests`
  std::string_view words = {};  ///< what progress calls it

  // how the specimen is held
  Hold hold = Hold::nothing;
  std::optional<Body> body = {};                    ///< none: the cylinder of the scenario
  std::string_view size_key = "specimen.diameter";  ///< of the body's smallest size
  std::array<std::vector<Face>, 2> faces = {};      ///< of the platens; empty: planes
  double grip = 0;                                  ///< thickness of what is gripped over the height
  double gap = 0;  ///< height over that of the body between two grips that reach down its sides
  /// 0: a place where particles are free, 1: held by the lower grip, 2: by the upper; for Hold::grips
  std::int8_t (*gripped)(const Test&, const Body&, const Vec3& at) = nullptr;
  double normal_stress = 0;          ///< Pa, on the upper of two grips that move along x
  double confining_pressure = 0;     ///< Pa; 0: no jacket
  bool membrane = false;             ///< flexible: no rigid cylinder (solver/walls.h)
  double confining_step = 0;         ///< Pa a step, while the confining pressure or the normal stress is raised
  std::optional<Stage> before = {};  ///< none: the test begins at once

  // the motion of the ends: both at the same speed, in opposite directions
  Axis motion = Axis::z;
  double sense = 1;           ///< 1: apart, tension counts positive; -1: towards each other, compression does
  double rate = 1e-7;         ///< strain a step
  double ramp_strain = 2e-5;  ///< they reach their speed over this strain
  Loops loops = {};

  // samples and the end
  Section (*section)(const Body& body) = cross_section;
  Gauge gauge = Gauge::along;
  bool (*in_gauge)(const Body& body, double length, const Vec3& at) = in_middle;  ///< `length`: measure.gauge
  double mouth = 0;             ///< m: reach of the gauge of a notch's mouth (MouthGauge); 0: none
  double sample_strain = 1e-5;  ///< between samples
  Ending ending = {};
  double typical_strain = 1e-3;  ///< at the end of such tests; only the estimate of time left hangs on it

  // what is read off
  Quantity strength = {};       ///< what the largest stress (MPa) is; without an id: no result by itself
  double rate_sensitivity = 1;  ///< how its strength follows the rate, for rate_bias() (characteristics.h)
  bool stretched = true;      ///< the gauge strains as the ends do: Young's modulus and the strain of the peak are read
  bool crack_stages = false;  ///< the stages of cracking too: initiation and damage, Poisson's ratio, residual strength
  void (*read_off)(const Test&, const Outcome&, Record&) = nullptr;  ///< what this test alone gives; none: nothing more

  [[nodiscard]] bool loads() const { return hold != Hold::nothing; }
};

/// What cases of one test differ in, beside their specimens.
struct Sweep {
  std::string_view name;  ///< of the key in its group: "confining_pressure"
  Parameter parameter;
  [[nodiscard]] std::string key() const { return std::string(parameter.key); }  ///< a real one
  [[nodiscard]] std::string list() const { return "sweep." + std::string(name); }
};

/// One line of the table of tests.
struct TestEntry {
  std::string_view name;            ///< as in the scenario's `tests`
  std::vector<Key> (*keys)();       ///< its scenario keys
  Test (*read)(const Scenario&);    ///< the test of one case; throws InputError for values that are wrong together
  std::optional<Sweep> sweep = {};  ///< a case of it for each value of this; the cases of other tests have none
  /// The scenario of a case with the values that the case runs at, where other keys stand in for them; none: as it is.
  Scenario (*resolve)(const Scenario&) = nullptr;
};

/// All tests, in the order of reports (table.cpp).
std::span<const TestEntry> tests();
/// The test of that name. Throws InputError that names the known ones.
const TestEntry& test_entry(std::string_view name);

/// The keys that every test has in its group, with its defaults.
struct PaceDefaults {
  std::string_view test;
  std::string_view moved;  ///< "platen": what the strain is of
  std::string_view rate, ramp_strain, stop, largest_strain, sample_strain;
};
std::vector<Key> pace_keys(const PaceDefaults& standard);

/// Reads what every test has from the keys of its group ("compression."): rate, ramp_strain, sample_strain, stop,
/// largest_strain, most_steps.
/// Throws InputError when samples are closer than steps.
void read_pace(const Scenario& scenario, const std::string& group, Test& test);

}  // namespace dem::texture
