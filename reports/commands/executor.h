#pragma once
// Where the cases of a run are simulated. An executor is one file and one line in executors(); what it runs, dem::run_study() or
// run-case, does not know of it.
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/study/progress.h"
#include "engine/study/study.h"
#include "reports/commands/command.h"
#include "reports/commands/run.h"

namespace cli {

/// What is to be done. Lives as long as the run.
struct Work {
  const RunRequest& request;
  std::span<const dem::Study> studies;
  dem::ProgressPrinter& progress;
};

/// Gives the outcomes of a study of the work when all its cases have ended. Throws as dem::run_study().
using CaseSource = std::function<std::vector<dem::CaseOutcome>(const dem::Study&)>;

struct Executor {
  std::string_view name;
  /// Throws dem::InputError for options that do not go with it, before anything is written.
  void (*check)(const RunRequest&);
  /// Nothing when there is nothing to report now (--detach), which has been said then.
  std::optional<CaseSource> (*begin)(const Work&);
};

Executor local_executor();  ///< executor_local.cpp: the threads of this machine
Executor slurm_executor();  ///< executor_slurm.cpp: job arrays over a shared folder

std::span<const Executor> executors();
const Executor& find_executor(std::string_view name);  ///< one of executors()

/// --executor and what belongs to one of them.
std::vector<Option> executor_options();
ExecutorRequest executor_request(const Arguments& arguments);

/// What a run is made of in the engine.
dem::StudyOptions study_options(const RunRequest& request);

}  // namespace cli
