#include "engine/study/study.h"

#include <algorithm>
#include <chrono>
#include <set>

#include "engine/core/archive.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/scenario/suggest.h"
#include "engine/store/store.h"

namespace dem {
namespace {

namespace fs = std::filesystem;

/// The record of a case on the disk.
struct OnDisk {
  std::optional<Record> current;
  std::string why;  ///< why there is none, for a person
};

OnDisk look_up(const CaseSpec& spec, const fs::path& path, std::span<const Key> keys) {
  std::error_code error;
  if (!fs::exists(path, error)) return {{}, "no record"};
  try {
    const std::string content = read_content(path);
    if (content != spec.content) return {{}, changes(content, spec.content, keys)};
    return {read_record(path), {}};
  } catch (const EnvironmentError& failure) {
    return {{}, failure.what()};
  }
}

class Runner {
 public:
  Runner(const Study& study, const StudyOptions& options, const StudyListener& listener)
      : study_(study), options_(options), listener_(listener), folder_(options.output / study.folder()) {}

  std::vector<CaseOutcome> run() {
    std::vector<CaseOutcome> outcomes;
    for (const CaseSpec& spec : study_.cases) {
      const bool asked = options_.only_case.empty() || options_.only_case == spec.id;
      const fs::path path = folder_ / "cases" / spec.id / "results.h5";
      OnDisk found = look_up(spec, path, study_.model->keys());
      CaseOutcome outcome{spec.id, CaseState::kept, std::move(found.current), {}, 0};
      if (asked && !options_.report_only && (options_.force || !outcome.record)) {
        simulate(spec, path, outcome.record ? "asked for by --force" : found.why, static_cast<int>(outcomes.size()) + 1,
                 outcome);
      } else if (!outcome.record) {
        outcome.state = asked ? CaseState::missing : CaseState::left_out;
        if (asked) outcome.error = "There is no record to draw from (" + found.why + "); run it without --report-only.";
      }
      listener_.end(outcome);
      outcomes.push_back(std::move(outcome));
    }
    return outcomes;
  }

 private:
  void simulate(const CaseSpec& spec, const fs::path& path, std::string why, int number, CaseOutcome& outcome) {
    if (options_.stop && options_.stop->load()) throw Interrupted{};
    const fs::path checkpoint = path.parent_path() / "checkpoint";
    make_folder(path.parent_path());
    remove_leftovers(path.parent_path());
    prepare_checkpoint(checkpoint, spec, why);
    listener_.begin(spec.id, number, static_cast<int>(study_.cases.size()), why);

    RunContext context;
    context.threads = options_.threads;
    context.specimens = options_.output / "specimens";
    context.checkpoint = checkpoint;
    context.checkpoint_seconds = options_.checkpoint_seconds;
    context.stop = options_.stop;
    context.report = listener_.progress;
    outcome.record.reset();
    const auto start = std::chrono::steady_clock::now();
    try {
      outcome.record = complete(study_.model->run(spec, context), spec);
      outcome.state = CaseState::simulated;
      write_record(*outcome.record, path);
      std::error_code ignored;
      fs::remove(checkpoint, ignored);
    } catch (const CaseError& failure) {
      outcome.state = CaseState::failed;
      outcome.error = failure.what();
    }
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  /// Leaves a checkpoint only when the case can go on from it, and says so in `why`.
  void prepare_checkpoint(const fs::path& path, const CaseSpec& spec, std::string& why) const {
    std::string bytes;
    CheckpointLoad load;
    if (!options_.force) load = read_checkpoint(path, spec.content, bytes);
    if (!load.note.empty()) listener_.note(load.note);
    if (load.loaded) {
      why += "; goes on from its checkpoint";
    } else {
      std::error_code ignored;
      fs::remove(path, ignored);
    }
  }

  /// What the runner knows of a case is the same in every model's records.
  [[nodiscard]] Record complete(Record record, const CaseSpec& spec) const {
    record.model = study_.model->name;
    record.scenario = study_.scenario.name();
    record.case_id = spec.id;
    record.content = spec.content;
    record.physics_version = study_.model->physics_version;
    record.seed = spec.scenario.seed();
    record.parameters = spec.parameters;
    return record;
  }

  const Study& study_;
  const StudyOptions& options_;
  const StudyListener& listener_;
  fs::path folder_;
};

std::vector<std::string> case_ids(const Study& study) {
  std::vector<std::string> ids;
  for (const CaseSpec& spec : study.cases) ids.push_back(spec.id);
  return ids;
}

}  // namespace

const Model& find_model(std::span<const Model> models, std::string_view name) {
  const auto at = std::ranges::find(models, name, &Model::name);
  if (at != models.end()) return *at;
  std::vector<std::string> names;
  for (const Model& known : models) names.emplace_back(known.name);
  throw InputError("unknown model '" + std::string(name) + "'", advice(name, names, "the models are"));
}

std::string Study::folder() const { return scenario.name() + "." + scenario.scale(); }

Study read_study(const std::string& file, std::string_view scale, std::span<const std::string> overrides,
                 std::span<const Model> models) {
  const auto keys_of = [models](std::string_view name) { return find_model(models, name).keys(); };
  Scenario scenario = Scenario::read(file, scale, overrides, keys_of);
  const Model& model = find_model(models, scenario.model());
  Study study{scenario, &model, model.cases(scenario)};
  if (study.cases.empty()) {
    throw InputError(Location{file, 0, 0}, {}, "this scenario has no case", "give at least one test to run");
  }
  std::set<std::string> seen;
  for (const CaseSpec& spec : study.cases) {
    if (!seen.insert(spec.id).second) {
      throw InputError(Location{file, 0, 0}, {}, "two cases are alike (" + spec.id + ")",
                       "give every value of a sweep once");
    }
  }
  return study;
}

void check_case(const Study& study, const std::string& id) {
  const std::vector<std::string> ids = case_ids(study);
  if (id.empty() || std::ranges::find(ids, id) != ids.end()) return;
  throw InputError(Location{study.scenario.file(), 0, 0}, "--case", "there is no case '" + id + "'",
                   advice(id, ids, "the cases are"));
}

std::vector<CaseOutcome> run_study(const Study& study, const StudyOptions& options, const StudyListener& listener) {
  check_case(study, options.only_case);
  return Runner(study, options, listener).run();
}

}  // namespace dem
