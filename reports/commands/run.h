#pragma once
// What `dem-report run` was asked for; on its own so that it can be tested without running anything.
#include <filesystem>
#include <string>
#include <vector>

#include "engine/study/study.h"
#include "reports/commands/arguments.h"
#include "reports/commands/command.h"
#include "reports/commands/night.h"

namespace cli {

/// Where to simulate; what is not given is empty or 0.
struct ExecutorRequest {
  std::string name = "local";
  std::string partition, time_limit;
  std::size_t cases_per_job = 0;
  std::vector<std::string> sbatch;
  bool detach = false;
  bool threads_given = false;  ///< RunRequest::threads is the user's
};

struct RunRequest {
  std::vector<std::string> scenarios;
  std::filesystem::path output;
  std::string scale;
  int threads = 1;
  std::vector<std::string> overrides;  ///< of --set, then --seed, as "key=value"
  std::string figure;                  ///< --only; "": all
  std::string only_case;               ///< --case; "": all
  bool report_only = false;
  bool force = false;
  bool html = true;
  bool pdf = true;
  double dpi = 0;          ///< --dpi
  double pdf_seconds = 0;  ///< --pdf-timeout
  bool quiet = false;
  bool strict = false;
  ExecutorRequest executor;
  NightRequest night;
  bool json_progress = false;
  bool dry_run = false;
};

/// Throws dem::InputError when options do not go together.
RunRequest run_request(const Arguments& arguments);

/// The options that say what is drawn and what counts as well; collect has them too.
std::vector<Option> report_options();
void take_report_options(const Arguments& arguments, RunRequest& request);

/// Everything that can be wrong with the input is found here, before anything is written: dem::InputError.
std::vector<dem::Study> checked_studies(const RunRequest& request);

/// Simulates and reports; the exit code.
int run(const RunRequest& request);
std::vector<ExitCode> run_exit_codes();

/// The folder below that of the study for a report of one figure or one case ("only.FIGURE", "case.ID", "case.ID.only.FIGURE"),
/// so that the full one stays; "" for the full one.
std::string part_folder(const RunRequest& request);

}  // namespace cli
