#pragma once
// How a report is made again: the command that the report shows.
#include <filesystem>

#include "engine/scenario/scenario.h"
#include "reports/commands/run.h"
#include "reports/options.h"

namespace cli {

/// The folder of the scenarios that come with the program, beside its assets.
std::filesystem::path shipped_scenarios(const std::filesystem::path& assets);

/// The command from the folder of a clone, with the options that shape the report and without folders of this machine.
/// What is asked for is the same however the scenario's path is typed: a file whose bytes are those of one of `shipped` is
/// named there, any other goes, with the files that it needs, into the folder of the clone.
reports::Again how_again(const RunRequest& request, const dem::Scenario& scenario,
                         const std::filesystem::path& shipped);

}  // namespace cli
