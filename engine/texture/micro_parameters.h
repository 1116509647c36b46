#pragma once
// Parameters of the contacts that are moved as one: a property of all minerals, of one of them, or a coefficient of the
// boundaries (Zhao et al. 2021, Table 4). What a sensitivity study raises, and what calibration searches for.
#include <string>
#include <vector>

#include "engine/scenario/scenario.h"

namespace dem::texture {

/// One factor on the values that some keys have.
struct MicroParameter {
  std::string name = {};               ///< "cohesion", "quartz.cohesion", "interaction.cohesion"
  std::string kind = {};               ///< the same without the mineral
  std::string symbol = {};             ///< as in the paper's Table 4: "C_b", "α_C"; with E_b goes E_c, with k_b k_c
  std::vector<std::string> keys = {};  ///< of the scenario
  std::vector<double> start = {};      ///< value of each, SI
  std::string unit = {};
  double low = 0, high = 0;  ///< factors that make sense

  [[nodiscard]] bool is_of_boundaries() const { return kind.starts_with("interaction."); }
};

/// By the name that a user gives it in `key`. Throws InputError about that key for a name that the rock has not, with the
/// nearest that it has, and for a coefficient that acts nowhere.
MicroParameter micro_parameter(const Scenario& scenario, const std::string& key, const std::string& name);

/// A copy with all values of the parameter times a factor. `source` is the key that asks for it.
Scenario multiplied(const Scenario& scenario, const MicroParameter& parameter, double factor,
                    const std::string& source);

/// Names of the minerals, in the order of the scenario.
std::vector<std::string> mineral_names(const Scenario& scenario);

}  // namespace dem::texture
