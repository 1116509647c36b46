// dem-report run: scenarios -> simulation -> reports.
#include "reports/commands/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "engine/core/errors.h"
#include "engine/core/instruction_set.h"
#include "engine/core/text.h"
#include "engine/study/study.h"
#include "reports/commands/again.h"
#include "reports/commands/assets.h"
#include "reports/commands/executor.h"
#include "reports/commands/machine.h"
#include "reports/commands/reporter.h"
#include "reports/commands/signals.h"
#include "reports/commands/study_options.h"
#include "reports/commands/terminal.h"
#include "reports/commands/verbs.h"
#include "reports/comparison/tolerances.h"
#include "reports/output/drawing.h"
#include "reports/output/pdf.h"
#include "reports/published/papers.h"

namespace cli {
namespace {

ReporterOptions reporter_options(const RunRequest& request) {
  ReporterOptions options;
  options.output = request.output;
  options.assets = assets_folder();
  options.html = request.html;
  options.pdf = request.pdf;
  options.figure = request.figure;
  options.part = part_folder(request);
  options.dpi = request.dpi;
  options.threads = request.threads;
  options.quiet = request.quiet;
  options.strict = request.strict;
  options.pdf_seconds = request.pdf_seconds;
  options.stop = &stop_asked();
  options.reference = request.night.reference;
  return options;
}

/// Reports one study, and says on the way what a person waits for. An error of the machine ends this study alone when there
/// are others.
class Night {
 public:
  Night(const RunRequest& request, std::span<const dem::Study> studies, dem::ProgressPrinter& progress,
        const std::filesystem::path& shipped)
      : request_(request), studies_(studies), progress_(progress), shipped_(shipped) {
    if (studies.size() < 2 || request.quiet) return;
    for (const dem::Study& study : studies) {
      plans_.push_back(plan_of(study, study_options(request)));
      seconds_ += plans_.back().seconds;
    }
  }

  /// True when all is well with it.
  bool report(std::size_t at, const CaseSource& outcomes_of, Reporter& reporter) {
    const dem::Study& study = studies_[at];
    begin(at);
    try {
      const auto outcomes = outcomes_of(study);
      progress_.say("drawing the figures and the report");
      return reporter.report(study, outcomes, how_again(request_, study.scenario, shipped_, Home::clone),
                             how_again(request_, study.scenario, shipped_, Home::installed));
    } catch (const dem::EnvironmentError& error) {
      if (studies_.size() < 2) throw;
      progress_.clear();
      std::cerr << "dem-report: " << study.folder() << ": " << dem::printable(error.what(), true) << "\n";
      write_failure(request_.output / study.folder(), error.what());
      failed_ = true;
      return false;
    }
  }

  [[nodiscard]] bool failed() const { return failed_; }  ///< a study could not run

 private:
  void begin(std::size_t at) {
    if (plans_.empty()) return;
    double left = 0;
    for (std::size_t i = at; i < plans_.size(); ++i) left += plans_[i].seconds;
    progress_.say(fmt::format("[{}/{}] {}: {} of {} cases to simulate, about {}; all: about {} left", at + 1,
                              studies_.size(), studies_[at].folder(), plans_[at].to_run, studies_[at].cases.size(),
                              dem::duration_text(plans_[at].seconds), dem::duration_text(left)));
  }

  const RunRequest& request_;
  std::span<const dem::Study> studies_;
  dem::ProgressPrinter& progress_;
  const std::filesystem::path& shipped_;
  std::vector<StudyPlan> plans_;
  double seconds_ = 0;
  bool failed_ = false;
};

/// What became of a run that was stopped, and how to go on.
std::string stopped_text(const dem::Interrupted& interrupted, const std::string& folder) {
  std::string text = "dem-report: stopped; ";
  if (interrupted.kept > 0) {
    text += "finished cases and the state of those at hand are kept in " + folder;
  } else if (interrupted.from_anew > 0) {
    text += "finished cases are kept in " + folder;
  } else {
    text += "what is finished is kept in " + folder;
  }
  if (interrupted.from_anew > 0) {
    text += interrupted.kept > 0 ? ", but for " + std::to_string(interrupted.from_anew) + " that will begin anew"
                                 : "; what was at hand had no state to keep yet and begins anew";
  }
  return text + ": give the same command to go on\n";
}

int perform(const Arguments& arguments) {
  const RunRequest request = run_request(arguments);
  find_executor(request.executor.name).check(request);
  if (request.report_only) {
    for (const dem::Study& study : checked_studies(request)) dem::check_records(study, study_options(request));
  }
  return run(request);
}

std::vector<Option> options() {
  std::vector<Option> all = {output_option(), scale_option(), threads_option(),
                             seed_option(),   case_option(),  set_option()};
  const auto add = [&](std::vector<Option> more) { all.insert(all.end(), more.begin(), more.end()); };
  add({{.name = "report-only", .help = "draw from the records that are there, simulate nothing"},
       {.name = "force", .help = "simulate also the cases whose record is current"}});
  add(report_options());
  add(night_options());
  add(executor_options());
  add({quiet_option(),
       {.name = "explain-keys", .help = "the same as dem-report keys", .verb = "keys"},
       {.name = "list-figures", .help = "the same as dem-report figures", .verb = "figures"},
       {.name = "version", .help = "print the version", .verb = "version"}});
  return all;
}

}  // namespace

dem::StudyOptions study_options(const RunRequest& request) {
  dem::StudyOptions options;
  options.output = request.output;
  options.threads = request.threads;
  options.memory = memory_bytes();
  options.only_case = request.only_case;
  options.report_only = request.report_only;
  options.force = request.force;
  options.stop = &stop_asked();
  return options;
}

std::vector<dem::Study> checked_studies(const RunRequest& request) {
  std::vector<dem::Study> studies = read_studies(request.scenarios, request.scale, request.overrides);
  for (const dem::Study& study : studies) {
    dem::check_case(study, request.only_case);
    reports::chosen_figures({&study.scenario, {}}, request.figure);
    reports::check_topics(study.scenario, assets_folder() / "papers");
  }
  if (!request.night.reference.empty()) comparison::read_tolerances(request.night.reference);
  return studies;
}

int run(const RunRequest& request) {
  const std::vector<dem::Study> studies = checked_studies(request);
  for (const dem::Study& study : studies) {
    for (const std::string& note : study.notes) std::cerr << "dem-report: note: " << note << "\n";
  }
  if (request.dry_run) {
    print_dry_run(studies, study_options(request));
    return 0;
  }
  const Executor& executor = find_executor(request.executor.name);
  executor.check(request);
  if (request.pdf) reports::check_printing();
  (void)dem::instruction_sets();  // a wrong DEM_SIMD is found before anything runs
  const std::filesystem::path shipped = shipped_scenarios(assets_folder());
  listen_to_signals();
  dem::ProgressPrinter progress = progress_printer(request.quiet, request.json_progress);
  ReporterOptions options = reporter_options(request);
  options.drawing = [&](std::size_t done, std::size_t all) { progress.count("drawing", done, all); };
  options.before_words = [&] { progress.clear(); };
  Reporter reporter(options);
  bool well = true;
  bool failed = false;
  try {
    reports::check_drawing([] { return stop_asked().load(); });
    const Work work{request, studies, progress};
    const std::optional<CaseSource> outcomes_of = executor.begin(work);
    if (!outcomes_of) return 0;
    Night night(request, studies, progress, shipped);
    std::vector<std::string> folders;
    for (std::size_t i = 0; i < studies.size(); ++i) {
      well = night.report(i, *outcomes_of, reporter) && well;
      folders.push_back(part_folder(request).empty() ? studies[i].folder()
                                                     : studies[i].folder() + "/" + part_folder(request));
    }
    failed = night.failed();
    end_night(request.night, request.output, folders, request.strict);
  } catch (const dem::Interrupted& interrupted) {
    progress.clear();
    std::cerr << stopped_text(interrupted, request.output.string());
    return interrupted.signal != 0 ? 128 + interrupted.signal : exit_code_of_signal();
  }
  return failed ? 3 : well ? 0 : 1;
}

std::vector<Option> report_options() {
  return {
      {.name = "only",
       .value = "FIGURE",
       .help = "draw only this figure, into the folder only.FIGURE of the report",
       .kind = OptionKind::text},
      {.name = "format",
       .value = "LIST",
       .help = "what to make",
       .kind = OptionKind::list,
       .standard = "html,pdf",
       .choices = {"html", "pdf"}},
      {.name = "dpi",
       .value = "N",
       .help = "resolution of pictures, 85 mm wide in a column and 170 mm over the page",
       .kind = OptionKind::number,
       .standard = "300",
       .low = 72,
       .high = 1200},
      {.name = "pdf-timeout",
       .value = "SECONDS",
       .help = "the longest that printing the PDF may take",
       .kind = OptionKind::number,
       .standard = "900",
       .low = 1,
       .high = 86400},
      {.name = "strict", .help = "exit with 1 also when a published number is missed"},
  };
}

void take_report_options(const Arguments& arguments, RunRequest& request) {
  request.figure = arguments.text("only");
  const auto& formats = arguments.texts("format");
  request.html = std::ranges::find(formats, "html") != formats.end();
  request.pdf = std::ranges::find(formats, "pdf") != formats.end();
  request.dpi = static_cast<double>(arguments.number("dpi"));
  request.pdf_seconds = static_cast<double>(arguments.number("pdf-timeout"));
  request.strict = arguments.has("strict");
}

std::vector<ExitCode> run_exit_codes() {
  std::vector<ExitCode> codes = usual_exit_codes();
  codes.insert(codes.begin() + 1, {"1",
                                   "a case or one of its checks failed, something changed beyond tolerance since the "
                                   "reference (with --strict also: a published number was missed); the report is "
                                   "made all the same"});
  codes.push_back({"129, 130, 143", "stopped by a signal: the same command goes on where it stopped"});
  return codes;
}

RunRequest run_request(const Arguments& arguments) {
  RunRequest request;
  request.scenarios = arguments.words("SCENARIO");
  request.output = output_folder(arguments.text("output"));
  request.scale = arguments.text("scale");
  request.threads = threads(arguments);
  request.overrides = overrides(arguments);
  request.only_case = arguments.text("case");
  take_report_options(arguments, request);
  request.executor = executor_request(arguments);
  request.report_only = arguments.has("report-only");
  request.force = arguments.has("force");
  request.quiet = arguments.has("quiet");
  request.night = night_request(arguments);
  request.json_progress = arguments.text("progress") == "json";
  request.dry_run = arguments.has("dry-run");
  if (!request.night.reference.empty() && (!request.figure.empty() || !request.only_case.empty())) {
    throw dem::InputError({}, "--reference", "does not go with --only or --case",
                          "a part of a study cannot be compared with the whole of it");
  }
  if (request.report_only && request.force) {
    throw dem::InputError({}, "--report-only", "does not go with --force", "choose one of them");
  }
  return request;
}

std::string part_folder(const RunRequest& request) {
  std::string name;
  if (!request.only_case.empty()) name = "case." + request.only_case;
  if (!request.figure.empty()) name += (name.empty() ? "only." : ".only.") + request.figure;
  return name;
}

Command verbs::run() {
  return {.name = "run",
          .summary = "simulate the cases of scenarios and report them",
          .details =
              "A finished case is kept until something that it depends on changes; a run that is cut off goes "
              "on from its last checkpoint. Results and reports lie in DIR/NAME.SCALE.",
          .positionals = {scenario_positional()},
          .options = options(),
          .examples = {{"dem-report scenarios/ldb_aspect_ratio.toml", "simulate and report at draft scale, in minutes"},
                       {"dem-report scenarios/ldb_aspect_ratio.toml --scale paper -o results --threads 2",
                        "the published size, in another folder"},
                       {"dem-report scenarios/ldb_aspect_ratio.toml --report-only", "draw again, simulate nothing"}},
          .exit_codes = run_exit_codes(),
          .perform = perform};
}

}  // namespace cli
