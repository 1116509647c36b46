#include "engine/analysis/jump.h"

#include <algorithm>
#include <cmath>

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
  // Sums over a side, all that lies beyond a face, and over its layer next to the face.
  struct Side {
    double points = 0, distance = 0, squares = 0, layer_points = 0, layer_distance = 0;
    std::array<double, 3> moved{}, product{}, layer_moved{};
  };
  std::array<Side, 2> sides;
  for (std::size_t i = 0; i + 2 < point.size(); i += 3) {
    const double d = dot(band.normal, &point[i]) - band.offset, size = std::abs(d);
    if (size < 0.5 * band.thickness) continue;
    const double in_layer = size <= band.thickness ? 1 : 0;
    Side& side = sides[d > 0 ? 1 : 0];
    side.points += 1;
    side.distance += d;
    side.squares += d * d;
    side.layer_points += in_layer;
    side.layer_distance += in_layer * d;
    for (std::size_t k = 0; k < 3; ++k) {
      const double moved = dot(direction[k], &displacement[i]);
      side.moved[k] += moved;
      side.product[k] += d * moved;
      side.layer_moved[k] += in_layer * moved;
    }
  }
  const auto& [below, above] = sides;
  if (std::min(below.layer_points, above.layer_points) < fewest) return std::nullopt;
  double squares = 0;
  for (const Side& side : sides) squares += side.squares - side.distance * side.distance / side.points;
  if (!(squares > 0)) return std::nullopt;
  std::array<Jump::Part, 3> parts{};
  for (std::size_t k = 0; k < 3; ++k) {
    double product = 0;
    for (const Side& side : sides) product += side.product[k] - side.distance * side.moved[k] / side.points;
    parts[k].moved = above.layer_moved[k] / above.layer_points - below.layer_moved[k] / below.layer_points;
    parts[k].even =
        product / squares * (above.layer_distance / above.layer_points - below.layer_distance / below.layer_points);
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
