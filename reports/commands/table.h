#pragma once
// The table of commands.
#include <span>

#include "reports/commands/command.h"

namespace cli {

/// In the order of help. The first one is performed when no verb is given.
std::span<const Command> commands();

}  // namespace cli
