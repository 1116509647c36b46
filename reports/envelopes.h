#pragma once
// Strengths against confining pressure, and the envelopes through them: what figures draw and verdicts compare.
#include <string_view>
#include <vector>

#include "reports/figure.h"
#include "reports/fits.h"

namespace reports {

struct StrengthPoints {
  std::vector<double> sigma_3, sigma_1;  ///< MPa, one point a case and seed
};

struct Envelopes {
  StrengthPoints peak, damage, initiation;
  std::optional<EnvelopeFit> peak_fit;      ///< s = 1
  std::optional<EnvelopeFit> damage_fit;    ///< with sigma_c of the peak
  std::optional<LineFit> initiation_fit;    ///< MPa; crack initiation by axial stiffness
  /// A fitted value by name: "peak.sigma_c", "peak.m", "damage.m", "damage.s", "initiation.intercept", "initiation.slope".
  [[nodiscard]] std::optional<Estimate> find(std::string_view name) const;
};

/// Of the compression tests of one mineral, or of the rock (""), that agree in all but confining pressure and seed.
Envelopes envelopes_of(const StudyResult& study, std::string_view mineral = "");

}  // namespace reports
