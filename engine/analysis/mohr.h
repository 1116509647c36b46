#pragma once
// Strengths under pressure in the invariants p, q and as circles of Mohr, with the envelope that touches the circles. Stresses
// in MPa, compression positive.
#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/fits.h"

namespace dem::analysis {

struct MeanAndDeviator {
  double p = 0, q = 0;
};
/// p = (sigma_1 + 2 sigma_3) / 3, q = sigma_1 - sigma_3 of a cylinder under a jacket.
MeanAndDeviator invariants(double sigma_3, double sigma_1);

/// Normal and shear stress on a plane.
struct OnPlane {
  double normal = 0, shear = 0;
};
/// The upper half of a circle in `steps` equal parts, from sigma_3 to sigma_1.
std::vector<OnPlane> mohr_circle(double sigma_3, double sigma_1, int steps = 60);

/// Where the circle at sigma_3 touches the envelope of all circles sigma_1(sigma_3) (Balmer 1952): the stresses on the plane that
/// fails. `slope` is d sigma_1 / d sigma_3 there.
OnPlane touching(double sigma_3, double sigma_1, double slope);

/// The straight line of Coulomb through strengths: sigma_1 = UCS + N sigma_3 gives sin(phi) = (N - 1) / (N + 1) and
/// c = UCS / (2 sqrt(N)). The interval of the angle is that of N.
struct Coulomb {
  double cohesion = 0;      ///< MPa
  Estimate friction_angle;  ///< degrees
  LineFit line;             ///< of sigma_1 by sigma_3
  [[nodiscard]] double shear_at(double normal) const;
};
/// Nothing where sigma_1 does not rise faster than sigma_3, or with fewer than two pressures.
std::optional<Coulomb> fit_coulomb(std::span<const double> sigma_3, std::span<const double> sigma_1);

}  // namespace dem::analysis
