#pragma once
// Linear contact of two spheres with friction: the law of contacts that form after installation, and of what is left of
// a broken bond once its faces have slid or turned off each other (mismatched in kinematics.h).
//
// As published (Cundall & Strack 1979; Potyondy & Cundall 2004; Zhao et al. 2021, sections 2.2 and 2.4, Appendix A):
// r = min(R1, R2), L = R1 + R2, A = pi r^2.
//   kn = A E_c / L              ks = kn / k_c                   N/m
//   F_n = -kn g  where g < 0, else nothing acts                 N; gap g, m
//   dF_s = -ks du_s             |F_s| <= mu F_n                 N; u_s: shear displacement of 2 against 1, m
//
// As coded: with d = x2 - x1, n = d / |d| and a = R1 / (R1 + R2) for the place of the contact on the branch,
//   g = |d| - L0
//   s <- (1 - n n) (s + dt v),  v = v2 - v1 - (a w1 + (1 - a) w2) x d
// where the elastic shear displacement s is the state: F_s = -ks s, cut to mu F_n in size. With F = F_n n - ks s on
// particle 2 and -F on particle 1, the moments about the centres are -a d x F and -(1 - a) d x F: momentum and angular
// momentum are kept whatever F is. Stored energy U = (kn g^2 + ks s^2) / 2. The heat of a slide is its length times the
// mean friction before and after (Liu et al. 2017, Eqs. 22-23), exact for the leapfrog.
//
// Departures: the gap counts from the distance L0 at which the contact was found, or from that of the bond that it is
// left of, so that it starts free of stress. The shear follows the contact plane by projection: it does not turn with
// the spin of the two about n. What shear is left when the contact opens turns into heat, by the same rule. There are
// no dashpots: damping is that of the particles.
#include <algorithm>
#include <numbers>

#include "engine/texture/laws/kinematics.h"
#include "engine/texture/laws/properties.h"

namespace dem::texture {

/// Parameters and state of a contact.
struct LinearContact {
  double normal = 0, shear = 0;   ///< kn, ks, N/m
  double friction = 0;            ///< mu
  double length = 0;              ///< L0, m
  Triple<double> slide{0, 0, 0};  ///< s, m
};

/// A contact of the given group between spheres of radii r1 and r2 (m), free of stress at `distance` (m).
inline LinearContact linear_contact(const ContactGroup& group, double r1, double r2, double distance) {
  const double r = std::min(r1, r2);
  LinearContact contact;
  contact.normal = std::numbers::pi * r * r * group.modulus / (r1 + r2);
  contact.shear = contact.normal / group.stiffness_ratio;
  contact.friction = group.friction;
  contact.length = distance;
  return contact;
}

/// A sphere at the end of a step: where it is, and the velocities that brought it there.
struct MovingSphere {
  Triple<double> x;     ///< m
  double radius;        ///< m
  Triple<double> v, w;  ///< m/s, rad/s
};

/// What the contact does in a step.
struct LinearResult {
  bool closed = false;      ///< false: nothing acts
  Action<double> action{};  ///< N, N m
  double energy = 0;        ///< U, J
  double heat = 0;          ///< J, never negative while slides are small against s
};

/// The velocity of sphere 2 against sphere 1 at their contact; d = x2 - x1, `share` the place a of the contact on it.
DEM_INLINE Triple<double> velocity_at_contact(const MovingSphere& one, const MovingSphere& two, const Triple<double>& d,
                                              double share) {
  const Triple<double> turn = share * one.w + (1 - share) * two.w;
  return two.v - one.v - cross(turn, d);
}

/// Lets the contact follow its spheres over a step of `dt` seconds.
DEM_INLINE LinearResult advance(LinearContact& contact, const MovingSphere& one, const MovingSphere& two, double dt) {
  LinearResult result;
  const Triple<double> d = two.x - one.x;
  const double length = root(dot(d, d));
  const Triple<double> n = (1 / length) * d;
  const double gap = length - contact.length;
  if (gap > 0) {
    result.heat = 0.5 * contact.shear * dot(contact.slide, contact.slide);
    contact.slide = {0, 0, 0};
    return result;
  }
  const double share = one.radius / (one.radius + two.radius);
  Triple<double> slide = contact.slide + dt * velocity_at_contact(one, two, d, share);
  slide = slide - dot(slide, n) * n;
  const double normal = -contact.normal * gap, limit = contact.friction * normal;
  const double trial = contact.shear * root(dot(slide, slide));
  if (trial > limit) {
    const Triple<double> kept = (limit / trial) * slide;
    result.heat = (0.5 * contact.shear) * dot(contact.slide + kept, slide - kept);
    slide = kept;
  }
  contact.slide = slide;
  const Triple<double> f = normal * n - contact.shear * slide;
  const Triple<double> twist = cross(d, f);
  result.closed = true;
  result.action = {f, -share * twist, -(1 - share) * twist};
  result.energy = 0.5 * (contact.normal * gap * gap + contact.shear * dot(slide, slide));
  return result;
}

}  // namespace dem::texture
