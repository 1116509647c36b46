// dem-report help: what the program and its commands take.
#include <iostream>

#include "engine/core/errors.h"
#include "engine/scenario/suggest.h"
#include "reports/commands/help_text.h"
#include "reports/commands/man_page.h"
#include "reports/commands/parse.h"
#include "reports/commands/table.h"
#include "reports/commands/verbs.h"

namespace cli {
namespace {

int perform(const Arguments& arguments) {
  const std::string& verb = arguments.word("VERB");
  if (arguments.has("man")) {
    std::cout << man_page(commands(), DEM_VERSION, DEM_DATE);
    return 0;
  }
  if (verb.empty()) {
    std::cout << program_help(commands());
    return 0;
  }
  const Command* command = find_command(commands(), verb);
  if (!command) {
    std::vector<std::string> known;
    for (const Command& other : commands()) known.push_back(other.name);
    throw dem::InputError({}, verb, "unknown verb", dem::advice(verb, known, "the verbs are"));
  }
  std::cout << command_help(*command);
  return 0;
}

}  // namespace

Command verbs::help() {
  return {.name = "help",
          .summary = "print help for the program, or for one verb",
          .positionals = {{.name = "VERB", .help = "what to explain", .least = 0, .verbs = true}},
          .options = {{.name = "man", .help = "print the manual page, which tells all, as roff"}},
          .examples = {{"dem-report help run", "the same as dem-report run --help"}},
          .exit_codes = usual_exit_codes(),
          .perform = perform};
}

}  // namespace cli
