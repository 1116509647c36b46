#pragma once
// Rock properties to element parameters and back (Liu et al. 2017: Appendix B; Eqs. 4, 6, 7, 8, 14, 15, 27, 28).
// Derived from one tetrahedral unit loaded along z at small strain.

namespace dem::lattice {

/// What is measured on rock.
struct Rock {
  double young_modulus = 0;         ///< E, Pa
  double poisson_ratio = 0;         ///< nu, 0 ... 0.2: Ks would be negative above (Eq. 4), Kn < Ks below
  double tensile_strength = 0;      ///< Tu, Pa
  double compressive_strength = 0;  ///< Cu, Pa, positive
  double internal_friction = 0;     ///< mu_i
  double density = 0;               ///< of the whole packing, kg/m^3
};

/// What an element and its bonds have.
struct Micro {
  double kn = 0;        ///< normal stiffness, N/m
  double ks = 0;        ///< shear stiffness, N/m
  double xb = 0;        ///< breaking displacement, m
  double fs0 = 0;       ///< initial shear resistance, N
  double mu = 0;        ///< coefficient of friction mu_p
  double diameter = 0;  ///< d, m
  double mass = 0;      ///< m, kg
};

/// Eqs. B1-B5 and 27. Throws InputError for nu outside [0, 0.2], a strength, modulus, density or diameter that is not
/// positive, mu_i below sqrt(2)/4 (mu_p would be negative).
Micro micro_of(const Rock& rock, double diameter);

/// Eqs. 4, 6, 7, 14, 15 and 27 solved for the rock. Throws InputError where a parameter is out of range: Ks outside
/// [0, Kn], mu_p outside [0, 1/sqrt(2)).
Rock rock_of(const Micro& micro);

/// Vertical stress at which horizontal bonds of a unit open in compression, Pa (Eq. 8); infinite when Ks = Kn.
double opening_stress(const Micro& micro);

/// Eq. 28 with V = elements sqrt(2) d^3 / 2, the volume that Eq. 27 gives the elements; N s/m.
double viscosity(const Micro& micro, long elements);

/// Upper bound of a stable time step, s: 2 / omega_max, where omega_max^2 <= 2 (4 Kn + 8 Ks) / m, the sum of the
/// stiffnesses of twelve bonds on the trace's mean direction, doubled for neighbours in counter-phase.
double stable_time_step(const Micro& micro);

/// Displacements of a single unit under a force Fz on its top element (Eqs. 2a-2d), m, tension positive.
struct UnitDisplacements {
  double dz = 0, xn1 = 0, xs1 = 0, xn2 = 0;
};
UnitDisplacements unit_displacements(const Micro& micro, double fz);

}  // namespace dem::lattice
