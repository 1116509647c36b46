#include "engine/texture/micro_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "engine/core/errors.h"
#include "engine/scenario/suggest.h"

namespace dem::texture {
namespace {

/// A property of minerals with the keys that move together, and the coefficient of the same name.
struct Property {
  std::string_view name, symbol, coefficient;
  std::vector<std::string_view> keys;
  std::string_view unit;
  double low, high;  ///< factors
};

const std::vector<Property>& properties() {
  static const std::vector<Property> all = {
      {"modulus", "E_b", "α_E", {"modulus", "bond_modulus"}, "GPa", 0.2, 5},
      {"stiffness_ratio", "k_b", "α_k", {"stiffness_ratio", "bond_stiffness_ratio"}, "", 0.3, 5},
      {"tensile_strength", "σ_t,b", "α_t", {"tensile_strength"}, "MPa", 0.2, 5},
      {"cohesion", "C_b", "α_C", {"cohesion"}, "MPa", 0.2, 5},
      {"friction_angle", "φ_b", "α_φ", {"friction_angle"}, "deg", 0.5, 2},
      {"friction", "μ_c", "α_μ", {"friction"}, "", 0.3, 3}};
  return all;
}

constexpr double steepest_angle = 1.5;               // rad, some 86 degrees
constexpr double largest_of_friction_angle = 1.5;    // the coefficient, as its key allows
constexpr double low_factor = 0.2, high_factor = 5;  // of coefficients

std::string key_of(std::size_t mineral, std::string_view key) { return fmt::format("mineral[{}].{}", mineral, key); }

MicroParameter of_minerals(const Scenario& scenario, const Property& one, const std::string& mineral) {
  MicroParameter made{.name = (mineral.empty() ? "" : mineral + ".") + std::string(one.name),
                      .kind = std::string(one.name),
                      .symbol = std::string(one.symbol),
                      .unit = std::string(one.unit),
                      .low = one.low,
                      .high = one.high};
  const std::vector<std::string> minerals = mineral_names(scenario);
  for (std::size_t i = 0; i < minerals.size(); ++i) {
    if (!mineral.empty() && minerals[i] != mineral) continue;
    for (const std::string_view key : one.keys) {
      made.keys.push_back(key_of(i, key));
      made.start.push_back(scenario.real(made.keys.back()));
      if (one.name == "friction_angle" && made.start.back() > 0)
        made.high = std::min(made.high, steepest_angle / made.start.back());
    }
  }
  return made;
}

MicroParameter of_boundaries(const Scenario& scenario, const Property& one) {
  MicroParameter made{.name = "interaction." + std::string(one.name),
                      .kind = "interaction." + std::string(one.name),
                      .symbol = std::string(one.coefficient),
                      .low = low_factor,
                      .high = high_factor};
  made.keys = {made.name};
  made.start = {scenario.real(made.name)};
  if (one.name == "friction_angle")
    made.high = std::min(made.high, largest_of_friction_angle / std::max(made.start.front(), 1e-9));
  return made;
}

}  // namespace

std::vector<std::string> mineral_names(const Scenario& scenario) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scenario.count("mineral"); ++i) names.push_back(scenario.text(key_of(i, "name")));
  return names;
}

MicroParameter micro_parameter(const Scenario& scenario, const std::string& key, const std::string& name) {
  const std::vector<std::string> minerals = mineral_names(scenario);
  const std::size_t dot = name.rfind('.');
  const std::string owner = dot == std::string::npos ? "" : name.substr(0, dot);
  const std::string leaf = dot == std::string::npos ? name : name.substr(dot + 1);
  std::vector<std::string> known;
  for (const Property& one : properties()) known.emplace_back(one.name);
  const auto found = std::ranges::find(properties(), leaf, &Property::name);
  if (owner == "interaction") {
    if (found == properties().end()) {
      throw scenario.error(key, "there is no coefficient '" + name + "'", advice(leaf, known, "below interaction are"));
    }
    if (minerals.size() < 2 && scenario.text("interaction.between") == "minerals") {
      throw scenario.error(key, "'" + name + "' does nothing: the rock has one mineral", "leave it out");
    }
    return of_boundaries(scenario, *found);
  }
  if (!owner.empty() && std::ranges::find(minerals, owner) == minerals.end()) {
    throw scenario.error(key, "there is no mineral '" + owner + "'", advice(owner, minerals, "the minerals are"));
  }
  if (found == properties().end()) {
    throw scenario.error(
        key, "there is no parameter '" + name + "'",
        advice(leaf, known, "of minerals there are") + "; of boundaries, interaction.cohesion and so on");
  }
  return of_minerals(scenario, *found, owner);
}

Scenario multiplied(const Scenario& scenario, const MicroParameter& parameter, double factor,
                    const std::string& source) {
  Scenario changed = scenario;
  for (std::size_t k = 0; k < parameter.keys.size(); ++k)
    changed = std::move(changed).with(parameter.keys[k], factor * parameter.start[k], source);
  return changed;
}

}  // namespace dem::texture
