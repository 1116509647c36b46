#pragma once
// What a case will take, from what is known of earlier runs: for plans, for packs of a cluster, for a person who asks.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/study/study.h"

namespace cluster {

/// What run.json beside a record says of the run that made it.
struct CaseRun {
  double seconds = 0;        ///< wall time
  int threads = 1;           ///< at its beginning
  std::uint64_t memory = 0;  ///< bytes, the largest of its process; 0: unknown
};

/// Nothing when there is none, or when it cannot be read: an estimate is no reason to stop.
std::optional<CaseRun> earlier_run(const std::filesystem::path& case_folder);

struct Estimate {
  double seconds = 0;        ///< wall time
  std::uint64_t memory = 0;  ///< bytes
  std::string from;          ///< "this case", "this study" (the mean of its other cases) or "its scale" (a guess)
};

/// One for each case, in their order. Looks for run.json of the case, then of the study's report (case_seconds), in `output`.
std::vector<Estimate> estimates(const dem::Study& study, const std::filesystem::path& output);

}  // namespace cluster
