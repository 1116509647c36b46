// Threads that wait for each other, and how many are taken.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "engine/core/random.h"
#include "engine/core/threads.h"

using namespace dem;

TEST_CASE("a barrier holds more threads than there are cores together") {
  constexpr int threads = 5, rounds = 400;
  Barrier barrier(threads);
  std::vector<std::atomic<int>> at(threads);
  std::atomic<int> apart = 0;
  {
    std::vector<std::jthread> team;
    for (int t = 0; t < threads; ++t) {
      team.emplace_back([&, t] {
        for (int round = 1; round <= rounds; ++round) {
          at[static_cast<std::size_t>(t)] = round;
          barrier.wait();
          for (const std::atomic<int>& other : at) apart += other < round ? 1 : 0;  // all have come
          barrier.wait();
        }
      });
    }
  }
  CHECK(apart == 0);
  CHECK(at[0] == rounds);
}

namespace {

// Threads taken after some seconds of work, where n threads do so much a second.
template <class Rate>
int taken(Pace& pace, int most, double seconds, Rate rate) {
  for (double t = 0; t < seconds; t += 0.01) pace.done(0.01 * rate(pace.threads(most)), 0.01);
  return pace.threads(most);
}

// Share of the work that the best number of threads would have done.
template <class Rate>
double share(Pace& pace, int most, double seconds, Rate rate, double best) {
  double done = 0;
  for (double t = 0; t < seconds; t += 0.01) {
    const double work = 0.01 * rate(pace.threads(most));
    done += work;
    pace.done(work, 0.01);
  }
  return done / (best * seconds);
}

}  // namespace

TEST_CASE("as many threads are taken as are of use") {
  const auto idle = [](int n) { return 1 + 0.8 * (n - 1); };
  const auto busy = [](int n) { return n == 1 ? 1.0 : 0.2; };
  const auto few = [](int n) { return n <= 4 ? n : 12.0 / n; };
  Pace pace;
  CHECK(pace.threads(2) == 2);  // until something else was seen to be faster
  CHECK(taken(pace, 2, 5, busy) == 1);
  CHECK(taken(pace, 2, 120, idle) == 2);  // the others have gone
  Pace of_many;
  CHECK(taken(of_many, 16, 60, few) == 4);
  CHECK(of_many.threads(1) == 1);
  CHECK(of_many.threads(8) == 8);  // another number to begin with
}

TEST_CASE("looking for a better number of threads costs little") {
  Pace idle, busy;
  CHECK(share(
            idle, 2, 20, [](int n) { return n == 1 ? 1.0 : 1.8; }, 1.8) > 0.985);
  CHECK(share(
            busy, 2, 20, [](int n) { return n == 1 ? 1.0 : 0.2; }, 1.0) > 0.95);
}

TEST_CASE("on a machine whose speed comes and goes the better number of threads is still found") {
  // Windows of the scheduler: each tenth of a second anything from 40 to 100 % of the speed.
  const RandomStream seed(1, Purpose::test_data);
  for (const double two : {0.8, 1.25}) {
    RandomStream random = seed;
    double speed = 1, time = 0;
    Pace pace;
    const double made = share(
        pace, 2, 60,
        [&](int n) {
          if ((time += 0.01) > 0.0995) time = 0, speed = random.uniform(0.4, 1);
          return speed * (n == 1 ? 1 : two);
        },
        0.7 * std::max(1.0, two));
    CAPTURE(two);
    CHECK(made > 0.93);  // of what the better number makes at the mean speed
    CHECK(pace.threads(2) == (two > 1 ? 2 : 1));
  }
}

TEST_CASE("stretches without work are not taken for slow ones") {
  Pace pace;
  for (int i = 0; i < 1000; ++i) {
    (void)pace.threads(2);
    pace.done(0, 0.01);
  }
  CHECK(pace.threads(2) == 2);
}
