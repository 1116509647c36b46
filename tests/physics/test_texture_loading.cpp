// Tests of specimens: the table, the rules that end them, the strain gauge, the direct tension that is cut.
#include <doctest/doctest.h>

#include <algorithm>

#include "engine/core/archive.h"
#include "engine/core/random.h"
#include "engine/texture/keys.h"
#include "engine/texture/loading/direct_tension.h"
#include "engine/texture/loading/loading.h"
#include "engine/texture/model.h"
#include "tests/support/granite.h"
#include "tests/support/near.h"

using namespace dem::texture;

namespace {

// Stress rises to `peak` (Pa) over a strain of `at`, in a hundred rows, and falls by the same slope to `share` of it.
std::vector<HistoryRow> triangle(double peak, double at, double share) {
  std::vector<HistoryRow> history;
  for (int i = 0; i <= 100 + static_cast<int>(100 * (1 - share)); ++i) {
    HistoryRow row;
    row.platen_strain = at * i / 100;
    row.axial_stress = peak * (i <= 100 ? i : 200 - i) / 100;
    history.push_back(row);
  }
  return history;
}

dem::Scenario my_rock(const std::vector<std::string>& set) {
  return dem::Scenario::read(DEM_SOURCE_DIR "/scenarios/my_rock.toml", "smoke", set,
                             [](std::string_view) { return keys(); });
}

}  // namespace

TEST_CASE("the tests of a scenario are those of the table, and an unknown one is an error that names them") {
  const auto choices = std::ranges::find(keys(), "tests", &dem::Key::path)->choices;
  CHECK(choices == std::vector<std::string>{"compression", "direct_tension", "genesis"});
  for (const TestEntry& entry : tests()) {
    const Test test = entry.read(my_rock({}));
    CHECK(test.name == entry.name);
    CHECK(test.loads() == (entry.name != "genesis"));
  }
  try {
    test_entry("tension");
    FAIL("there is no such test");
  } catch (const dem::InputError& error) {
    const std::string said = error.what();
    for (const TestEntry& entry : tests()) CHECK(said.find(entry.name) != std::string::npos);
  }
  CHECK_THROWS_AS(read_settings(my_rock({}), "tension"), dem::InputError);
}

TEST_CASE("each test reads its own keys") {
  const dem::Scenario scenario = my_rock({"compression.stop=0.7", "direct_tension.stop=0.4", "compression.rate=2e-7",
                                          "direct_tension.rate=3e-8", "direct_tension.grip=0.1"});
  const Test pressed = read_settings(scenario, "compression").test,
             pulled = read_settings(scenario, "direct_tension").test;
  CHECK(pressed.hold == Hold::platens);
  CHECK(pulled.hold == Hold::grips);
  CHECK(pressed.sense == -1);
  CHECK(pulled.sense == 1);
  CHECK(pressed.ending.stop == 0.7);
  CHECK(pulled.ending.stop == 0.4);
  CHECK(pressed.rate == 2e-7);
  CHECK(pulled.rate == 3e-8);
  CHECK(pulled.grip == 0.1);
  CHECK(pressed.grip == 0);
  CHECK(pulled.ending.strain_limit == 0);
  CHECK_THROWS_AS(
      read_settings(my_rock({"direct_tension.sample_strain=1e-8", "direct_tension.rate=1e-7"}), "direct_tension"),
      dem::InputError);
}

TEST_CASE("the rules that end a test") {
  const double peak = 100e6, at = 2e-3;
  SUBCASE("the stress falls to a share of its peak") {
    const auto history = triangle(peak, at, 0.5);
    CHECK(end_row(history, {.stop = 0.8}) == 121);  // the first row below 80 %
    CHECK_FALSE(end_row(history, {.stop = 0.4}));
    CHECK(is_over(history, {.stop = 0.8}));
    CHECK_FALSE(is_over(history, {.stop = 0.4}));
  }
  SUBCASE("the strain passes a multiple of that of the peak") {
    const auto history = triangle(peak, at, 0.5);
    CHECK(end_row(history, {.stop = 0.4, .strain_limit = 1.3}) == 131);
    CHECK_FALSE(end_row(history, {.stop = 0.4, .strain_limit = 0}));
    // Not below a strain of 1e-3, where the first peaks are small.
    CHECK_FALSE(end_row(triangle(peak, 5e-4, 0.5), {.stop = 0.4, .strain_limit = 1.3}));
  }
  SUBCASE("noise ends nothing") { CHECK_FALSE(end_row(triangle(0.9e5, at, 0.1), {.stop = 0.8})); }
  SUBCASE("a test may be followed after its end") {
    auto history = triangle(peak, at, 0.5);
    CHECK(is_over(history, {.stop = 0.8, .follow = 1.5}));
    CHECK_FALSE(is_over(history, {.stop = 0.8, .follow = 1.6}));
    CHECK(end_row(history, {.stop = 0.8, .follow = 1.6}) == 121);
  }
}

TEST_CASE("the strain gauge reads an affine field, from where it was started last") {
  dem::RandomStream random(9, dem::Purpose::test_data);
  std::vector<Vec3> position;
  for (int i = 0; i < 200; ++i) {
    position.push_back({random.uniform(-5e-3, 5e-3), random.uniform(-5e-3, 5e-3), random.uniform(0, 20e-3)});
  }
  const auto strained = [&](double axial, double lateral_x, double lateral_y) {
    std::vector<Row8> poses;
    for (const Vec3& p : position) {
      // What lies outside the gauge moves as it likes.
      const double wild = std::abs(p[2] - 10e-3) > 6e-3 ? 1e-4 : 0;
      poses.push_back({{p[0] * (1 + lateral_x) + 1e-5, p[1] * (1 + lateral_y) - 2e-5,
                        p[2] * (1 + axial) + 3e-5 + wild * p[0], 1e-4, 1, 0, 0, 0}});
    }
    return poses;
  };
  StrainGauge gauge(position, 20e-3, 12e-3);
  const StrainGauge::Strains read = gauge.read(strained(-2e-3, 4e-4, 6e-4));
  CHECK(read.axial == test::near(-2e-3).epsilon(1e-9));
  CHECK(read.lateral == test::near(5e-4).epsilon(1e-9));
  std::vector<Vec3> start;
  for (const Row8& p : strained(-2e-3, 4e-4, 6e-4)) start.push_back({p.v[0], p.v[1], p.v[2]});
  gauge.restart(start);
  CHECK(std::abs(gauge.read(strained(-2e-3, 4e-4, 6e-4)).axial) < 1e-15);
}

TEST_CASE("a direct tension pulls its specimen in two, and one that is cut goes on to the same bits") {
  Settings settings = dem_test::granite(6.25, 12.5);
  settings.test = direct_tension();
  settings.test.rate = 1e-7;
  dem::RunContext context;
  const Specimen specimen = make_specimen(settings, context);
  Loading whole(specimen, settings, 1);
  for (int k = 0; k < 40; ++k) whole.advance();
  dem::ArchiveWriter writer;
  writer(whole);
  Loading resumed(specimen, settings, 2);
  dem::ArchiveReader reader(writer.bytes());
  reader(resumed);
  while (whole.advance()) CHECK(resumed.advance());
  CHECK_FALSE(resumed.advance());
  const std::vector<HistoryRow>&a = whole.history(), &b = resumed.history();
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].axial_stress == b[i].axial_stress);
    CHECK(a[i].ledger.work == b[i].ledger.work);
  }
  REQUIRE(whole.end());
  const auto peak = std::ranges::max_element(a, {}, &HistoryRow::axial_stress);
  CHECK(peak->axial_stress > 1e6);
  CHECK(a[*whole.end()].axial_stress < settings.test.ending.stop * peak->axial_stress);
  // It stretches and grows thinner; all cracks are counted.
  CHECK(peak->axial_strain > 0);
  CHECK(peak->lateral_strain < 0);
  CHECK(a.back().cracks[0] + a.back().cracks[1] + a.back().cracks[2] + a.back().cracks[3] ==
        static_cast<double>(whole.assembly().cracks().size()));
}
