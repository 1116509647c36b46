#include "engine/core/threads.h"

#include <immintrin.h>

#include <algorithm>
#include <cstdlib>

namespace dem {
namespace {

constexpr int spins = 1000;  // 20 to 50 microseconds: more than threads of a step wait where each has its core

// OpenMP spins for milliseconds, and can be told otherwise by the environment alone, which it reads as it begins. It is
// linked into the program (CMakeLists.txt), so that this comes before. What the user says himself stands.
[[gnu::constructor(101)]] void let_openmp_sleep() {
  if (std::getenv("OMP_WAIT_POLICY") == nullptr) setenv("GOMP_SPINCOUNT", "1000", 0);
}

constexpr double window = 0.1;                                             // s: many turns of the scheduler
constexpr double first_interval = 0.4, longest_interval = 60, slower = 4;  // s, s, times as seldom
constexpr std::size_t turns = 5;
constexpr double hopeless = 0.75, plain = 1.3;  // ratios that need no further turn
constexpr double gain = 1.05;                   // that makes more threads worth it: fewer leave room for others

}  // namespace

void Barrier::wait() {
  if (threads_ == 1) return;
  const unsigned turn = turn_.load(std::memory_order_acquire);
  if (waiting_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
    waiting_.store(0, std::memory_order_relaxed);
    turn_.store(turn + 1, std::memory_order_release);
    turn_.notify_all();  // asks the system only when one sleeps
    return;
  }
  for (int spin = 0; spin < spins; ++spin) {
    if (turn_.load(std::memory_order_acquire) != turn) return;
    _mm_pause();
  }
  turn_.wait(turn, std::memory_order_acquire);
}

int Pace::threads(int most) {
  if (most != most_) {
    most_ = now_ = most;
    interval_ = first_interval;
    since_ = 0;
    ratios_.clear();
    next(Phase::steady);
  }
  return phase_ == Phase::trial ? tried_ : now_;
}

int Pace::other() const {
  const bool more = now_ == 1 || (up_ && now_ < most_);
  return more ? std::min(2 * now_, most_) : now_ / 2;
}

void Pace::next(Phase phase) {
  phase_ = phase;
  work_ = seconds_ = 0;
}

void Pace::done(double work, double seconds) {
  work_ += work;
  seconds_ += seconds;
  since_ += seconds;
  if (most_ <= 1 || seconds_ < window || work_ <= 0) return;
  const double rate = work_ / seconds_;
  if (phase_ == Phase::trial) {
    trial_rate_ = rate;
    return next(Phase::check);
  }
  if (phase_ == Phase::check) {  // the rates of before the trial and after it
    const bool fewer = tried_ < now_;
    const double ratio = 2 * trial_rate_ / (rate_ + rate);
    ratios_.push_back(ratio);
    const bool seen = ratios_.size() == 1 && (ratio < hopeless || (fewer && ratio > plain));
    rate_ = rate;
    if (!seen && ratios_.size() < turns) return next(Phase::trial);
    std::ranges::nth_element(ratios_, ratios_.begin() + static_cast<std::ptrdiff_t>(ratios_.size() / 2));
    const bool better = ratios_[ratios_.size() / 2] > (fewer ? 1 : gain);
    ratios_.clear();
    if (better) now_ = tried_;
    interval_ = better ? first_interval : std::min(slower * interval_, longest_interval);
    up_ = !up_;
    since_ = 0;
    return next(Phase::steady);
  }
  rate_ = rate;
  next(Phase::steady);
  if (since_ < interval_) return;
  tried_ = other();
  next(Phase::trial);
}

}  // namespace dem
