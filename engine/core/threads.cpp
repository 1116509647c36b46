#include "engine/core/threads.h"

#include <immintrin.h>
#include <time.h>

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

constexpr double window = 0.1;                                 // s: many turns of the scheduler
constexpr double first_interval = 0.4, longest_interval = 60;  // s
constexpr double lasting = 4;                                  // s on more threads that were not luck
constexpr int calm_at_first = 2, calm = 5;                     // windows in a row with a core, before more threads come
constexpr std::size_t turns = 5;
constexpr double hopeless = 0.75, plain = 1.3;  // ratios that need no further turn
constexpr double gain = 1.05;                   // that makes more threads worth it: fewer leave room for others
constexpr double crowded = 0.75;                // share of a core below which others keep the cores busy: free cores
                                                // give 0.89 to 1, two busy neighbours on two cores 0.06 to 0.5

double read(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

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

Clocks system_clocks() {
  return {.wall = [] { return read(CLOCK_MONOTONIC); }, .thread = [] { return read(CLOCK_THREAD_CPUTIME_ID); }};
}

int Pace::threads(int most) {
  if (most != most_) {
    most_ = most;
    now_ = 1;
    calm_ = 0;
    interval_ = wait_ = first_interval;
    since_ = stood_ = 0;
    ratios_.clear();
    next(Phase::first);
  }
  return phase_ == Phase::trial ? tried_ : now_;
}

int Pace::begin(int most) {
  began_ = clocks_.wall();
  return threads(most);
}

int Pace::other() const {
  const bool more = now_ == 1 || (up_ && now_ < most_);
  return more ? std::min(2 * now_, most_) : now_ / 2;
}

void Pace::next(Phase phase) {
  phase_ = phase;
  work_ = seconds_ = 0;
  wall_ = clocks_.wall();
  thread_ = clocks_.thread();
}

// Back to steady work, on as many threads as before; the next trial comes later.
void Pace::settle(double seldom) {
  interval_ = std::min(seldom * interval_, longest_interval);
  up_ = !up_;
  since_ = 0;
  ratios_.clear();
  next(Phase::steady);
}

// Back to steady work, on another number of threads. Beside busy processes a few lucky windows make more threads look
// better: where they did not last, the next wait for them is twice as long.
void Pace::change(int threads) {
  const bool luck = threads < now_ && stood_ < lasting;
  if (threads > now_) {
    wait_ = interval_;
    stood_ = 0;
  }
  now_ = threads;
  interval_ = luck ? 2 * wait_ : first_interval;
  settle(1);
}

void Pace::done(double work) {
  const double seconds = clocks_.wall() - began_;
  work_ += work;
  seconds_ += seconds;
  since_ += seconds;
  stood_ += seconds;
  const bool first = phase_ == Phase::first;
  if (most_ <= 1 || seconds_ < window || (work_ <= 0 && !first)) return;
  const double rate = work_ / seconds_;
  // Asked once a window: the question itself may end the thread's turn.
  const bool crowd = clocks_.thread() - thread_ < crowded * (clocks_.wall() - wall_);
  calm_ = crowd ? 0 : calm_ + 1;
  if (first) {
    if (calm_ >= calm_at_first) now_ = most_;
    return next(crowd || now_ > 1 ? Phase::steady : Phase::first);
  }
  if (phase_ == Phase::trial) {
    if (crowd && tried_ > now_) return settle(2);  // others may be gone soon
    trial_rate_ = rate;
    return next(Phase::check);
  }
  if (crowd && now_ > 1) return change(now_ / 2);
  if (phase_ == Phase::check) {  // the rates of before the trial and after it
    const bool fewer = tried_ < now_;
    const double ratio = 2 * trial_rate_ / (rate_ + rate);
    ratios_.push_back(ratio);
    const bool seen = ratios_.size() == 1 && (ratio < hopeless || (fewer && ratio > plain));
    rate_ = rate;
    if (!seen && ratios_.size() < turns) return next(Phase::trial);
    std::ranges::nth_element(ratios_, ratios_.begin() + static_cast<std::ptrdiff_t>(ratios_.size() / 2));
    const bool better = ratios_[ratios_.size() / 2] > (fewer ? 1 : gain);
    return better ? change(tried_) : settle(4);
  }
  rate_ = rate;
  next(Phase::steady);
  if (since_ < interval_ || (calm_ < calm && other() > now_)) return;
  tried_ = other();
  next(Phase::trial);
}

}  // namespace dem
