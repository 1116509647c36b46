// The table of tests, and what they share.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "engine/texture/loading/compression.h"
#include "engine/texture/loading/direct_tension.h"
#include "engine/texture/loading/genesis.h"
#include "engine/texture/loading/test.h"

namespace dem::texture {

std::span<const TestEntry> tests() {
  static const std::array table = {
      compression_entry(),
      direct_tension_entry(),
      genesis_entry(),
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

Section cross_section(const Cylinder& vessel) {
  return {std::numbers::pi / 4 * vessel.diameter * vessel.diameter, vessel.height};
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
