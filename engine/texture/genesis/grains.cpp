// Grain seeds, masking by ellipsoids, and growth (Zhao et al. 2021, section 2.3, steps 1 and 3).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/texture/genesis/packing.h"

namespace dem::texture {
namespace {

// The seeds are packed lightly: overlaps near 0.4 % of a radius.
constexpr double seed_pressure = 1e-3;
constexpr double first_solid_fraction = 0.62;
// The number of seeds follows from the solid fraction that their own packing reaches: found roughly first,
// then in one round or two.
constexpr int seed_rounds = 3;
constexpr double seed_scale_tolerance = 0.01;
// Few grains of a mineral meet its volume only with diameters somewhat off their range; off by more is refused.
constexpr double range_tolerance = 0.2;

/// Uniform diameters of one mineral that fill `wanted` m3: one diameter from each of `count` equal parts of the range,
/// so that few grains, too, represent it; then all by one factor to meet the volume exactly.
std::vector<double> draw_radii(const MineralGrains& mineral, double seed_scale, double wanted, std::uint64_t seed,
                               std::uint32_t index) {
  const double low = seed_scale * mineral.diameter_min / 2, high = seed_scale * mineral.diameter_max / 2;
  // Mean of r^3 over [low, high], without the cancellation of (high^4 - low^4) / (high - low).
  const double mean_volume = sphere_volume(1) * (high + low) * (high * high + low * low) / 4;
  const auto count = std::max(1, static_cast<int>(std::lround(wanted / mean_volume)));
  RandomStream stream(seed, Purpose::grain_seed_sizes, index);
  std::vector<double> radii(count);
  double filled = 0;
  for (int k = 0; k < count; ++k) {
    radii[k] = low + (high - low) * (k + stream.uniform()) / count;
    filled += sphere_volume(radii[k]);
  }
  for (double& r : radii) r *= std::cbrt(wanted / filled);
  const auto [least, most] = std::minmax_element(radii.begin(), radii.end());
  if (*least < (1 - range_tolerance) * low || *most > (1 + range_tolerance) * high)
    throw CaseError(
        fmt::format("the share of mineral {} in a specimen of this size is {:.3g} mm3: no number of grains of "
                    "{:.3g} to {:.3g} mm makes that; take a larger specimen or a smaller seed scale",
                    index + 1, 1e9 * wanted, 2e3 * low, 2e3 * high));
  return radii;
}

struct Cloud {
  std::vector<Sphere> spheres;
  std::vector<std::int32_t> mineral;
};

Cloud draw_seeds(const Cylinder& vessel, const std::vector<MineralGrains>& minerals, double seed_scale,
                 double solid_fraction, std::uint64_t seed) {
  Cloud cloud;
  for (std::size_t m = 0; m < minerals.size(); ++m) {
    if (minerals[m].share <= 0) continue;
    const double wanted = minerals[m].share * solid_fraction * volume(vessel);
    for (const double r : draw_radii(minerals[m], seed_scale, wanted, seed, static_cast<std::uint32_t>(m))) {
      if (2 * r > std::min(vessel.diameter, vessel.height))
        throw CaseError(
            fmt::format("a grain seed of {:.3g} mm does not fit in the specimen: take a larger specimen or a "
                        "smaller seed scale",
                        2e3 * r));
      const auto index = static_cast<std::uint32_t>(cloud.spheres.size());
      const Vec3 at = random_place(vessel, r, seed, Purpose::grain_seed_positions, index);
      cloud.spheres.push_back({at[0], at[1], at[2], r});
      cloud.mineral.push_back(static_cast<std::int32_t>(m));
    }
  }
  return cloud;
}

/// (x'/a)^2 + (y'/b)^2 + (z'/c)^2 of Eq. 5: below 1 inside. The axis is a unit vector along the dip.
class EllipsoidMetric {
 public:
  explicit EllipsoidMetric(const GrainShape& shape)
      : axis_{std::cos(shape.dip) * std::cos(shape.dip_direction), std::cos(shape.dip) * std::sin(shape.dip_direction),
              std::sin(shape.dip)},
        lambda_(std::cbrt(shape.aspect_ratio)) {}

  [[nodiscard]] double operator()(const Vec3& at, const Vec3& centre, double radius) const {
    const Vec3 d{at[0] - centre[0], at[1] - centre[1], at[2] - centre[2]};
    const double along = d[0] * axis_[0] + d[1] * axis_[1] + d[2] * axis_[2];
    const double across2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - along * along;
    const double a = lambda_ * lambda_ * radius, b = radius / lambda_;
    return along * along / (a * a) + across2 / (b * b);
  }
  /// Largest distance of a point of the ellipsoid from its centre.
  [[nodiscard]] double reach(double radius) const { return std::max(lambda_ * lambda_, 1 / lambda_) * radius; }

 private:
  Vec3 axis_;
  double lambda_;
};

constexpr std::int32_t nobody = -1;

/// Each particle to the ellipsoid whose metric is least among those that hold its centre.
std::vector<std::int32_t> mask(const Packing& packing, const GrainSeeds& seeds, const EllipsoidMetric& metric) {
  // Particles by height: an ellipsoid looks only at those within its reach.
  std::vector<std::pair<double, std::size_t>> by_height(packing.position.size());
  for (std::size_t i = 0; i < by_height.size(); ++i) by_height[i] = {packing.position[i][2], i};
  std::sort(by_height.begin(), by_height.end());
  std::vector<std::int32_t> grain(packing.position.size(), nobody);
  std::vector<double> nearest(packing.position.size(), std::numeric_limits<double>::infinity());
  for (std::size_t g = 0; g < seeds.radius.size(); ++g) {
    const double reach = metric.reach(seeds.radius[g]) * (1 + 1e-9);
    const double low = seeds.position[g][2] - reach, high = seeds.position[g][2] + reach;
    for (auto at = std::lower_bound(by_height.begin(), by_height.end(), std::pair{low, std::size_t{0}});
         at != by_height.end() && at->first <= high; ++at) {
      const std::size_t i = at->second;
      const double q = metric(packing.position[i], seeds.position[g], seeds.radius[g]);
      if (q <= 1 && q < nearest[i]) {  // of equal claims the first, so the lowest grain, stays
        nearest[i] = q;
        grain[i] = static_cast<std::int32_t>(g);
      }
    }
  }
  return grain;
}

std::int32_t nearest_grain(const Vec3& at, const GrainSeeds& seeds, const EllipsoidMetric& metric) {
  std::int32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t g = 0; g < seeds.radius.size(); ++g) {
    const double q = metric(at, seeds.position[g], seeds.radius[g]);
    if (q < least) {
      least = q;
      best = static_cast<std::int32_t>(g);
    }
  }
  return best;
}

/// The grain most frequent among claimed neighbours, the lowest of equally frequent ones; nobody when there is none.
std::int32_t commonest(const std::vector<std::int32_t>& neighbours, const std::vector<std::int32_t>& grain) {
  std::vector<std::int32_t> claims;
  for (const std::int32_t j : neighbours)
    if (grain[j] != nobody) claims.push_back(grain[j]);
  std::sort(claims.begin(), claims.end());
  std::int32_t best = nobody;
  std::ptrdiff_t most = 0;
  for (auto run = claims.begin(); run != claims.end();) {
    const auto end = std::upper_bound(run, claims.end(), *run);
    if (end - run > most) {
      most = end - run;
      best = *run;
    }
    run = end;
  }
  return best;
}

/// The grain of the claimed neighbour with the largest overlap; nobody when there is none.
std::int32_t deepest(std::size_t i, const std::vector<std::int32_t>& neighbours, const Packing& packing,
                     const std::vector<std::int32_t>& grain) {
  std::int32_t best = nobody;
  double largest = -std::numeric_limits<double>::infinity();
  for (const std::int32_t j : neighbours) {
    if (grain[j] == nobody) continue;
    const Vec3 &a = packing.position[i], &b = packing.position[j];
    const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
    const double overlap = packing.radius[i] + packing.radius[j] - std::sqrt(dx * dx + dy * dy + dz * dz);
    if (overlap > largest || (overlap == largest && grain[j] < best)) {
      largest = overlap;
      best = grain[j];
    }
  }
  return best;
}

/// Touching particles of each particle.
std::vector<std::vector<std::int32_t>> neighbours(const Packing& packing) {
  std::vector<std::vector<std::int32_t>> touching(packing.position.size());
  for (const auto& [i, j] : packing.contacts) {
    touching[i].push_back(j);
    touching[j].push_back(i);
  }
  return touching;
}

}  // namespace

GrainSeeds seed_grains(const Cylinder& vessel, const std::vector<MineralGrains>& minerals, double seed_scale,
                       std::uint64_t seed, RunContext& context) {
  SettleGoal goal;
  goal.pressure = seed_pressure;
  goal.remove_floaters = false;  // a seed without contacts is a seed: taking it out would thin the small grains
  SettleGoal rough = goal;       // enough to learn the solid fraction
  rough.unbalance = 1e-2;
  rough.pressure_tolerance = 0.05;
  const double rough_scale =
      settle(vessel, draw_seeds(vessel, minerals, seed_scale, first_solid_fraction, seed).spheres, rough, context)
          .radius_scale;
  double solid_fraction = first_solid_fraction * rough_scale * rough_scale * rough_scale;
  for (int round = 1;; ++round) {
    const Cloud cloud = draw_seeds(vessel, minerals, seed_scale, solid_fraction, seed);
    const Settled settled = settle(vessel, cloud.spheres, goal, context);
    const double scale = settled.radius_scale;
    if (round < seed_rounds && std::abs(scale - 1) > seed_scale_tolerance) {
      solid_fraction *= scale * scale * scale;
      continue;
    }
    GrainSeeds seeds;
    for (std::size_t k = 0; k < settled.spheres.size(); ++k) {
      const Sphere& s = settled.spheres[k];
      seeds.position.push_back({s.x, s.y, s.z});
      seeds.radius.push_back(s.r);
      seeds.mineral.push_back(cloud.mineral[settled.origin[k]]);
    }
    return seeds;
  }
}

GrainMap grow_grains(const Packing& packing, const GrainSeeds& seeds, const GrainShape& shape, GrowthRule rule) {
  const EllipsoidMetric metric(shape);
  GrainMap map;
  map.grain = mask(packing, seeds, metric);
  map.growth_round.assign(map.grain.size(), 0);
  const auto touching = neighbours(packing);
  std::vector<std::size_t> unclaimed;
  for (std::size_t i = 0; i < map.grain.size(); ++i)
    if (map.grain[i] == nobody) unclaimed.push_back(i);

  // All particles of a round see the grains as they were before it: the order of particles plays no part.
  int round = 0;
  while (!unclaimed.empty()) {
    ++round;
    std::vector<std::pair<std::size_t, std::int32_t>> claimed;
    std::vector<std::size_t> left;
    for (const std::size_t i : unclaimed) {
      const std::int32_t grain = rule == GrowthRule::most_contacts ? commonest(touching[i], map.grain)
                                                                   : deepest(i, touching[i], packing, map.grain);
      if (grain == nobody)
        left.push_back(i);
      else
        claimed.emplace_back(i, grain);
    }
    // No contact leads to the rest: each takes the nearest ellipsoid.
    if (claimed.empty())
      for (const std::size_t i : std::exchange(left, {}))
        claimed.emplace_back(i, nearest_grain(packing.position[i], seeds, metric));
    for (const auto& [i, grain] : claimed) {
      map.grain[i] = grain;
      map.growth_round[i] = round;
    }
    unclaimed = std::move(left);
  }

  map.mineral.reserve(map.grain.size());
  for (const std::int32_t grain : map.grain) map.mineral.push_back(seeds.mineral[grain]);
  return map;
}

}  // namespace dem::texture
