#pragma once
// The manual page dem-report(1), made from the declarations of the commands: roff with the man macros.
#include <span>
#include <string>

#include "reports/commands/command.h"

namespace cli {

/// `version` and the `date` of it, YYYY-MM-DD, stand in the page's foot: the same page whenever and wherever it is made.
std::string man_page(std::span<const Command> commands, const std::string& version, const std::string& date);

}  // namespace cli
