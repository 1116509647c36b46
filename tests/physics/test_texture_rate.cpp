// Long: halving the loading rates of the scenarios moves strengths by less than 2 % at draft scale (12.5 x 25 mm).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include "engine/texture/keys.h"
#include "engine/texture/loading/loading.h"
#include "engine/texture/model.h"

using namespace dem::texture;

namespace {

// Of the case `id` of the scenario, at `share` of its rate.
double strength(const std::string& scenario, const std::string& id, double share) {
  const auto file = dem::Scenario::read(std::string(DEM_SOURCE_DIR) + "/scenarios/" + scenario + ".toml", "draft", {},
                                        [](std::string_view) { return keys(); });
  const auto cases = model().cases(file);
  const auto spec = std::ranges::find(cases, id, &dem::CaseSpec::id);
  REQUIRE(spec != cases.end());
  Settings s = read_settings(spec->scenario, std::get<std::string>(spec->parameters.front().second));
  s.test.rate *= share;
  s.test.ending.follow = 0;
  dem::RunContext context;
  context.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  context.specimens = std::filesystem::temp_directory_path() / "dem-test-rate";
  std::filesystem::create_directories(context.specimens);
  Loading test(make_specimen(s, context), s, context.threads);
  while (test.advance()) {
  }
  double peak = 0;
  for (const HistoryRow& row : test.history()) peak = std::max(peak, row.axial_stress);
  return peak;
}

}  // namespace

TEST_CASE("halving the loading rate moves the strengths by less than 2 %") {
  for (const auto& [scenario, id] : {std::pair{"ldb_uniaxial", "compression_ar_1"},
                                     {"ldb_aspect_ratio", "direct_tension_ar_1"},
                                     {"ldb_confinement", "compression_ar_1_sigma3_10"}}) {
    const double as_shipped = strength(scenario, id, 1), slow = strength(scenario, id, 0.5);
    MESSAGE(id, ": ", as_shipped * 1e-6, " and ", slow * 1e-6, " MPa");
    CHECK(std::abs(slow / as_shipped - 1) < 0.02);
  }
}
