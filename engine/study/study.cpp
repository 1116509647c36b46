#include "engine/study/study.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

#include "engine/core/archive.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "engine/scenario/suggest.h"
#include "engine/store/store.h"

namespace dem {
namespace {

namespace fs = std::filesystem;

/// Cases of shipped studies that have several need less than 1 GiB each; the sheet at high scale, 2.6 GiB, is alone.
constexpr std::uint64_t memory_of_a_case = std::uint64_t{2} << 30;

/// The record of a case on the disk.
struct OnDisk {
  std::optional<Record> current;
  std::string why;  ///< why there is none, for a person
};

OnDisk look_up(const CaseSpec& spec, const fs::path& path, const Model& model) {
  std::error_code error;
  if (!fs::exists(path, error)) return {{}, "no record yet"};
  try {
    const std::string content = read_content(path);
    if (content != spec.content) return {{}, changes(content, spec.content, model.keys())};
    Record record = read_record(path);
    record.quantities = model.quantities();
    return {std::move(record), {}};
  } catch (const EnvironmentError& failure) {
    return {{}, failure.what()};
  }
}

bool is_current(const CaseSpec& spec, const fs::path& path) {
  try {
    std::error_code error;
    return fs::exists(path, error) && read_content(path) == spec.content;
  } catch (const EnvironmentError&) {
    return false;
  }
}

// failed.txt: a line that says which content failed, then the words.
fs::path failure_path(const fs::path& folder) { return folder / "failed.txt"; }

std::string failure_head(const CaseSpec& spec) { return "content " + sha256(spec.content) + "\n"; }

std::optional<std::string> read_failure(const fs::path& folder, const CaseSpec& spec) {
  std::error_code error;
  if (!fs::exists(failure_path(folder), error)) return {};
  try {
    const std::string text = read_file(failure_path(folder));
    const std::string head = failure_head(spec);
    if (text.starts_with(head)) return text.substr(head.size());
  } catch (const EnvironmentError&) {
  }
  return {};
}

/// What the next plan wants to know of this run. The memory is the largest of the whole process: what ran beside counts too.
void write_run_facts(const fs::path& folder, double seconds, int threads) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  write_file(folder / "run.json", fmt::format("{{\"seconds\": {:.3f}, \"threads\": {}, \"memory_bytes\": {}}}\n",
                                              seconds, threads, static_cast<std::int64_t>(usage.ru_maxrss) * 1024));
}

/// Runs the cases in up to so many threads as are given. Each worker takes the next case in order; what it does with
/// the case does not depend on the others.
class Runner {
 public:
  Runner(const Study& study, const StudyOptions& options, const StudyListener& listener)
      : study_(study),
        options_(options),
        listener_(listener),
        outcomes_(study.cases.size()),
        waiting_(study.cases.size(), false),
        free_threads_(std::max(options.threads, 1)) {}

  std::vector<CaseOutcome> run() {
    remove_leftovers(options_.output / "specimens");
    for (const CaseSpec& spec : study_.cases) remove_leftovers(path_of(spec).parent_path());
    const int places = count_places();
    free_places_ = places;
    {
      std::vector<std::jthread> others;
      try {
        for (int i = 1; i < places; ++i) others.emplace_back([this] { work(); });
      } catch (const std::system_error&) {
        // The machine has no more threads: fewer will do.
      }
      work();
    }
    if (error_) std::rethrow_exception(error_);
    if (interrupted_) throw Interrupted{.kept = kept_, .from_anew = from_anew_};
    return std::move(outcomes_);
  }

 private:
  [[nodiscard]] fs::path path_of(const CaseSpec& spec) const {
    return case_folder(options_.output, study_, spec.id) / "results.h5";
  }
  [[nodiscard]] bool asked(const CaseSpec& spec) const {
    return options_.only_case.empty() || options_.only_case == spec.id;
  }
  [[nodiscard]] bool may_simulate(const CaseSpec& spec) const { return asked(spec) && !options_.report_only; }
  [[nodiscard]] bool stopped() const { return given_up_ || (options_.stop && options_.stop->load()); }

  /// How many cases may run at a time; marks those that wait for it.
  int count_places() {
    if (free_threads_ == 1) return 1;  // nothing to share
    int each = 1;
    for (std::size_t i = 0; i < study_.cases.size(); ++i) {
      const CaseSpec& spec = study_.cases[i];
      waiting_[i] = may_simulate(spec) && (options_.force || !is_current(spec, path_of(spec)));
      if (waiting_[i]) each = std::max(each, spec.threads);
    }
    std::uint64_t places = std::min<std::uint64_t>(free_threads_ / each, std::ranges::count(waiting_, true));
    if (options_.memory > 0) places = std::min(places, options_.memory / memory_of_a_case);
    return static_cast<int>(std::max<std::uint64_t>(places, 1));
  }

  /// What a thread of the runner does. An error ends the study; the cases of the other threads are asked to stop.
  void work() {
    try {
      for (std::size_t at = next_++; at < study_.cases.size() && !given_up_; at = next_++) look_at(at);
    } catch (const Interrupted&) {
      interrupted_ = true;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      given_up_ = true;
    }
  }

  void look_at(std::size_t at) {
    if (stopped()) throw Interrupted{};
    const CaseSpec& spec = study_.cases[at];
    const fs::path path = path_of(spec);
    OnDisk found = look_up(spec, path, *study_.model);
    CaseOutcome outcome{spec.id, CaseState::kept, std::move(found.current), {}, 0};
    if (may_simulate(spec) && (options_.force || !outcome.record)) {
      simulate(at, path, outcome.record ? "asked for by --force" : found.why, outcome);
    } else if (!outcome.record) {
      outcome.state = asked(spec) ? CaseState::missing : CaseState::left_out;
      if (const auto failure = read_failure(path.parent_path(), spec); asked(spec) && failure) {
        outcome.state = CaseState::failed;
        outcome.error = *failure;
      } else if (asked(spec)) {
        outcome.error = "There is no record to draw from (" + found.why + "); run it without --report-only.";
      }
    }
    const std::lock_guard lock(mutex_);
    waiting_[at] = false;
    hand_out();
    listener_.end(outcome);
    outcomes_[at] = std::move(outcome);
  }

  /// The place of a running case, with its share of the threads. Those that are free are shared by the cases that can
  /// begin now, and by those that run when none is left to begin: the last cases of a study have several each.
  class Place {
   public:
    Place(Runner& runner, std::size_t at) : runner_(runner) {
      const std::lock_guard lock(runner_.mutex_);
      const auto others = static_cast<int>(std::ranges::count(runner_.waiting_, true)) - (runner_.waiting_[at] ? 1 : 0);
      lent_ = std::max(runner_.free_threads_ / std::clamp(others + 1, 1, std::max(runner_.free_places_, 1)), 1);
      runner_.waiting_[at] = false;
      --runner_.free_places_;
      runner_.free_threads_ -= lent_;
      runner_.running_.push_back(this);
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    ~Place() {
      const std::lock_guard lock(runner_.mutex_);
      std::erase(runner_.running_, this);
      ++runner_.free_places_;
      runner_.free_threads_ += lent_;
      runner_.hand_out();
    }
    [[nodiscard]] const std::atomic<int>& lent() const { return lent_; }
    void lend_one() { ++lent_; }

   private:
    Runner& runner_;
    std::atomic<int> lent_ = 1;
  };

  /// Gives the free threads to running cases, those with fewest first, when no case is left to begin.
  void hand_out() {
    if (std::ranges::count(waiting_, true) > 0) return;
    for (; free_threads_ > 0 && !running_.empty(); --free_threads_) {
      (*std::ranges::min_element(running_, {}, [](const Place* place) { return place->lent().load(); }))->lend_one();
    }
  }

  void simulate(std::size_t at, const fs::path& path, std::string why, CaseOutcome& outcome) {
    if (stopped()) throw Interrupted{};
    const CaseSpec& spec = study_.cases[at];
    const fs::path checkpoint = path.parent_path() / "checkpoint";
    make_folder(path.parent_path());
    const bool goes_on = prepare_checkpoint(checkpoint, spec, why);
    std::error_code ignored;
    fs::remove(failure_path(path.parent_path()), ignored);

    const Place place(*this, at);
    RunContext context;
    context.threads = place.lent();
    context.lent = &place.lent();
    context.specimens = options_.output / "specimens";
    context.turns = &turns_;
    context.checkpoint = checkpoint;
    context.checkpoint_seconds = options_.checkpoint_seconds;
    context.stopped = [this] { return stopped(); };
    context.report = [this, &spec](const Progress& progress) {
      const std::lock_guard lock(mutex_);
      listener_.progress(spec.id, progress);
    };
    context.note = [this, &spec](const std::string& note) {
      const std::lock_guard lock(mutex_);
      listener_.note(spec.id + ": " + note);
    };
    outcome.record.reset();
    const auto start = std::chrono::steady_clock::now();
    {
      const std::lock_guard lock(mutex_);
      listener_.begin(spec.id, static_cast<int>(at) + 1, static_cast<int>(study_.cases.size()), why);
    }
    try {
      outcome.record = study_.model->run(spec, context);
      outcome.state = CaseState::simulated;
      write_record(*outcome.record, path);
      fs::remove(checkpoint, ignored);
    } catch (const CaseError& failure) {
      outcome.state = CaseState::failed;
      outcome.error = failure.what();
      write_file(failure_path(path.parent_path()), failure_head(spec) + outcome.error);
    } catch (const Interrupted&) {
      ++(fs::exists(checkpoint, ignored) ? kept_ : from_anew_);
      throw;
    }
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (outcome.record && !goes_on) write_run_facts(path.parent_path(), outcome.seconds, context.threads);
  }

  /// Leaves a checkpoint only when the case can go on from it, and says so in `why`; true then.
  bool prepare_checkpoint(const fs::path& path, const CaseSpec& spec, std::string& why) {
    std::string bytes;
    CheckpointLoad load;
    if (!options_.force) load = read_checkpoint(path, spec.content, bytes);
    if (!load.note.empty()) {
      const std::lock_guard lock(mutex_);
      listener_.note(load.note);
    }
    if (load.loaded) {
      why += "; goes on from its checkpoint";
    } else {
      std::error_code ignored;
      fs::remove(path, ignored);
    }
    return load.loaded;
  }

  const Study& study_;
  const StudyOptions& options_;
  const StudyListener& listener_;
  Turns turns_;  // of specimens
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> given_up_ = false, interrupted_ = false;
  std::atomic<int> kept_ = 0, from_anew_ = 0;  // of the interrupted cases

  std::mutex mutex_;  // of what follows, and of what is told to the listener
  std::vector<CaseOutcome> outcomes_;
  std::vector<bool> waiting_;  // cases that have to be simulated and have not begun
  int free_places_ = 1;
  int free_threads_;
  std::vector<Place*> running_;
  std::exception_ptr error_;
};

std::vector<std::string> case_ids(const Study& study) {
  std::vector<std::string> ids;
  for (const CaseSpec& spec : study.cases) ids.push_back(spec.id);
  return ids;
}

}  // namespace

std::string Study::folder() const { return scenario.name() + "." + scenario.scale(); }

namespace {

// Why a value that the user gave changes no case; "" when it does change one. The content of a case holds the values that
// its result depends on.
std::string idle(const std::string& path, const Key& key, const Scenario& scenario,
                 const std::vector<CaseSpec>& cases) {
  if (key.affects != Affects::specimen && key.affects != Affects::test) return {};
  std::string why;
  for (const CaseSpec& spec : cases) {
    const auto said = std::ranges::find(spec.idle, path, &std::pair<std::string, std::string>::first);
    if (said == spec.idle.end()) {
      why.clear();
      break;
    }
    why = said->second;
  }
  if (!why.empty()) return why;
  const std::string line = "\n" + scenario.line(path);
  if (std::ranges::any_of(cases, [&](const CaseSpec& c) { return c.content.find(line) != std::string::npos; }))
    return {};
  const bool known = std::ranges::any_of(
      cases, [&](const CaseSpec& c) { return c.content.find("\n" + path + " = ") != std::string::npos; });
  if (known) return "every case takes a value of its own: a list of sweep or another key sets it";
  return fmt::format("it is for {}, and no case here is one", fmt::join(key.when, ", "));
}

void tell_idle_keys(Study& study) {
  for (const auto& [path, key] : study.scenario.given_keys(study.model->keys())) {
    const InputError place = study.scenario.error(path, "", "");
    const std::string& file = place.where().file;
    if (!study.scenario.included().empty() && file == study.scenario.included()) continue;
    const std::string why = idle(path, *key, study.scenario, study.cases);
    if (why.empty()) continue;
    const InputError error =
        study.scenario.error(path, "this value changes nothing in this scenario", why + "; leave it out");
    if (file == "--set") throw InputError(error);
    study.notes.emplace_back(error.what());
  }
}

// The key that most likely makes cases twice: a list of the sweep, a table of `extra`, the tests.
std::string listed(const Scenario& scenario, const Model& model) {
  std::string found = "tests";
  for (const auto& [path, key] : scenario.given_keys(model.keys())) {
    if (path.starts_with("extra")) found = path;
    if (path.starts_with("sweep.")) return path;
  }
  return found;
}

}  // namespace

Study read_study(const std::string& file, std::string_view scale, std::span<const std::string> overrides,
                 std::span<const Model> models) {
  const auto keys_of = [models](std::string_view name) { return find_model(models, name).keys(); };
  Scenario scenario = Scenario::read(file, scale, overrides, keys_of);
  const Model& model = find_model(models, scenario.model());
  Study study{scenario, &model, model.cases(scenario), {}};
  if (study.cases.empty()) {
    throw InputError(Location{file, 0, 0}, {}, "this scenario has no case", "give at least one test to run");
  }
  std::set<std::string> seen;
  for (const CaseSpec& spec : study.cases) {
    if (!seen.insert(spec.id).second) {
      throw scenario.error(listed(scenario, model), "two cases are alike (" + spec.id + ")",
                           "give every value of a sweep once");
    }
  }
  tell_idle_keys(study);
  return study;
}

void check_case(const Study& study, const std::string& id) {
  const std::vector<std::string> ids = case_ids(study);
  if (id.empty() || std::ranges::find(ids, id) != ids.end()) return;
  throw InputError(Location{study.scenario.file(), 0, 0}, "--case", "there is no case '" + id + "'",
                   advice(id, ids, "the cases are"));
}

Study with_one_case(const Study& study, const std::string& id) {
  check_case(study, id);
  Study one = study;
  std::erase_if(one.cases, [&](const CaseSpec& spec) { return spec.id != id; });
  return one;
}

fs::path case_folder(const fs::path& output, const Study& study, const std::string& id) {
  return inside(inside(output, study.folder()) / "cases", id);
}

std::string why_to_run(const fs::path& output, const Study& study, const CaseSpec& spec) {
  return look_up(spec, case_folder(output, study, spec.id) / "results.h5", *study.model).why;
}

bool is_kept(const fs::path& output, const Study& study, const CaseSpec& spec) {
  return is_current(spec, case_folder(output, study, spec.id) / "results.h5");
}

std::optional<std::string> failure_of(const fs::path& output, const Study& study, const CaseSpec& spec) {
  return read_failure(case_folder(output, study, spec.id), spec);
}

void make_specimens(const Study& study, const StudyOptions& options, const StudyListener& listener) {
  if (study.cases.empty() || !study.model->make_specimens) return;
  const CaseSpec& spec = study.cases.front();
  RunContext context;
  context.threads = options.threads;
  context.specimens = options.output / "specimens";
  remove_leftovers(context.specimens);
  context.stopped = [&] { return options.stop && options.stop->load(); };
  context.report = [&](const Progress& progress) { listener.progress(spec.id, progress); };
  context.note = [&](const std::string& note) { listener.note(spec.id + ": " + note); };
  study.model->make_specimens(spec, context);
}

void check_records(const Study& study, const StudyOptions& options) {
  const fs::path folder = options.output / study.folder();
  std::string first;  // why the first of them has none
  for (const CaseSpec& spec : study.cases) {
    if (!options.only_case.empty() && spec.id != options.only_case) continue;
    const OnDisk found = look_up(spec, case_folder(options.output, study, spec.id) / "results.h5", *study.model);
    if (found.current || read_failure(case_folder(options.output, study, spec.id), spec)) return;
    if (first.empty()) first = spec.id + ": " + found.why;
  }
  throw InputError(Location{study.scenario.file(), 0, 0}, "--report-only",
                   "there is no record to draw from in " + folder.string() + " (" + first + ")",
                   "run it once without --report-only");
}

std::vector<CaseOutcome> run_study(const Study& study, const StudyOptions& options, const StudyListener& listener) {
  check_case(study, options.only_case);
  return Runner(study, options, listener).run();
}

}  // namespace dem
