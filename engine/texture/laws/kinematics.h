#pragma once
// Relative motion of two bonded particles, in total form: it follows from the two poses alone, nothing is summed up over
// steps. That makes an intact bond a conservative mechanism: its force and moments are the exact gradient of its energy,
// momentum and angular momentum are kept to rounding, and an intact bond has no state that must be written.
//
// A bond is installed with reference branch vector D (from particle 1 to particle 2; both particles unrotated). With
// d = x2 - x1, L = |d|, n = d / L and the rotations R1, R2 of the particles since installation:
//   g  = L - |D|                        opening (tension positive)
//   w1 = a1 R1 D,  w2 = (1 - a1) R2 D   arms that the particles carry with them, a1 L: distance of the face from x1
//   u  = -(w1 + w2) + ((w1 + w2).n) n   shear displacement of face 2 against face 1 (perpendicular to n)
//   q  = R2 R1^-1,  theta = 2 vec(q)    relative rotation (2 sin(angle / 2) about its axis)
// To first order these are the increments of the usual formulation (Potyondy & Cundall 2004, Eqs. 5-12) summed up.
#include "engine/texture/laws/vector_math.h"

namespace dem::texture {

template <class V>
struct Pose {
  Triple<V> x;  ///< m
  Quaternion<V> q;
};

template <class V>
struct Motion {
  V length;  ///< L, m
  V gap;     ///< g, m
  Triple<V> n;
  Triple<V> w1, w2;   ///< m
  V along;            ///< (w1 + w2).n, m
  Triple<V> u;        ///< m
  V cosine;           ///< scalar part of q
  Triple<V> theta_t;  ///< bending part of theta
  V theta_n;          ///< twisting part of theta, about n
};

template <class V>
DEM_INLINE Motion<V> motion(const Pose<V>& one, const Pose<V>& two, const Triple<V>& reference, const V& share_one,
                            const V& reference_length) {
  Motion<V> m;
  const Triple<V> d = two.x - one.x;
  m.length = root(dot(d, d));
  m.n = (1.0 / m.length) * d;
  m.gap = m.length - reference_length;
  m.w1 = share_one * rotate(one.q, reference);
  m.w2 = (1.0 - share_one) * rotate(two.q, reference);
  const Triple<V> w = m.w1 + m.w2;
  m.along = dot(w, m.n);
  m.u = m.along * m.n - w;
  const Quaternion<V> q = relative(two.q, one.q);
  m.cosine = q.w;
  const Triple<V> theta{q.x + q.x, q.y + q.y, q.z + q.z};
  m.theta_n = dot(theta, m.n);
  m.theta_t = theta - m.theta_n * m.n;
  return m;
}

/// Faces that have slid against each other by this share of their distance, or turned by this angle (rad), no
/// longer match: a broken bond becomes a frictional contact of spheres. The total form is good for smaller motions only:
/// on a fragment that rolls on, its friction would do work that no energy stands for.
inline constexpr double mismatch = 0.1;

template <class V>
DEM_INLINE auto mismatched(const Motion<V>& m) {
  const V limit = mismatch * m.length;
  const V turn = dot(m.theta_t, m.theta_t) + m.theta_n * m.theta_n;
  return (dot(m.u, m.u) > limit * limit) | (turn > (turn - turn) + mismatch * mismatch);
}

/// What a bond does to its particles: force on 2 (the opposite acts on 1) and the moments about the two centres.
template <class V>
struct Action {
  Triple<V> force;     ///< N, on particle 2
  Triple<V> moment_1;  ///< N m
  Triple<V> moment_2;
};

template <class V>
DEM_INLINE Action<V> operator+(const Action<V>& a, const Action<V>& b) {
  return {a.force + b.force, a.moment_1 + b.moment_1, a.moment_2 + b.moment_2};
}
template <class V>
DEM_INLINE Action<V> operator-(const Action<V>& a, const Action<V>& b) {
  return {a.force - b.force, a.moment_1 - b.moment_1, a.moment_2 - b.moment_2};
}

/// Stiffnesses of an intact bond: normal and shear (N/m), bending and twisting (N m/rad).
template <class V>
struct Stiffness {
  V normal, shear, bending, twisting;
};

/// Stored energy U = kn g^2/2 + ks u^2/2 + kb theta_t^2/2 + kt theta_n^2/2, J.
template <class V>
DEM_INLINE V energy(const Motion<V>& m, const Stiffness<V>& k) {
  return 0.5 * (k.normal * m.gap * m.gap + k.shear * dot(m.u, m.u) + k.bending * dot(m.theta_t, m.theta_t) +
                k.twisting * m.theta_n * m.theta_n);
}

/// The exact gradient of energy() with respect to both poses. The terms of second order (the change of n in the shear and
/// in the twist) are what keeps energy and angular momentum.
template <class V>
DEM_INLINE Action<V> action(const Motion<V>& m, const Stiffness<V>& k) {
  const V inverse = 1.0 / m.length;
  const Triple<V> shear = k.shear * m.u;
  const V twist = (k.twisting - k.bending) * m.theta_n;
  const Triple<V> moment = m.cosine * (k.bending * m.theta_t + (k.twisting * m.theta_n) * m.n);
  const Triple<V> second = (0.5 * twist) * cross(m.theta_t, m.n);
  const V zero = m.length - m.length;
  Action<V> a;
  a.force = (zero - k.normal * m.gap) * m.n - (m.along * inverse) * shear - (twist * inverse) * m.theta_t;
  a.moment_1 = cross(m.w1, shear) + moment - second;
  a.moment_2 = cross(m.w2, shear) - moment - second;
  return a;
}

/// Action of a force f on particle 2 through the contact point x1 + a1 d, with a couple c on particle 2:
/// keeps momentum and angular momentum whatever f and c are. Used where friction has put the shear out of line with u.
template <class V>
DEM_INLINE Action<V> action_at_contact(const Motion<V>& m, const V& share_one, const Triple<V>& f, const Triple<V>& c) {
  const Triple<V> turn = m.length * cross(m.n, f);
  const Triple<V> none = c - c;
  return {f, none - c - share_one * turn, c - (1.0 - share_one) * turn};
}

}  // namespace dem::texture
