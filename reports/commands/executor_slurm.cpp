// The cases as job arrays of Slurm over the shared output folder. What is known of a run lies in OUT/slurm/KEY, so that the same
// command goes on from there: manifest.jsonl, packs.jsonl, jobs.jsonl (what was submitted), job.sh, log/JOB_ELEMENT.txt. Whether a
// case is done is told by its record alone, whether a job is over by squeue.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "engine/core/text.h"
#include "reports/cluster/manifest.h"
#include "reports/cluster/packs.h"
#include "reports/cluster/process.h"
#include "reports/cluster/slurm.h"
#include "reports/commands/executor.h"
#include "reports/commands/plan.h"
#include "reports/commands/signals.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr int most_tries = 2;          // of a case
constexpr double shortest_look = 0.5;  // s between questions to Slurm, at first ...
constexpr double longest_look = 15;    // ... and in a long run
constexpr double settling = 3;         // s that a job may be over before its files are missed: shared folders are slow
constexpr std::uint64_t largest_file = std::uint64_t{64} << 20;

/// An array that was submitted: element k is pack first + k.
struct Job {
  std::string id;
  std::size_t first = 0;
  std::size_t count = 0;
};

std::string to_text(const std::vector<Job>& jobs) {
  std::string text;
  for (const Job& job : jobs) text += Json{{"job", job.id}, {"first", job.first}, {"count", job.count}}.dump() + "\n";
  return text;
}

std::vector<Job> read_jobs(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  std::vector<Job> jobs;
  const std::string text = dem::read_input(file, largest_file);
  try {
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = std::min(text.find('\n', from), text.size());
      const Json json = Json::parse(text.substr(from, end - from));
      jobs.push_back({json.at("job").get<std::string>(), json.at("first").get<std::size_t>(),
                      json.at("count").get<std::size_t>()});
      from = end + 1;
    }
  } catch (const nlohmann::json::exception&) {
    throw dem::InputError(dem::Location{file.string(), static_cast<int>(jobs.size()) + 1, 0}, {},
                          "this is no line of submitted jobs",
                          "remove " + file.parent_path().string() + " to begin anew");
  }
  return jobs;
}

/// The last lines of a log, indented.
std::string tail_of(const fs::path& file) {
  constexpr std::size_t most_lines = 12, most_bytes = 4000;
  std::string text;
  try {
    text = dem::read_file(file);
  } catch (const dem::EnvironmentError&) {
    return "    (there is no such log)\n";
  }
  if (text.size() > most_bytes) text.erase(0, text.size() - most_bytes);
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    lines.push_back("    " + dem::printable(text.substr(from, end - from)) + "\n");
    from = end + 1;
  }
  if (lines.size() > most_lines) lines.erase(lines.begin(), lines.end() - most_lines);
  std::string all;
  for (const std::string& line : lines) all += line;
  return all.empty() ? "    (it is empty)\n" : all;
}

class Cluster {
 public:
  explicit Cluster(const Work& work)
      : work_(work), output_(fs::absolute(work.request.output)), program_(own_program()) {
    most_elements_ = cluster::max_array_size();
    folder_ = output_ / "slurm" / key();
    if (fs::exists(folder_ / "jobs.jsonl")) {
      manifest_ = cluster::read_manifest(folder_ / "manifest.jsonl");
      packs_ = cluster::read_packs(folder_ / "packs.jsonl");
      jobs_ = read_jobs(folder_ / "jobs.jsonl");
    } else {
      std::vector<cluster::Source> sources;
      for (const std::string& scenario : work.request.scenarios) {
        sources.push_back({fs::current_path().string(), scenario, work.request.scale, work.request.overrides});
      }
      manifest_ = cluster::plan({work.studies.begin(), work.studies.end()}, sources, output_, work.request.only_case);
    }
    cases_.resize(manifest_.size());
    for (std::size_t i = 0; i < manifest_.size(); ++i) find_case(manifest_[i], cases_[i]);
  }

  /// True when the cases have ended; false when it was left (--detach).
  bool run() {
    if (manifest_.empty()) return true;
    const bool goes_on = !jobs_.empty();
    if (!goes_on) {
      dem::make_folder(folder_ / "log");
      dem::write_file(folder_ / "manifest.jsonl", cluster::to_text(manifest_));
      dem::write_file(folder_ / "job.sh", cluster::job_script());
      std::vector<std::size_t> lines;
      for (std::size_t i = 1; i <= manifest_.size(); ++i) lines.push_back(i);
      add_packs(lines);
    } else {
      say(fmt::format("goes on with {}", jobs_text()));
    }
    submit_packs();
    if (work_.request.executor.detach) {
      if (goes_on) retry_once();
      std::cout << fmt::format(
          "{} of {} cases are left to {}; the same command without --detach waits and reports, scancel {} "
          "cancels them\n",
          open_cases(), cases_.size(), jobs_text(), ids_text());
      return false;
    }
    wait();
    return true;
  }

  /// What the report says in the place of a case that has no result; "" when it has one or left its own words.
  [[nodiscard]] std::string words_for(const std::string& study, const std::string& id) const {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (manifest_[i].study != study || manifest_[i].case_id != id || cases_[i].kept) continue;
      return fmt::format("Its job ended {} times without a result.", cases_[i].tries);
    }
    return {};
  }

  /// What is left behind: nothing when all is well, else the logs.
  void end() {
    std::error_code ignored;
    if (manifest_.empty()) return;
    if (std::ranges::all_of(cases_, &Case::kept)) {
      fs::remove_all(folder_, ignored);
      fs::remove(folder_.parent_path(), ignored);  // when empty
    } else {
      fs::remove(folder_ / "jobs.jsonl", ignored);  // the next one begins anew
    }
  }

 private:
  struct Case {
    const dem::Study* study = nullptr;
    const dem::CaseSpec* spec = nullptr;
    fs::file_time_type seen{};  ///< the record that was last looked at
    bool kept = false;
    int tries = 0;         ///< submissions
    std::size_t pack = 0;  ///< of its last one
    bool waits = false;    ///< its job is in the queue
    bool given_up = false;
    Clock::time_point gone{};  ///< when its job was first seen to be over
  };

  /// Which run this is: of the same cases with the same content.
  [[nodiscard]] std::string key() const {
    std::string text = work_.request.only_case;
    for (const dem::Study& study : work_.studies) {
      text += "\n" + study.folder();
      for (const dem::CaseSpec& spec : study.cases) text += "\n" + spec.id + "\n" + dem::sha256(spec.content);
    }
    return dem::sha256(text).substr(0, 12);
  }

  static fs::path own_program() {
    std::error_code error;
    fs::path path = fs::read_symlink("/proc/self/exe", error);
    if (error) throw dem::EnvironmentError("cannot tell where dem-report lies: " + error.message());
    return path;
  }

  void find_case(const cluster::Line& line, Case& found) const {
    for (const dem::Study& study : work_.studies) {
      if (study.folder() != line.study) continue;
      const auto spec = std::ranges::find(study.cases, line.case_id, &dem::CaseSpec::id);
      if (spec == study.cases.end() || dem::sha256(spec->content) != line.content) continue;
      found.study = &study;
      found.spec = &*spec;
      return;
    }
    throw dem::InputError(dem::Location{(folder_ / "manifest.jsonl").string(), 0, 0}, {},
                          "it lists other cases than this command", "remove " + folder_.string() + " to begin anew");
  }

  void say(const std::string& text) const { work_.progress.say("slurm: " + text); }

  [[nodiscard]] std::string ids_text() const {
    std::vector<std::string> ids;
    for (const Job& job : jobs_) ids.push_back(job.id);
    return fmt::format("{}", fmt::join(ids, " "));
  }
  [[nodiscard]] std::string jobs_text() const {
    std::size_t elements = 0;
    for (const Job& job : jobs_) elements += job.count;
    return fmt::format("{} job{} in {} array{} ({})", elements, elements == 1 ? "" : "s", jobs_.size(),
                       jobs_.size() == 1 ? "" : "s", ids_text());
  }
  [[nodiscard]] std::size_t open_cases() {
    look_at_records();
    return static_cast<std::size_t>(std::ranges::count(cases_, false, &Case::kept));
  }

  void add_packs(const std::vector<std::size_t>& lines) {
    const ExecutorRequest& asked = work_.request.executor;
    cluster::PackOptions options;
    options.cases_per_job = asked.cases_per_job;
    if (asked.threads_given) options.threads = work_.request.threads;
    // Half of the limit, as estimates are no promises.
    const auto limit = cluster::seconds_of_limit(asked.time_limit);
    if (limit) options.seconds = std::min(options.seconds, *limit / 2);
    const auto missing = [&](const std::string& specimen) {
      std::error_code error;
      return !fs::exists(output_ / "specimens" / specimen, error);
    };
    const auto more = cluster::packs(manifest_, lines, options, missing);
    packs_.insert(packs_.end(), more.begin(), more.end());
    dem::write_file(folder_ / "packs.jsonl", cluster::to_text(packs_));
  }

  /// Submits the packs that no job has yet: those at the end.
  void submit_packs() {
    const std::size_t submitted = jobs_.empty() ? 0 : jobs_.back().first + jobs_.back().count;
    const std::vector<cluster::Pack> rest(packs_.begin() + static_cast<std::ptrdiff_t>(submitted), packs_.end());
    std::vector<std::string> makers;
    const ExecutorRequest& asked = work_.request.executor;
    for (const cluster::Array& array : cluster::arrays(rest, most_elements_)) {
      const bool makes = rest[array.first].specimens_only;
      cluster::Submission submission{.folder = folder_,
                                     .program = program_,
                                     .output = output_,
                                     .first = submitted + array.first,
                                     .count = array.count,
                                     .threads = rest[array.first].threads,
                                     .memory = 0,
                                     .after = makes ? std::vector<std::string>{} : makers,
                                     .partition = asked.partition,
                                     .time_limit = asked.time_limit,
                                     .more = {}};
      for (std::size_t k = 0; k < array.count; ++k) {
        submission.memory = std::max(submission.memory, rest[array.first + k].memory);
      }
      for (const std::string& text : asked.sbatch) {
        const auto words = cluster::split_words(text, "--sbatch");
        submission.more.insert(submission.more.end(), words.begin(), words.end());
      }
      const std::string id = cluster::submit(submission);
      jobs_.push_back({id, submission.first, submission.count});
      dem::write_file(folder_ / "jobs.jsonl", to_text(jobs_));
      if (makes) makers.push_back(id);
      say(fmt::format("job {} submitted: {} of {} thread{}{}", id,
                      submission.count == 1 ? "1 element" : fmt::format("{} elements", submission.count),
                      submission.threads, submission.threads == 1 ? "" : "s",
                      makes ? ", to make specimens that others wait for" : ""));
    }
    count_tries();
  }

  void count_tries() {
    for (Case& c : cases_) c.tries = 0;
    for (const Job& job : jobs_) {
      for (std::size_t p = job.first; p < job.first + job.count && p < packs_.size(); ++p) {
        if (packs_[p].specimens_only) continue;
        for (const std::size_t line : packs_[p].lines) {
          Case& c = cases_.at(line - 1);
          ++c.tries;
          c.pack = p;
          c.gone = {};
        }
      }
    }
  }

  void look_at_records() {
    for (Case& c : cases_) {
      if (c.kept) continue;
      std::error_code error;
      const auto written = fs::last_write_time(dem::case_folder(output_, *c.study, c.spec->id) / "results.h5", error);
      if (error || written == c.seen) continue;
      c.seen = written;
      c.kept = dem::is_kept(output_, *c.study, *c.spec);
    }
  }

  void look_at_queue(const cluster::Queue& queue) {
    std::set<std::size_t> alive;  // packs
    for (const Job& job : jobs_) {
      for (std::size_t k = 0; k < job.count; ++k) {
        if (queue.contains({job.id, k})) alive.insert(job.first + k);
      }
    }
    for (Case& c : cases_) {
      c.waits = alive.contains(c.pack);
      if (c.waits) {
        c.gone = {};
      } else if (c.gone == Clock::time_point{}) {
        c.gone = Clock::now();
      }
    }
  }

  /// Submits once more what ended without a result.
  void try_again() {
    std::vector<std::size_t> lines;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      Case& c = cases_[i];
      if (c.kept || c.waits || c.given_up || Clock::now() - c.gone < std::chrono::duration<double>(settling)) continue;
      if (c.tries >= most_tries) {
        c.given_up = true;
      } else {
        lines.push_back(i + 1);
      }
    }
    if (lines.empty()) return;
    for (const std::size_t line : lines) {
      say(fmt::format("{} ended without a result, and is tried once more", manifest_[line - 1].case_id));
    }
    add_packs(lines);
    submit_packs();
    for (const std::size_t line : lines) cases_[line - 1].waits = true;  // until squeue says otherwise
  }

  /// For who does not wait: what has ended without a result by now.
  void retry_once() {
    const auto queue = cluster::queue([] { return stop_asked().load(); });
    if (!queue) return;
    look_at_records();
    look_at_queue(*queue);
    for (Case& c : cases_)
      c.gone -= std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(settling));
    try_again();
  }

  void tell(const cluster::Queue& queue) {
    int queued = 0, running = 0;
    std::set<std::string> held;
    for (const Job& job : jobs_) {
      for (std::size_t k = 0; k < job.count; ++k) {
        const auto at = queue.find({job.id, k});
        if (at == queue.end()) continue;
        ++(at->second.state == "PENDING" ? queued : running);
        if (at->second.reason.find("eld") != std::string::npos) held.insert(job.id + " (" + at->second.reason + ")");
      }
    }
    const auto done = std::ranges::count(cases_, true, &Case::kept);
    const auto failed = std::ranges::count(cases_, true, &Case::given_up);
    std::string text = fmt::format("{} queued, {} running; {} of {} cases done, {} failed", queued, running, done,
                                   cases_.size(), failed);
    if (!held.empty()) text += fmt::format("; held: {}: scontrol release lets go", fmt::join(held, ", "));
    if (text == told_) return;
    told_ = text;
    say(text);
  }

  void wait() {
    double pause = shortest_look;
    bool answers = true;
    while (true) {
      const auto queue = cluster::queue([] { return stop_asked().load(); });
      if (stop_asked()) leave();
      look_at_records();
      if (queue) {
        look_at_queue(*queue);
        try_again();
        tell(*queue);
        if (std::ranges::all_of(cases_, [](const Case& c) { return c.kept || c.given_up; })) return tell_failures();
      } else if (answers) {
        say("does not answer; the jobs go on, and so does the asking");
      }
      answers = queue.has_value();
      for (double left = pause; left > 0; left -= 0.05) {
        if (stop_asked()) leave();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
      pause = std::min(pause * 1.1, longest_look);
    }
  }

  [[noreturn]] void leave() const {
    work_.progress.clear();
    std::cerr << fmt::format("dem-report: the jobs go on without this program; to cancel them: scancel {}\n",
                             ids_text());
    throw dem::Interrupted{};
  }

  void tell_failures() const {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Case& c = cases_[i];
      if (c.kept) continue;
      const fs::path log = log_of(c.pack);
      work_.progress.clear();
      std::cerr << fmt::format("dem-report: case {} failed {} times; the end of {}:\n{}", manifest_[i].case_id, c.tries,
                               dem::printable(log.string()), tail_of(log));
    }
  }

  [[nodiscard]] fs::path log_of(std::size_t pack) const {
    for (const Job& job : jobs_) {
      if (pack < job.first || pack >= job.first + job.count) continue;
      return cluster::log_of(folder_, job.id, pack - job.first);
    }
    return folder_ / "log";
  }

  const Work& work_;
  fs::path output_, program_, folder_;
  std::size_t most_elements_ = 0;
  cluster::Manifest manifest_;
  std::vector<cluster::Pack> packs_;
  std::vector<Job> jobs_;
  std::vector<Case> cases_;  // one a line
  std::string told_;
};

void check(const RunRequest& request) {
  const ExecutorRequest& asked = request.executor;
  const auto refuse = [](const char* option, const char* right) {
    throw dem::InputError({}, option, "does not go with --executor slurm", right);
  };
  if (request.force) refuse("--force", "remove the records that are to be made again");
  if (request.report_only) refuse("--report-only", "leave out --executor: nothing is simulated");
  if (!asked.time_limit.empty() && !cluster::seconds_of_limit(asked.time_limit)) {
    throw dem::InputError({}, "--time-limit", "'" + asked.time_limit + "' is no time limit",
                          "write minutes (90), hours (4:00:00), or days (1-12)");
  }
  for (const std::string& text : asked.sbatch) (void)cluster::split_words(text, "--sbatch");
}

std::optional<CaseSource> begin(const Work& work) {
  Cluster cluster(work);
  if (!cluster.run()) return {};
  cluster.end();
  return [cluster = std::move(cluster), &work](const dem::Study& study) {
    dem::StudyOptions options = study_options(work.request);
    options.report_only = true;
    auto outcomes = dem::run_study(study, options, {});
    for (dem::CaseOutcome& outcome : outcomes) {
      const std::string words = cluster.words_for(study.folder(), outcome.id);
      if (outcome.state == dem::CaseState::missing && !words.empty()) outcome.error = words;
    }
    return outcomes;
  };
}

}  // namespace

Executor slurm_executor() { return {"slurm", &check, &begin}; }

}  // namespace cli
