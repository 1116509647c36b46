// Bodies that are cut out of packings, jaws and the gauge of a notch; direct shear, loops of unloading.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "engine/analysis/emission.h"
#include "engine/core/archive.h"
#include "engine/core/random.h"
#include "engine/texture/genesis/body.h"
#include "engine/texture/keys.h"
#include "engine/texture/laws/wall_contact.h"
#include "engine/texture/loading/bending.h"
#include "engine/texture/loading/brazilian.h"
#include "engine/texture/loading/direct_shear.h"
#include "engine/texture/loading/loading.h"
#include "engine/texture/loading/unloading_loops.h"
#include "engine/texture/model.h"
#include "engine/texture/quantities.h"
#include "engine/texture/results.h"
#include "tests/support/granite.h"
#include "tests/support/near.h"
#include "tests/support/scratch.h"

using namespace dem::texture;

namespace {

Settings granite_in(const Test& test) {
  Settings s = dem_test::granite(6.25, 12.5);
  s.test = test;
  if (test.body) s.packing.vessel = vessel_of(*test.body, s.packing.radius_min * (1 + s.packing.radius_ratio));
  return s;
}

// Runs a test to its end and reads it off.
struct Run {
  Settings settings;
  Specimen specimen;
  Loading loading;
  dem::Record record;
  explicit Run(const Settings& s) : settings(s), specimen(make(s)), loading(specimen, settings, 1) {
    while (loading.advance()) {
    }
    record.quantities = quantities();
    add_test(record, specimen, settings, loading);
  }
  static Specimen make(const Settings& s) {
    dem::RunContext context;
    return make_specimen(s, context);
  }
  [[nodiscard]] double value(const dem::Quantity& quantity) const { return record.value_or_nan(quantity); }
};

Settings unbreakable(Settings s) {
  for (Mineral& m : s.minerals) m.tensile_strength = m.cohesion = 1e15;
  return s;
}

}  // namespace

TEST_CASE("a body knows its volume and what belongs to it") {
  const Body bar{Body::Shape::bar, {40e-3, 6e-3, 10e-3}, 5e-3};
  CHECK(bar.volume() == test::near(40e-3 * 6e-3 * 10e-3));
  CHECK(bar.smallest() == 6e-3);
  CHECK(bar.holds({19e-3, 2.9e-3, 0}));
  CHECK_FALSE(bar.holds({19e-3, 3.1e-3, 5e-3}));
  CHECK_FALSE(bar.holds({0, 0, -1e-6}));
  CHECK(bar.notched({-1e-3, 0, 1e-3}, {1e-3, 0, 2e-3}));
  CHECK(bar.notched({-1e-3, 0, 4e-3}, {1e-3, 0, 5.9e-3}));        // it crosses the plane at 4.95 mm
  CHECK_FALSE(bar.notched({-1e-3, 0, 4e-3}, {1e-3, 0, 6.1e-3}));  // at 5.05 mm
  CHECK_FALSE(bar.notched({1e-3, 0, 1e-3}, {2e-3, 0, 1e-3}));     // on one side
  const Cylinder vessel = vessel_of(bar, 1e-3);
  CHECK(vessel.diameter == test::near(std::hypot(6e-3, 10e-3) + 2e-3));
  CHECK(vessel.height == test::near(42e-3));
  const Body disc{Body::Shape::disc, {20e-3, 10e-3, 20e-3}}, half{Body::Shape::half_disc, {20e-3, 10e-3, 10e-3}};
  CHECK(disc.volume() == test::near(std::numbers::pi * 1e-4 * 10e-3));
  CHECK(half.volume() == test::near(disc.volume() / 2));
  CHECK(half.holds({5e-3, 0, 1e-6}));
  CHECK_FALSE(half.holds({5e-3, 0, -1e-6}));
}

TEST_CASE("what is cut out of a packing lies in its box, holds together, and has its notch") {
  constexpr double particle = 0.35e-3 * 2.66;
  for (const Test& test : {brazilian(9e-3, 5e-3), semicircular_bending(11e-3, 5e-3, 0.5, 0.6, particle),
                           bending(7e-3, 5e-3, 0.5, particle)}) {
    const Settings settings = granite_in(test);
    const Specimen specimen = Run::make(settings);
    const Body& body = *test.body;
    CAPTURE(test.name);
    const std::size_t n = specimen.packing.position.size();
    REQUIRE(n > 100);
    std::vector<int> contacts(n, 0);
    std::size_t across = 0;
    for (const BondSpec& bond : specimen.bonds) {
      REQUIRE(static_cast<std::size_t>(bond.second) < n);
      ++contacts[static_cast<std::size_t>(bond.first)];
      ++contacts[static_cast<std::size_t>(bond.second)];
      const Vec3 &a = specimen.packing.position[static_cast<std::size_t>(bond.first)],
                 &b = specimen.packing.position[static_cast<std::size_t>(bond.second)];
      CHECK(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) <=
            specimen.packing.radius[static_cast<std::size_t>(bond.first)] +
                specimen.packing.radius[static_cast<std::size_t>(bond.second)]);
      across += body.notched(a, b) ? 1 : 0;
    }
    CHECK(across == 0);
    if (body.notch <= 0) CHECK(*std::ranges::min_element(contacts) >= 2);
    double low = 1, high = -1;
    for (const Vec3& at : specimen.packing.position) {
      CHECK(body.holds(at));
      CHECK(std::abs(at[0]) <= body.size[0] / 2);
      CHECK(std::abs(at[1]) <= body.size[1] / 2);
      low = std::min(low, at[2]);
      high = std::max(high, at[2]);
    }
    CHECK(low > -1e-9);
    CHECK(high < body.size[2] + 1e-9);
    CHECK(high - low > 0.85 * body.size[2]);
    CHECK(specimen.packing.porosity > 0.2);
    CHECK(specimen.packing.porosity < 0.45);
    // Every grain that is left has particles, and every particle a grain.
    std::vector<int> particles(specimen.seeds.radius.size(), 0);
    for (const std::int32_t grain : specimen.grains.grain) ++particles.at(static_cast<std::size_t>(grain));
    CHECK(*std::ranges::min_element(particles) > 0);
  }
}

TEST_CASE("a hollow jaw pushes towards its axis") {
  // A jaw of 5 mm round a sphere of 1 mm, whose centre is 3.5 mm from the axis: half a millimetre is left.
  const JawGap jaw = jaw_gap(5e-3, 2.1e-3, -2.8e-3, 1e-3);
  CHECK(jaw.gap == test::near(0.5e-3));
  CHECK(jaw.x == test::near(-0.6));
  CHECK(jaw.z == test::near(0.8));
}

TEST_CASE("the gauge of a notch reads how far its sides have moved apart") {
  dem::RandomStream random(3, dem::Purpose::test_data);
  std::vector<Vec3> position;
  for (int i = 0; i < 300; ++i) {
    position.push_back({random.uniform(-5e-3, 5e-3), random.uniform(-2e-3, 2e-3), random.uniform(0, 8e-3)});
  }
  const MouthGauge gauge(position, 1.5e-3);
  std::vector<Row8> poses;
  for (const Vec3& p : position) {
    // Its sides turn as it opens; what lies higher is not looked at.
    const double side = (p[0] < 0 ? -4e-6 : 3e-6) * (1 - p[2] / 4e-3), far = p[2] > 1.5e-3 ? 1e-4 : 0;
    poses.push_back({{p[0] + side + far, p[1], p[2], 1e-4, 1, 0, 0, 0}});
  }
  CHECK(gauge.read(poses) == test::near(7e-6).epsilon(1e-9));
  CHECK(MouthGauge({}, 0).read({}) == 0);
}

TEST_CASE("what makes no test is told with file, line and key") {
  struct Bad {
    std::string test, table, key, value, said;  // in the file: [table], key = value
    std::string more = {};                      // a line of the table before it
  };
  const std::vector<Bad> all = {
      {"brazilian", "brazilian", "thickness", "\"3 mm\"", "write at least 4.55 mm"},
      {"brazilian", "brazilian", "diameter", "\"8 mm\"", "write at least 4.55 mm"},
      {"brazilian", "brazilian", "thickness", "\"21 mm\"", "thicker than wide", "diameter = \"20 mm\""},
      {"brazilian", "brazilian", "jaw_ratio", "1.0", "write 1.5 (ISRM)"},
      {"brazilian", "sweep", "jaw_ratio", "[0, 1.02]", "write 1.5 (ISRM)"},
      {"brazilian", "sweep", "jaw_ratio", "[]", "the list is empty"},
      {"brazilian", "brazilian", "sample_strain", "1e-8", "closer than steps"},
      {"bending", "bending", "width", "\"3 mm\"", "write at least 4.55 mm"},
      {"bending", "bending", "notch", "0.1", "write 0.19 to 0.81", "depth = \"10 mm\""},
      {"bending", "bending", "notch", "0.9", "0 to 0.7"},
      {"bending", "sweep", "notch", "[0, 0.05]", "the notch is"},
      {"semicircular_bending", "semicircular_bending", "thickness", "\"3 mm\"", "write at least 4.55 mm"},
      {"semicircular_bending", "semicircular_bending", "notch", "0.6", "the ligament is 1.8 mm high",
       "diameter = \"9 mm\""},
      {"semicircular_bending", "semicircular_bending", "notch", "0.7", "0.4 to 0.6"},
      {"semicircular_bending", "semicircular_bending", "span", "0.4", "0.5 to 0.8"},
      {"direct_shear", "direct_shear", "edge", "\"3 mm\"", "write at least 4.55 mm"},
      {"direct_shear", "direct_shear", "grip", "0.02", "write at least 0.05", "edge = \"7 mm\""},
      {"direct_shear", "direct_shear", "gap", "0.1", "write at least 0.17", "edge = \"7 mm\""},
      {"direct_shear", "direct_shear", "normal_stress", "\"-5 MPa\"", "from 0 MPa to 1000 MPa"},
      {"direct_shear", "direct_shear", "displacement", "0.2", "write less than 0.1"},
      {"direct_shear", "sweep", "normal_stress", "[\"5 mm\"]", "MPa"},
      {"unloading_loops", "unloading_loops", "first", "0.06", "write less than unloading_loops.largest_strain"},
      {"unloading_loops", "unloading_loops", "every", "5e-5", "write at least 0.0001"},
      {"unloading_loops", "unloading_loops", "low", "1.0", "0.01 to 0.9"},
  };
  const test::Scratch folder;
  for (const Bad& bad : all) {
    const std::filesystem::path file = folder / "bad.toml";
    std::ofstream(file) << "model = \"grain_texture\"\ninclude = \"" DEM_SOURCE_DIR
                           "/scenarios/rocks/my_rock.toml\"\ntests = [\""
                        << bad.test << "\"]\n[" << bad.table << "]\n"
                        << (bad.more.empty() ? "# nothing" : bad.more) << "\n"
                        << bad.key << " = " << bad.value
                        << "\n[specimen]\ndiameter = \"12.5 mm\"\nheight = \"25 mm\"\n[scales.paper]\n";
    CAPTURE(bad.table + "." + bad.key + " = " + bad.value);
    std::optional<dem::InputError> error;
    try {
      const dem::Scenario scenario = dem::Scenario::read(file, "paper", {}, [](std::string_view) { return keys(); });
      (void)model().cases(scenario);
    } catch (const dem::InputError& caught) {
      error = caught;
    }
    REQUIRE(error);
    const std::string what = error->what();
    CAPTURE(what);
    CHECK(error->where().file.ends_with("bad.toml"));
    CHECK(error->where().line == 6);
    CHECK(error->key().starts_with(bad.table + "." + bad.key));
    CHECK(what.find(bad.said) != std::string::npos);
  }
}

TEST_CASE("a block in direct shear keeps its normal stress, breaks along the gap, and goes on to the same bits") {
  Test test = direct_shear(7e-3, 10e6);
  test.rate = 1e-6;
  test.ending.follow_strain = 0.01;
  const Settings settings = granite_in(test);
  const Run run(settings);
  REQUIRE(run.loading.end());
  const std::vector<HistoryRow>& h = run.loading.history();
  const auto peak = std::ranges::max_element(h, {}, &HistoryRow::axial_stress);
  CHECK(peak->axial_stress > 10e6);
  double normal = 0;
  for (const HistoryRow& row : h) normal += row.confining_pressure / static_cast<double>(h.size());
  CHECK(normal == test::near(10e6).epsilon(0.03));
  CHECK(run.value(quantity::energy_residual) < 1e-2);
  CHECK(run.value(quantity::residual_shear) < run.value(quantity::shear_strength));
  // Acoustic emission: whatever the window, events release what the ledger says of the bonds broken by then.
  namespace analysis = dem::analysis;
  const analysis::Hits hits = analysis::hits_of(run.record);
  REQUIRE(hits.own_energies);
  REQUIRE(hits.all.size() > 20);
  const auto after = std::ranges::find_if(h, [&](const HistoryRow& row) { return row.time >= hits.all.back().time; });
  REQUIRE(after != h.end());
  const double broken = after->ledger.bond_tension + after->ledger.bond_shear;
  std::size_t fewest = hits.all.size();
  for (const double window : {1e-9, 2e-3, 1.0}) {
    const auto events = analysis::events_of(hits.all, {.length = window, .time = window});
    double released = 0;
    for (const analysis::Event& event : events) released += event.energy;
    CHECK(released == test::near(broken).epsilon(1e-3));
    CHECK(events.size() <= fewest);
    fewest = events.size();
  }
  CHECK(fewest == 1);
  // From a checkpoint.
  Loading whole(run.specimen, settings, 1);
  for (int k = 0; k < 30; ++k) whole.advance();
  dem::ArchiveWriter writer;
  writer(whole);
  Loading resumed(run.specimen, settings, 1);
  dem::ArchiveReader reader(writer.bytes());
  reader(resumed);
  for (int k = 0; k < 20; ++k) {
    whole.advance();
    resumed.advance();
  }
  CHECK(whole.history().back().axial_stress == resumed.history().back().axial_stress);
  CHECK(whole.history().back().opening == resumed.history().back().opening);
}

TEST_CASE("a disc splits along its loaded diameter, and where it cracks first is read off its first cracks") {
  const double diameter = 12.5e-3, radius = diameter / 2;
  Test test = brazilian(diameter, radius, 0);
  test.rate = 2e-7;
  const Run run(granite_in(test));
  REQUIRE(run.loading.end());
  const dem::Table& cracks = run.record.table("cracks");
  const auto place = cracks.real("position");
  double at_peak = 0, middle = 0, band = 0, along = 0;
  for (const dem::Quantity& one : quantity::cracks_at_peak) at_peak += run.value(one);
  const auto first = static_cast<std::size_t>(std::max(at_peak / 100, 10.0));
  for (std::size_t i = 0; i < cracks.rows(); ++i) {
    const double x = place[3 * i], z = place[3 * i + 2] - radius;
    along += std::abs(x) < radius / 4 ? 1 : 0;
    if (i >= first) continue;
    middle += std::hypot(x, z) < radius / 2 ? 1 : 0;
    band += std::abs(x) < radius / 4 ? 1 : 0;
  }
  CHECK(run.value(quantity::first_cracks_middle) == doctest::Approx(middle / static_cast<double>(first)));
  CHECK(run.value(quantity::first_cracks_band) == doctest::Approx(band / static_cast<double>(first)));
  // Of cracks spread evenly 31 % would lie there.
  CHECK(along / static_cast<double>(cracks.rows()) > 0.6);
  CHECK(run.value(quantity::brazilian_strength) > 5);
}

TEST_CASE("an unbreakable specimen loses no modulus in its loops") {
  Test test = unloading_loops();
  test.rate = 2e-7;
  test.loops = {4e-4, 2e-4, 0.1};
  test.ending.largest_strain = 1.1e-3;
  const Run run(unbreakable(granite_in(test)));
  const dem::Table& loops = run.record.table("loops");
  REQUIRE(loops.rows() >= 3);
  for (const double damage : loops.real("damage")) CHECK(std::abs(damage) < 0.01);
  const auto strain = loops.real("strain"), stress = loops.real("stress"), low = loops.real("low_stress");
  for (std::size_t i = 0; i < loops.rows(); ++i) {
    CHECK(strain[i] > 0);
    CHECK(low[i] < 0.1 * stress[i]);
  }
  CHECK_FALSE(run.record.has(quantity::compressive_strength));
  CHECK(run.value(quantity::energy_residual) < 1e-2);
}

TEST_CASE("no loop ends a test") {
  std::vector<HistoryRow> history(4);
  const double stress[] = {10e6, 1e6, 9e6, 12e6};
  for (std::size_t i = 0; i < 4; ++i) {
    history[i].axial_stress = stress[i];
    history[i].platen_strain = 1e-3;
  }
  CHECK(end_row(history, {.stop = 0.5}) == 1);
  history[1].phase = 1;
  history[2].phase = 2;
  CHECK_FALSE(end_row(history, {.stop = 0.5}));
}
