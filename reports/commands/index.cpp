// dem-report index: one page over the studies of a folder.
#include <iostream>
#include <optional>

#include "engine/core/errors.h"
#include "reports/commands/assets.h"
#include "reports/commands/night.h"
#include "reports/commands/study_options.h"
#include "reports/commands/verbs.h"
#include "reports/overview/index.h"

namespace cli {
namespace {

int perform(const Arguments& arguments) {
  const std::filesystem::path folder = arguments.word("DIR");
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw dem::InputError({}, "DIR", "there is no folder " + folder.string(),
                          "give the folder that a run has written to");
  }
  std::optional<overview::History> history;
  if (arguments.has("history")) history = overview::read_history(arguments.text("history"));
  const std::vector<overview::StudyRow> rows = overview::read_rows(folder, true);
  if (rows.empty()) {
    throw dem::InputError({}, "DIR", "no study lies in " + folder.string(),
                          "give the folder that a run has written to");
  }
  overview::write_index(folder, rows, history ? &*history : nullptr, assets_folder());
  if (!arguments.has("quiet")) std::cout << (folder / "index.html").string() << "\n";
  return 0;
}

}  // namespace

Command verbs::index() {
  return {
      .name = "index",
      .summary = "make one page over all studies of a folder",
      .details =
          "Writes DIR/index.html and DIR/index.json: a row a study, what failed first, with filters; with a history "
          "also where a number stepped.",
      .positionals = {{.name = "DIR", .help = "the folder that runs have written to", .kind = OptionKind::folder}},
      .options = {history_option(), {.name = "quiet", .help = "print nothing but errors"}},
      .examples = {{"dem-report index out --history history.jsonl", "with sparklines and steps"}},
      .exit_codes = usual_exit_codes(),
      .perform = perform};
}

}  // namespace cli
