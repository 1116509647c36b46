#pragma once
// How a report is made again: the command that the report shows.
#include <filesystem>

#include "engine/scenario/scenario.h"
#include "reports/commands/run.h"
#include "reports/options.h"

namespace cli {

/// The folder of the scenarios that come with the program, beside its assets.
std::filesystem::path shipped_scenarios(const std::filesystem::path& assets);

/// Where the command is given: in the folder of a clone, or in any folder where the Debian package is installed.
enum class Home { clone, installed };

/// The command with the options that shape the report, without folders of this machine.
/// What is asked for is the same however the scenario's path is typed: a file whose bytes are those of one of `shipped` is
/// named where it comes with the program, any other goes, with the files that it needs, into the folder at hand.
reports::Again how_again(const RunRequest& request, const dem::Scenario& scenario, const std::filesystem::path& shipped,
                         Home home);

}  // namespace cli
