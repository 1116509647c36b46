#include "reports/commands/executor.h"

#include <algorithm>
#include <stdexcept>

namespace cli {

std::span<const Executor> executors() {
  static const std::vector<Executor> table = {local_executor(), slurm_executor()};
  return table;
}

const Executor& find_executor(std::string_view name) {
  const auto at = std::ranges::find(executors(), name, &Executor::name);
  if (at == executors().end()) throw std::logic_error("no executor " + std::string(name));
  return *at;
}

std::vector<Option> executor_options() {
  std::vector<std::string> names;
  for (const Executor& executor : executors()) names.emplace_back(executor.name);
  return {{.name = "executor",
           .value = "WHERE",
           .help = "where to simulate; slurm: as jobs of a cluster, see docs/use/cluster.md",
           .kind = OptionKind::text,
           .standard = "local",
           .choices = names},
          {.name = "partition", .value = "P", .help = "slurm: the partition of the jobs", .kind = OptionKind::text},
          {.name = "time-limit",
           .value = "T",
           .help = "slurm: the time limit of a job, as sbatch takes it: 90, 4:00:00, 1-12",
           .kind = OptionKind::text},
          {.name = "cases-per-job",
           .value = "N",
           .help = "slurm: cases in a job; when not given, as many as take 20 minutes",
           .kind = OptionKind::number,
           .low = 1,
           .high = 100000},
          {.name = "sbatch",
           .value = "OPTIONS",
           .help = "slurm: more options for sbatch: --sbatch '--account=rock --qos=long'",
           .kind = OptionKind::text,
           .repeatable = true,
           .dashes = true},
          {.name = "detach", .help = "slurm: leave when the jobs are submitted; the same command goes on"}};
}

ExecutorRequest executor_request(const Arguments& arguments) {
  ExecutorRequest request;
  request.name = arguments.text("executor");
  request.partition = arguments.text("partition");
  request.time_limit = arguments.text("time-limit");
  if (arguments.has("cases-per-job")) request.cases_per_job = arguments.number("cases-per-job");
  request.sbatch = arguments.texts("sbatch");
  request.detach = arguments.has("detach");
  request.threads_given = arguments.has("threads");
  return request;
}

}  // namespace cli
