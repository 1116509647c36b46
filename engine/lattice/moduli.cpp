#include "engine/lattice/moduli.h"

#include <cmath>
#include <numbers>

namespace dem::lattice {

// With e the bond directions of one element and V = d^3 / sqrt(2) its volume,
//   c_ijij = (d^2 / V) sum over 6 bonds [(Kn - Ks) ei^2 ej^2 + Ks ...]
// sums: ez^4 4/3, ez^2 2, ex^4 5/4, ex^2 2, ex^2 ez^2 1/3, ex^2 ey^2 5/12.
Hexagonal affine_moduli(const Micro& m) {
  const double unit = std::numbers::sqrt2 / m.diameter;
  const double n = m.kn - m.ks;
  Hexagonal c;
  c.c11 = unit * (1.25 * n + 2 * m.ks);
  c.c12 = unit * (5.0 / 12 * n);
  c.c13 = unit * (n / 3);
  c.c33 = unit * (4.0 / 3 * n + 2 * m.ks);
  c.c44 = unit * (n / 3 + m.ks);
  return c;
}

// The shift s between layers costs (Kn + 5 Ks) s^2 / 2 a cell of two elements (volume sqrt(2) d^3) and gains
// (Kn - Ks) d (exx - eyy) s_x / (2 sqrt(3)), and the like for exy.
Hexagonal relaxed_moduli(const Micro& m) {
  Hexagonal c = affine_moduli(m);
  const double n = m.kn - m.ks;
  const double softer = n * n / (12 * std::numbers::sqrt2 * m.diameter * (m.kn + 5 * m.ks));
  c.c11 -= softer;
  c.c12 += softer;
  return c;
}

double Hexagonal::young_modulus(double angle) const {
  const double plane = c33 * (c11 + c12) - 2 * c13 * c13;
  const double s33 = (c11 + c12) / plane;
  const double s13 = -c13 / plane;
  const double s11 = (c33 / plane + 1 / (c11 - c12)) / 2;
  const double s = std::sin(angle) * std::sin(angle), c = std::cos(angle) * std::cos(angle);
  return 1 / (s11 * s * s + s33 * c * c + (2 * s13 + 1 / c44) * s * c);
}

double wave_speed_z(const Micro& m) {
  const double density = m.mass * std::numbers::sqrt2 / (m.diameter * m.diameter * m.diameter);
  return std::sqrt(affine_moduli(m).c33 / density);
}

}  // namespace dem::lattice
