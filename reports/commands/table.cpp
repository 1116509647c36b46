#include "reports/commands/table.h"

#include "reports/commands/verbs.h"

namespace cli {

std::span<const Command> commands() {
  static const std::vector<Command> table = {
      verbs::run(),     verbs::calibrate(),  //
      verbs::compare(), verbs::accept(),    verbs::index(),   verbs::plan(), verbs::run_case(),   verbs::collect(),
      verbs::figures(), verbs::keys(),      verbs::results(), verbs::help(), verbs::completion(), verbs::version(),
  };
  return table;
}

}  // namespace cli
