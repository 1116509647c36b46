#pragma once
// Which way cracks lie, and the band that holds most of them: whether a specimen splits along its axis or shears.
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/record.h"

namespace dem::analysis {

/// Angles between the planes of cracks and the loading axis: 0 degrees is splitting along the axis, 90 a crack across it.
/// Weighted by area. Planes of random direction have a mean of 32.7 degrees (90 - 57.3) and half of their area within 30.
struct Orientation {
  std::vector<double> share;  ///< of the area, in classes of `width` degrees from 0
  double width = 10;
  double mean = 0;   ///< degrees
  double along = 0;  ///< share within 30 degrees of the axis
  double area = 0;   ///< m^2; with none the rest is NaN
};
/// Of the cracks from row `first` on; `mode` as in the table, or any.
Orientation orientation_of(const dem::Table& cracks, std::size_t first, int mode = -1);

/// The flat band, some mean particle diameters thick, whose share of the crack area exceeds its share of the particles'
/// volume most.
struct BandFit {
  double inclination = 0;         ///< degrees between the band and the loading axis
  double cracks = 0, volume = 0;  ///< shares inside the band
  std::array<double, 3> normal{};
  double offset = 0;  ///< of its middle from the origin, along the normal
  [[nodiscard]] double concentration() const { return cracks / volume; }
  [[nodiscard]] double excess() const { return cracks - volume; }
};
/// Points are triples. Nothing to find (no weights): NaN.
BandFit densest_band(std::span<const double> crack, std::span<const double> area, std::span<const double> particle,
                     std::span<const double> volume, double thickness);

/// The largest excess of the densest band among `draws` placings of the cracks at random particles, those of one contact
/// together: what any band must exceed to mean something.
double excess_at_random(std::span<const std::int32_t> contact, std::span<const double> area,
                        std::span<const double> particle, std::span<const double> volume, double thickness, int draws);

}  // namespace dem::analysis
