// Long: halving the loading rate moves UCS and TS by less than 2 % at draft scale (12.5 x 25 mm).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include "engine/texture/loading.h"
#include "tests/support/granite.h"

using namespace dem::texture;

namespace {

double strength(TestKind kind, double rate) {
  Settings s = dem_test::granite(12.5, 25);
  s.test = kind;
  s.rate = rate;
  const bool compression = kind == TestKind::compression;
  s.ramp_strain = compression ? 2e-5 : 2e-6;
  s.sample_strain = compression ? 1e-5 : 1e-6;
  s.stop = compression ? 0.8 : 0.5;
  dem::RunContext context;
  context.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  context.specimens = std::filesystem::temp_directory_path() / "dem-test-rate";
  std::filesystem::create_directories(context.specimens);
  LoadingTest test(make_specimen(s, context), s, context.threads);
  while (test.advance()) {
  }
  double peak = 0;
  for (const HistoryRow& row : test.history()) peak = std::max(peak, row.axial_stress);
  return peak;
}

}  // namespace

TEST_CASE("halving the loading rate moves the strengths by less than 2 %") {
  const double ucs = strength(TestKind::compression, 1e-7), slow_ucs = strength(TestKind::compression, 5e-8);
  const double ts = strength(TestKind::direct_tension, 1e-8), slow_ts = strength(TestKind::direct_tension, 5e-9);
  MESSAGE("UCS ", ucs * 1e-6, " and ", slow_ucs * 1e-6, " MPa; TS ", ts * 1e-6, " and ", slow_ts * 1e-6, " MPa");
  CHECK(std::abs(slow_ucs / ucs - 1) < 0.02);
  CHECK(std::abs(slow_ts / ts - 1) < 0.02);
}
