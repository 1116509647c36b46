#pragma once
// Micro-parameters of minerals and of the contacts between them (Zhao et al. 2021, Table 4, Eqs. 7-8 and A1-A5). SI units.
#include <string>

namespace dem::texture {

/// The material group of Table 4.
struct Mineral {
  std::string name;
  double share = 0;                           ///< C_m
  double diameter_min = 0, diameter_max = 0;  ///< of grain seeds, m
  double density = 0;                         ///< kg/m^3
  double modulus = 0;                         ///< E_c, Pa
  double stiffness_ratio = 0;                 ///< k_c
  double friction = 0;                        ///< mu_c
  double bond_modulus = 0;                    ///< E_b, Pa
  double bond_stiffness_ratio = 0;            ///< k_b
  double tensile_strength = 0;                ///< sigma_t,b, Pa
  double cohesion = 0;                        ///< C_b, Pa
  double friction_angle = 0;                  ///< phi_b, rad
};

/// The material-interaction group of Table 4: attenuation on grain boundaries.
struct Interaction {
  double modulus = 1;           ///< alpha_E
  double stiffness_ratio = 1;   ///< alpha_k
  double friction = 1;          ///< alpha_mu
  double tensile_strength = 1;  ///< alpha_t
  double cohesion = 1;          ///< alpha_C
  double friction_angle = 1;    ///< alpha_phi
};

/// Parameters of one contact group.
struct ContactGroup {
  double modulus = 0, stiffness_ratio = 1, friction = 0;  ///< linear part
  double bond_modulus = 0, bond_stiffness_ratio = 1;      ///< bond
  double tensile_strength = 0, cohesion = 0, friction_angle = 0;
};

/// Which modulus the flat joint takes. Table 3's moduli of the minerals are out of reach with E_c alone in any packing;
/// with the sum of both parts all four come out within about 5 %.
enum class JointModulus { sum, linear };

/// Where the coefficients of the interaction act. "According to the kinds of minerals (S), the total number of contact
/// groups is S(S+1)/2" (section 2.4): S of one mineral and S(S-1)/2 of two. So grains of one mineral meet in a group that
/// has their mineral's own values.
enum class Attenuated { unlike_minerals, all_boundaries };

/// Inside a grain: the mineral's values, for the flat joint.
ContactGroup inside(const Mineral& mineral, JointModulus modulus);

/// Between grains: Eqs. 7 and 8, for the parallel bond. Moduli by harmonic mean, stiffness ratios weighted by the modulus
/// of the other side, friction the minimum times alpha_mu (Table 4 has it, Eq. 7 leaves it out), strengths by arithmetic
/// mean; each times its attenuation coefficient. For one mineral without coefficients: that mineral's own values.
ContactGroup between(const Mineral& a, const Mineral& b, const Interaction& alpha);

}  // namespace dem::texture
