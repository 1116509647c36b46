// dem-report completion: what a shell sources to complete the words of this program.
#include <iostream>

#include "reports/commands/shells.h"
#include "reports/commands/table.h"
#include "reports/commands/verbs.h"

namespace cli {
namespace {

int perform(const Arguments& arguments) {
  std::cout << completion(arguments.word("SHELL"), commands());
  return 0;
}

}  // namespace

Command verbs::completion() {
  return {
      .name = "completion",
      .summary = "print what a shell needs to complete verbs, options and files",
      .details = "The Debian package and cmake --install put these scripts where the shells look.",
      .positionals = {{.name = "SHELL", .help = "for which shell", .choices = shells()}},
      .examples = {{"source <(dem-report completion bash)", "for this session of bash"},
                   {"dem-report completion fish > ~/.config/fish/completions/dem-report.fish", "for good, in fish"}},
      .exit_codes = usual_exit_codes(),
      .perform = perform};
}

}  // namespace cli
