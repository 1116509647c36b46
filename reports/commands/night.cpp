#include "reports/commands/night.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <optional>
#include <string_view>

#include "engine/core/files.h"
#include "engine/study/progress.h"
#include "reports/cluster/estimate.h"
#include "reports/commands/assets.h"
#include "reports/commands/study_options.h"
#include "reports/output/summary.h"
#include "reports/overview/for_ci.h"
#include "reports/overview/history.h"
#include "reports/overview/index.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr double usual_report_seconds = 10;  // when no earlier run tells

}  // namespace

Option history_option() {
  return {.name = "history",
          .value = "FILE",
          .help = "file with the numbers night by night, a JSON object a line",
          .kind = OptionKind::file};
}

std::vector<Option> night_options() {
  Option reference = reference_option();
  reference.help = "compare each study with DIR/NAME.SCALE; what changed beyond tolerance is not well";
  return {reference,
          {.name = "junit", .value = "FILE", .help = "also write what a CI reads: JUnit XML", .kind = OptionKind::file},
          {.name = "markdown", .value = "FILE", .help = "also write a summary in Markdown", .kind = OptionKind::file},
          history_option(),
          {.name = "label",
           .value = "TEXT",
           .help = "with --history: the commit or version that this run is of",
           .kind = OptionKind::text},
          {.name = "progress",
           .value = "FORM",
           .help = "how progress is told on stderr: json is an object a line",
           .kind = OptionKind::text,
           .standard = "text",
           .choices = {"text", "json"}},
          {.name = "dry-run", .help = "say which cases would be simulated, why, and for how long; write nothing"}};
}

NightRequest night_request(const Arguments& arguments) {
  NightRequest request{arguments.text("reference"), arguments.text("junit"), arguments.text("markdown"),
                       arguments.text("history"), arguments.text("label")};
  if (arguments.has("label") && !arguments.has("history")) {
    throw dem::InputError({}, "--label", "it names a line of a history, and there is none", "add --history FILE");
  }
  return request;
}

void end_night(const NightRequest& request, const fs::path& output, const std::vector<std::string>& folders,
               bool strict) {
  const bool many = folders.size() > 1;
  const bool rows_needed = many || !request.junit.empty() || !request.markdown.empty() || !request.history.empty();
  if (!rows_needed) return;
  std::vector<overview::StudyRow> rows;
  for (const std::string& folder : folders) {
    rows.push_back(overview::read_row(output / folder, false));
    rows.back().folder = folder;
  }
  if (!request.history.empty()) {
    overview::append_history(request.history, rows, request.label,
                             fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
  }
  if (many) {
    std::optional<overview::History> history;
    if (!request.history.empty()) history = overview::read_history(request.history);
    overview::write_index(output, overview::read_rows(output, true), history ? &*history : nullptr, assets_folder());
  }
  overview::sort_rows(rows);
  if (!request.junit.empty()) dem::write_file(request.junit, overview::junit(rows, strict));
  if (!request.markdown.empty()) dem::write_file(request.markdown, overview::markdown(rows));
}

void write_failure(const fs::path& folder, const std::string& error) {
  try {
    dem::write_file(folder / "run.json", reports::run_json({{"error", error}}));
  } catch (const dem::EnvironmentError&) {
    // The folder itself may be what is in the way; the error was told.
  }
}

StudyPlan plan_of(const dem::Study& study, const dem::StudyOptions& options) {
  StudyPlan plan;
  const std::vector<cluster::Estimate> estimates = cluster::estimates(study, options.output);
  double work = 0, longest = 0;
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const dem::CaseSpec& spec = study.cases[i];
    std::string why = dem::why_to_run(options.output, study, spec);
    if (why.empty() && options.force) why = "asked for by --force";
    if (!options.only_case.empty() && options.only_case != spec.id) {
      plan.lines.push_back(spec.id + ": left out");
    } else if (why.empty()) {
      plan.lines.push_back(spec.id + ": kept, nothing it depends on has changed");
    } else if (options.report_only) {
      plan.lines.push_back(spec.id + ": no record to draw from (" + why + ")");
    } else {
      plan.lines.push_back(fmt::format("{}: to simulate, {}; about {} ({})", spec.id, why,
                                       dem::duration_text(estimates[i].seconds), estimates[i].from));
      ++plan.to_run;
      work += estimates[i].seconds;
      longest = std::max(longest, estimates[i].seconds);
    }
  }
  const overview::StudyRow earlier = overview::read_row(options.output / study.folder(), false);
  const double report = earlier.report_seconds > 0 ? earlier.report_seconds : usual_report_seconds;
  plan.seconds = std::max(longest, work / std::max(1, options.threads)) + report;
  return plan;
}

void print_dry_run(std::span<const dem::Study> studies, const dem::StudyOptions& options) {
  double seconds = 0;
  std::size_t cases = 0, to_run = 0;
  for (const dem::Study& study : studies) {
    const StudyPlan plan = plan_of(study, options);
    std::cout << fmt::format("{}: {} of {} cases to simulate, about {} with the report\n", study.folder(), plan.to_run,
                             study.cases.size(), dem::duration_text(plan.seconds));
    for (const std::string& line : plan.lines) std::cout << "  " << line << "\n";
    seconds += plan.seconds;
    cases += study.cases.size();
    to_run += plan.to_run;
  }
  std::cout << fmt::format("all: {} of {} cases to simulate, about {}; nothing was written\n", to_run, cases,
                           dem::duration_text(seconds));
}

void annotate(const dem::InputError& error) {
  const char* github = std::getenv("GITHUB_ACTIONS");
  if (!github || std::string_view(github) != "true") return;
  const dem::Location& where = error.where();
  std::cout << overview::github_annotation(where.line > 0 ? where.file : "", where.line, where.column, error.what())
            << "\n";
}

}  // namespace cli
