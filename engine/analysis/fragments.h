#pragma once
// Parts that hold together: particles joined by bonds that live, and how their sizes are distributed. Sizes are volumes of
// the particles (m^3) and numbers of particles.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/fits.h"
#include "engine/core/record.h"

namespace dem::analysis {

struct Fragment {
  std::int32_t particles = 0;
  double volume = 0;               ///< m^3
  std::array<double, 3> centre{};  ///< of volume, m
};

/// Largest volume first.
struct Fragments {
  std::vector<Fragment> all;
  std::vector<std::int32_t> of;  ///< the fragment of each particle, an index into `all`
  double volume = 0;             ///< of all, m^3
  [[nodiscard]] double share(std::size_t k) const { return k < all.size() ? all[k].volume / volume : 0; }
  [[nodiscard]] std::size_t of_at_least(double share) const;  ///< how many have this share of the volume
  [[nodiscard]] std::size_t single() const;                   ///< particles without a bond
};

/// `pair`: two particles a bond; `alive`: which bonds hold; `position`: triples.
Fragments fragments_of(std::span<const std::int32_t> pair, const std::vector<bool>& alive,
                       std::span<const double> position, std::span<const double> radius);

/// The bonds that hold at the end of a test, by the tables contacts and cracks of its record. A bond between grains and a bond
/// of the lattice end with their first crack, a flat joint with the last of its three elements.
std::vector<bool> living_bonds(const dem::Record& record);
/// Of a record at the end of its test. Places are those at rest.
Fragments fragments_of(const dem::Record& record);

/// A power law of numbers: a fragment has n particles, n >= least, with a probability of n^-exponent / zeta(exponent, least).
/// Maximum likelihood with the interval of its curvature (Clauset, Shalizi & Newman 2009, Appendix B).
struct PowerLaw {
  Estimate exponent;
  std::int32_t least = 1;
  std::size_t fragments = 0;
  double p = 0;                                   ///< of such sizes by the law (goodness.h)
  [[nodiscard]] bool holds() const;               ///< it is not ruled out
  [[nodiscard]] double at_least(double n) const;  ///< share of fragments that have n particles or more
};
/// Nothing with fewer than thirty fragments, or fewer than five sizes: too few to tell a law by.
std::optional<PowerLaw> fit_power_law(std::span<const std::int32_t> particles, std::int32_t least = 1);

/// The zeta function of Hurwitz, sum of (a + k)^-s over k = 0, 1, ...; s > 1, a > 0.
double hurwitz_zeta(double s, double a);

}  // namespace dem::analysis
