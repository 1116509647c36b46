// The cases of a study side by side on the threads of this machine.
#include "engine/core/errors.h"
#include "reports/commands/executor.h"
#include "reports/commands/terminal.h"

namespace cli {
namespace {

void check(const RunRequest& request) {
  const ExecutorRequest& asked = request.executor;
  const auto refuse = [](const char* option) {
    throw dem::InputError({}, option, "belongs to a cluster", "add --executor slurm, or leave it out");
  };
  if (!asked.partition.empty()) refuse("--partition");
  if (!asked.time_limit.empty()) refuse("--time-limit");
  if (asked.cases_per_job > 0) refuse("--cases-per-job");
  if (!asked.sbatch.empty()) refuse("--sbatch");
  if (asked.detach) refuse("--detach");
}

std::optional<CaseSource> begin(const Work& work) {
  return [work](const dem::Study& study) {
    work.progress.start(static_cast<int>(study.cases.size()));
    return dem::run_study(study, study_options(work.request), progress_listener(work.progress));
  };
}

}  // namespace

Executor local_executor() { return {"local", &check, &begin}; }

}  // namespace cli
