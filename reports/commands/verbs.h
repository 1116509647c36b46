#pragma once
// The commands of the program, one function and one file each; table.cpp lists them.
#include "reports/commands/command.h"

namespace cli::verbs {

Command run();         ///< run.cpp
Command calibrate();   ///< calibrate.cpp
Command compare();     ///< compare.cpp
Command accept();      ///< accept.cpp
Command index();       ///< index.cpp
Command plan();        ///< plan.cpp
Command run_case();    ///< run_case.cpp
Command collect();     ///< collect.cpp
Command figures();     ///< figures.cpp
Command keys();        ///< keys.cpp
Command results();     ///< results.cpp
Command help();        ///< help.cpp
Command completion();  ///< completion.cpp
Command version();     ///< version.cpp

}  // namespace cli::verbs
