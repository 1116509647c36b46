#pragma once
// How threads that work together wait for each other, and how many of them are of use. On a busy machine the other
// threads are often not on a processor: one that spins until they come keeps them off it. So all waiting here, and that
// of OpenMP's own regions, spins for some tens of microseconds and then sleeps.
#include <atomic>
#include <vector>

namespace dem {

/// A barrier for threads that meet every few microseconds.
class Barrier {
 public:
  explicit Barrier(int threads = 1) : threads_(threads) {}
  /// For another number of threads; while none waits.
  void set_threads(int threads) { threads_ = threads; }
  void wait();

 private:
  int threads_;
  alignas(64) std::atomic<int> waiting_{0};
  alignas(64) std::atomic<unsigned> turn_{0};
};

/// How many threads serve a long piece of work best, found while it runs: now and then tenths of a second on half as
/// many, or on twice as many again, in turn with as many as now; the faster number by the median of up to five turns is
/// kept, as one turn on a busy machine tells little. It asks more seldom while nothing changes.
class Pace {
 public:
  /// Of the next stretch of work; all of them until something else was seen to be faster.
  [[nodiscard]] int threads(int most);
  /// The stretch is done: so much work in so many seconds.
  void done(double work, double seconds);

 private:
  enum class Phase { steady, trial, check };
  [[nodiscard]] int other() const;
  void next(Phase phase);

  int most_ = 0, now_ = 0, tried_ = 0;
  bool up_ = false;  ///< more threads are tried next, where there are more
  Phase phase_ = Phase::steady;
  double work_ = 0, seconds_ = 0;     ///< of this window
  double since_ = 0, interval_ = 0;   ///< s since the last trial, and between trials
  double rate_ = 0, trial_rate_ = 0;  ///< of the last windows
  std::vector<double> ratios_ = {};   ///< of this trial to the windows before and after it, turn by turn
};

}  // namespace dem
