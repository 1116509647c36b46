// The sheet as the study runner sees it: scenarios, cases, records, runs that are cut and taken up again.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "engine/core/errors.h"
#include "engine/sheet/model.h"
#include "engine/sheet/quantities.h"
#include "tests/support/scratch.h"

namespace {

namespace quantity = dem::sheet::quantity;

using namespace dem::sheet;

dem::Scenario scenario(const std::string& name, std::vector<std::string> overrides = {}) {
  return dem::Scenario::read(std::string(DEM_SOURCE_DIR) + "/scenarios/" + name + ".toml", "smoke", overrides,
                             [](std::string_view) { return keys(); });
}

const std::vector<std::string> tiny{"sheet.columns=24", "sweep.spread=[0.6]", "solvers=[\"converged\"]"};

dem::Record run(const dem::CaseSpec& spec) {
  dem::RunContext context;
  return model().run(spec, context);
}

}  // namespace

TEST_CASE("the four scenarios are read at all scales") {
  for (const char* name :
       {"elle_polycrystal", "elle_layer_extension", "elle_layer_compression", "elle_expanding_grains"}) {
    for (const char* scale : {"smoke", "draft", "paper", "high"}) {
      CAPTURE(name);
      CAPTURE(scale);
      const auto s = dem::Scenario::read(std::string(DEM_SOURCE_DIR) + "/scenarios/" + name + ".toml", scale, {},
                                         [](std::string_view) { return keys(); });
      CHECK(!model().cases(s).empty());
      const Settings settings = read_settings(s);
      if (std::string(scale) == "paper") CHECK(settings.columns * settings.rows == 184800);
      if (std::string(scale) == "high") CHECK(settings.columns * settings.rows == 737600);
    }
  }
}

TEST_CASE("a solver beside the main one runs the first spread only; ids tell cases apart") {
  const auto cases = model().cases(scenario("elle_polycrystal"));
  REQUIRE(cases.size() == 4);
  CHECK(cases[0].id == "pure_shear_spread_0_6");
  CHECK(cases[3].id == "pure_shear_spread_0_6_historical");
  for (const auto& spec : cases) CHECK(spec.content.find("kind = ") != std::string::npos);
}

TEST_CASE("values that are wrong together are refused with their place") {
  for (const auto& [name, set] : {std::pair{"elle_polycrystal", "grains.source=\"file\""},
                                  {"elle_polycrystal", "grains.file=\"map.elle\""},
                                  {"elle_polycrystal", "loading.kind=\"growth\""},
                                  {"elle_layer_extension", "grains.layer_low=0.7"},
                                  {"elle_polycrystal", "loading.snapshots=[0.2, 0.1]"}}) {
    CAPTURE(set);
    CHECK_THROWS_AS((void)model().cases(scenario(name, {set})), dem::InputError);
  }
  try {
    (void)model().cases(scenario("elle_expanding_grains", {"grains.expanding=1000"}));
    FAIL("a thousand grains cannot expand");
  } catch (const dem::InputError& error) {
    CHECK(error.key() == "grains.expanding");
    CHECK(std::string(error.what()).find("--set") != std::string::npos);
  }
}

TEST_CASE("a record holds what figures and summary need") {
  auto s = scenario("elle_layer_extension",
                    {"sheet.columns=40", "loading.steps=24", "grains.layer_low=0.45", "grains.layer_high=0.55"});
  const dem::Record r = run(model().cases(s).front());
  CHECK(r.value(quantity::particles) == 40 * 46);
  CHECK(r.table("particles").rows() == 40 * 46);
  const double cracks = r.value(quantity::cracks_intra_tension) + r.value(quantity::cracks_inter_tension);
  CHECK(cracks > 10);
  CHECK(static_cast<double>(r.table("cracks").rows()) == cracks);
  CHECK(r.table("history").rows() == 24);
  CHECK(r.table("history").has("crossing_fractures"));
  CHECK(r.find("snapshots/0000") != nullptr);
  for (const auto& check : r.checks) CHECK(check.held);
}

TEST_CASE("a grain file given by the scenario is used, and is part of the content key") {
  const test::Scratch scratch;
  const std::filesystem::path file = scratch / "map.elle";
  std::ofstream(file) << elle_text(voronoi_map({20, 2, true, 1.0, 7}));
  std::vector<std::string> set = tiny;
  set.push_back("grains.source=\"file\"");
  set.push_back("grains.file=\"" + file.string() + "\"");
  set.push_back("loading.steps=3");
  const auto first = model().cases(scenario("elle_polycrystal", set)).front();
  CHECK(run(first).value(quantity::grains) == 20);
  std::ofstream(file) << elle_text(voronoi_map({21, 2, true, 1.0, 7}));
  CHECK(model().cases(scenario("elle_polycrystal", set)).front().content != first.content);
}

TEST_CASE("a run that is stopped goes on from its checkpoint to the same record") {
  const test::Scratch scratch;
  std::vector<std::string> set = tiny;
  set.push_back("loading.steps=5");
  const auto spec = model().cases(scenario("elle_polycrystal", set)).front();
  const dem::Record whole = run(spec);
  dem::RunContext context;
  context.checkpoint = scratch / "state";
  bool stop = false;
  context.stopped = [&] { return stop; };
  int calls = 0;
  context.report = [&](const dem::Progress&) { stop = ++calls == 40; };
  CHECK_THROWS_AS((void)model().run(spec, context), dem::Interrupted);
  stop = false;
  context.report = [](const dem::Progress&) {};
  const dem::Record resumed = model().run(spec, context);
  REQUIRE(resumed.results.size() == whole.results.size());
  for (std::size_t k = 0; k < whole.results.size(); ++k) {
    CAPTURE(whole.results[k].first);
    CHECK(resumed.results[k] == whole.results[k]);
  }
  REQUIRE(resumed.tables.size() == whole.tables.size());
  const auto a = whole.tables.back().real("displacement"), b = resumed.tables.back().real("displacement");
  CHECK(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}
