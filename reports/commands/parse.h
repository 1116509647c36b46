#pragma once
// From the words of a command line to a command with checked arguments.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/commands/command.h"

namespace cli {

struct Call {
  const Command* command = nullptr;
  Arguments arguments;
};

/// `words` without the program's name. The first of `commands` is the default verb: `dem-report SCENARIO` is
/// `dem-report run SCENARIO`. Throws dem::InputError that says what would be right.
Call parse(std::span<const Command> commands, const std::vector<std::string>& words);

/// nullptr when there is none of that name.
const Command* find_command(std::span<const Command> commands, std::string_view name);

}  // namespace cli
