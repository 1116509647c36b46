// Events of cracks, their sources and magnitudes.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "engine/analysis/emission.h"
#include "engine/analysis/magnitudes.h"
#include "engine/core/random.h"

using doctest::Approx;
using namespace dem::analysis;

namespace {

Hit at(double time, double x, double energy = 1) { return {.time = time, .place = {x, 0, 0}, .energy = energy}; }

/// Magnitudes of a law with this b, those that are seen: above `complete` all, below it ever fewer.
std::vector<double> catalogue(dem::RandomStream& random, double b, double complete, std::size_t events) {
  std::vector<double> seen;
  while (seen.size() < events) {
    const double m = complete - 1 - std::log10(1 - random.uniform()) / b;
    if (m >= complete || random.uniform() < std::pow(10, 2.5 * (m - complete))) seen.push_back(m);
  }
  return seen;
}

dem::Record record_with(bool own) {
  dem::Record record;
  dem::Table particles{"particles", {}, {}}, contacts{"contacts", {}, {}}, cracks{"cracks", {}, {}},
      history{"history", {}, {}};
  particles.add("position", "m", std::vector<double>{0, 0, 0, 0, 0, 2}, 3);
  contacts.add("pair", "", std::vector<std::int32_t>{0, 1}, 2);
  cracks.add("time", "s", std::vector<double>{1, 2, 2.5, 9});
  cracks.add("position", "m", std::vector<double>(12, 0.0), 3);
  cracks.add("normal", "1", std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
  cracks.add("area", "m^2", std::vector<double>{1, 1, 3, 1});
  cracks.add("mode", "", std::vector<std::int32_t>{0, 0, 0, 1});
  cracks.add("contact", "", std::vector<std::int32_t>(4, 0));
  history.add("time", "s", std::vector<double>{0, 2, 4, 8});
  history.add("bond_tension", "J", std::vector<double>{0, 10, 16, 16});
  history.add("bond_shear", "J", std::vector<double>{0, 0, 0, 5});
  if (own) {
    cracks.add("released", "J", std::vector<double>{1, 2, 3, 4});
    cracks.add("force", "N", std::vector<double>{0, 0, -7, 0, 0, 7, 5, 0, 0, 0, 0, 0}, 3);
  }
  record.tables = {particles, contacts, cracks, history};
  return record;
}

}  // namespace

TEST_CASE("cracks within the window of an event belong to it, others begin one") {
  const Window window{1, 0.1};
  const std::vector<Hit> hits{at(0, 0), at(0.05, 0.9), at(0.06, 5), at(0.14, -0.5), at(0.3, 0), at(0.35, 1.1)};
  const auto events = events_of(hits, window);
  REQUIRE(events.size() == 4);
  CHECK(events[0].hits == 3);  // the third one comes within the time of the second
  CHECK(events[0].duration == Approx(0.14));
  CHECK(events[1].centre[0] == Approx(5));
  CHECK(events[2].time == 0.3);
  CHECK(events[3].hits == 1);  // 1.1 from the first crack of the event before
  CHECK(events_of({}, window).empty());
}

TEST_CASE("of two events a crack belongs to the one that began nearer") {
  const auto events = events_of(std::vector{at(0, 0), at(0, 1.5), at(0.01, 0.9)}, {1, 0.1});
  REQUIRE(events.size() == 2);
  CHECK(events[1].hits == 2);
}

TEST_CASE("no energy is lost between cracks and events, and the centre is that of the energy") {
  const auto events = events_of(std::vector{at(0, 0, 1), at(0.01, 0.8, 3)}, {1, 0.1});
  REQUIRE(events.size() == 1);
  CHECK(events[0].energy == 4);
  CHECK(events[0].centre[0] == Approx(0.6));
  CHECK(events[0].magnitude() == Approx(2.0 / 3 * (std::log10(4.0) - 4.8)));
  CHECK(energy_magnitude(std::pow(10, 4.8)) == Approx(0));
}

TEST_CASE("cracks that keep what they released and which force have it as it is") {
  const Hits hits = hits_of(record_with(true));
  CHECK(hits.own_energies);
  REQUIRE(hits.forces);
  CHECK(hits.all[3].energy == 4);
  // A bond in tension pulls its second particle back: its end is a dipole that opens along z.
  CHECK(hits.all[0].moment[2] == Approx(14));
  CHECK(hits.all[1].moment[2] == Approx(-14));
  CHECK(hits.all[2].moment[4] == Approx(-5));  // xz, half of f l
  CHECK(hits.all[2].moment[2] == 0);
}

TEST_CASE("without them the heat between two samples is shared by area, class by class, and none is lost") {
  const Hits hits = hits_of(record_with(false));
  CHECK_FALSE(hits.own_energies);
  CHECK_FALSE(hits.forces);
  CHECK(hits.all[0].energy == Approx(5));
  CHECK(hits.all[1].energy == Approx(5));
  CHECK(hits.all[2].energy == Approx(6));
  CHECK(hits.all[3].energy == Approx(5));  // after the last sample: it belongs to that
}

TEST_CASE("sources: a dipole opens or closes, a couple shears, whatever the axes") {
  const auto opening = source_of({0, 0, 3, 0, 0, 0});
  REQUIRE(opening);
  CHECK(opening->ratio == Approx(100.0 * 3 / 7));  // trace 3, deviator 2 + 1 + 1
  CHECK(opening->kind() == Source::opens);
  CHECK(opening->scalar_moment == Approx(3 / std::sqrt(2.0)));
  CHECK(source_of({0, -2, 0, 0, 0, 0})->kind() == Source::closes);
  const auto couple = source_of({0, 0, 0, 0, 5, 0});
  CHECK(couple->ratio == Approx(0));
  CHECK(couple->kind() == Source::shears);
  CHECK(couple->scalar_moment == Approx(5));
  CHECK(source_of({1, 1, 1, 0, 0, 0})->ratio == Approx(100));
  CHECK_FALSE(source_of({}));
  // A tension crack in a medium with lambda = mu, (1, 1, 3), turned about x by 30 degrees.
  const double c = std::cos(0.5235987755982988), s = std::sin(0.5235987755982988);
  const auto crack = source_of({1, c * c + 3 * s * s, s * s + 3 * c * c, 0, 0, -2 * s * c});
  CHECK(crack->ratio == Approx(100 * 5 / (5 + 8.0 / 3)));
}

TEST_CASE("bins hold what is nearest to their centre") {
  const MagnitudeBins bins = bins_of(std::vector{-1.04, -0.96, -0.76}, 0.1);
  CHECK(bins.first == Approx(-1));
  CHECK(bins.events == std::vector<std::size_t>{2, 0, 1});
  CHECK(bins.centre(2) == Approx(-0.8));
  CHECK(bins_of({}).events.empty());
}

TEST_CASE("b comes back within two standard errors in 95 of 100 catalogues") {
  dem::RandomStream random(1, dem::Purpose::test_data);
  for (const double b : {0.8, 1.0, 1.5}) {
    CAPTURE(b);
    int within = 0;
    double sum = 0;
    for (int c = 0; c < 100; ++c) {
      const auto fit = fit_magnitudes(catalogue(random, b, -6, 2000));
      REQUIRE(fit);
      CHECK(fit->complete_from >= -6.05);
      within += std::abs(fit->b - b) <= 2 * fit->error;
      sum += fit->b / 100;
    }
    CHECK(within >= 95);
    CHECK(sum == Approx(b).epsilon(0.01));
  }
}

TEST_CASE("wide bins do not bend b: the correction is exact for a law in bins") {
  dem::RandomStream random(2, dem::Purpose::test_data);
  double sum = 0;
  for (int c = 0; c < 50; ++c) {
    std::vector<double> magnitudes;
    for (int k = 0; k < 2000; ++k) magnitudes.push_back(-0.25 - std::log10(1 - random.uniform()));
    sum += fit_magnitudes(magnitudes, 0.5)->b / 50;  // Aki's formula says 0.8
  }
  CHECK(sum == Approx(1).epsilon(0.015));
}

TEST_CASE("the line through the catalogue gives its number of events; too few have none") {
  dem::RandomStream random(3, dem::Purpose::test_data);
  const auto fit = fit_magnitudes(catalogue(random, 1, -6, 1000));
  REQUIRE(fit);
  CHECK(fit->at_least(fit->complete_from - 0.05) == Approx(static_cast<double>(fit->events)));
  CHECK_FALSE(fit_magnitudes(std::vector<double>(20, -5.0)));
  CHECK_FALSE(fit_magnitudes(std::vector<double>(200, -5.0)));
  CHECK_FALSE(fit_magnitudes({}));
}

TEST_CASE("a catalogue that bends is fitted from where it is straight, and one of two humps not at all") {
  dem::RandomStream random(4, dem::Purpose::test_data);
  std::vector<double> bent = catalogue(random, 1, -6, 1000);
  for (double& m : bent)
    if (m < -5.5) m = -5.5 + 0.1 * random.uniform() * 5;  // even up to -5, then as it was
  const auto fit = fit_magnitudes(bent);
  REQUIRE(fit);
  CHECK(fit->holds());
  CHECK(fit->complete_from > -5.55);
  CHECK(std::abs(fit->b - 1) < 3 * fit->error);
  std::vector<double> humps;
  for (int k = 0; k < 400; ++k) humps.push_back((k % 2 == 0 ? -6.0 : -4.0) + 0.05 * random.normal());
  const auto none = fit_magnitudes(humps);
  REQUIRE(none);
  CHECK_FALSE(none->holds());
}

TEST_CASE("a law can be asked to begin higher") {
  dem::RandomStream random(5, dem::Purpose::test_data);
  const auto magnitudes = catalogue(random, 1, -6, 2000);
  const auto fit = fit_magnitudes(magnitudes, 0.1, 30, -5.5);
  REQUIRE(fit);
  CHECK(fit->complete_from >= -5.55);
  CHECK(fit->events < 1000);
  CHECK_FALSE(fit_magnitudes(magnitudes, 0.1, 30, 5));
}
