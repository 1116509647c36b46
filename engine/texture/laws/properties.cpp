#include "engine/texture/laws/properties.h"

#include <algorithm>

namespace dem::texture {

ContactGroup inside(const Mineral& m, JointModulus modulus) {
  const double both = modulus == JointModulus::sum ? m.modulus + m.bond_modulus : m.modulus;
  return {m.modulus,          m.stiffness_ratio, m.friction,      both, m.bond_stiffness_ratio,
          m.tensile_strength, m.cohesion,        m.friction_angle};
}

ContactGroup between(const Mineral& a, const Mineral& b, const Interaction& alpha) {
  const auto harmonic = [](double p, double q) { return 2 * p * q / (p + q); };
  const auto weighted = [](double k1, double e1, double k2, double e2) { return (k1 * e2 + k2 * e1) / (e1 + e2); };
  ContactGroup g;
  g.modulus = alpha.modulus * harmonic(a.modulus, b.modulus);
  g.bond_modulus = alpha.modulus * harmonic(a.bond_modulus, b.bond_modulus);
  g.stiffness_ratio = alpha.stiffness_ratio * weighted(a.stiffness_ratio, a.modulus, b.stiffness_ratio, b.modulus);
  g.bond_stiffness_ratio =
      alpha.stiffness_ratio * weighted(a.bond_stiffness_ratio, a.bond_modulus, b.bond_stiffness_ratio, b.bond_modulus);
  g.friction = alpha.friction * std::min(a.friction, b.friction);
  g.cohesion = 0.5 * alpha.cohesion * (a.cohesion + b.cohesion);
  g.friction_angle = 0.5 * alpha.friction_angle * (a.friction_angle + b.friction_angle);
  g.tensile_strength = 0.5 * alpha.tensile_strength * (a.tensile_strength + b.tensile_strength);
  return g;
}

}  // namespace dem::texture
