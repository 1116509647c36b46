#pragma once
// The part of a plan that outlives its cases: what `collect` reports. OUT/plan.json.
#include <filesystem>
#include <string>
#include <vector>

#include "reports/cluster/manifest.h"
#include "reports/commands/run.h"

namespace cli {

/// The studies of a request with where they come from; throws dem::InputError as the run would, before anything is written.
struct Planned {
  std::vector<dem::Study> studies;
  std::vector<cluster::Source> sources;  ///< one each
};
Planned planned(const RunRequest& request);

/// What plan.json holds, and the request that it is read into. Both throw dem::InputError: a name that is not UTF-8; a file
/// that is missing or broken; a folder that the scenarios are not seen from.
std::string plan_text(const RunRequest& request);
RunRequest read_plan(const std::filesystem::path& output);

}  // namespace cli
