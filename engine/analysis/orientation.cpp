#include "engine/analysis/orientation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "engine/core/random.h"

namespace dem::analysis {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int parts = 4;  // of a band's thickness: bands are tried at every part

// Weights by their distance along a normal, in bins from `low`.
std::vector<double> binned(std::span<const double> point, std::span<const double> weight,
                           const std::array<double, 3>& normal, double low, double width, std::size_t bins) {
  std::vector<double> sums(bins, 0.0);
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const double d = normal[0] * point[3 * i] + normal[1] * point[3 * i + 1] + normal[2] * point[3 * i + 2];
    const double bin = std::floor((d - low) / width);
    if (bin >= 0 && bin < static_cast<double>(bins)) sums[static_cast<std::size_t>(bin)] += weight[i];
  }
  return sums;
}

}  // namespace

Orientation orientation_of(const dem::Table& cracks, std::size_t first, int mode) {
  Orientation found;
  found.share.assign(static_cast<std::size_t>(std::lround(90 / found.width)), 0.0);
  const auto normal = cracks.real("normal");
  const auto area = cracks.real("area");
  const auto modes = cracks.integer("mode");
  double sum = 0;
  for (std::size_t i = first; i < cracks.rows(); ++i) {
    if (mode >= 0 && modes[i] != mode) continue;
    const double length = std::hypot(normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]);
    if (!(length > 0)) continue;
    const double angle = std::asin(std::min(1.0, std::abs(normal[3 * i + 2]) / length)) / degree;
    const auto bin = std::min(found.share.size() - 1, static_cast<std::size_t>(angle / found.width));
    found.share[bin] += area[i];
    found.area += area[i];
    sum += area[i] * angle;
    if (angle <= 30) found.along += area[i];
  }
  for (double& share : found.share) share = found.area > 0 ? share / found.area : none;
  found.mean = found.area > 0 ? sum / found.area : none;
  found.along = found.area > 0 ? found.along / found.area : none;
  return found;
}

BandFit densest_band(std::span<const double> crack, std::span<const double> area, std::span<const double> particle,
                     std::span<const double> volume, double thickness) {
  const double all_area = std::accumulate(area.begin(), area.end(), 0.0);
  const double all_volume = std::accumulate(volume.begin(), volume.end(), 0.0);
  if (!(all_area > 0) || !(all_volume > 0) || !(thickness > 0)) return {none, none, none, {}, none};
  double reach = 0;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    reach = std::max(reach, std::hypot(particle[3 * i], particle[3 * i + 1], particle[3 * i + 2]));
  }
  const double low = -reach - thickness, width = thickness / parts;
  const auto bins = static_cast<std::size_t>(std::ceil(2 * (reach + thickness) / width));
  BandFit best{none, none, none, {}, none};
  double excess = -1;
  for (int inclination = 0; inclination <= 90; inclination += 5) {
    for (int azimuth = 0; azimuth < 360; azimuth += 10) {
      if (inclination == 90 && azimuth > 0) break;
      if (inclination == 0 && azimuth >= 180) break;
      const double i = inclination * degree, a = azimuth * degree;
      const std::array<double, 3> normal{std::cos(i) * std::cos(a), std::cos(i) * std::sin(a), std::sin(i)};
      const auto areas = binned(crack, area, normal, low, width, bins);
      const auto volumes = binned(particle, volume, normal, low, width, bins);
      for (std::size_t k = 0; k + parts <= bins; ++k) {
        const double inside = std::accumulate(&areas[k], &areas[k] + parts, 0.0) / all_area;
        const double filled = std::accumulate(&volumes[k], &volumes[k] + parts, 0.0) / all_volume;
        if (!(inside - filled > excess) || !(filled > 0)) continue;
        excess = inside - filled;
        best = {static_cast<double>(inclination), inside, filled, normal,
                low + width * (static_cast<double>(k) + 0.5 * parts)};
      }
    }
  }
  return best;
}

double excess_at_random(std::span<const std::int32_t> contact, std::span<const double> area,
                        std::span<const double> particle, std::span<const double> volume, double thickness, int draws) {
  std::map<std::int32_t, double> broken;  // area, by contact
  for (std::size_t i = 0; i < area.size(); ++i) broken[contact[i]] += area[i];
  if (broken.empty() || volume.empty()) return none;
  std::vector<double> areas;
  for (const auto& [index, sum] : broken) areas.push_back(sum);
  double largest = 0;
  for (int draw = 0; draw < draws; ++draw) {
    dem::RandomStream random(1, dem::Purpose::random_cracks, static_cast<std::uint32_t>(draw));
    std::vector<double> place;
    for (std::size_t i = 0; i < areas.size(); ++i) {
      const std::uint64_t at = random.below(volume.size());
      for (std::uint64_t k = 0; k < 3; ++k) place.push_back(particle[3 * at + k]);
    }
    largest = std::max(largest, densest_band(place, areas, particle, volume, thickness).excess());
  }
  return largest;
}

}  // namespace dem::analysis
