#pragma once
// How threads that work together wait for each other, and how many of them are of use. On a busy machine the other
// threads are often not on a processor: one that spins until they come keeps them off it. So all waiting here, and that
// of OpenMP's own regions, spins for some tens of microseconds and then sleeps.
#include <atomic>
#include <functional>
#include <utility>
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

/// s by two clocks: the wall's, and that of the thread that asks, which stands while the thread has no core or sleeps.
struct Clocks {
  std::function<double()> wall, thread;
};
Clocks system_clocks();

/// How many threads serve a long piece of work best, found while it runs. It begins with one, and takes all of them once
/// this one has had its core to itself. Where other processes keep the cores busy, half as many: a thread that waits for
/// its core keeps all others waiting, and how long is a matter of chance that no short trial tells. Where cores are free,
/// now and then tenths of a second on half as many, or on twice as many again, in turn with as many as now; the faster
/// number by the median of up to five turns is kept. It asks more seldom while nothing changes, and where more threads
/// did not last. On a busy machine a second thread costs more than the time of its trial (measured: docs/reliability.md).
class Pace {
 public:
  explicit Pace(Clocks clocks = system_clocks()) : clocks_(std::move(clocks)) {}

  /// How many now.
  [[nodiscard]] int threads(int most);
  /// The same, of a stretch of work that begins now.
  [[nodiscard]] int begin(int most);
  /// The stretch is done, by the same thread: so much work.
  void done(double work);

 private:
  enum class Phase { first, steady, trial, check };
  [[nodiscard]] int other() const;
  void next(Phase phase);
  void settle(double seldom);
  void change(int threads);

  int most_ = 0, now_ = 0, tried_ = 0;
  int calm_ = 0;     ///< windows in a row in which the thread that asks had its core
  bool up_ = false;  ///< more threads are tried next, where there are more
  Phase phase_ = Phase::steady;
  Clocks clocks_;
  double began_ = 0;                  ///< this stretch, by the clock on the wall
  double work_ = 0, seconds_ = 0;     ///< of this window's stretches
  double wall_ = 0, thread_ = 0;      ///< the clocks as this window began
  double since_ = 0, interval_ = 0;   ///< s since the last trial, and between trials
  double stood_ = 0, wait_ = 0;       ///< s since there were last more threads, and the wait before that
  double rate_ = 0, trial_rate_ = 0;  ///< of the last windows
  std::vector<double> ratios_ = {};   ///< of this trial to the windows before and after it, turn by turn
};

}  // namespace dem
