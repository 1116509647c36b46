#pragma once
// How a page is made again: the files to be saved, what they hold, and the command.
#include "engine/scenario/scenario.h"
#include "reports/options.h"
#include "reports/template.h"

namespace reports {

/// The command, and which files have to be saved before it is given.
[[nodiscard]] PageData again_data(const dem::Scenario& scenario, const Again& again);

/// The scenario and the rock that it includes, to be read and saved. `printed`: on paper, in columns.
[[nodiscard]] PageData sources_data(const dem::Scenario& scenario, const Again& again, bool printed);

}  // namespace reports
