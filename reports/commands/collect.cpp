// dem-report collect: the reports of a plan, from the records that are there.
#include "reports/commands/plan.h"
#include "reports/commands/study_options.h"
#include "reports/commands/verbs.h"

namespace cli {
namespace {

int perform(const Arguments& arguments) {
  RunRequest request = read_plan(output_folder(arguments.word("OUT")));
  take_report_options(arguments, request);
  request.threads = threads(arguments);
  request.quiet = arguments.has("quiet");
  request.report_only = true;
  return run(request);
}

}  // namespace

Command verbs::collect() {
  std::vector<Option> options = report_options();
  options.push_back(threads_option());
  options.push_back(quiet_option());
  return {.name = "collect",
          .summary = "write the reports of a plan",
          .details =
              "The report is the one that dem-report SCENARIO... would have made. Cases without a record are shown as "
              "failed, with what is known of them.",
          .positionals = {{.name = "OUT", .help = "the folder of the plan", .kind = OptionKind::folder}},
          .options = std::move(options),
          .examples = {{"dem-report collect out", "report what has been run of the plan in out"}},
          .exit_codes = run_exit_codes(),
          .perform = perform};
}

}  // namespace cli
