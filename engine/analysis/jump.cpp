#include "engine/analysis/jump.h"

#include <algorithm>
#include <cmath>

#include "engine/analysis/fits.h"

namespace dem::analysis {
namespace {

using Vec = std::array<double, 3>;

double dot(const Vec& a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

BandFrame band_frame(const Vec& normal, double offset, double thickness) {
  BandFrame band{.normal = normal, .along = {1, 0, 0}, .offset = offset, .thickness = thickness};
  const double across = std::hypot(normal[0], normal[1]);
  if (across > 1e-9) band.along = {-normal[2] * normal[0] / across, -normal[2] * normal[1] / across, across};
  return band;
}

std::optional<Jump> jump_across(std::span<const double> point, std::span<const double> displacement,
                                const BandFrame& band) {
  constexpr double fewest = 10;
  const Vec level = cross(band.normal, band.along);
  const std::array<Vec, 3> direction{band.normal, band.along, level};
  std::vector<double> distance;
  std::array<std::vector<double>, 3> moved;
  struct Layer {
    double points = 0, distance = 0;
    std::array<double, 3> moved{};
  };
  Layer below, above;
  for (std::size_t i = 0; i + 2 < point.size(); i += 3) {
    const double d = dot(band.normal, &point[i]) - band.offset, size = std::abs(d);
    const bool inside = size >= 0.5 * band.thickness && size <= band.thickness;
    Layer& layer = d > 0 ? above : below;
    distance.push_back(d);
    layer.points += inside;
    layer.distance += inside ? d : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      moved[k].push_back(dot(direction[k], &displacement[i]));
      layer.moved[k] += inside ? moved[k].back() : 0;
    }
  }
  if (std::min(below.points, above.points) < fewest) return std::nullopt;
  std::array<Jump::Part, 3> parts{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto line = fit_line(distance, moved[k]);
    if (!line) return std::nullopt;
    parts[k].moved = above.moved[k] / above.points - below.moved[k] / below.points;
    parts[k].even = line->slope.value * (above.distance / above.points - below.distance / below.points);
  }
  return Jump{parts[0], parts[1], parts[2]};
}

JumpProfile profile_across(std::span<const double> point, std::span<const double> displacement, const BandFrame& band,
                           double step, double reach) {
  constexpr double fewest = 5;
  const auto bins = static_cast<std::size_t>(std::ceil(2 * reach / step));
  std::vector<double> number(bins, 0), across(bins, 0), along(bins, 0);
  for (std::size_t i = 0; i + 2 < point.size(); i += 3) {
    const double bin = std::floor((dot(band.normal, &point[i]) - band.offset + reach) / step);
    if (bin < 0 || bin >= static_cast<double>(bins)) continue;
    const auto k = static_cast<std::size_t>(bin);
    number[k] += 1;
    across[k] += dot(band.normal, &displacement[i]);
    along[k] += dot(band.along, &displacement[i]);
  }
  JumpProfile profile;
  for (std::size_t k = 0; k < bins; ++k) {
    if (number[k] < fewest) continue;
    profile.distance.push_back(step * (static_cast<double>(k) + 0.5) - reach);
    profile.across.push_back(across[k] / number[k]);
    profile.along.push_back(along[k] / number[k]);
  }
  return profile;
}

}  // namespace dem::analysis
