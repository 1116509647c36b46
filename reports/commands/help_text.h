#pragma once
// Help, made from the declarations of the commands, for a terminal of 80 columns.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/commands/command.h"

namespace cli {

/// Of the program: its verbs, and all about the default one, which is the first.
std::string program_help(std::span<const Command> commands);

/// Of one command.
std::string command_help(const Command& command);

/// The options of a command, --help at the end.
std::vector<Option> options_of(const Command& command);

/// "size of the study (smoke, draft, paper or high; default: draft)"
std::string option_text(const Option& option);

/// "smoke, draft, paper or high"
std::string one_of(const std::vector<std::string>& choices);

/// "simulate the cases" -> "Simulate the cases."
std::string sentence(std::string text);

/// What the program does.
std::string_view program_summary();

/// "SCENARIO...", "[MODEL]", "A B"; with `endings` as one would write it: "SCENARIO.toml".
std::string positionals_text(const Command& command, bool endings = false);

}  // namespace cli
