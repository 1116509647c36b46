// The sheet as the study runner sees it: scenarios, cases, records, runs that are cut and taken up again.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <tuple>

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

TEST_CASE("repeats are specimens of the following seeds, each as a scenario of that seed makes it") {
  const auto cases = model().cases(scenario("elle_polycrystal", {"seed=7", "repeats=3", "sweep.spread=[0.6, 0.2]"}));
  std::vector<std::string> ids;
  for (const auto& spec : cases) ids.push_back(spec.id);
  CHECK(ids == std::vector<std::string>{"pure_shear_spread_0_6", "pure_shear_spread_0_6_seed_8",
                                        "pure_shear_spread_0_6_seed_9", "pure_shear_spread_0_2",
                                        "pure_shear_spread_0_2_seed_8", "pure_shear_spread_0_2_seed_9",
                                        "pure_shear_spread_0_6_historical"});
  const auto alone = model().cases(scenario("elle_polycrystal", {"seed=9", "sweep.spread=[0.6, 0.2]"}));
  CHECK(cases[2].content == alone[0].content);  // so that its record is kept
  CHECK(cases[2].content != cases[0].content);
  CHECK(std::get<double>(*dem::find_value(cases[2].parameters, "seed")) == 9);
  CHECK_THROWS_WITH_AS((void)model().cases(scenario("elle_polycrystal", {"seed=9007199254740990", "repeats=10"})),
                       doctest::Contains("the last of 10 seeds"), dem::InputError);
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

namespace {

// Four grains, one of GARNET, with unodes in a grid: CONC_A is 1 in the left half, 2 in the right.
std::string map_text(const std::string& corners = "0 0\n1 0\n1 1\n0 1\n") {
  VoronoiSettings settings{6, 2, true, 1.0, 7};
  ElleMap map = voronoi_map(settings);
  map.attributes.push_back({"MINERAL", "QUARTZ", {{2, "GARNET"}}});
  map.attributes.push_back({"EXPAND", "0.00000000e+00", {{1, "1.00000000e+00"}}});
  std::string text = elle_text(map);
  text += "UNODES CONC_A\n";
  for (int u = 0; u < 400; ++u)
    text += fmt::format("{} {} {} {}\n", u, (u % 20 + 0.5) / 20, (u / 20 + 0.5) / 20, u % 20 < 10 ? 1 : 2);
  text += "U_WORK\n0 x\n900 1\n";
  const auto box = text.find("CellBoundingBox"), end = text.find("FLYNNS");
  return text.substr(0, box) + "CellBoundingBox " + corners + text.substr(end);
}

// A scenario on such a map, with the text of its rules.
struct OnMap {
  test::Scratch scratch;
  std::filesystem::path file = scratch / "study.toml";

  explicit OnMap(const std::string& rest, const std::string& map = map_text()) {
    std::ofstream(scratch / "map.elle") << map;
    std::ofstream(file)
        << "model = \"sheet\"\ntitle = \"On a map\"\n[sheet]\ncolumns = 24\n[grains]\nsource = \"file\"\n"
           "file = \"map.elle\"\n[loading]\nkind = \"pure_shear\"\nsteps = 2\n[scales.smoke]\n"
        << rest;
  }
  [[nodiscard]] std::vector<dem::CaseSpec> cases(std::vector<std::string> overrides = {}) const {
    return model().cases(
        dem::Scenario::read(file.string(), "smoke", overrides, [](std::string_view) { return keys(); }));
  }
  void refuses(int line, const std::string& part) const {
    try {
      (void)cases();
      FAIL_CHECK("read without complaint: " << part);
    } catch (const dem::InputError& error) {
      const std::string what = error.what();
      CAPTURE(what);
      CHECK(what.find(part) != std::string::npos);
      CHECK(error.where().line == line);
      CHECK_FALSE(error.right().empty());
    }
  }
};

std::string rule(const std::string& attribute, const std::string& value, const std::string& what = "stiffness = 2.0") {
  return "[[rule]]\nattribute = \"" + attribute + "\"\nvalue = \"" + value + "\"\n" + what + "\n";
}

}  // namespace

TEST_CASE("a rule that fits nothing is refused at its line, with what the map has") {
  const std::string fits = rule("MINERAL", "GARNET");
  OnMap(fits + rule("MINERL", "QUARTZ")).refuses(17, "map.elle has no attribute 'MINERL'; did you mean 'MINERAL'?");
  OnMap(fits + rule("MINERL", "QUARTZ")).refuses(17, "its attributes are CONC_A, EXPAND, MINERAL, U_WORK");
  OnMap(fits + rule("MINERAL", "Quartz"))
      .refuses(18, "no grain of map.elle has MINERAL 'Quartz'; did you mean 'QUARTZ'?");
  OnMap(fits + rule("MINERAL", "MICA")).refuses(18, "its values are GARNET, QUARTZ");
  OnMap(fits + rule("EXPAND", "2")).refuses(18, "EXPAND '2'");
  OnMap(fits + rule("CONC_A", "3")).refuses(18, "no unode of map.elle has CONC_A '3'; its values are 1, 2");
}

TEST_CASE("rules on grown maps: the attributes are those that the source gives") {
  const auto what = [](const std::string& name, const std::string& set) -> std::string {
    try {
      (void)model().cases(scenario(name, {set}));
    } catch (const dem::InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(what("elle_layer_extension", "rule[0].value=\"Matrix\"").find("did you mean 'MATRIX'?") != std::string::npos);
  CHECK(what("elle_layer_extension", "rule[0].attribute=\"EXPAND\"").find("its attributes are MINERAL") !=
        std::string::npos);
  CHECK(what("elle_expanding_grains", "rule[0].value=\"1.0\"").empty());  // numbers are the same in any form
  CHECK(what("elle_expanding_grains", "grains.expanding=0").find("it has none at all") != std::string::npos);
}

TEST_CASE("values that Elle writes fit numbers; unodes give particles their properties") {
  const OnMap study(rule("EXPAND", "1", "strength = 0.5") + rule("CONC_A", "2", "stiffness = 3.0\nstrength = 0.25"));
  const Settings settings = read_settings(study.cases().front().scenario);
  const Specimen made = make_specimen(settings);
  CHECK(made.grains[1].strength == 0.5);
  Settings without = settings;
  without.rules.pop_back();
  const Specimen plain = make_specimen(without);
  int left = 0, right = 0;
  for (int slot = 0; slot < made.sheet.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (plain.sheet.stiffness[k] <= 0) continue;
    const double factor = made.sheet.stiffness[k] / plain.sheet.stiffness[k];
    const auto i = static_cast<std::size_t>(made.sheet.first(slot)),
               j = static_cast<std::size_t>(made.sheet.second(slot));
    const double low = std::min(made.sheet.x[i], made.sheet.x[j]), high = std::max(made.sheet.x[i], made.sheet.x[j]);
    if (low > 0.1 && high < 0.45) left += factor == 1 ? 1 : 1000000;
    if (low > 0.55 && high < 0.9) right += factor == doctest::Approx(3) ? 1 : 1000000;
  }
  CHECK(left > 100);
  CHECK(left < 1000000);
  CHECK(right > 100);
  CHECK(right < 1000000);
  CHECK(plain.map.notes.size() == made.map.notes.size() + 1);  // unodes without a rule are told
}

TEST_CASE("a map's notes stand in the record") {
  const dem::Record record = run(OnMap("").cases().front());
  const auto told = [&](const char* part) {
    return std::any_of(record.notes.begin(), record.notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
  };
  CHECK(told("400 unodes"));
  CHECK(told("U_WORK"));
}

TEST_CASE("a cell too high or too flat for a sheet is refused at its line") {
  OnMap("", map_text("0 0\n1 0\n1 1e7\n0 1e7\n")).refuses(6, "1 wide and 1e+07 high: 2.77e+08 rows of particles");
  OnMap("", map_text("0 0\n1e7 0\n1e7 1\n0 1\n")).refuses(6, "raise sheet.columns");
  OnMap("[scales.smoke.sheet]\nrows = 100\n").refuses(6, "100 rows of particles would lay it");
}

TEST_CASE("snapshots beyond the end of the loading, and lists that name a value twice, are refused") {
  for (const auto& [name, set, part] :
       {std::tuple{"elle_polycrystal", "loading.snapshots=[0.1]", "ends at a strain of 0.005 (10 steps of 0.0005)"},
        {"elle_polycrystal", "loading.steps=2", "before the snapshot at 0.003"},
        {"elle_expanding_grains", "loading.snapshots=[0.021]", "ends at a strain of 0.02"},
        {"elle_polycrystal", "loading.snapshots=[0.001, 0.001]", "each once"},
        {"elle_polycrystal", "sweep.spread=[0.5, 0.6, 0.5]", "entries 1 and 3 of the list are the same"},
        {"elle_polycrystal", "solvers=[\"converged\", \"converged\"]", "entries 1 and 2"}}) {
    CAPTURE(set);
    CHECK_THROWS_WITH_AS((void)model().cases(scenario(name, {set})), doctest::Contains(part), dem::InputError);
  }
  const auto close =
      model().cases(scenario("elle_polycrystal", {"sweep.spread=[0.5, 0.50000001]", "solvers=[\"converged\"]"}));
  REQUIRE(close.size() == 2);
  CHECK(close[0].id == "pure_shear_spread_0_5");
  CHECK(close[1].id == "pure_shear_spread_0_50000001");
}

TEST_CASE("snapshots that an early end does not reach are told") {
  const dem::Record r = run(model()
                                .cases(scenario("elle_layer_extension",
                                                {"sheet.columns=40", "grains.layer_low=0.45", "grains.layer_high=0.55",
                                                 "loading.most_breaks=1", "loading.snapshots=[0.0005, 0.02, 0.0245]"}))
                                .front());
  REQUIRE(!r.notes.empty());
  CHECK(r.notes.back().find("before the snapshots at 0.02, 0.0245: most_breaks springs were broken") !=
        std::string::npos);
}

TEST_CASE("a record holds what figures and summary need") {
  auto s = scenario("elle_layer_extension", {"sheet.columns=40", "loading.steps=24", "grains.layer_low=0.45",
                                             "grains.layer_high=0.55", "loading.snapshots=[0.005, 0.01]"});
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
  set.push_back("loading.steps=6");
  const auto first = model().cases(scenario("elle_polycrystal", set)).front();
  CHECK(run(first).value(quantity::grains) == 20);
  std::ofstream(file) << elle_text(voronoi_map({21, 2, true, 1.0, 7}));
  CHECK(model().cases(scenario("elle_polycrystal", set)).front().content != first.content);
}

TEST_CASE("a run that is stopped goes on from its checkpoint to the same record") {
  const test::Scratch scratch;
  std::vector<std::string> set = tiny;
  set.push_back("loading.steps=6");
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
