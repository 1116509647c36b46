#include "engine/texture/loading/unloading_loops.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/texture/loading/outcome.h"

namespace dem::texture {
namespace {

constexpr std::string_view name = "unloading_loops";

std::vector<Key> keys() {
  const auto key = [](const char* path, double low, double high, const char* value, const char* help) {
    return Key{.path = path,
               .low = low,
               .high = high,
               .standard = value,
               .affects = Affects::test,
               .when = {"unloading_loops"},
               .help = help};
  };
  std::vector<Key> own = {
      key("unloading_loops.first", 1e-6, 0.1, "1.5e-3", "platen strain at which the first loop is turned down"),
      key("unloading_loops.every", 1e-6, 0.1, "5e-4", "strain from one loop to the next"),
      key("unloading_loops.low", 0.01, 0.9, "0.1",
          "a loop is turned up at this share of the stress where it was turned down"),
  };
  const std::vector<Key> pace = pace_keys({.test = name,
                                           .moved = "platen",
                                           .rate = "1e-7",
                                           .ramp_strain = "2e-5",
                                           .stop = "0.5",
                                           .largest_strain = "0.05",
                                           .sample_strain = "1e-5"});
  own.insert(own.end(), pace.begin(), pace.end());
  return own;
}

void read_off(const Test& test, const Outcome& of, Record& record) {
  const std::vector<HistoryRow>& h = of.history();
  Table table{"loops", {{"meaning", "where the load was turned down and up again, and the secant between"}}, {}};
  std::vector<double> strain, stress, low_strain, low_stress, modulus, damage;
  for (std::size_t i = 1; i < h.size(); ++i) {
    if (h[i].phase != 1 || h[i - 1].phase == 1) continue;
    std::size_t turned = i;
    while (turned + 1 < h.size() && h[turned + 1].phase == 1) ++turned;
    if (turned + 1 == h.size()) break;  // the test ended on the way down
    const HistoryRow &top = h[i - 1], &bottom = h[turned];
    strain.push_back(top.axial_strain);
    stress.push_back(top.axial_stress);
    low_strain.push_back(bottom.axial_strain);
    low_stress.push_back(bottom.axial_stress);
    modulus.push_back((top.axial_stress - bottom.axial_stress) / (top.axial_strain - bottom.axial_strain));
    damage.push_back(1 - modulus.back() / modulus.front());
    record.put(quantity::loop_damage, std::to_string(modulus.size()), damage.back());
  }
  if (!modulus.empty()) {
    record.put(quantity::unloading_modulus, 1e-9 * modulus.front());
  } else {
    record.notes.push_back(
        fmt::format("The test ended before its first loop: {}.first is beyond its peak.", test.name));
  }
  table.add("strain", "1", std::move(strain));
  table.add("stress", "Pa", std::move(stress));
  table.add("low_strain", "1", std::move(low_strain));
  table.add("low_stress", "Pa", std::move(low_stress));
  table.add("modulus", "Pa", std::move(modulus));
  table.add("damage", "1", std::move(damage));
  record.tables.push_back(std::move(table));
  if (const auto ratio = secant_poisson_ratio(h, of.characteristics.peak)) record.put(quantity::poisson_ratio, *ratio);
}

Test read(const Scenario& scenario) {
  Test test = unloading_loops();
  read_pace(scenario, "unloading_loops.", test);
  test.loops = {scenario.real("unloading_loops.first"), scenario.real("unloading_loops.every"),
                scenario.real("unloading_loops.low")};
  if (test.loops.first >= test.ending.largest_strain) {
    throw scenario.error(
        "unloading_loops.first", "the test is given up before its first loop",
        fmt::format("write less than unloading_loops.largest_strain, {:g}", test.ending.largest_strain));
  }
  // The ends turn over a ramp and between samples: loops as close as these would follow each other in place.
  const double least = 5 * std::max(test.sample_strain, test.ramp_strain);
  if (test.loops.every < least) {
    throw scenario.error(
        "unloading_loops.every", "loops are so close that the test does not get on",
        fmt::format("write at least {:g}, 5 times the larger of sample_strain and ramp_strain", least));
  }
  return test;
}

}  // namespace

TestEntry unloading_loops_entry() { return {name, &keys, &read}; }

Test unloading_loops() {
  return {
      .name = name,
      .words = "compression with loops",
      .hold = Hold::platens,
      .sense = -1,
      .rate = 1e-7,
      .loops = {1.5e-3, 5e-4, 0.1},
      .ending = {.stop = 0.5, .largest_strain = 0.05, .most_steps = 10000000},
      .typical_strain = 4.5e-3,
      .strength = quantity::compressive_strength,
      .rate_sensitivity = 4.5,
      .read_off = read_off,
  };
}

}  // namespace dem::texture
