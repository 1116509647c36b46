// Compiled several times with different -m flags: see CMakeLists.txt. DEM_KERNEL names the result, DEM_LANES the width.
// Every operation is element-wise and none is fused, so that all widths give the same bits.
#include "engine/lattice/kernel.h"

#include <immintrin.h>

namespace dem::lattice {
namespace {

constexpr int lanes = DEM_LANES;
using V = double __attribute__((vector_size(8 * DEM_LANES)));
using Unaligned = double __attribute__((vector_size(8 * DEM_LANES), aligned(8), may_alias));
using Mask = long long __attribute__((vector_size(8 * DEM_LANES)));

inline V load(const double* p) { return *reinterpret_cast<const Unaligned*>(p); }
inline void store(double* p, V v) { *reinterpret_cast<Unaligned*>(p) = v; }
inline V fill(double x) { return x - V{}; }
inline V load(const Wide& w) { return *reinterpret_cast<const V*>(w.lane); }

#if DEM_LANES == 8
inline V root(V x) { return _mm512_sqrt_pd(x); }
inline V larger(V a, V b) { return _mm512_max_pd(a, b); }
inline bool any(Mask m) {
  return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(m), reinterpret_cast<__m512i>(m)) != 0;
}
constexpr Mask lane_bits = {1, 2, 4, 8, 16, 32, 64, 128};
inline V shift_in(V before, V now) { return __builtin_shuffle(before, now, Mask{7, 8, 9, 10, 11, 12, 13, 14}); }
#elif DEM_LANES == 4
inline V root(V x) { return _mm256_sqrt_pd(x); }
inline V larger(V a, V b) { return _mm256_max_pd(a, b); }
inline bool any(Mask m) { return _mm256_movemask_pd(reinterpret_cast<__m256d>(m)) != 0; }
constexpr Mask lane_bits = {1, 2, 4, 8};
inline V shift_in(V before, V now) { return __builtin_shuffle(before, now, Mask{3, 4, 5, 6}); }
#else
inline V root(V x) { return _mm_sqrt_pd(x); }
inline V larger(V a, V b) { return _mm_max_pd(a, b); }
inline bool any(Mask m) { return _mm_movemask_pd(reinterpret_cast<__m128d>(m)) != 0; }
constexpr Mask lane_bits = {1, 2};
inline V shift_in(V before, V now) { return __builtin_shuffle(before, now, Mask{1, 2}); }
#endif

constexpr unsigned full = (1u << DEM_LANES) - 1;

inline Mask mask_of(unsigned bits) { return ((static_cast<long long>(bits) - Mask{}) & lane_bits) != 0; }
inline V where(Mask m, V v) { return reinterpret_cast<V>(m & reinterpret_cast<Mask>(v)); }
inline V select(Mask m, V a, V b) { return m ? a : b; }

// What the six bonds of every element of a vector are, so that most vectors need no masks.
enum class Bonds { whole, some_missing, some_broken };

inline Bonds bonds_of(const Bits& bits) {
  constexpr unsigned long long all_full = full * 0x010101010101ull;
  unsigned long long intact, broken;
  __builtin_memcpy(&intact, bits.intact, 8);
  __builtin_memcpy(&broken, bits.broken, 8);
  return intact == all_full ? Bonds::whole : broken == 0 ? Bonds::some_missing : Bonds::some_broken;
}

// Reference vectors have zeros: no z in the layer, no x along y, no y in direction 5.
constexpr bool has_x(int k) { return k != 0; }
constexpr bool has_y(int k) { return k != 5; }
constexpr bool has_z(int k) { return k >= 3; }

struct Vector {
  V x, y, z;
};
inline Vector load_vector(const double* p, long pitch) { return {load(p), load(p + pitch), load(p + 2 * pitch)}; }

struct Accumulated {
  V fx, fy, fz;  // on this element
  V energy_normal, energy_shear, friction;
  Mask trip;  // bonds past a limit, over all directions
};

// Stretch and direction of the bonds in direction K of one vector of elements. Differences are taken as near end less
// far end, the far one being the operand in memory.
struct Stretch {
  V xn, ex, ey, ez;
};
template <int K, Bonds B>
inline Stretch stretch(const Constants& c, const Row& row, const Bits& bits, long at, const Vector& u) {
  if constexpr (B != Bonds::whole) {
    if ((bits.intact[K] | bits.broken[K]) == 0) return Stretch{V{}, V{}, V{}, V{}};
  }
  const long pitch = c.pitch;
  const double* far = row.other[K] + at;
  const Wide* r0 = c.bond[row.layer_kind][K];
  const V dx = u.x - load(far), dy = u.y - load(far + pitch), dz = u.z - load(far + 2 * pitch);
  V along = V{};
  if constexpr (has_x(K)) along = load(r0[0]) * dx;
  if constexpr (has_x(K) && has_y(K)) along = along + load(r0[1]) * dy;
  if constexpr (!has_x(K)) along = load(r0[1]) * dy;
  if constexpr (has_z(K)) along = along + load(r0[2]) * dz;
  const V q = ((dx * dx + dy * dy) + dz * dz) - (along + along);
  const V r = root(load(c.d2) + q);
  const V s = r + load(c.d);
  const V inverse = 1.0 / (r * s);
  const V xn = q * r * inverse;
  const V ir = s * inverse;
  const V ex = has_x(K) ? load(r0[0]) - dx : -dx;
  const V ey = has_y(K) ? load(r0[1]) - dy : -dy;
  const V ez = has_z(K) ? load(r0[2]) - dz : -dz;
  return {xn, ex * ir, ey * ir, ez * ir};
}

// Forces of the bonds in direction K of one vector of elements, added to `sum`; the force itself goes to (fx, fy, fz).
template <int K, Bonds B, bool Sample>
inline void bond(const Constants& c, const Row& row, const Bits& bits, long at, const Vector& w, const Stretch& bonds,
                 Accumulated& sum, V& fx, V& fy, V& fz) {
  const long pitch = c.pitch;
  double* force = K > 0 ? row.force + 3 * (K - 1) * c.force_pitch + at : nullptr;
  if constexpr (B != Bonds::whole) {
    if ((bits.intact[K] | bits.broken[K]) == 0) {
      fx = fy = fz = V{};
      if constexpr (K > 0) {
        store(force, V{});
        store(force + c.force_pitch, V{});
        store(force + 2 * c.force_pitch, V{});
      }
      return;
    }
  }
  const V xn = bonds.xn, ex = bonds.ex, ey = bonds.ey, ez = bonds.ez;
  const double* far = row.other[K] + at + 3 * pitch;
  double* shear = row.shear + 3 * directions * at + 3 * K * lanes;
  const V px = load(shear), py = load(shear + lanes), pz = load(shear + 2 * lanes);
  V tx = px - (w.x - load(far)), ty = py - (w.y - load(far + pitch)), tz = pz - (w.z - load(far + 2 * pitch));
  const V te = (tx * ex + ty * ey) + tz * ez;
  tx = tx - te * ex;
  ty = ty - te * ey;
  tz = tz - te * ez;
  V x2 = (tx * tx + ty * ty) + tz * tz;

  V fn = load(c.kn) * xn;
  const V room = larger(load(c.fs0) - load(c.mu) * fn, V{});
  const Mask past = (xn > load(c.xb)) | ((load(c.ks2) * x2) > (room * room));
  V xe = xn;
  if constexpr (B == Bonds::whole) {
    sum.trip |= past;
  } else {
    const unsigned intact = bits.intact[K], broken = bits.broken[K];
    sum.trip |= past & mask_of(intact);
    if constexpr (B == Bonds::some_broken) {
      if (broken != 0) {
        const Mask gone = mask_of(broken);
        const V touching = select(fn < 0.0, fn, V{});
        const V limit = load(c.mu) * touching;  // negative or zero
        const V over = load(c.ks2) * x2;
        const V cut = select(over > limit * limit, -limit / root(over), fill(1.0));
        const V ratio = select(gone, cut, fill(1.0));
        const V before = (px * tx + py * ty) + pz * tz;
        sum.friction += where(gone, load(c.half_ks) * (1.0 - ratio) * (before + ratio * x2));
        tx = tx * ratio;
        ty = ty * ratio;
        tz = tz * ratio;
        x2 = ratio * ratio * x2;
        fn = select(gone, touching, fn);
        xe = select(gone, select(xn < 0.0, xn, V{}), xn);
      }
    }
    const Mask there = mask_of(intact | broken);
    tx = where(there, tx);
    ty = where(there, ty);
    tz = where(there, tz);
    fn = where(there, fn);
    xe = where(there, xe);
    x2 = where(there, x2);
  }
  store(shear, tx);
  store(shear + lanes, ty);
  store(shear + 2 * lanes, tz);
  fx = fn * ex + load(c.ks) * tx;
  fy = fn * ey + load(c.ks) * ty;
  fz = fn * ez + load(c.ks) * tz;
  sum.fx += fx;
  sum.fy += fy;
  sum.fz += fz;
  if constexpr (K > 0) {
    store(force, fx);
    store(force + c.force_pitch, fy);
    store(force + 2 * c.force_pitch, fz);
  }
  if constexpr (Sample) {
    sum.energy_normal += 0.5 * load(c.kn) * xe * xe;
    sum.energy_shear += load(c.half_ks) * x2;
  }
}

// What a vector of bonds hands to the slow path and takes back, lane by lane.
struct Spilled {
  double first[3][DEM_LANES];  // force in direction 0
  double sum[3][DEM_LANES];
  double energy_normal[DEM_LANES], energy_shear[DEM_LANES];
};

// Breaks the bonds past their limit in one lane and direction: the same operations as above, on single values.
inline void break_bond(const Constants& c, const Row& row, Bits& bits, long at, int lane, int k, Spilled& s,
                       Events& events) {
  const long pitch = c.pitch;
  const double kn = c.kn.lane[0], ks = c.ks.lane[0], ks2 = c.ks2.lane[0], d = c.d.lane[0];
  const long column = at + lane;
  const double* me = row.self + column;
  const double* far = row.other[k] + column;
  const Wide* r0 = c.bond[row.layer_kind][k];
  double* t = row.shear + 3 * directions * at + 3 * k * lanes + lane;
  double du[3], dw[3], e[3];
  for (int i = 0; i < 3; ++i) {
    du[i] = far[i * pitch] - me[i * pitch];
    dw[i] = far[(3 + i) * pitch] - me[(3 + i) * pitch];
  }
  double along = 0;
  for (int i = 0; i < 3; ++i) along = along + r0[i].lane[0] * du[i];
  const double q = (along + along) + ((du[0] * du[0] + du[1] * du[1]) + du[2] * du[2]);
  const double r = __builtin_sqrt(c.d2.lane[0] + q);
  const double sd = r + d;
  const double inverse = 1.0 / (r * sd);
  const double xn = q * r * inverse;
  for (int i = 0; i < 3; ++i) e[i] = (r0[i].lane[0] + du[i]) * (sd * inverse);
  const double x2 = (t[0] * t[0] + t[lanes] * t[lanes]) + t[2 * lanes] * t[2 * lanes];
  const double fn = kn * xn;
  const double room_signed = c.fs0.lane[0] - c.mu.lane[0] * fn;
  const double room = room_signed > 0.0 ? room_signed : 0.0;
  const bool opening = xn > c.xb.lane[0];
  if (!opening && !(ks2 * x2 > room * room)) return;

  const double touching = fn < 0.0 ? fn : 0.0;
  const double limit = c.mu.lane[0] * touching;
  const double over = ks2 * x2;
  const double ratio = over > limit * limit ? -limit / __builtin_sqrt(over) : 1.0;
  double heat_normal = fn < 0.0 ? 0.0 : 0.5 * kn * xn * xn;
  double heat_shear = 0.5 * ks * (x2 - ratio * ratio * x2);
  s.energy_normal[lane] -= heat_normal;
  s.energy_shear[lane] -= heat_shear;
  for (int i = 0; i < 3; ++i) {
    const double before = fn * e[i] + ks * t[i * lanes];
    const double lost_normal = (fn - touching) * e[i];
    const double lost_shear = ks * (t[i * lanes] - ratio * t[i * lanes]);
    heat_normal -= 0.5 * lost_normal * dw[i];
    heat_shear -= 0.5 * lost_shear * dw[i];
    t[i * lanes] = ratio * t[i * lanes];
    const double after = touching * e[i] + ks * t[i * lanes];
    s.sum[i][lane] = (s.sum[i][lane] - before) + after;
    if (k == 0) {
      s.first[i][lane] = after;
    } else {
      row.force[(3 * (k - 1) + i) * c.force_pitch + column] = after;
    }
  }
  const unsigned char bit = static_cast<unsigned char>(1u << lane);
  bits.intact[k] = static_cast<unsigned char>(bits.intact[k] & ~bit);
  bits.broken[k] = static_cast<unsigned char>(bits.broken[k] | bit);
  events.items[events.count++] = {events.step, row.index, static_cast<int>(column), k, opening ? 0 : 1,
                                  heat_normal, heat_shear};
}

__attribute__((noinline)) void break_bonds(const Constants& c, const Row& row, long at, Spilled& s, Events& events) {
  Bits& bits = row.bits[at / lanes];
  for (int lane = 0; lane < lanes; ++lane) {
    for (int k = 0; k < directions; ++k) {
      if (bits.intact[k] >> lane & 1) break_bond(c, row, bits, at, lane, k, s, events);
    }
  }
}

template <Bonds B>
inline void stretches_of_vector(const Constants& c, const Row& row, long at, Stretch* bonds) {
  const Bits& bits = row.bits[at / lanes];
  const Vector u = load_vector(row.self + at, c.pitch);
  bonds[0] = stretch<0, B>(c, row, bits, at, u);
  bonds[1] = stretch<1, B>(c, row, bits, at, u);
  bonds[2] = stretch<2, B>(c, row, bits, at, u);
  bonds[3] = stretch<3, B>(c, row, bits, at, u);
  bonds[4] = stretch<4, B>(c, row, bits, at, u);
  bonds[5] = stretch<5, B>(c, row, bits, at, u);
}

template <Bonds B, bool Sample>
inline void forces_of_vector(const Constants& c, const Row& row, long at, const Stretch* bonds, Vector& left,
                             Events& events) {
  const long pitch = c.pitch;
  const Bits& bits = row.bits[at / lanes];
  const Vector w = load_vector(row.self + 3 * pitch + at, pitch);
  Accumulated sum{};
  V fx, fy, fz;
  Vector first;
  bond<0, B, Sample>(c, row, bits, at, w, bonds[0], sum, first.x, first.y, first.z);
  bond<1, B, Sample>(c, row, bits, at, w, bonds[1], sum, fx, fy, fz);
  bond<2, B, Sample>(c, row, bits, at, w, bonds[2], sum, fx, fy, fz);
  bond<3, B, Sample>(c, row, bits, at, w, bonds[3], sum, fx, fy, fz);
  bond<4, B, Sample>(c, row, bits, at, w, bonds[4], sum, fx, fy, fz);
  bond<5, B, Sample>(c, row, bits, at, w, bonds[5], sum, fx, fy, fz);
  if (any(sum.trip)) {
    Spilled s;
    store(s.first[0], first.x);
    store(s.first[1], first.y);
    store(s.first[2], first.z);
    store(s.sum[0], sum.fx);
    store(s.sum[1], sum.fy);
    store(s.sum[2], sum.fz);
    store(s.energy_normal, sum.energy_normal);
    store(s.energy_shear, sum.energy_shear);
    break_bonds(c, row, at, s, events);
    first = {load(s.first[0]), load(s.first[1]), load(s.first[2])};
    sum.fx = load(s.sum[0]);
    sum.fy = load(s.sum[1]);
    sum.fz = load(s.sum[2]);
    sum.energy_normal = load(s.energy_normal);
    sum.energy_shear = load(s.energy_shear);
  }
  store(row.sum + at, sum.fx - shift_in(left.x, first.x));
  store(row.sum + pitch + at, sum.fy - shift_in(left.y, first.y));
  store(row.sum + 2 * pitch + at, sum.fz - shift_in(left.z, first.z));
  left = first;
  if constexpr (B == Bonds::some_broken) store(row.friction + at, load(row.friction + at) + sum.friction);
  if constexpr (Sample) {
    store(row.sample + at, sum.energy_normal);
    store(row.sample + pitch + at, sum.energy_shear);
  }
}

template <bool Sample>
void forces_of_row(const Constants& c, const Row& row, Events& events) {
  // All roots and quotients of a few vectors first: they take long, and none waits for another. Done bond by bond, the
  // processor would wait for most of them.
  constexpr long together = 4;
  Stretch bonds[together * directions];
  Vector left{};  // the force in direction 0 of the vector before
  for (long from = 0; from < c.pitch; from += together * lanes) {
    const long to = from + together * lanes < c.pitch ? from + together * lanes : c.pitch;
    Stretch* next = bonds;
    for (long at = from; at < to; at += lanes, next += directions) {
      if (bonds_of(row.bits[at / lanes]) == Bonds::whole) {
        stretches_of_vector<Bonds::whole>(c, row, at, next);
      } else {
        stretches_of_vector<Bonds::some_missing>(c, row, at, next);
      }
    }
    next = bonds;
    for (long at = from; at < to; at += lanes, next += directions) {
      switch (bonds_of(row.bits[at / lanes])) {
        case Bonds::whole:
          forces_of_vector<Bonds::whole, Sample>(c, row, at, next, left, events);
          break;
        case Bonds::some_missing:
          forces_of_vector<Bonds::some_missing, Sample>(c, row, at, next, left, events);
          break;
        case Bonds::some_broken:
          forces_of_vector<Bonds::some_broken, Sample>(c, row, at, next, left, events);
          break;
      }
    }
  }
}

template <bool Sample>
void advance_row(const Constants& c, const Row& row) {
  const long pitch = c.pitch;
  for (long at = 0; at < pitch; at += lanes) {
    V f[3], w[3], wn[3];
    for (int i = 0; i < 3; ++i) {
      V sum = load(row.sum + i * pitch + at);
      for (int k = 1; k < directions; ++k) sum = sum - load(row.source[k] + (3 * (k - 1) + i) * c.force_pitch + at);
      f[i] = sum;
      w[i] = load(row.self + (3 + i) * pitch + at);
    }
    if (row.push) {
      for (int i = 0; i < 3; ++i) f[i] = f[i] + load(row.push + i * pitch + at);
    }
    V held = V{};
    if (row.plane_stiffness) {
      V& fa = f[c.axis];
      const V u = load(row.self + c.axis * pitch + at);
      const V spring = load(row.plane_stiffness + at) * (load(row.plane_position + at) - u);
      held = load(row.held + at);
      store(row.plane_force + at, select(held > 0.0, fa, spring));
      fa = fa + spring;
    }
    for (int i = 0; i < 3; ++i) wn[i] = load(c.keep) * w[i] + load(c.push) * f[i];
    V free[3] = {w[0], w[1], w[2]};
    if (row.plane_stiffness) {  // prescribed motion is made, and accounted for, by the plane
      free[c.axis] = select(held > 0.0, V{}, w[c.axis]);
      wn[c.axis] = select(held > 0.0, V{}, wn[c.axis]);
    }
    V viscous = V{}, kinetic = V{}, half = V{};
    for (int i = 0; i < 3; ++i) {
      const V both = free[i] + wn[i];
      viscous = viscous + both * both;
      if constexpr (Sample) {
        kinetic = kinetic + free[i] * wn[i];
        half = half + both * free[i];
      }
    }
    store(row.viscous + at, load(row.viscous + at) + viscous);
    if constexpr (Sample) {
      store(row.sample + 2 * pitch + at, kinetic);
      store(row.sample + 3 * pitch + at, half);
    }
    for (int i = 0; i < 3; ++i) {
      store(row.self + i * pitch + at, load(row.self + i * pitch + at) + wn[i]);
      store(row.self + (3 + i) * pitch + at, wn[i]);
    }
  }
}

void forces(const Constants& c, const Row& row, bool sample, Events& events) {
  sample ? forces_of_row<true>(c, row, events) : forces_of_row<false>(c, row, events);
}
void advance(const Constants& c, const Row& row, bool sample) {
  sample ? advance_row<true>(c, row) : advance_row<false>(c, row);
}

}  // namespace

const Kernel& DEM_KERNEL() {
  static constexpr Kernel kernel{DEM_LANES, forces, advance};
  return kernel;
}

}  // namespace dem::lattice
