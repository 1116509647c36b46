#pragma once
// What a model gives to the study runner. A case is a pure function from its content to its record.
#include <atomic>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/record.h"
#include "engine/core/turns.h"
#include "engine/model/case.h"
#include "engine/scenario/scenario.h"

namespace dem {

/// What a running case tells about itself now and then; values in SI units, NaN where they do not apply.
struct Progress {
  std::string stage;  ///< "packing", "loading"
  std::int64_t step = 0;
  double fraction = 0;  ///< 0 ... 1, an estimate of what is done
  double strain = 0;    ///< axial, in the sense of the test
  double stress = 0;    ///< Pa, in the sense of the test
};

/// What the runner lends to a case. Nothing here may change the result. Cases run side by side, each in a thread of its own:
/// they share nothing but the folder of specimens.
struct RunContext {
  int threads = 1;  ///< at the beginning of the case
  const std::atomic<int>* lent =
      nullptr;  ///< threads by now: grows when other cases have ended and none waits; none: as at first
  std::filesystem::path specimens;   ///< folder for generated specimens, kept by content
  Turns* turns = nullptr;            ///< to be taken by path while a specimen is looked for and made; none: alone
  std::filesystem::path checkpoint;  ///< file for the state of a cut case; the case writes it aside, then renames it
  double checkpoint_seconds = 120;   ///< wall time between checkpoints
  std::function<bool()> stopped = [] { return false; };  ///< asked for: write the checkpoint and throw Interrupted
  std::function<void(const Progress&)> report = [](const Progress&) {};
  std::function<void(const std::string&)> note = [](const std::string&) {};  ///< what a person has to know of the case

  /// For a case that can change their number on its way; others keep to `threads`.
  [[nodiscard]] int threads_now() const { return lent ? lent->load() : threads; }
};

/// Thrown by a case that was asked to stop, its checkpoint written when there is a state to keep yet; by run_study(), with
/// how many cases were at hand; and by what draws and prints.
struct Interrupted {
  int kept = 0;       ///< cases that go on from their state
  int from_anew = 0;  ///< cases that begin anew: they were stopped before there was anything to keep
  int signal = 0;     ///< that ended a process which worked for this one; 0: this one was asked
};

/// One model of the program; see models().
struct Model {
  std::string_view name;                       ///< the scenario's `model`
  std::string_view physics_version;            ///< raised whenever results change; part of every content key
  std::span<const Key> (*keys)();              ///< its scenario keys
  std::span<const Quantity> (*quantities)();   ///< what its cases give
  std::span<const Parameter> (*parameters)();  ///< what its cases differ in
  /// The cases of a scenario, in report order. Throws InputError for values that are wrong together.
  std::vector<CaseSpec> (*cases)(const Scenario&);
  /// Simulates a case. Throws CaseError when it fails, Interrupted when stopped.
  Record (*run)(const CaseSpec&, RunContext&);
  /// Files in the folder of specimens that a case reads or else makes; cases with the same file share it. None: nothing is
  /// shared.
  std::vector<std::string> (*specimens)(const CaseSpec&) = nullptr;
  /// Makes those that are missing, and nothing else. Throws as run().
  void (*make_specimens)(const CaseSpec&, RunContext&) = nullptr;
  std::span<const Measurable> (*measurables)() = nullptr;  ///< what laboratories measure of it; none: nothing
};

/// The explicit table of models (engine/models.cpp).
std::span<const Model> models();
/// Throws InputError listing the known names.
const Model& find_model(std::span<const Model> models, std::string_view name);

}  // namespace dem
