#pragma once
// Help, made from the declarations of the commands, for a terminal of 80 columns.
#include <span>
#include <string>

#include "reports/commands/command.h"

namespace cli {

/// Of the program: its verbs, and all about the default one, which is the first.
std::string program_help(std::span<const Command> commands);

/// Of one command.
std::string command_help(const Command& command);

/// "SCENARIO...", "[MODEL]", "A B"; with `endings` as one would write it: "SCENARIO.toml".
std::string positionals_text(const Command& command, bool endings = false);

}  // namespace cli
