// dem-report figures: what can be drawn, and which published figure it mirrors.
#include <iostream>

#include "reports/commands/verbs.h"
#include "reports/output/report.h"

namespace cli {
namespace {

int perform(const Arguments&) {
  std::cout << reports::list_figures();
  return 0;
}

}  // namespace

Command verbs::figures() {
  return {.name = "figures",
          .summary = "list the figures and the published figures that they mirror",
          .details =
              "One line a figure, grouped by model: its id (for --only and for the key 'figures' of a scenario), "
              "what it mirrors, its title, and the scenarios that show it.",
          .exit_codes = usual_exit_codes(),
          .perform = perform};
}

}  // namespace cli
