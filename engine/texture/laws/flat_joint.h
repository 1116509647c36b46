#pragma once
// Flat joint (FJM), N_r = 1, N_alpha = 3: the law inside grains.
//
// As published (Potyondy 2012, 2016; Zhao et al. 2021, section 2.1): the faces of two particles meet in a disc of radius
// R = min(R1, R2), split into three elements of area A_e = pi R^2 / 3 with centroids at rho = 0.55133 R from the axis
// (exactly sqrt(3) R / pi), at 60, 180 and 300 degrees. Normal and shear stiffness are stresses per displacement:
//   kn = E* / (R1 + R2)                       ks = kn / kappa
//   sigma_e = kn g_e                          tau_e = ks |s_e|                  (tension positive)
//   g_e = g + n.(theta x rho_e)               s_e = u + theta_n n x rho_e
//   tension crack:  sigma_e > sigma_t         shear crack:  tau_e > C - sigma_e tan(phi)
// A broken element carries compression, and shear up to mu times the compression; elements break one by one.
//
// As coded: while all three elements are bonded their sum has the closed form of an elastic bond with
//   Kn = kn A,  Ks = ks A,  Kb = kn A rho^2 / 2,  Kt = ks A rho^2              (A = pi R^2)
// so an intact joint needs no state and one cheap bound on its largest element stress; only when the bound is passed are
// the elements looked at one by one. A joint with a broken element is evaluated element by element.
//
// Departures: total instead of incremental displacements (kinematics.h), so that what still holds two faces which no longer
// match (mismatched) is torn: an element that bears the mean of its face only would else be a hinge for any angle, though
// its rim opens by a hundred times what its strength allows; E* = E_c + E_b (see properties.h); all elements
// over their strength in a step break in that step; the released energy of a shear crack includes the drop of its shear
// stress to the friction limit.
#include "engine/texture/laws/kinematics.h"

namespace dem::texture {

/// sqrt(3)/pi: distance of the centroid of a sector of 120 degrees from the axis, over R.
inline constexpr double flat_joint_arm = 0.55132889542179209;

/// An intact flat joint. Strengths are divided by kn: displacements in m.
template <class V>
struct FlatJoint {
  V normal;         ///< Kn = kn A, N/m
  V inverse_ratio;  ///< 1 / kappa
  V rho;            ///< m
  V opening;        ///< sigma_t / kn, m
  V cohesion;       ///< C / kn, m
  V tan_phi;
};

template <class V>
DEM_INLINE Stiffness<V> stiffness(const FlatJoint<V>& j) {
  const V shear = j.normal * j.inverse_ratio;
  const V squared = j.rho * j.rho;
  return {j.normal, shear, 0.5 * (j.normal * squared), shear * squared};
}

/// True where some element may be over its strength: the stresses used are upper bounds over the whole rim rho.
template <class V>
DEM_INLINE auto may_break(const Motion<V>& m, const FlatJoint<V>& j) {
  const V normal = m.gap + j.rho * root(dot(m.theta_t, m.theta_t));
  const V twist = m.theta_n * j.rho, zero = twist - twist;
  // |u| + |twist|, in units of sigma / kn
  const V shear = j.inverse_ratio * (root(dot(m.u, m.u)) + select(twist < zero, zero - twist, twist));
  return (normal > j.opening) | (shear > j.cohesion - normal * j.tan_phi);
}

/// One element of three, for joints that are looked at element by element. Eight doubles, as the vector code
/// reads it: truths are 1 or 0.
struct JointElement {
  Triple<double> slip{0, 0, 0};  ///< shear displacement without stress, in the frame of particle 1, m
  double bonded = 1;
  Triple<double> shear{0, 0, 0};  ///< elastic shear displacement one step ago, m; for the account of friction
  double unused = 0;
};

/// A flat joint with its elements, and what it takes to evaluate and log it. The vector code (broken_joints in kernels.inc)
/// reads five rows of eight doubles in this order.
struct alignas(32) PartlyBrokenJoint {
  Triple<double> reference{};  ///< D, m
  double share_one = 0.5;
  Triple<double>
      zero_angle{};  ///< unit vector in the joint's plane (frame of particle 1) from which angles are counted
  double open = 0;   ///< 1: all three elements broken and apart in the last step
  FlatJoint<double> law{};
  double friction = 0;          ///< mu
  double reference_length = 0;  ///< |D|, m
  JointElement element[3];
  int first = 0, second = 0;  ///< particles
  int contact = 0;            ///< index in the specimen's contact table
  bool alive = true;          ///< false: parted for good and dropped

  [[nodiscard]] bool broken() const { return element[0].bonded + element[1].bonded + element[2].bonded == 0; }
};

/// Directions of the three elements from the zero angle: 60, 180 and 300 degrees.
inline constexpr double element_cosine[3] = {0.5, -1.0, 0.5};
inline constexpr double element_sine[3] = {0.86602540378443865, 0.0, -0.86602540378443865};

/// True when a joint that was open shows without further work that it still is: bending is a part of theta.
DEM_INLINE bool stays_open(const PartlyBrokenJoint& joint, const Pose<double>& one, const Pose<double>& two) {
  const Triple<double> d = two.x - one.x;
  const double gap = root(dot(d, d)) - joint.reference_length;
  const Quaternion<double> q = relative(two.q, one.q);
  const double half_theta_squared = q.x * q.x + q.y * q.y + q.z * q.z;
  return joint.open != 0 && gap > 0 && gap * gap > 4 * joint.law.rho * joint.law.rho * half_theta_squared;
}

/// A fixed direction perpendicular to D.
Triple<double> any_perpendicular(const Triple<double>& d);

/// What an element tells when it breaks.
struct ElementBreak {
  int element = 0;
  bool shear = false;
  Triple<double> position{};  ///< centroid, m
  Triple<double> normal{};
  double area = 0;           ///< m^2
  double released = 0;       ///< drop of stored energy, J
  Action<double> removed{};  ///< what the element did just before less what it does after
};

struct JointResult {
  Action<double> action{};
  double friction_heat = 0;  ///< J, in this call
  int breaks = 0;
  ElementBreak broke[3];
};

/// Evaluates the elements at the given poses; breaks elements that are over their strength and lets broken ones slip.
/// The action is that after breaking and slipping.
JointResult advance(PartlyBrokenJoint& joint, const Pose<double>& one, const Pose<double>& two);
/// Energy stored in the elements, J.
double stored(const PartlyBrokenJoint& joint, const Pose<double>& one, const Pose<double>& two);

}  // namespace dem::texture
