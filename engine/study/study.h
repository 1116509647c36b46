#pragma once
// The cases of a scenario, run into out/NAME.SCALE/cases/CASE/results.h5. A finished case is kept as long as its
// content key is the same; a cut one goes on from its checkpoint; a failed one does not stop the others, and leaves its
// words (failed.txt) until it is run again. How long a case took stands in run.json beside its record.
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/record.h"
#include "engine/model/model.h"
#include "engine/scenario/changes.h"
#include "engine/scenario/scenario.h"

namespace dem {

/// A checked scenario with its cases, ready to run.
struct Study {
  Scenario scenario;
  const Model* model = nullptr;
  std::vector<CaseSpec> cases;     ///< ids are unique
  std::vector<std::string> notes;  ///< keys that change nothing here, a line each: to be told before anything runs

  /// "NAME.SCALE", the folder below the output folder.
  [[nodiscard]] std::string folder() const;
};

/// Reads and checks everything that can be checked without simulating. Writes nothing. Throws InputError, also for a key
/// of --set that changes nothing; one in the scenario's own file is a note, one in a file that it includes is neither.
Study read_study(const std::string& file, std::string_view scale, std::span<const std::string> overrides,
                 std::span<const Model> models);

/// Throws InputError listing the cases when `id` is none of them; "" stands for all.
void check_case(const Study& study, const std::string& id);

struct StudyOptions {
  std::filesystem::path output = "out";
  int threads = 1;  ///< for all cases together: they run side by side, each with as many as it asks for (CaseSpec)
  std::uint64_t memory =
      0;                  ///< bytes of the machine: at most one case for every 2 GiB runs at a time; 0: no such bound
  std::string only_case;  ///< run only this one; the others are taken when their record is current
  bool report_only = false;  ///< simulate nothing
  bool force = false;        ///< simulate also what has a current record, from the start
  double checkpoint_seconds = 120;
  const std::atomic<bool>* stop = nullptr;
};

enum class CaseState {
  kept,       ///< the record was there and current
  simulated,  ///< in this run
  failed,     ///< CaseError
  missing,    ///< no current record, and nothing may be simulated (report_only)
  left_out,   ///< no current record, and another case was asked for
};

struct CaseOutcome {
  std::string id;
  CaseState state = CaseState::missing;
  std::optional<Record> record;
  std::string error;   ///< for failed and missing: what the report shows in the place of its figures
  double seconds = 0;  ///< wall time of the simulation
};

/// What the runner tells while it works; the program prints it. Called from the threads of the cases, never twice at a
/// time.
struct StudyListener {
  /// A case begins (number from 1): "no record", "seed: 1 -> 2", "goes on from its checkpoint".
  std::function<void(const std::string& id, int number, int total, const std::string& why)> begin =
      [](const std::string&, int, int, const std::string&) {};
  std::function<void(const std::string& id, const Progress&)> progress = [](const std::string&, const Progress&) {};
  /// It is done, whatever its state.
  std::function<void(const CaseOutcome&)> end = [](const CaseOutcome&) {};
  std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// Throws InputError when no case that was asked for has a current record, or failed as it is now: there is nothing to
/// report then.
void check_records(const Study& study, const StudyOptions& options);

/// The outcomes in report order; cases begin in that order, and end as they end. Throws Interrupted when stopped (the
/// cases at hand have left their checkpoints), InputError as check_case(), EnvironmentError when a file cannot be
/// written (the other cases at hand are stopped).
std::vector<CaseOutcome> run_study(const Study& study, const StudyOptions& options, const StudyListener& listener);

/// The study of one of its cases alone; throws as check_case().
Study with_one_case(const Study& study, const std::string& id);

/// Where a case keeps its record, its checkpoint and what is known of its run.
std::filesystem::path case_folder(const std::filesystem::path& output, const Study& study, const std::string& id);

/// Why a case has to be simulated, as StudyListener::begin() says it; "" when its record is current.
std::string why_to_run(const std::filesystem::path& output, const Study& study, const CaseSpec& spec);

/// Whether a current record is there.
bool is_kept(const std::filesystem::path& output, const Study& study, const CaseSpec& spec);

/// What a case that failed (CaseError) last left beside its record; nothing when it was of another content.
std::optional<std::string> failure_of(const std::filesystem::path& output, const Study& study, const CaseSpec& spec);

/// Makes the specimens of the first case that are missing (Model::specimens), and simulates nothing. Throws as run_study(),
/// and CaseError.
void make_specimens(const Study& study, const StudyOptions& options, const StudyListener& listener);

}  // namespace dem
