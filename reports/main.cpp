// dem-report: from scenarios to reports. The only file that knows engine, render and reports.
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <set>

#include "engine/core/errors.h"
#include "engine/core/instruction_set.h"
#include "engine/study/progress.h"
#include "engine/study/study.h"
#include "render/draw.h"
#include "reports/commands/cli.h"
#include "reports/output/drawing.h"
#include "reports/output/report.h"

namespace {

namespace fs = std::filesystem;

// A signal can reach nothing but these.
std::atomic<bool> stop_asked = false;
volatile std::sig_atomic_t signal_received = 0;

extern "C" void on_signal(int number) {
  signal_received = number;
  stop_asked.store(true);
}

/// The first signal asks the running cases to write their checkpoints and stop; a second one ends the program at once.
void listen_to_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
}

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 100;
}

dem::ProgressPrinter printer(bool quiet) {
  using Mode = dem::ProgressPrinter::Mode;
  const Mode mode = quiet ? Mode::quiet : isatty(STDERR_FILENO) != 0 ? Mode::bar : Mode::lines;
  return {std::cerr, mode, seconds_now, terminal_width()};
}

/// Installed: beside the executable's folder; in the build folder: in the source tree.
fs::path assets_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "share" / "dem-report" / "assets";
  if (!error && fs::is_directory(installed, error)) return installed;
  fs::path source = fs::path(DEM_SOURCE_DIR) / "assets";
  if (fs::is_directory(source, error)) return source;
  throw dem::EnvironmentError("the page template and published numbers are missing: neither " + installed.string() +
                              " nor " + source.string() + " is there; install dem-report again");
}

void require_weasyprint() {
  const char* path = std::getenv("PATH");
  std::string folders = path ? path : "";
  for (std::size_t from = 0; from <= folders.size();) {
    const std::size_t colon = std::min(folders.find(':', from), folders.size());
    const fs::path program = fs::path(folders.substr(from, colon - from)) / "weasyprint";
    if (access(program.c_str(), X_OK) == 0) return;
    from = colon + 1;
  }
  throw dem::EnvironmentError(
      "the PDF needs WeasyPrint, which is not installed: run 'apt-get install weasyprint', or leave the PDF out with "
      "--format html");
}

/// Everything that can be wrong with the input is found here, before anything is written.
std::vector<dem::Study> read_studies(const cli::CommandLine& line) {
  std::vector<dem::Study> studies;
  std::set<std::string> folders;
  for (const std::string& file : line.scenarios) {
    dem::Study study = dem::read_study(file, line.scale, line.overrides, dem::models());
    dem::check_case(study, line.only_case);
    reports::chosen_figures({&study.scenario, {}}, line.figure);
    if (!folders.insert(study.folder()).second) {
      throw dem::InputError(dem::Location{file, 0, 0}, {}, "another scenario of the same name is given",
                            "run them one by one, with different --output folders");
    }
    studies.push_back(std::move(study));
  }
  return studies;
}

dem::StudyListener listener(dem::ProgressPrinter& progress) {
  dem::StudyListener listener;
  listener.begin = [&](const std::string& id, int number, int total, const std::string& why) {
    progress.begin(id, number);
    progress.say(fmt::format("{} ({}/{}): simulated, {}", id, number, total, why));
  };
  listener.progress = [&](const std::string& id, const dem::Progress& now) { progress.update(id, now); };
  listener.note = [&](const std::string& note) { progress.say(note); };
  listener.end = [&](const dem::CaseOutcome& outcome) {
    using dem::CaseState;
    progress.end(outcome.id);
    switch (outcome.state) {
      case CaseState::kept:
        return progress.say(outcome.id + ": kept, nothing it depends on has changed");
      case CaseState::simulated:
        return progress.say(outcome.id + ": done in " + dem::duration_text(outcome.seconds));
      case CaseState::left_out:
        return;
      case CaseState::failed:
      case CaseState::missing:
        return progress.say(outcome.id + ": failed: " + outcome.error);
    }
  };
  return listener;
}

reports::RunFacts run_facts(const cli::CommandLine& line, const std::vector<dem::CaseOutcome>& outcomes) {
  std::string host(256, '\0');
  if (gethostname(host.data(), host.size() - 1) != 0) host.clear();
  host.resize(std::char_traits<char>::length(host.c_str()));
  reports::RunFacts facts = {{"host", host},
                             {"threads", static_cast<double>(line.threads)},
                             {"compiler", std::string("g++ ") + __VERSION__},
                             {"engine_version", std::string(DEM_VERSION)}};
  for (const dem::CaseOutcome& outcome : outcomes) {
    if (outcome.seconds > 0) facts.emplace_back("case_seconds." + outcome.id, outcome.seconds);
  }
  return facts;
}

/// True when every case that was asked for has a record and every check holds; else says what does not.
bool all_well(const std::vector<dem::CaseOutcome>& outcomes) {
  bool well = true;
  for (const dem::CaseOutcome& outcome : outcomes) {
    if (outcome.state == dem::CaseState::failed || outcome.state == dem::CaseState::missing) {
      std::cerr << "dem-report: case " << outcome.id << " failed: " << outcome.error << "\n";
      well = false;
    }
    if (!outcome.record) continue;
    for (const dem::Check& check : outcome.record->checks) {
      if (check.held) continue;
      std::cerr << fmt::format("dem-report: case {}: the check {} does not hold: {:.4g}, limit {:.4g}\n", outcome.id,
                               check.id, check.value, check.limit);
      well = false;
    }
  }
  return well;
}

/// Simulates and reports one study; true when all is well.
bool run(const dem::Study& study, const cli::CommandLine& line, dem::ProgressPrinter& progress,
         std::optional<render::Canvas>& canvas) {
  dem::StudyOptions options;
  options.output = line.output;
  options.threads = line.threads;
  options.memory =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  options.only_case = line.only_case;
  options.report_only = line.report_only;
  options.force = line.force;
  options.stop = &stop_asked;
  progress.start(static_cast<int>(study.cases.size()));
  const std::vector<dem::CaseOutcome> outcomes = dem::run_study(study, options, listener(progress));

  reports::StudyResult result{&study.scenario, {}};
  for (const dem::CaseOutcome& outcome : outcomes) {
    result.cases.push_back({outcome.id, outcome.record ? &*outcome.record : nullptr, outcome.error});
  }
  reports::ReportOptions report;
  report.folder = line.output / study.folder();
  report.assets = assets_folder();
  report.html = line.html;
  report.pdf = line.pdf;
  report.only = line.figure;
  report.command = cli::command_text(line, study.scenario.file());
  report.engine_version = DEM_VERSION;
  report.workers = line.threads;
  progress.say("drawing the figures and the report");
  const auto own_canvas = [&]() -> render::Canvas& {
    if (!canvas) canvas.emplace();
    return *canvas;
  };
  const reports::ReportOutcome made = reports::make_report(result, report, own_canvas, run_facts(line, outcomes));
  if (!line.quiet) {
    for (const fs::path& file : made.files) std::cout << file.string() << "\n" << std::flush;
  }
  const bool met = made.published_all_met || !line.strict;
  if (!met) std::cerr << "dem-report: a published number is missed (see the table in the report)\n";
  return all_well(outcomes) && met;
}

int run(const cli::CommandLine& line) {
  const std::vector<dem::Study> studies = read_studies(line);
  if (line.pdf) require_weasyprint();
  (void)dem::instruction_sets();  // a wrong DEM_SIMD is found before anything runs
  listen_to_signals();
  dem::ProgressPrinter progress = printer(line.quiet);
  std::optional<render::Canvas> canvas;
  bool well = true;
  try {
    for (const dem::Study& study : studies) well = run(study, line, progress, canvas) && well;
  } catch (const dem::Interrupted&) {
    progress.clear();
    std::cerr << "dem-report: stopped; finished cases and the state of those at hand are kept in "
              << line.output.string() << ": give the same command to go on\n";
    return 128 + signal_received;
  }
  return well ? 0 : 1;
}

void print_keys() {
  std::cout << "Keys of every scenario\n" << dem::explain(dem::common_keys());
  for (const dem::Model& model : dem::models()) {
    std::cout << "\nKeys of model = \"" << model.name << "\"\n" << dem::explain(model.keys());
  }
}

int perform(const cli::CommandLine& line) {
  switch (line.action) {
    case cli::Action::help:
      std::cout << cli::help();
      return 0;
    case cli::Action::version:
      std::cout << "dem-report " << DEM_VERSION << "\n";
      return 0;
    case cli::Action::list_figures:
      std::cout << reports::list_figures();
      return 0;
    case cli::Action::explain_keys:
      print_keys();
      return 0;
    case cli::Action::run:
      return run(line);
  }
  return 3;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return perform(cli::parse(std::vector<std::string>(argv + 1, argv + argc)));
  } catch (const dem::InputError& error) {
    std::cerr << "dem-report: " << error.what() << "\n";
    return 2;
  } catch (const dem::EnvironmentError& error) {
    std::cerr << "dem-report: " << error.what() << "\n";
  } catch (const std::bad_alloc&) {
    std::cerr << "dem-report: out of memory; try a smaller --scale\n";
  } catch (const std::exception& error) {
    std::cerr << "dem-report: internal error: " << error.what() << "\n";
  }
  return 3;
}
