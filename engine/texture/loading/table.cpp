// The table of tests, and what they share.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/texture/loading/bending.h"
#include "engine/texture/loading/brazilian.h"
#include "engine/texture/loading/compression.h"
#include "engine/texture/loading/direct_shear.h"
#include "engine/texture/loading/direct_tension.h"
#include "engine/texture/loading/genesis.h"
#include "engine/texture/loading/test.h"
#include "engine/texture/loading/unloading_loops.h"

namespace dem::texture {

std::span<const TestEntry> tests() {
  static const std::array table = {
      compression_entry(),          direct_tension_entry(), brazilian_entry(),       bending_entry(),
      semicircular_bending_entry(), direct_shear_entry(),   unloading_loops_entry(), genesis_entry(),
  };
  return table;
}

const TestEntry& test_entry(std::string_view name) {
  const std::span<const TestEntry> all = tests();
  const auto found = std::ranges::find(all, name, &TestEntry::name);
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  for (const TestEntry& entry : all) names.push_back(entry.name);
  throw InputError(fmt::format("there is no test '{}'", name), fmt::format("the tests are {}", fmt::join(names, ", ")));
}

Section cross_section(const Body& body) { return {std::numbers::pi / 4 * body.size[0] * body.size[0], body.size[2]}; }

bool in_middle(const Body& body, double length, const Vec3& at) {
  return std::abs(at[2] - body.size[2] / 2) <= length * body.size[2] / 2;
}

std::vector<Key> pace_keys(const PaceDefaults& standard) {
  const std::string test(standard.test), group = test + ".", moved(standard.moved);
  const auto key = [&](const char* name, double low, double high, std::string_view value, std::string help) {
    return Key{.path = group + name,
               .low = low,
               .high = high,
               .standard = std::string(value),
               .affects = Affects::test,
               .when = {test},
               .help = std::move(help)};
  };
  Key steps = key("most_steps", 1, 1e9, "10000000", "steps after which it is given up");
  steps.type = KeyType::integer;
  return {key("rate", 1e-10, 1e-4, standard.rate, moved + " strain a step"),
          key("ramp_strain", 1e-9, 1e-2, standard.ramp_strain, "strain over which the load reaches its speed"),
          key("stop", 0.05, 0.999, standard.stop, "the test ends at this share of the peak, after it"),
          key("largest_strain", 1e-6, 0.5, standard.largest_strain,
              moved + " strain at which a test that does not end is given up: no strength was found"),
          std::move(steps),
          key("sample_strain", 1e-8, 1e-3, standard.sample_strain, "strain between samples")};
}

void read_pace(const Scenario& scenario, const std::string& group, Test& test) {
  test.rate = scenario.real(group + "rate");
  test.ramp_strain = scenario.real(group + "ramp_strain");
  test.sample_strain = scenario.real(group + "sample_strain");
  test.ending.stop = scenario.real(group + "stop");
  test.ending.largest_strain = scenario.real(group + "largest_strain");
  test.ending.most_steps = scenario.integer(group + "most_steps");
  if (test.sample_strain < test.rate) {
    throw scenario.error(group + "sample_strain", "samples are closer than steps",
                         "write at least the value of " + group + "rate");
  }
}

}  // namespace dem::texture
