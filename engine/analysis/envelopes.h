#pragma once
// Strengths against confining pressure, and the envelopes through them (Zhao et al. 2021, Eqs. 10 to 13).
#include <optional>
#include <string_view>
#include <vector>

#include "engine/analysis/series.h"

namespace dem::analysis {

struct StrengthPoints {
  std::vector<double> sigma_3, sigma_1;  ///< MPa, one point a case and seed
};

/// Crack initiation by one reading, and the line through it (MPa).
struct Initiation {
  std::string_view id;    ///< of the reading: "axial_stiffness"
  std::string_view name;  ///< "axial stiffness"
  StrengthPoints points;
  std::optional<LineFit> fit;
};

/// What a model measures that envelopes go through.
struct EnvelopeQuantities {
  Quantity peak, damage;
  std::span<const Reading> initiation;
};

struct Envelopes {
  StrengthPoints peak, damage;
  double ucs = 0;                         ///< mean peak at no pressure, MPa; NaN without such a test
  std::optional<EnvelopeFit> peak_fit;    ///< s = 1, sigma_c held at UCS as in the paper
  std::optional<EnvelopeFit> free_fit;    ///< s = 1, sigma_c fitted too
  std::optional<EnvelopeFit> damage_fit;  ///< sigma_c held at UCS
  std::vector<Initiation> initiation;     ///< one for each reading
  /// A fitted value by name: "peak.m", "free.sigma_c", "free.m", "damage.m", "damage.s",
  /// "initiation.READING.intercept", "initiation.READING.slope", "initiation.READING.r_squared".
  [[nodiscard]] std::optional<Estimate> find(std::string_view name) const;
};

/// Through the points of one series along the confining pressure.
Envelopes envelopes_of(std::span<const Point> series, const EnvelopeQuantities& of);

}  // namespace dem::analysis
