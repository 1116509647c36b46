// Tests of specimens: the table, the rules that end them, the strain gauge, the direct tension that is cut.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/core/archive.h"
#include "engine/core/random.h"
#include "engine/texture/keys.h"
#include "engine/texture/loading/characteristics.h"
#include "engine/texture/loading/direct_tension.h"
#include "engine/texture/loading/loading.h"
#include "engine/texture/model.h"
#include "engine/texture/quantities.h"
#include "engine/texture/results.h"
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
  CHECK(choices == std::vector<std::string>{"compression", "direct_tension", "brazilian", "bending",
                                            "semicircular_bending", "direct_shear", "unloading_loops", "genesis"});
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
  SUBCASE("a fall with few cracks is a local one, unless to half of the peak") {
    auto history = triangle(peak, at, 0.3);
    for (HistoryRow& row : history) row.cracks = {40, 9, 50, 0};
    CHECK(end_row(history, {.stop = 0.8, .least_cracks = 99}) == 121);
    const auto end = end_row(history, {.stop = 0.8, .least_cracks = 100});
    REQUIRE(end);
    CHECK(history[*end].axial_stress == doctest::Approx(0.5 * peak).epsilon(0.011));
    CHECK_FALSE(end_row(triangle(peak, at, 0.52), {.stop = 0.8, .least_cracks = 100}));
  }
  SUBCASE("a test may be followed after its end") {
    auto history = triangle(peak, at, 0.5);
    CHECK(is_over(history, {.stop = 0.8, .follow = 1.5}));
    CHECK_FALSE(is_over(history, {.stop = 0.8, .follow = 1.6}));
    CHECK(end_row(history, {.stop = 0.8, .follow = 1.6}) == 121);
    // Up to a strain, however far from that of the peak.
    CHECK(is_over(history, {.stop = 0.8, .follow_strain = 1.49 * at}));
    CHECK_FALSE(is_over(history, {.stop = 0.8, .follow_strain = 1.6 * at}));
  }
}

TEST_CASE("a test that no rule ends is given up at its limits") {
  const auto with_steps = [](std::vector<HistoryRow> history, double each) {
    for (std::size_t i = 0; i < history.size(); ++i) history[i].step = 1 + each * static_cast<double>(i);
    return history;
  };
  struct Case {
    const char* words;
    std::vector<HistoryRow> history;
    Ending ending;
    const char* limit;
  };
  const std::vector<Case> cases = {
      {"it never bears a load", triangle(0, 5e-3, 1), {.largest_strain = 5e-3}, "largest_strain"},
      {"a rock of kPa strength", triangle(0.9e5, 2e-3, 0.1), {.largest_strain = 3e-3}, "largest_strain"},
      {"it does not fall to its share",
       triangle(100e6, 2e-3, 0.6),
       {.stop = 0.5, .largest_strain = 2.5e-3},
       "largest_strain"},
      {"it hardens on", triangle(100e6, 2e-3, 1), {.largest_strain = 2e-3}, "largest_strain"},
      {"it is loaded too slowly", with_steps(triangle(100e6, 2e-3, 1), 10), {.most_steps = 1000}, "most_steps"},
  };
  for (const Case& c : cases) {
    CAPTURE(c.words);
    CHECK(limit_reached(c.history, c.ending) == c.limit);
    CHECK(is_over(c.history, c.ending));
    CHECK_FALSE(end_row(c.history, c.ending));
    const std::vector<HistoryRow> before(c.history.begin(), c.history.begin() + 50);
    CHECK(limit_reached(before, c.ending).empty());
    CHECK_FALSE(is_over(before, c.ending));
  }
  CHECK(limit_reached({}, {.largest_strain = 1e-3}).empty());
  // Every test that loads has both limits; its keys set them.
  for (const TestEntry& entry : tests()) {
    const std::string group = std::string(entry.name) + ".";
    if (!entry.read(my_rock({})).loads()) continue;
    const Test test = entry.read(my_rock({group + "largest_strain=0.04", group + "most_steps=77"}));
    CHECK(test.ending.largest_strain == 0.04);
    CHECK(test.ending.most_steps == 77);
    CHECK(entry.read(my_rock({})).ending.largest_strain > 5 * test.typical_strain);
  }
}

TEST_CASE("loading that is too fast, and a gauge that has not moved") {
  CHECK(rate_bias(0, 6) == 0);
  CHECK(rate_bias(1.2e-5, 6) < 0.03);
  CHECK(rate_bias(1.2e-2, 6) > 0.3);
  CHECK(rate_bias(2e-6, 6) * 2 == test::near(rate_bias(8e-6, 6)));
  // An elastic bar; its gauge moves by `share` of the ends.
  const auto bar = [](double share) {
    std::vector<HistoryRow> history = triangle(100e6, 2e-3, 0.7);
    for (HistoryRow& row : history) {
      row.axial_strain = share * row.platen_strain;
      row.lateral_strain = -0.2 * row.axial_strain;
      row.ledger.elastic = row.axial_stress;
      row.time = row.platen_strain / 4;
    }
    return history;
  };
  const Characteristics sound = characterise(bar(0.9), 0.02, true);
  REQUIRE(sound.young_modulus);
  CHECK(*sound.young_modulus == test::near(50e9 / 0.9).epsilon(1e-9));
  CHECK(sound.strain_rate == test::near(4).epsilon(1e-9));
  CHECK(sound.elastic_energy == test::near(30e6).epsilon(0.02));
  // 3 kg between ends 0.1 m apart that move at 0.2 m/s each: a sixth of 3 kg x (0.2 m/s)^2.
  CHECK(kinetic_share(sound, 0.1, 3) == test::near(0.02 / sound.elastic_energy).epsilon(1e-9));
  CHECK(kinetic_share({}, 0.1, 3) == 0);
  CHECK(sound.gauge_share == test::near(0.9).epsilon(1e-9));
  CHECK(sound.poisson_ratio);
  for (const double share : {0.0, 1e-6, 0.2, -1.0, 5.0}) {
    CAPTURE(share);
    const Characteristics still = characterise(bar(share), 0.02, true);
    CHECK_FALSE(still.young_modulus);
    CHECK_FALSE(still.poisson_ratio);
  }
}

TEST_CASE("specimens that are too coarse are refused, with the reason") {
  const auto refused = [](const std::vector<std::string>& set, const std::string& word) {
    try {
      read_settings(my_rock(set), "compression");
    } catch (const dem::InputError& error) {
      return std::string(error.what()).find(word) != std::string::npos;
    }
    return false;
  };
  CHECK(refused({"packing.minimum_radius=\"0.69 mm\""}, "across the specimen"));
  CHECK(refused({"packing.minimum_radius=\"0.6 mm\"", "texture.seed_scale=0.5"}, "a particle or two"));
  CHECK_NOTHROW(read_settings(my_rock({"packing.minimum_radius=\"0.5 mm\""}), "compression"));
}

TEST_CASE("a tension that finds nothing to hold comes to its end and says how far it went") {
  Settings settings = dem_test::granite(6.25, 12.5);
  settings.test = direct_tension();
  settings.test.rate = 1e-7;
  settings.test.ending.largest_strain = 2e-5;
  dem::RunContext context;
  const Specimen specimen = make_specimen(settings, context);
  Loading loading(specimen, settings, 1);
  double before = 0;
  while (loading.advance()) {
    CHECK(loading.fraction() >= before);
    before = loading.fraction();
  }
  CHECK(before > 0.5);
  CHECK(loading.fraction() == 1);
  CHECK_FALSE(loading.end());
  dem::Record record;
  record.quantities = quantities();
  add_test(record, specimen, settings, loading);
  CHECK_FALSE(record.has(quantity::tensile_strength));
  CHECK_FALSE(record.has(quantity::peak_strain));
  CHECK(record.has(quantity::coordination));
  CHECK(std::ranges::any_of(record.notes, [](const std::string& note) {
    return note.find("No strength was found up to a strain of") == 0 &&
           note.find("direct_tension.largest_strain") != std::string::npos;
  }));
  for (const auto& [id, value] : record.results) {
    CAPTURE(id);
    CHECK(std::isfinite(value));
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
  StrainGauge gauge(position, [](const Vec3& at) { return std::abs(at[2] - 10e-3) <= 6e-3; });
  const auto read = gauge.read(strained(-2e-3, 4e-4, 6e-4));
  CHECK(read[0] == test::near(4e-4).epsilon(1e-9));
  CHECK(read[1] == test::near(6e-4).epsilon(1e-9));
  CHECK(read[2] == test::near(-2e-3).epsilon(1e-9));
  std::vector<Vec3> start;
  for (const Row8& p : strained(-2e-3, 4e-4, 6e-4)) start.push_back({p.v[0], p.v[1], p.v[2]});
  gauge.restart(start);
  CHECK(std::abs(gauge.read(strained(-2e-3, 4e-4, 6e-4))[2]) < 1e-15);
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
