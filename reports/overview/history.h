#pragma once
// The numbers of studies night by night: one JSON object a line, a line a study and run.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "reports/overview/study_row.h"

namespace overview {

struct Night {
  std::string study, label, date;
  std::vector<std::pair<std::string, double>> numbers{};  ///< "results/...", "checks/...", "seconds", "seconds/CASE"
};

/// Appends a line for each study, whole or not at all; runs that write at once lose nothing. Throws dem::EnvironmentError.
void append_history(const std::filesystem::path& file, const std::vector<StudyRow>& rows, const std::string& label,
                    const std::string& date);

/// In the order of the file. A last line without an end, as of a run that was killed just now, is left out; a line that is
/// no such object is counted in `damaged`. Throws dem::InputError when the file cannot be read.
struct History {
  std::vector<Night> nights;
  std::size_t damaged = 0;
};
History read_history(const std::filesystem::path& file);

/// One number of one study over the nights.
struct Series {
  std::string id;
  std::vector<double> values{};
  std::vector<std::string> labels{};
};
std::vector<Series> series_of(const History& history, const std::string& study);

/// Where a series stepped: the first value of the new level.
struct Step {
  std::size_t at = 0;
  double before = 0, after = 0;  ///< medians of the levels
};

/// A piecewise constant fit: the sum of distances to the median of each piece, plus a penalty for each piece after the
/// first (L1 Potts functional; Storath and Weinmann 2014; as asv does). The penalty is 4 ln(n) times the noise, which is the median of the
/// changes from night to night, over sqrt 2; pieces have two values at least, one where there is no noise at all.
std::vector<Step> steps(const std::vector<double>& values);

/// The penalty, for the page.
inline constexpr const char* penalty_text =
    "L1 Potts fit; penalty of a step: 4 ln(n) times the median change from night to night over √2";

}  // namespace overview
