// dem-report version.
#include <iostream>

#include "reports/commands/verbs.h"

namespace cli {
namespace {

int perform(const Arguments&) {
  std::cout << "dem-report " << DEM_VERSION << "\n";
  return 0;
}

}  // namespace

Command verbs::version() {
  return {.name = "version", .summary = "print the version", .exit_codes = usual_exit_codes(), .perform = perform};
}

}  // namespace cli
