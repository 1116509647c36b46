#pragma once
// Linear parallel bond (LPBM): the law of grain boundaries, and, without its bond, of new frictional contacts.
//
// As published (Zhao et al. 2021, sections 2.2 and 2.4, Appendix A; Potyondy & Cundall 2004): two parts side by side that
// share one displacement. r = min(R1, R2), L = R1 + R2, A = pi r^2, I = pi r^4 / 4, J = pi r^4 / 2.
//   linear part:  kn = A E_c / L, ks = kn / k_c; no tension; |F_s| <= mu F_n
//   bond:         kbn = E_b / L, kbs = kbn / k_b (stress per displacement); forces A kbn g, A kbs u, moments kbn I, kbs J
//   tension crack: kbn g > sigma_t            shear crack: kbs |u| > C - kbn g tan(phi)     (beta = 0, Eq. 2: the moments
//                                                                    act but do not enter the strength)
// The whole bond breaks at once; the linear part stays.
//
// As coded: total displacements (kinematics.h). The state is the slip of the linear part, which is its shear displacement
// without stress, in the frame of particle 1; and its elastic shear displacement one step ago, which only the account of
// friction needs: heat = (F_before + F_after) / 2 . slip (Liu et al. 2017, Eqs. 22-23) is exact for the leapfrog.
// Where the linear part is open its slip follows the shear displacement.
// Where no bond holds the two any more and their faces have slid or turned off each other (mismatched in kinematics.h), the
// linear part goes on as a contact of spheres (linear_contact.h).
// Departure: the gap of the linear part counts from the installed distance, so that bonds start free of stress.
#include "engine/texture/laws/kinematics.h"

namespace dem::texture {

template <class V>
struct ParallelBond {
  V linear_normal;         ///< kn of the linear part, N/m
  V linear_inverse_ratio;  ///< 1 / k_c
  V friction;              ///< mu
  V normal;                ///< A kbn, N/m; 0 when the bond is broken
  V inverse_ratio;         ///< 1 / k_b
  V radius;                ///< r, m
  V opening;               ///< sigma_t / kbn, m; huge when broken
  V cohesion;              ///< C / kbn, m; huge when broken
  V tan_phi;
};

template <class V>
DEM_INLINE Stiffness<V> stiffness(const ParallelBond<V>& b) {
  const V shear = b.normal * b.inverse_ratio;
  const V squared = b.radius * b.radius;  // I / A = r^2 / 4, J / A = r^2 / 2
  return {b.normal, shear, 0.25 * (b.normal * squared), 0.5 * (shear * squared)};
}

/// True where the bond is over its strength.
template <class V>
DEM_INLINE auto breaks(const Motion<V>& m, const ParallelBond<V>& b) {
  const V shear = b.inverse_ratio * root(dot(m.u, m.u));
  return (m.gap > b.opening) | (shear > b.cohesion - m.gap * b.tan_phi);
}

/// The linear part: its force on particle 2, the new slip (global frame) and the heat of the slip.
template <class V>
struct LinearPart {
  Triple<V> force;  ///< N
  Triple<V> shear;  ///< elastic shear displacement that is left, m
  V heat;           ///< J: the mean friction before and after the step times the slip
  decltype(V{} > V{}) slipped;
};

template <class V>
DEM_INLINE LinearPart<V> linear_part(const Motion<V>& m, const ParallelBond<V>& b, const Triple<V>& slip,
                                     const Triple<V>& shear_before) {
  const V zero = m.length - m.length;
  const V closed = select(m.gap < zero, m.gap, zero);
  const V normal = b.linear_normal * closed;  // <= 0
  const V ks = b.linear_normal * b.linear_inverse_ratio;
  const Triple<V> trial = m.u - (slip - dot(slip, m.n) * m.n);
  const V length = root(dot(trial, trial));
  const V limit = zero - b.friction * normal;  // N
  const V force = ks * length;
  const V one = zero + 1.0;
  LinearPart<V> r;
  r.slipped = force > limit;
  const V keep = select(r.slipped, limit / select(r.slipped, force, one), one);
  r.shear = keep * trial;
  r.heat = (0.5 * ks) * dot(shear_before + r.shear, trial - r.shear);
  r.force = (zero - normal) * m.n - ks * r.shear;
  return r;
}

}  // namespace dem::texture
