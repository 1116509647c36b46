// What verdicts read off the tables of a record: cracks by class, mineral and part of the test; how a block comes apart.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "engine/analysis/breaking.h"
#include "engine/analysis/cracking.h"
#include "engine/analysis/peaks.h"

namespace {

using dem::Record;
using dem::Table;
using dem::analysis::CrackChoice;
using dem::analysis::CrackMeasure;
using Ints = std::vector<std::int32_t>;
using Reals = std::vector<double>;

// Four particles of feldspar, feldspar, quartz, biotite in a row: a joint and two bonds; the joint is broken twice.
Record granite() {
  Record r;
  Table particles{"particles", {{"minerals", "alkali_feldspar,quartz,biotite"}}, {}};
  particles.add("mineral", "", Ints{0, 0, 1, 2});
  Table contacts{"contacts", {}, {}};
  contacts.add("pair", "", Ints{0, 1, 1, 2, 2, 3}, 2);
  contacts.add("place", "", Ints{0, 1, 1});
  Table cracks{"cracks", {}, {}};
  cracks.add("place", "", Ints{1, 0, 0, 1});
  cracks.add("mode", "", Ints{0, 0, 1, 1});
  cracks.add("mineral_a", "", Ints{0, 0, 0, 1});
  cracks.add("mineral_b", "", Ints{1, 0, 0, 2});
  cracks.add("contact", "", Ints{1, 0, 0, 2});
  cracks.add("area", "m^2", Reals{4, 1, 1, 2});
  Table history{"history", {}, {}};
  history.add("axial_strain", "1", Reals{0, 0.001, 0.002, 0.003});
  history.add("lateral_strain", "1", Reals{0, -0.0002, -0.0006, -0.002});
  history.add("axial_stress", "Pa", Reals{0, 70e6, 120e6, 60e6});
  r.tables = {particles, contacts, cracks, history};
  for (const auto& [moment, count] : {std::pair{"damage", "1"}, {"peak", "3"}})
    r.tables.push_back({"snapshots/000" + std::string(count), {{"moment", moment}, {"cracks", count}}, {}});
  return r;
}

// A square of four elements, one bond along each side, pulled apart: two bonds open.
Record block() {
  Record r;
  Table particles{"particles", {}, {}};
  particles.add("position", "m", Reals{0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1}, 3);
  particles.add("radius", "m", Reals(4, 0.5));
  Table contacts{"contacts", {}, {}};
  contacts.add("pair", "", Ints{0, 1, 0, 2, 1, 3, 2, 3}, 2);
  contacts.add("direction", "", Ints{0, 3, 3, 0});
  Table cracks{"cracks", {}, {}};
  cracks.add("element", "", Ints{0, 1});
  cracks.add("direction", "", Ints{3, 3});
  Table h{"history", {}, {}};
  h.add("time", "s", Reals{0, 1, 2, 3, 4, 5});
  h.add("axial_strain", "1", Reals{0, 1e-4, 2e-4, 3e-4, 4e-4, 5e-4});
  h.add("axial_stress", "Pa", Reals{0, 10, 20, 18, 40, 4});
  h.add("opening", "1", Reals{0, 0, 0, 1, 2, 2});
  h.add("sliding", "1", Reals(6, 0.0));
  h.add("elastic_normal", "J", Reals{0, 1, 4, 3, 16, 1});
  h.add("elastic_shear", "J", Reals(6, 0.0));
  h.add("elastic_planes", "J", Reals(6, 0.0));
  h.add("kinetic", "J", Reals{0, 0, 0, 1, 4, 1});
  h.add("breaking_heat_normal", "J", Reals{0, 0, 0, 1, 3, 4});
  h.add("breaking_heat_shear", "J", Reals(6, 0.0));
  r.tables = {particles, contacts, cracks, h};
  return r;
}

}  // namespace

TEST_CASE("cracks by class, by mineral, by pair and by moment") {
  const Record r = granite();
  const auto number = [&](const CrackChoice& choice) { return cracks_of(r, choice, CrackMeasure::number); };
  CHECK(number({}) == 4);
  CHECK(number({.place = 0}) == 2);
  CHECK(number({.mode = 1}) == 2);
  CHECK(number({.minerals = {"alkali feldspar"}}) == 3);
  CHECK(number({.without = {"quartz"}}) == 2);
  CHECK(number({.pair = {"quartz", "alkali feldspar"}}) == 1);
  CHECK(number({.minerals = {"biotite", "quartz"}}) == 2);
  CHECK(number({.until = "damage"}) == 1);
  CHECK(number({.after = "damage", .until = "peak"}) == 2);
  CHECK(number({.after = "peak"}) == 1);
  CHECK_THROWS_AS(number({.until = "post_peak"}), std::out_of_range);
  CHECK_THROWS_AS(number({.minerals = {"olivine"}}), std::invalid_argument);
}

TEST_CASE("the same cracks by contact, by area and by what could crack") {
  const Record r = granite();
  CHECK(cracks_of(r, {.place = 0}, CrackMeasure::contacts) == 1);
  CHECK(cracks_of(r, {.place = 1}, CrackMeasure::area) == 6);
  CHECK(cracks_of(r, {.place = 1, .mode = 0}, CrackMeasure::exposure) == 0.5);
  CHECK(cracks_of(r, {.place = 1, .pair = {"quartz", "biotite"}}, CrackMeasure::exposure) == 1);
}

TEST_CASE("lateral strain at an axial strain, up to the peak") {
  CHECK(dem::analysis::lateral_strain_at(granite(), 0.0015) == doctest::Approx(-0.0004));
  CHECK(std::isnan(dem::analysis::lateral_strain_at(granite(), 0.0025)));
}

TEST_CASE("pieces are what unbroken bonds hold together") {
  Record r = block();
  CHECK(dem::analysis::pieces_of(r) == 2);
  CHECK(dem::analysis::pieces_of(r, 0.6) == 0);
  r.tables[2].columns.clear();
  r.tables[2].add("element", "", Ints{0});
  r.tables[2].add("direction", "", Ints{3});
  CHECK(dem::analysis::pieces_of(r) == 1);
}

TEST_CASE("falls, straightness and what is left of energies") {
  const Record r = block();
  using namespace dem::analysis;
  CHECK(largest_fall(r, 0, 4) == doctest::Approx(0.1));
  CHECK(largest_fall(r, 0, 2) == 0);
  CHECK(straightness(r, 2) == doctest::Approx(1));
  CHECK(straightness(r, 3) == doctest::Approx(0.6));
  CHECK(opened_below(r, 19) == 0);
  CHECK(opened_below(r, 30) == 1);
  CHECK(elastic_left(r, 4) == doctest::Approx(1.0 / 16));
  CHECK(kinetic_left(r, 3) == 0.25);
  CHECK(breaking_after(r, 4) == 0.25);
  CHECK(first_at_boundary(r) == 1);  // all are outside
}

TEST_CASE("a fall begins at the largest stress so far, and its end is the least before the stress is as large again") {
  Record r;
  Table h{"history", {}, {}};
  h.add("time", "s", Reals{0, 1, 2, 3, 4, 5, 6, 7});
  h.add("axial_strain", "1", Reals{0, 1, 2, 3, 4, 5, 6, 7});
  h.add("axial_stress", "Pa", Reals{0, 57, 55, 44, 39, 50, 60, 1});
  r.tables = {h};
  for (const double while_it_falls : {1.0, 2.0, 3.0}) {
    const dem::analysis::Fall fall = dem::analysis::fall_at(r, while_it_falls);
    CHECK(fall.time == 1);
    CHECK(fall.strain == 1);
    CHECK(fall.stress == 57);
    CHECK(fall.low_time == 4);
    CHECK(fall.low_stress == 39);
  }
  CHECK(dem::analysis::fall_at(r, 6).low_stress == 1);
}

TEST_CASE("kinetic energy and viscous heat are shares of one whole in every test") {
  Record r = block();
  Table& h = r.tables.back();
  h.add("work", "J", Reals{0, 1, 4, 5, 20, 10});
  h.add("viscous_heat", "J", Reals{0, 0, 0, 0, 1, 5});
  h.add("frictional_heat", "J", Reals{0, 0, 0, 0, 0, 1});
  CHECK(dem::analysis::kinetic_over_work(r, 3) == doctest::Approx(0.2));
  CHECK(dem::analysis::kinetic_over_work(r, 5) == doctest::Approx(0.1));
  CHECK(dem::analysis::viscous_share(r) == doctest::Approx(0.5));
}

TEST_CASE("what is lost and generated between two moments, and whether the elastic energy goes with the stress") {
  Record r = block();
  Table& h = r.tables.back();
  h.add("viscous_heat", "J", Reals{0, 0, 0, 0, 1, 5});
  h.add("frictional_heat", "J", Reals{0, 0, 0, 0, 0, 1});
  using namespace dem::analysis;
  CHECK(elastic_loss(r, 2, 3) == doctest::Approx(0.25));
  CHECK(elastic_loss(r, 3, 4) < 0);
  CHECK(time_of_least_elastic(r, 2) == 5);
  CHECK(heat_until(r, 2) == 0);
  CHECK(heat_until(r, 4) == doctest::Approx(0.4));
  CHECK(breaking_between(r, 2, 4) == doctest::Approx(0.75));
  CHECK(shear_breaking_between(r, 2, 4) == 0);  // there is none at all
  CHECK(breaking_over_elastic(r, 2, 4) == doctest::Approx(0.75));
  const std::array path{0.0, 2.0, 3.0, 4.0, 5.0};
  CHECK(steps_alike(r, path) == 4);
  for (dem::Column& column : r.tables.back().columns) {
    if (column.name == "elastic_normal") std::get<Reals>(column.values)[3] = 5;  // stress falls there
  }
  CHECK(steps_alike(r, path) == 3);
}

TEST_CASE("where grains grow between walls that are held, growth is not called strain") {
  const dem::Quantity onset{.id = "onset_strain", .name = "Strain at the first break"};
  Record growth, shear;
  growth.parameters = {{"test", "growth"}};
  shear.parameters = {{"test", "pure_shear"}};
  const std::vector<const Record*> grown{&growth}, both{&growth, &shear};
  CHECK(dem::analysis::name_of(onset, grown) == "Growth at the first break");
  CHECK(dem::analysis::name_of(onset, both) == "Strain at the first break");
  CHECK(dem::analysis::name_of(onset, {}) == "Strain at the first break");
}

TEST_CASE("a stress that still rises at the end of a run has no peak") {
  const dem::Quantity largest{.id = "largest", .name = "Largest stress", .peak_name = "Peak stress"};
  const auto sheet = [](const Reals& loaded, const Reals& left) {
    Record r;
    Table h{"history", {}, {}};
    h.add("loaded_stress_xx", "1", loaded);
    h.add("loaded_stress_yy", "1", Reals(loaded.size(), 0.0));
    h.add("stress_xx", "1", left);
    h.add("stress_yy", "1", Reals(left.size(), 0.0));
    r.tables = {h};
    return r;
  };
  using namespace dem::analysis;
  // A load step that takes a third and gives it back is no peak; neither is a last step that takes a tenth.
  const Record rising = sheet({1, 2, 3, 4}, {1, 1.3, 3, 3.6}), fallen = sheet({1, 2, 4, 3}, {1, 2, 3, 2.9});
  CHECK_FALSE(passed_peak(rising));
  CHECK(passed_peak(fallen));
  CHECK(passed_peak(block()));
  const std::vector<const Record*> both{&fallen, &rising}, one{&fallen};
  CHECK(name_of(largest, both) == "Largest stress");
  CHECK(name_of(largest, one) == "Peak stress");
  CHECK(name_of({.id = "other", .name = "Other"}, one) == "Other");
}
