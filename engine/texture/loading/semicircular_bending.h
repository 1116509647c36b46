#pragma once
// Bending of a half disc with a notch in its flat face, which lies on two rollers.
//
// ISRM suggested method (Kuruppu et al. 2014). Radius R, thickness B, rollers s apart, notch of depth a:
//   K = Y' P sqrt(pi a) / (2 R B),
//   Y' = -1.297 + 9.516 q - (0.47 + 16.457 q) r + (1.071 + 34.401 q) r^2,   q = s / 2R, r = a / R
// K_Ic is K at the largest load P. The notch is a cut without width: contacts across it are not bonded. Its tip lies between
// particles, so that its depth is known to half a particle.
#include "engine/texture/loading/test.h"

namespace dem::texture {

/// Y'(s/2R, a/R) above.
double half_disc_factor(double span, double depth);

/// Keys "semicircular_bending.".
TestEntry semicircular_bending_entry();

/// With standard settings. Diameter and thickness (m), depth of the notch over the radius, span over the diameter.
Test semicircular_bending(double diameter, double thickness, double notch = 0.5, double span = 0.6);

}  // namespace dem::texture
