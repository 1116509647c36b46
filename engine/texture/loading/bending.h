#pragma once
// Three-point bending of a bar, with or without a notch (bending.cpp), and of a half disc with a notch
// (semicircular_bending.cpp).
//
// Both bear on strips, bedded on their rough surface: on faces that touch the highest particles alone, bodies of few
// particles roll over. Strips push along the load alone, without friction: fixed rollers take thrust as the body turns on
// them, and it bears as an arch.
//
// Bar of width b and depth W over a span S = 4 W. Without a notch: modulus of rupture 3 P S / (2 b W^2). With a notch of
// depth a, ASTM E399 (Srawley 1976: within 0.5 % for every a/W):
//   K = P S / (b W^1.5) f(a/W),   f(r) = 3 sqrt(r) (1.99 - r (1 - r) (2.15 - 3.93 r + 2.7 r^2)) / (2 (1 + 2 r) (1 - r)^1.5)
// Half disc of radius R and thickness B, supports s apart, notch of depth a, ISRM suggested method (Kuruppu et al. 2014,
// for s / 2R from 0.5 to 0.8 and a / R from 0.4 to 0.6):
//   K = Y' P sqrt(pi a) / (2 R B),
//   Y' = -1.297 + 9.516 q - (0.47 + 16.457 q) r + (1.071 + 34.401 q) r^2,   q = s / 2R, r = a / R
// K_Ic is K at the largest load P. A notch is a cut without width: contacts across it are not bonded. The tip lies between
// particles, so that its depth is known to half a particle.
#include "engine/texture/loading/test.h"

namespace dem::texture {

/// f(a/W) and Y'(s/2R, a/R) above.
double bar_factor(double depth);
double half_disc_factor(double span, double depth);

/// Half the width of a strip, m: a twentieth of the body's depth, and half a particle (mean diameter) at least.
double strip_on(double depth, double particle);

/// Throws InputError, by the name of the key, for a notch that is too short to be one between particles, or leaves too
/// little.
void check_notch(const Scenario& scenario, const std::string& key, const Body& body);

/// Mean diameter of the particles of a scenario, m.
double mean_particle(const Scenario& scenario);

/// Keys "bending." and "semicircular_bending.".
TestEntry bending_entry();
TestEntry semicircular_bending_entry();

/// With standard settings. Depth and width of the bar (m), depth of the notch over that of the bar, mean diameter of the
/// particles (m).
Test bending(double depth, double width, double notch, double particle);
/// Diameter and thickness (m), depth of the notch over the radius, span over the diameter, mean diameter of the particles.
Test semicircular_bending(double diameter, double thickness, double notch, double span, double particle);

}  // namespace dem::texture
