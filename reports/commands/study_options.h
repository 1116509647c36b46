#pragma once
// Options that several commands share, and the studies that they ask for.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/study/study.h"
#include "reports/commands/command.h"

namespace cli {

Positional scenario_positional();  ///< SCENARIO..., one or more

Option output_option();     ///< -o, --output DIR
Option scale_option();      ///< --scale SCALE
Option threads_option();    ///< --threads N
Option seed_option();       ///< --seed N
Option case_option();       ///< --case ID
Option set_option();        ///< --set KEY=VALUE, repeatable
Option quiet_option();      ///< --quiet
Option reference_option();  ///< --reference DIR, without a default

/// --threads; the threads of the machine when it is not given.
int threads(const Arguments& arguments);

/// The values of --set, then of --seed, as "key=value": the last one of a key counts.
std::vector<std::string> overrides(const Arguments& arguments);

/// Reads and checks scenarios before anything is written. Throws dem::InputError, also when two would share a folder.
std::vector<dem::Study> read_studies(std::span<const std::string> files, const std::string& scale,
                                     std::span<const std::string> overrides);

/// "a/../b" as the path that it is: writers refuse to leave a folder that they have gone into.
std::filesystem::path output_folder(const std::filesystem::path& given);

/// `text` as one word of a shell.
std::string shell_quoted(const std::string& text);

}  // namespace cli
