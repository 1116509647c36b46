#pragma once
// The band that holds most cracks beyond its share of the volume, after the peak.
#include "engine/analysis/orientation.h"
#include "engine/core/record.h"

namespace reports::texture {

constexpr double band_diameters = 5;  ///< thickness of the band in mean particle diameters

/// Whether a band with a layer on each side, half as thick as it, goes across the specimen.
bool is_wide_enough_for_a_band(const dem::Record& record);

/// The densest band of the cracks after the peak, and the largest excess that cracks at random have. Places are counted from
/// the middle of the specimen.
struct Band {
  dem::analysis::BandFit fit;
  double at_random = 0;
};
/// `draws` 0: without the comparison.
Band band_of(const dem::Record& record, int draws);

/// Triples from row `first` on, from the middle of the specimen.
std::vector<double> from_middle(const dem::Record& record, std::span<const double> points, std::size_t first = 0);

}  // namespace reports::texture
