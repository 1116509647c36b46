#pragma once
// Keeps the state of a running case: now and then, and when the case is asked to stop.
#include <chrono>

#include "engine/core/archive.h"
#include "engine/model/case.h"
#include "engine/model/model.h"

namespace dem {

class Keeper {
 public:
  Keeper(const CaseSpec& spec, const RunContext& context) : spec_(spec), context_(context) {}

  /// Puts the kept state into `state`; false when there is none that belongs to this case.
  template <class State>
  [[nodiscard]] bool resume(State& state) const {
    return !context_.checkpoint.empty() && load_checkpoint(context_.checkpoint, spec_.content, state).loaded;
  }

  /// To be called between steps: saves what `state()` gives when it is time, or when the case is asked to stop; then throws
  /// Interrupted.
  template <class MakeState>
  void look(const MakeState& state) {
    const bool stop = context_.stopped();
    const double since = std::chrono::duration<double>(Clock::now() - saved_).count();
    if (!stop && since < context_.checkpoint_seconds) return;
    if (!context_.checkpoint.empty()) save_checkpoint(context_.checkpoint, spec_.content, state());
    if (stop) throw Interrupted{};
    saved_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  const CaseSpec& spec_;
  const RunContext& context_;
  Clock::time_point saved_ = Clock::now();
};

}  // namespace dem
