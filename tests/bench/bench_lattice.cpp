// Bond updates per second of the close-packed lattice, one JSON line a result; and what the machine could give: the
// bandwidth of a plain copy over the same amount of memory and the rate of independent vector operations.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "engine/lattice/solver.h"

namespace {

using dem::lattice::Block;
using Clock = std::chrono::steady_clock;

// Time of this thread on a processor: what a core does, however busy the machine.
double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void print(const std::string& name, double value, const char* unit, int threads, std::size_t size) {
  fmt::print("{{\"name\": \"{}\", \"value\": {:.6g}, \"unit\": \"{}\", \"threads\": {}, \"size\": {}}}\n", name, value,
             unit, threads, size);
  std::fflush(stdout);
}

dem::lattice::Setup quartzite(int threads, std::size_t elements) {
  dem::lattice::Setup setup;
  setup.micro = dem::lattice::micro_of({90e9, 0.16, 25e6, 252e6, 1, 2650}, 1e-3);
  setup.viscosity = dem::lattice::viscosity(setup.micro, static_cast<long>(elements));
  setup.threads = threads;
  return setup;
}

// Rates over windows of some milliseconds: the best is what the loop can do, the median what the machine let it do,
// whose clock may halve and whose cores may be shared.
struct Rate {
  double best = 0, median = 0, best_cpu = 0;  // bond updates a second; the last by the calling thread's own time
};
Rate rate_of(const Block& block, int threads, dem::InstructionSet set) {
  dem::lattice::Setup setup = quartzite(threads, block.site.size());
  setup.set = set;
  dem::lattice::Solver solver(block, setup);
  const int steps = std::max(1, static_cast<int>(3e5 / static_cast<double>(block.bonds.size())));
  solver.run(100, -1.7e-9, 1.7e-9);
  std::vector<double> rates;
  Rate rate;
  const double updates = static_cast<double>(steps) * static_cast<double>(block.bonds.size());
  for (int window = 0; window < 800; ++window) {
    const auto start = Clock::now();
    const double start_cpu = thread_seconds();
    solver.run(steps, 1.7e-10, -1.7e-10);
    rate.best_cpu = std::max(rate.best_cpu, updates / (thread_seconds() - start_cpu));
    rates.push_back(updates / seconds_since(start));
  }
  std::sort(rates.begin(), rates.end());
  rate.best = rates.back();
  rate.median = rates[rates.size() / 2];
  return rate;
}

double copy_bandwidth(std::size_t bytes) {
  const std::size_t n = bytes / 2 / sizeof(double);
  std::vector<double> a(n, 1.0), b(n, 2.0);
  double best = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto start = Clock::now();
    const int rounds = static_cast<int>(2e7 / static_cast<double>(n)) + 1;
    for (int i = 0; i < rounds; ++i) {
      std::copy(a.begin(), a.end(), b.begin());
      std::swap(a, b);
    }
    best = std::max(best, 2.0 * sizeof(double) * static_cast<double>(n) * rounds / seconds_since(start));
  }
  return best;
}

}  // namespace

int main() {
  for (const int ny : {2, 4, 7, 12, 30}) {
    const Block block = dem::lattice::make_block(dem::lattice::block_shape(ny), 1e-3);
    const std::size_t n = block.site.size();
    for (const dem::InstructionSet set : dem::instruction_sets()) {
      const std::string_view kernel = dem::name_of(set);
      for (const int threads : {1, 2}) {
        if (threads > 1 && n < 1000) continue;  // as in the model
        const Rate rate = rate_of(block, threads, set);
        print(fmt::format("bond_updates_{}", kernel), rate.best, "1/s", threads, n);
        print(fmt::format("bond_updates_{}_median", kernel), rate.median, "1/s", threads, n);
        if (threads == 1) print(fmt::format("bond_updates_{}_cpu", kernel), rate.best_cpu, "1/s", threads, n);
      }
    }
    const double start = thread_seconds();
    const dem::InstructionSet chosen = dem::lattice::fastest_set(block, quartzite(2, n));
    print(fmt::format("choice_of_{}", dem::name_of(chosen)), thread_seconds() - start, "s", 1, n);
    dem::lattice::Solver solver(block, quartzite(1, n));
    print("state", static_cast<double>(solver.bytes()) / static_cast<double>(block.bonds.size()), "B/bond", 1, n);
    print("copy_same_size", copy_bandwidth(solver.bytes()), "B/s", 1, n);
  }
  return 0;
}
