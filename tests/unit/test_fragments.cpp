// Parts that hold together: counted, sorted, and their sizes fitted.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "engine/analysis/fragments.h"
#include "engine/core/random.h"

using doctest::Approx;
using namespace dem::analysis;

namespace {

/// Particles on a line, each bonded to the next.
struct Chain {
  std::vector<std::int32_t> pair;
  std::vector<double> position, radius;
  explicit Chain(int n) {
    for (int i = 0; i < n; ++i) {
      position.insert(position.end(), {static_cast<double>(i), 0.0, 0.0});
      radius.push_back(0.5);
      if (i > 0) pair.insert(pair.end(), {i - 1, i});
    }
  }
};

dem::Record record_of(const std::vector<std::int32_t>& kind, const std::vector<std::int32_t>& broken) {
  const Chain chain(static_cast<int>(kind.size()) + 1);
  dem::Record record;
  dem::Table particles{"particles", {}, {}}, contacts{"contacts", {}, {}}, cracks{"cracks", {}, {}};
  particles.add("position", "m", chain.position, 3);
  particles.add("radius", "m", chain.radius);
  contacts.add("pair", "", chain.pair, 2);
  contacts.add("kind", "", kind);
  cracks.add("contact", "", broken);
  record.tables = {particles, contacts, cracks};
  return record;
}

}  // namespace

TEST_CASE("a chain that is cut twice has three parts, the largest first") {
  const Chain chain(10);
  std::vector<bool> alive(9, true);
  alive[2] = alive[7] = false;  // 0 1 2 | 3 4 5 6 7 | 8 9
  const Fragments parts = fragments_of(chain.pair, alive, chain.position, chain.radius);
  REQUIRE(parts.all.size() == 3);
  CHECK(parts.all[0].particles == 5);
  CHECK(parts.all[1].particles == 3);
  CHECK(parts.all[2].particles == 2);
  CHECK(parts.all[0].centre[0] == Approx(5));
  CHECK(parts.of[0] == 1);
  CHECK(parts.of[5] == 0);
  CHECK(parts.of[9] == 2);
  CHECK(parts.share(0) == Approx(0.5));
  CHECK(parts.share(3) == 0);
  CHECK(parts.of_at_least(0.25) == 2);
  CHECK(parts.single() == 0);
}

TEST_CASE("without a bond every particle is its own; with all of them there is one part") {
  const Chain chain(4);
  CHECK(fragments_of(chain.pair, std::vector<bool>(3, false), chain.position, chain.radius).single() == 4);
  CHECK(fragments_of(chain.pair, std::vector<bool>(3, true), chain.position, chain.radius).all.size() == 1);
}

TEST_CASE("a flat joint holds until its third element breaks, a bond between grains parts at once") {
  CHECK(fragments_of(record_of({0, 0, 0}, {1, 1})).all.size() == 1);
  CHECK(fragments_of(record_of({0, 0, 0}, {1, 1, 1})).all.size() == 2);
  CHECK(fragments_of(record_of({0, 1, 0}, {1})).all.size() == 2);
}

TEST_CASE("bonds of a lattice are found by element and direction") {
  dem::Record record = record_of({0, 0, 0}, {});
  record.tables[1] = {"contacts", {}, {}};
  record.tables[1].add("pair", "", std::vector<std::int32_t>{0, 1, 1, 2, 2, 3}, 2);
  record.tables[1].add("direction", "", std::vector<std::int32_t>{0, 3, 0});
  record.tables[2] = {"cracks", {}, {}};
  record.tables[2].add("element", "", std::vector<std::int32_t>{1});
  record.tables[2].add("direction", "", std::vector<std::int32_t>{3});
  const Fragments parts = fragments_of(record);
  REQUIRE(parts.all.size() == 2);
  CHECK(parts.of == std::vector<std::int32_t>{0, 0, 1, 1});
}

TEST_CASE("the zeta function of Hurwitz has its known values") {
  CHECK(hurwitz_zeta(2, 1) == Approx(1.6449340668482264).epsilon(1e-12));
  CHECK(hurwitz_zeta(4, 1) == Approx(1.0823232337111382).epsilon(1e-12));
  CHECK(hurwitz_zeta(3, 2) == Approx(1.2020569031595943 - 1).epsilon(1e-11));
  CHECK(hurwitz_zeta(1.5, 1) == Approx(2.6123753486854883).epsilon(1e-9));
}

TEST_CASE("a power law of sizes comes back within its interval") {
  dem::RandomStream random(1, dem::Purpose::test_data);
  int held = 0, ruled_out = 0;
  constexpr int catalogues = 200;
  const double exponent = 2.2, all = hurwitz_zeta(exponent, 1);
  for (int c = 0; c < catalogues; ++c) {
    std::vector<std::int32_t> sizes;
    for (int k = 0; k < 150; ++k) {
      double left = random.uniform();
      std::int32_t n = 1;
      while (n < 5000 && (left -= std::pow(n, -exponent) / all) > 0) ++n;
      sizes.push_back(n);
    }
    const auto law = fit_power_law(sizes);
    REQUIRE(law);
    held += law->exponent.low <= exponent && exponent <= law->exponent.high;
    ruled_out += !law->holds();
    CHECK(law->at_least(1) == Approx(1));
    CHECK(law->at_least(2) == Approx(1 - 1 / hurwitz_zeta(law->exponent.value, 1)));
  }
  CHECK(held >= 182);  // of 95 %, 190: three standard deviations below
  CHECK(held <= 199);
  CHECK(ruled_out <= 7);  // of 1 %, 2: some three standard deviations above
  CHECK_FALSE(fit_power_law(std::vector<std::int32_t>(20, 1)));
  CHECK_FALSE(fit_power_law(std::vector<std::int32_t>{1, 2, 3}));
}

TEST_CASE("sizes that follow no power law are told so") {
  dem::RandomStream random(2, dem::Purpose::test_data);
  std::vector<std::int32_t> sizes;
  for (int k = 0; k < 200; ++k) sizes.push_back(20 + static_cast<std::int32_t>(random.below(20)));
  const auto law = fit_power_law(sizes);
  REQUIRE(law);
  CHECK_FALSE(law->holds());
  CHECK_FALSE(fit_power_law(std::vector<std::int32_t>(29, 1)));
  std::vector<std::int32_t> four_sizes(50, 1);
  four_sizes.insert(four_sizes.end(), {2, 3, 4});
  CHECK_FALSE(fit_power_law(four_sizes));
}
