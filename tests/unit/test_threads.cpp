// Threads that wait for each other, and how many are taken.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
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

// A pace whose clocks stand still until told, and work of a hundredth of a second after the other.
class Driver {
 public:
  /// rate: work a second on so many threads; share: of a core that the first of them has. Returns the work done.
  template <class Rate, class Share>
  double work(int most, double seconds, Rate rate, Share share) {
    double done = 0;
    for (int i = 0; i < std::lround(100 * seconds); ++i) {
      const int threads = pace_.begin(most);
      now_->wall += 0.01;
      now_->thread += 0.01 * share(threads);
      pace_.done(0.01 * rate(threads));
      done += 0.01 * rate(threads);
    }
    return done;
  }
  template <class Rate>
  double work(int most, double seconds, Rate rate) {
    return work(most, seconds, rate, [](int) { return 1.0; });
  }
  int threads(int most) { return pace_.threads(most); }

 private:
  struct Now {
    double wall = 0, thread = 0;
  };
  std::shared_ptr<Now> now_ = std::make_shared<Now>();
  Pace pace_{{.wall = [n = now_] { return n->wall; }, .thread = [n = now_] { return n->thread; }}};
};

}  // namespace

TEST_CASE("as many threads are taken as are of use") {
  const auto idle = [](int n) { return 1 + 0.8 * (n - 1); };
  const auto busy = [](int n) { return n == 1 ? 1.0 : 0.2; };
  const auto few = [](int n) { return n <= 4 ? n : 12.0 / n; };
  Driver two;
  CHECK(two.threads(2) == 1);  // until it was seen that the cores are free
  two.work(2, 0.3, idle);
  CHECK(two.threads(2) == 2);
  two.work(2, 5, busy);
  CHECK(two.threads(2) == 1);
  two.work(2, 120, idle);
  CHECK(two.threads(2) == 2);  // the others have gone
  Driver many;
  many.work(16, 60, few);
  CHECK(many.threads(16) == 4);
  CHECK(many.threads(1) == 1);
  many.work(8, 0.3, few);
  CHECK(many.threads(8) == 8);  // another number to begin with
}

TEST_CASE("looking for a better number of threads costs little") {
  CHECK(Driver().work(2, 20, [](int n) { return n == 1 ? 1.0 : 1.8; }) > 0.985 * 1.8 * 20);
  CHECK(Driver().work(2, 20, [](int n) { return n == 1 ? 1.0 : 0.2; }) > 0.95 * 20);
}

TEST_CASE("on a machine whose speed comes and goes the better number of threads is still found") {
  // Windows of the scheduler: each tenth of a second anything from 40 to 100 % of the speed.
  for (const double two : {0.8, 1.25}) {
    RandomStream random(1, Purpose::test_data);
    double speed = 1;
    int turn = 0;
    Driver driver;
    const double made = driver.work(2, 60, [&](int n) {
      if (turn++ % 20 == 0) speed = random.uniform(0.4, 1);  // asked twice a stretch
      return speed * (n == 1 ? 1 : two);
    });
    CAPTURE(two);
    CHECK(made > 0.93 * 0.7 * 60 * std::max(1.0, two));  // of what the better number makes at the mean speed
    CHECK(driver.threads(2) == (two > 1 ? 2 : 1));
  }
}

TEST_CASE("where other processes keep the cores busy, threads do not wait for each other") {
  // Two neighbours on two cores: one thread has two thirds of a core; of two the first mostly waits for the other.
  Driver driver;
  const auto busy = [](int n) { return n == 1 ? 1 : 0.1; };
  const auto alone = [](int n) { return n == 1 ? 0.67 : 0.1; };
  CHECK(driver.work(2, 20, busy, alone) == doctest::Approx(20));  // a second one is not even begun
  CHECK(driver.threads(2) == 1);
  CHECK(driver.work(2, 5, [](int n) { return n == 1 ? 1 : 1.6; }) > 1.4 * 5);  // they have gone
  CHECK(driver.threads(2) == 2);
  CHECK(driver.work(2, 20, busy, alone) > 0.99 * 20);
  // One that has a core to itself now and then looks for more, ever more seldom.
  int turn = 0;
  const auto now_and_then = [&](int n) { return n == 2 ? 0.1 : ++turn % 50 < 15 ? 1 : 0.6; };
  CHECK(driver.work(2, 60, busy, now_and_then) > 0.98 * 60);
}

TEST_CASE("more threads that never last are tried ever more seldom") {
  // Each time two look better for a second and a half, and then wait for each other.
  Driver driver;
  int stretches = 0, on_two = 0, on_one_now = 0, on_two_now = 0;
  const auto calm = [&](int n) { return n == 1 || on_two_now < 150; };
  const auto share = [&](int n) {
    ++stretches;
    on_two += n == 2 ? 1 : 0;
    on_one_now = n == 2 ? 0 : on_one_now + 1;
    on_two_now = n == 2 ? on_two_now + 1 : on_one_now > 15 ? 0 : on_two_now;  // trials of one are shorter
    return calm(n) ? 0.95 : 0.3;
  };
  driver.work(
      2, 120, [&](int n) { return n == 1    ? 1
                                  : calm(n) ? 1.3
                                            : 0.1; }, share);
  CAPTURE(on_two);
  CHECK(on_two < stretches / 6);
  // Free cores where one window a second is bad luck: two stay.
  Driver free;
  stretches = on_two = 0;
  free.work(
      2, 60, [](int n) { return n == 1 ? 1.0 : 1.8; },
      [&](int n) {
        ++stretches;
        on_two += n == 2 ? 1 : 0;
        return n == 2 && stretches % 1000 < 10 ? 0.3 : 0.95;
      });
  CAPTURE(on_two);
  CHECK(on_two > 0.85 * stretches);
}

TEST_CASE("the clock of a thread stands while it sleeps") {
  using namespace std::chrono_literals;
  const Clocks clocks = system_clocks();
  const double wall = clocks.wall(), thread = clocks.thread();
  volatile double sum = 0;
  while (clocks.thread() - thread < 0.02) sum = sum + 1;
  CHECK(clocks.wall() - wall >= 0.0199);
  const double before = clocks.wall(), computed = clocks.thread();
  std::this_thread::sleep_for(30ms);
  CHECK(clocks.wall() - before >= 0.03);
  CHECK(clocks.thread() - computed < 0.015);
}

TEST_CASE("stretches without work are not taken for slow ones") {
  Driver driver;
  driver.work(2, 10, [](int) { return 0.0; });
  CHECK(driver.threads(2) == 2);
}
