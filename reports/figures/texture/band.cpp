#include "reports/figures/texture/band.h"

#include <cmath>

#include "reports/figures/texture/parts.h"

namespace reports::texture {
namespace {

// The first crack after the peak; all of them where fewer than fifty follow.
std::size_t first_after_peak(const dem::Record& record) {
  const dem::Table& cracks = record.table("cracks");
  const auto strain = cracks.real("strain");
  const double peak = record.value_or_nan(quantity::peak_strain);
  std::size_t first = 0;
  while (first < strain.size() && !(strain[first] >= peak)) ++first;
  return strain.size() - first < 50 ? 0 : first;
}

}  // namespace

bool is_wide_enough_for_a_band(const dem::Record& record) {
  return size_of(record).diameter >= 2 * band_diameters * mean_diameter(record);
}

std::vector<double> from_middle(const dem::Record& record, std::span<const double> points, std::size_t first) {
  const Size size = size_of(record);
  const double middle = size.z_low + 0.5 * size.height;
  std::vector<double> moved(points.begin() + static_cast<std::ptrdiff_t>(3 * first), points.end());
  for (std::size_t i = 2; i < moved.size(); i += 3) moved[i] -= middle;
  return moved;
}

Band band_of(const dem::Record& record, int draws) {
  const dem::Table& cracks = record.table("cracks");
  const dem::Table& particles = record.table("particles");
  const std::size_t first = first_after_peak(record);
  const auto radius = particles.real("radius");
  std::vector<double> volume;
  double mean = 0;
  for (const double r : radius) {
    volume.push_back(r * r * r);
    mean += 2 * r / static_cast<double>(radius.size());
  }
  const auto places = from_middle(record, particles.real("position"));
  const auto area = cracks.real("area").subspan(first);
  const double thickness = band_diameters * mean;
  return {analysis::densest_band(from_middle(record, cracks.real("position"), first), area, places, volume, thickness),
          draws > 0 ? analysis::excess_at_random(cracks.integer("contact").subspan(first), area, places, volume,
                                                 thickness, draws)
                    : 0};
}

}  // namespace reports::texture
