#pragma once
// Cracks of a granite record counted by class, by the minerals at their ends and by the part of the test in which they
// formed, and how much of what could crack they are.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/record.h"

namespace dem::analysis {

/// Which cracks. Moments are those of the record's snapshots: "crack_initiation", "damage", "peak", "post_peak" (the stress
/// has fallen to 0.9 of the peak), "end"; "" is the first load, or the end of the test.
struct CrackChoice {
  int place = -1, mode = -1;               ///< as in the table of cracks; -1: any
  std::vector<std::string> minerals = {};  ///< one of them is at one end at least; empty: any
  std::vector<std::string> without = {};   ///< none of them is at either end
  std::vector<std::string> pair = {};      ///< two: one at each end
  std::string after = {}, until = {};
};

/// What is counted of them.
enum class CrackMeasure {
  number,    ///< broken elements of flat joints (three a joint) and broken bonds
  contacts,  ///< contacts with at least one
  area,      ///< m^2
  exposure,  ///< contacts with at least one over all contacts of that place between such minerals
};

/// Throws std::out_of_range where the record lacks a table or the moment, std::invalid_argument for a mineral that it has not.
double cracks_of(const Record& record, const CrackChoice& choice, CrackMeasure measure);

/// Lateral strain at the first row with so large an axial strain before the peak; NaN where the peak comes before.
double lateral_strain_at(const Record& record, double axial_strain);

}  // namespace dem::analysis
