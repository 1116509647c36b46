#pragma once
// Strengths against confining pressure, and the envelopes through them: what figures draw and verdicts compare.
#include <string_view>
#include <vector>

#include "reports/figure.h"
#include "engine/analysis/fits.h"

namespace reports {

struct StrengthPoints {
  std::vector<double> sigma_3, sigma_1;  ///< MPa, one point a case and seed
};

/// Crack initiation by one reading, and the line through it (MPa).
struct Initiation {
  std::string_view id;    ///< of the result: "crack_initiation_MPa.ID"
  std::string_view name;  ///< "axial stiffness"
  StrengthPoints points;
  std::optional<analysis::LineFit> fit;
};

struct Envelopes {
  StrengthPoints peak, damage;
  double ucs = 0;                         ///< mean peak at no pressure, MPa; NaN without such a test
  std::optional<analysis::EnvelopeFit> peak_fit;    ///< s = 1, sigma_c held at UCS as in the paper
  std::optional<analysis::EnvelopeFit> free_fit;    ///< s = 1, sigma_c fitted too
  std::optional<analysis::EnvelopeFit> damage_fit;  ///< sigma_c held at UCS
  std::vector<Initiation>
      initiation;  ///< axial_stiffness, strain_0_1_percent, one_percent_of_cracks, crack_volumetric_strain
  /// A fitted value by name: "peak.m", "free.sigma_c", "free.m", "damage.m", "damage.s", "initiation.axial_stiffness.intercept",
  /// "initiation.axial_stiffness.slope" and those of the other readings.
  [[nodiscard]] std::optional<analysis::Estimate> find(std::string_view name) const;
};

/// Of the compression tests of one mineral, or of the rock (""), that agree in all but confining pressure and seed.
Envelopes envelopes_of(const StudyResult& study, std::string_view mineral = "");

}  // namespace reports
