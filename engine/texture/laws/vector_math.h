#pragma once
// Three-vectors and quaternions over a number type V: double, or a GCC vector of doubles (one lane a contact).
// Everything is always inlined: the same source is built for several instruction sets, and nothing of it may be shared
// between them by the linker. lanes.h, where it is used, must come before this header. No fused operations (-ffp-contract=off), so every width gives the same bits.

#define DEM_INLINE inline __attribute__((always_inline))

namespace dem::texture {

template <class V>
struct Triple {
  V x, y, z;
};

template <class V>
DEM_INLINE Triple<V> operator+(const Triple<V>& a, const Triple<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
DEM_INLINE Triple<V> operator-(const Triple<V>& a, const Triple<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
DEM_INLINE Triple<V> operator*(const V& s, const Triple<V>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class V>
DEM_INLINE V dot(const Triple<V>& a, const Triple<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
DEM_INLINE Triple<V> cross(const Triple<V>& a, const Triple<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

DEM_INLINE double root(double a) { return __builtin_sqrt(a); }
DEM_INLINE double select(bool mask, double yes, double no) { return mask ? yes : no; }

/// A rotation: unit quaternion, w the scalar part.
template <class V>
struct Quaternion {
  V w, x, y, z;
};

template <class V>
DEM_INLINE Triple<V> rotate(const Quaternion<V>& q, const Triple<V>& a) {
  const Triple<V> u{q.x, q.y, q.z};
  Triple<V> t = cross(u, a);
  t = t + t;
  return a + q.w * t + cross(u, t);
}
template <class V>
DEM_INLINE Triple<V> rotate_back(const Quaternion<V>& q, const Triple<V>& a) {
  return rotate(Quaternion<V>{q.w, -q.x, -q.y, -q.z}, a);
}
/// a times the inverse of b: the rotation that leads from b to a.
template <class V>
DEM_INLINE Quaternion<V> relative(const Quaternion<V>& a, const Quaternion<V>& b) {
  return {a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z, a.x * b.w - a.w * b.x - (a.y * b.z - a.z * b.y),
          a.y * b.w - a.w * b.y - (a.z * b.x - a.x * b.z), a.z * b.w - a.w * b.z - (a.x * b.y - a.y * b.x)};
}

}  // namespace dem::texture
