#pragma once
// Completion in shells, made from the declarations of the commands: a script that a shell sources.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/commands/command.h"

namespace cli {

/// "bash", "zsh", "fish"
std::vector<std::string> shells();

/// The script of one of them. It completes verbs, options and their fixed values, and files and folders where those are meant.
std::string completion(std::string_view shell, std::span<const Command> commands);

}  // namespace cli
