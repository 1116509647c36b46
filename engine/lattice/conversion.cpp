#include "engine/lattice/conversion.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/errors.h"

namespace dem::lattice {
namespace {

constexpr double root2 = std::numbers::sqrt2;

void positive(double value, const char* what) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw InputError(fmt::format("{} is {}", what, value), fmt::format("{} must be a positive number", what));
  }
}

double volume_of_element(double d) { return root2 * d * d * d / 2; }  // Eq. 27

}  // namespace

Micro micro_of(const Rock& rock, double d) {
  positive(rock.young_modulus, "Young's modulus");
  positive(rock.tensile_strength, "the tensile strength");
  positive(rock.compressive_strength, "the compressive strength");
  positive(rock.density, "the density");
  positive(d, "the element diameter");
  const double nu = rock.poisson_ratio;
  if (!(nu >= 0 && nu <= 0.2)) {
    throw InputError(
        fmt::format("Poisson's ratio is {}", nu),
        "it must lie in 0 ... 0.2: above 0.2 the shear stiffness of a bond would be negative (Eq. 4), below "
        "0 larger than the normal stiffness");
  }
  const double least_friction = root2 / 4;
  if (!(rock.internal_friction >= least_friction - 1e-12) || !std::isfinite(rock.internal_friction)) {
    throw InputError(fmt::format("the coefficient of internal friction is {}", rock.internal_friction),
                     fmt::format("it must be at least {:.4f}: below, the friction of a contact mu_p would be negative "
                                 "(Eq. B5)",
                                 least_friction));
  }
  const double e = rock.young_modulus;
  Micro m;
  m.diameter = d;
  m.kn = root2 * e * d / (4 * (1 - 2 * nu));                            // B1
  m.ks = root2 * (1 - 5 * nu) * e * d / (4 * (1 + nu) * (1 - 2 * nu));  // B2
  if (nu == 0.2) m.ks = 0;                                              // 1 - 5 nu leaves a rounding error
  m.xb = (3 * m.kn + m.ks) / (6 * root2 * m.kn * (m.kn + m.ks)) * rock.tensile_strength * d * d;  // B3
  const double root_i = std::sqrt(1 + rock.internal_friction * rock.internal_friction) + rock.internal_friction;
  const double i = root_i * root_i;
  m.mu = std::fmax(0.0, (-2 * root2 + root2 * i) / (2 + 2 * i));       // B5
  m.fs0 = (1 - root2 * m.mu) / 6 * rock.compressive_strength * d * d;  // B4
  m.mass = rock.density * volume_of_element(d);                        // 27
  return m;
}

Rock rock_of(const Micro& m) {
  positive(m.kn, "the normal stiffness");
  positive(m.diameter, "the element diameter");
  positive(m.xb, "the breaking displacement");
  positive(m.fs0, "the initial shear resistance");
  positive(m.mass, "the element mass");
  if (!(m.ks >= 0 && m.ks <= m.kn)) {
    throw InputError(fmt::format("the shear stiffness is {} N/m", m.ks),
                     fmt::format("it must lie between 0 and the normal stiffness, {} N/m", m.kn));
  }
  if (!(m.mu >= 0 && m.mu < 1 / root2)) {
    throw InputError(
        fmt::format("the friction of a contact mu_p is {}", m.mu),
        "it must lie in 0 ... 0.7071 (1/sqrt(2)): at that bound the compressive strength is infinite (Eq. 14)");
  }
  Rock r;
  const double d = m.diameter;
  r.young_modulus = 6 * root2 * m.kn * (m.kn + m.ks) / (d * (5 * m.kn + m.ks));                // 6
  r.poisson_ratio = (m.kn - m.ks) / (5 * m.kn + m.ks);                                         // 4
  r.tensile_strength = 6 * root2 * m.kn * (m.kn + m.ks) / (3 * m.kn + m.ks) * m.xb / (d * d);  // 7
  r.compressive_strength = 6 / (1 - root2 * m.mu) * m.fs0 / (d * d);                           // 14
  const double p = (2 + root2 * m.mu) / (1 - root2 * m.mu);
  r.internal_friction = (p - 1) / (2 * std::sqrt(p));  // 15
  r.density = m.mass / volume_of_element(d);
  return r;
}

double opening_stress(const Micro& m) {
  if (m.ks == m.kn) return std::numeric_limits<double>::infinity();
  return 6 * root2 * m.kn * (m.kn + m.ks) / (m.kn - m.ks) * m.xb / (m.diameter * m.diameter);
}

double viscosity(const Micro& m, long elements) {
  const double volume = static_cast<double>(elements) * volume_of_element(m.diameter);
  return m.diameter / std::cbrt(volume) * std::sqrt(8 * m.mass * m.kn);
}

double stable_time_step(const Micro& m) { return 2 / std::sqrt(2 * (4 * m.kn + 8 * m.ks) / m.mass); }

UnitDisplacements unit_displacements(const Micro& m, double fz) {
  const double kn = m.kn, ks = m.ks;
  UnitDisplacements u;
  u.dz = (5 * kn + ks) / (9 * kn * (kn + ks)) * fz;
  u.xn1 = std::sqrt(6.0) * (3 * kn + ks) / (18 * kn * (kn + ks)) * fz;
  u.xs1 = 2 * std::sqrt(3.0) * kn / (9 * kn * (kn + ks)) * fz;
  u.xn2 = -std::sqrt(6.0) * (kn - ks) / (18 * kn * (kn + ks)) * fz;
  return u;
}

}  // namespace dem::lattice
