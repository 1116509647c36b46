// The specimen of the published size: 25 x 50 mm, R_min 0.35 mm.
#include <doctest/doctest.h>

#include "tests/support/granite.h"

using namespace dem;
using namespace dem::texture;

namespace {

double inter_grain_share(const Packing& packing, const GrainMap& map) {
  double inter = 0;
  for (const auto& [i, j] : packing.contacts) inter += map.grain[i] != map.grain[j] ? 1 : 0;
  return inter / static_cast<double>(packing.contacts.size());
}

}  // namespace

TEST_CASE("the published specimen has the published number of particles") {
  RunContext context;
  context.threads = 2;
  const Packing packing = pack(dem_test::granite_packing(25e-3), context);
  CHECK(static_cast<double>(packing.radius.size()) == doctest::Approx(36528).epsilon(0.01));
  CHECK(packing.coordination == doctest::Approx(7.13).epsilon(0.01));
  CHECK(packing.pressure == doctest::Approx(0.01 * 58e9).epsilon(0.01));
  MESSAGE("particles " << packing.radius.size() << ", coordination " << packing.coordination << ", porosity "
                       << packing.porosity);
  const GrainSeeds seeds = seed_grains({25e-3, 50e-3}, dem_test::granite_minerals(), 1, 1, context);
  CHECK(static_cast<double>(seeds.radius.size()) == doctest::Approx(1147).epsilon(0.05));
  for (const GrowthRule rule : {GrowthRule::most_contacts, GrowthRule::deepest_contact}) {
    double before = 0;
    for (const double aspect_ratio : {1.0, 2.0, 3.0}) {
      const GrainMap map = grow_grains(packing, seeds, {aspect_ratio, 0, 0}, rule);
      const double share = inter_grain_share(packing, map);
      MESSAGE("rule " << static_cast<int>(rule) << ", aspect ratio " << aspect_ratio << ", inter-grain share "
                      << share);
      CHECK(share > before);  // Eq. 14: the more elongated, the more surface
      before = share;
    }
  }
  // Figs. 13 and 16 show grain 3770. The rule of growth was chosen by the share at AR 1; that at AR 3 follows.
  const GrainSeeds small = seed_grains({25e-3, 50e-3}, dem_test::granite_minerals(), 0.669, 1, context);
  CHECK(small.radius.size() >= 3770);
  CHECK(small.radius.size() < 3800);
  for (const auto& [aspect_ratio, published] : {std::pair{1.0, 0.55}, std::pair{3.0, 0.60}}) {
    const GrainMap map = grow_grains(packing, small, {aspect_ratio, 0, 0}, GrowthRule::deepest_contact);
    CHECK(std::abs(inter_grain_share(packing, map) - published) < 0.02);
  }
}
