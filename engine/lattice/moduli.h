#pragma once
// Elastic constants of the infinite lattice at small strain, in closed form: a hexagonal solid with its axis along z.
// Sums over the twelve bonds (Born & Huang 1954; for these springs Wang & Mora 2008), worked out for hexagonal packing.
// "Affine": elements follow the mean strain. "Relaxed": layers A and B shift against each other until forces vanish.
// The two differ in c11, c12 and c66 only, so that loading along z (Eqs. 4 and 6 of Liu et al. 2017) is affine.
#include "engine/lattice/conversion.h"

namespace dem::lattice {

/// Pa; Voigt notation, shear as engineering strain.
struct Hexagonal {
  double c11 = 0, c12 = 0, c13 = 0, c33 = 0, c44 = 0;
  [[nodiscard]] double c66() const { return (c11 - c12) / 2; }
  /// Young's modulus along a direction that makes `angle` (rad) with z, sides free; Pa.
  [[nodiscard]] double young_modulus(double angle) const;
  /// -(lateral strain) / (axial strain) for loading along z.
  [[nodiscard]] double poisson_ratio_z() const { return c13 / (c11 + c12); }
};

Hexagonal affine_moduli(const Micro& micro);
Hexagonal relaxed_moduli(const Micro& micro);

/// Speed of a plane compressional wave along z, sqrt(c33 / density), m/s, long waves.
double wave_speed_z(const Micro& micro);

}  // namespace dem::lattice
