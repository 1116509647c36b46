#include "reports/cluster/slurm.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/core/errors.h"
#include "engine/core/text.h"
#include "reports/cluster/process.h"

namespace cluster {
namespace {

constexpr double warning = 120;  // s before the limit: a checkpoint takes seconds, slow disks and large specimens more

std::optional<std::size_t> whole(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(at, from), text.size());
    parts.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return parts;
}

std::string words_of(const Said& said) {
  std::string text = dem::printable(said.err.empty() ? said.out : said.err, true);
  while (text.ends_with('\n')) text.pop_back();
  return text.empty() ? fmt::format("it said nothing, and ended with {}", said.code) : text;
}

/// Time before the limit at which a job is warned: a quarter of a short limit.
int warning_of(const std::string& time_limit) {
  const double limit = seconds_of_limit(time_limit).value_or(4 * warning);
  return static_cast<int>(std::clamp(limit / 4, 10.0, warning));
}

/// Where Slurm writes what a job says. It reads %% as %, and with a backslash anywhere no pattern at all: one log for all then.
std::string log_pattern(const std::filesystem::path& folder) {
  const std::string text = folder.string();
  const bool literal = text.find('\\') != std::string::npos;
  std::string pattern;
  for (const char c : text) {
    pattern += c;
    if (c == (literal ? '\\' : '%')) pattern += c;
  }
  return pattern + (literal ? "/log/all.txt" : "/log/%A_%a.txt");
}

}  // namespace

std::filesystem::path log_of(const std::filesystem::path& folder, const std::string& job, std::size_t element) {
  if (folder.string().find('\\') != std::string::npos) return folder / "log" / "all.txt";
  return folder / "log" / fmt::format("{}_{}.txt", job, element);
}

std::size_t max_array_size() {
  const Said said = run_words({"scontrol", "show", "config"});
  if (said.code == 127) {
    throw dem::EnvironmentError(
        "there is no Slurm here (scontrol is not found); run without --executor slurm, or on a "
        "machine from which sbatch works");
  }
  if (said.code != 0) throw dem::EnvironmentError("Slurm does not answer: " + words_of(said));
  return max_array_size_in(said.out);
}

std::size_t max_array_size_in(std::string_view config) {
  constexpr std::size_t of_slurm = 1001;
  for (const std::string_view line : split(config, '\n')) {
    if (!line.starts_with("MaxArraySize")) continue;
    const std::size_t at = line.find_first_of("0123456789");
    if (at == std::string_view::npos) continue;
    const auto number = whole(line.substr(at, line.find_last_of("0123456789") - at + 1));
    if (number && *number > 0) return *number;
  }
  return of_slurm;
}

std::optional<double> seconds_of_limit(std::string_view text) {
  double days = 0;
  bool has_days = false;
  if (const std::size_t dash = text.find('-'); dash != std::string_view::npos) {
    const auto number = whole(text.substr(0, dash));
    if (!number) return {};
    days = static_cast<double>(*number);
    has_days = true;
    text.remove_prefix(dash + 1);
  }
  std::vector<double> parts;
  for (const std::string_view part : split(text, ':')) {
    const auto number = whole(part);
    if (!number) return {};
    parts.push_back(static_cast<double>(*number));
  }
  if (parts.size() > 3) return {};
  // From the largest unit: hours where days stand before, else minutes, or hours where there are three parts.
  const double first = has_days || parts.size() == 3 ? 3600 : 60;
  double seconds = 86400 * days, unit = first;
  for (const double part : parts) {
    seconds += part * unit;
    unit /= 60;
  }
  return seconds;
}

std::vector<std::string> sbatch_words(const Submission& s) {
  std::vector<std::string> words = {"sbatch",
                                    "--parsable",
                                    "--job-name=dem-report",
                                    fmt::format("--array=0-{}", s.count - 1),
                                    "--nodes=1",
                                    "--ntasks=1",
                                    fmt::format("--cpus-per-task={}", s.threads),
                                    fmt::format("--mem={}M", std::max<std::uint64_t>(s.memory >> 20, 1)),
                                    "--requeue",
                                    "--open-mode=append",
                                    fmt::format("--signal=B:USR1@{}", warning_of(s.time_limit)),
                                    "--chdir=" + s.folder.string(),
                                    "--output=" + log_pattern(s.folder)};
  if (!s.after.empty()) words.push_back(fmt::format("--dependency=afterany:{}", fmt::join(s.after, ":")));
  if (!s.partition.empty()) words.push_back("--partition=" + s.partition);
  if (!s.time_limit.empty()) words.push_back("--time=" + s.time_limit);
  words.insert(words.end(), s.more.begin(), s.more.end());
  words.insert(words.end(),
               {(s.folder / "job.sh").string(), s.program.string(), s.output.string(), std::to_string(s.first)});
  return words;
}

std::string submit(const Submission& submission) {
  const Said said = run_words(sbatch_words(submission));
  if (said.code == 127) {
    throw dem::EnvironmentError("there is no Slurm here (sbatch is not found); run without --executor slurm");
  }
  const std::string id = said.out.substr(0, said.out.find_first_of(";\n"));  // "12" or "12;cluster"
  if (said.code != 0 || !whole(id)) throw dem::EnvironmentError("Slurm takes no job: " + words_of(said));
  return id;
}

std::string_view job_script() {
  return R"sh(#!/bin/sh
# One element of a job array of dem-report: runs the cases of a pack, in the folder of the run.
# Its words: the program, the output folder, the pack of element 0.
warned= child=
trap 'warned=yes; [ -z "$child" ] || kill -TERM "$child"' USR1 # the time limit is near: keep the state, queue again
trap : TERM # cancelled or pre-empted: the program has been told too
"$1" run-case "$2" --manifest manifest.jsonl --pack "$(($3 + SLURM_ARRAY_TASK_ID))" \
  --threads "${SLURM_CPUS_PER_TASK:-1}" </dev/null &
child=$!
[ -z "$warned" ] || kill -TERM "$child"
while :; do
  wait "$child" # a signal ends it early
  code=$?
  kill -0 "$child" 2>/dev/null || break
done
if [ -n "$warned" ] && [ "$code" -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 100 ]; then
  echo "the time is over: queued again"
  scontrol requeue "$SLURM_JOB_ID"
fi
exit "$code"
)sh";
}

std::optional<Queue> queue(const std::function<bool()>& stopped) {
  const Said said = run_words(
      {"squeue", "--noheader", "--array", fmt::format("--user={}", ::geteuid()), "--format=%F|%K|%T|%r"}, stopped);
  if (said.code != 0) return {};
  return queue_in(said.out);
}

Queue queue_in(std::string_view squeue) {
  Queue queue;
  for (const std::string_view line : split(squeue, '\n')) {
    const auto parts = split(line, '|');
    if (parts.size() < 4) continue;
    const auto element = whole(parts[1]);  // "N/A": no array, so none of ours
    if (!element) continue;
    queue[{std::string(parts[0]), *element}] = {std::string(parts[2]), std::string(parts[3])};
  }
  return queue;
}

}  // namespace cluster
