#pragma once
// The calibrated rock as a file that scenarios include.
#include <map>
#include <string>

#include "engine/model/model.h"
#include "engine/scenario/scenario.h"

namespace calibrate {

/// A value with four digits in its unit, as the file says it: what was run is what is written. SI.
double rounded(double si, const std::string& unit);

/// The rock of the scenario with these values (SI, by key) in the place of its own; `head`: lines of comment.
std::string rock_file(const dem::Scenario& scenario, const dem::Model& model,
                      const std::map<std::string, double>& values, const std::string& head);

}  // namespace calibrate
