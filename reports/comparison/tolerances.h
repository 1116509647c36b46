#pragma once
// tolerances.toml beside the references: exceptions from "nothing may change", each with its reason.
//
//   [[tolerance]]
//   study = "ldb_*"                        # all studies when it is left out
//   item = "results/*/energy_residual"     # ids as in comparison.json; * stands for anything
//   relative = 0.01                        # of the old value; or absolute = ..., in the unit of the number;
//                                          # of curves and pictures: share = 0.001, of the range or of the pixels
//   reason = "rounding of the last step"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace comparison {

struct Tolerance {
  std::string study = "*", item;
  double relative = 0, absolute = 0, share = 0;
  std::string reason;
};

/// Those of DIR/tolerances.toml; none when there is no such file. Throws dem::InputError that names file, line and what
/// would be right.
std::vector<Tolerance> read_tolerances(const std::filesystem::path& folder);

/// The first one that is meant for an item of a study; nullptr: none is.
const Tolerance* find_tolerance(const std::vector<Tolerance>& all, std::string_view study, std::string_view item);

/// "results/*/young_modulus" fits "results/compression_ar_1/young_modulus".
bool fits_pattern(std::string_view pattern, std::string_view text);

}  // namespace comparison
