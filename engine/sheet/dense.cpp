#include "engine/sheet/dense.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

// One clone per vector width; element-wise operations and a fixed order of sums make them agree to the last bit.
#define DEM_CLONES __attribute__((target_clones("avx2", "default")))

namespace dem::sheet {
namespace {

typedef double V4 __attribute__((vector_size(32)));
typedef float F4 __attribute__((vector_size(16)));
typedef float F8 __attribute__((vector_size(32)));

constexpr int block = 48;        // columns eliminated together
constexpr int stripe = 16;       // rows packed together
constexpr int prefetched = 256;  // floats that a sweep asks for ahead

inline __attribute__((always_inline)) V4 load(const double* p) {
  V4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline __attribute__((always_inline)) V4 load(const float* p) {
  F4 v;
  std::memcpy(&v, p, sizeof v);
  return __builtin_convertvector(v, V4);
}
inline __attribute__((always_inline)) F8 load8(const float* p) {
  F8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline __attribute__((always_inline)) void store(double* p, const V4& v) { std::memcpy(p, &v, sizeof v); }
inline __attribute__((always_inline)) void store(float* p, const F8& v) { std::memcpy(p, &v, sizeof v); }
inline __attribute__((always_inline)) double sum(const V4& v) { return (v[0] + v[2]) + (v[1] + v[3]); }

// The columns of a front: first those of the panel, then those that are left for the parent.
struct Front {
  Panel<float> panel;
  Packed<float> rest;
  [[nodiscard]] float* column(int j) const {
    return j < panel.ns ? panel.column(j) : rest.column(j - panel.ns) - panel.ns;
  }
};

// The w x w triangle at column k, into `d` (column by column, leading dimension `block`) and back.
DEM_CLONES int factor_triangle(const Front& front, int k, int w, const float* diagonal, float floor_of, float raised_to,
                               float* d) {
  for (int j = 0; j < w; ++j) {
    const float* in = front.column(k + j) + k;
    for (int i = j; i < w; ++i) d[j * block + i] = in[i];
  }
  int negative = 0;
  for (int p = 0; p < w; ++p) {
    float* previous = d + p * block;
    float pivot = previous[p];
    if (!(pivot > floor_of * diagonal[k + p])) {
      if (pivot < -floor_of * diagonal[k + p]) ++negative;
      pivot = raised_to * diagonal[k + p];
    }
    const float root = std::sqrt(pivot);
    const float inverse = 1.0F / root;
    previous[p] = root;
    for (int i = p + 1; i < w; ++i) previous[i] *= inverse;
    for (int j = p + 1; j < w; ++j) {
      float* column = d + j * block;
      const float factor = previous[j];
#pragma GCC ivdep
      for (int i = j; i < w; ++i) column[i] -= previous[i] * factor;
    }
  }
  for (int j = 0; j < w; ++j) {
    float* out = front.column(k + j) + k;
    for (int i = j; i < w; ++i) out[i] = d[j * block + i];
  }
  return negative;
}

// x (w columns of a stripe of rows, packed) = x L^-T with the triangle L in `d`.
DEM_CLONES void solve_stripe(float* x, int w, const float* d) {
  int j = 0;
  for (; j + 4 <= w; j += 4) {
    F8 c[4][2];
    for (int q = 0; q < 4; ++q) c[q][0] = load8(x + stripe * (j + q)), c[q][1] = load8(x + stripe * (j + q) + 8);
    for (int p = 0; p < j; ++p) {
      const F8 x0 = load8(x + stripe * p), x1 = load8(x + stripe * p + 8);
      const float* l = d + p * block + j;
      for (int q = 0; q < 4; ++q) {
        c[q][0] -= x0 * l[q];
        c[q][1] -= x1 * l[q];
      }
    }
    for (int q = 0; q < 4; ++q) {
      for (int p = 0; p < q; ++p) {
        const float l = d[(j + p) * block + j + q];
        c[q][0] -= c[p][0] * l;
        c[q][1] -= c[p][1] * l;
      }
      const float inverse = 1.0F / d[(j + q) * block + j + q];
      c[q][0] *= inverse;
      c[q][1] *= inverse;
    }
    for (int q = 0; q < 4; ++q) store(x + stripe * (j + q), c[q][0]), store(x + stripe * (j + q) + 8, c[q][1]);
  }
  for (; j < w; ++j) {
    F8 c0 = load8(x + stripe * j), c1 = load8(x + stripe * j + 8);
    for (int p = 0; p < j; ++p) {
      const float l = d[p * block + j];
      c0 -= load8(x + stripe * p) * l;
      c1 -= load8(x + stripe * p + 8) * l;
    }
    const float inverse = 1.0F / d[j * block + j];
    store(x + stripe * j, c0 * inverse);
    store(x + stripe * j + 8, c1 * inverse);
  }
}

// Columns and rows from `first` on -= P P^T (lower part), P packed in stripes of rows, stripe by stripe, column by
// column.
DEM_CLONES void update_trailing(const Front& front, int first, int w, const float* packed) {
  const int m = front.panel.nf - first;
  for (int j0 = 0; j0 < m; j0 += 4) {
    const float* b =
        packed + static_cast<std::size_t>(j0 / stripe) * static_cast<std::size_t>(stripe * w) + j0 % stripe;
    const int columns = std::min(4, m - j0);
    float* out[4];
    for (int q = 0; q < columns; ++q) out[q] = front.column(first + j0 + q) + first;
    for (int i0 = j0 / stripe * stripe; i0 < m; i0 += stripe) {
      const float* p = packed + static_cast<std::size_t>(i0 / stripe) * static_cast<std::size_t>(stripe * w);
      F8 c[4][2] = {};
      for (int k = 0; k < w; ++k) {
        const F8 x0 = load8(p + stripe * k), x1 = load8(p + stripe * k + 8);
        for (int q = 0; q < 4; ++q) {
          const float y = b[stripe * k + q];
          c[q][0] += x0 * y;
          c[q][1] += x1 * y;
        }
      }
      if (i0 >= j0 + 4 && i0 + stripe <= m && columns == 4) {
        for (int q = 0; q < 4; ++q) {
          store(out[q] + i0, load8(out[q] + i0) - c[q][0]);
          store(out[q] + i0 + 8, load8(out[q] + i0 + 8) - c[q][1]);
        }
      } else {
        float tile[4][stripe];
        for (int q = 0; q < 4; ++q) store(tile[q], c[q][0]), store(tile[q] + 8, c[q][1]);
        for (int q = 0; q < columns; ++q) {
          for (int i = std::max(i0, j0 + q); i < std::min(i0 + stripe, m); ++i) out[q][i] -= tile[q][i - i0];
        }
      }
    }
  }
}

DEM_CLONES void forward(const Panel<const float>& panel, const double* inverse, double* t) {
  const int ns = panel.ns, nf = panel.nf;
  int j = 0;
  for (; j + 4 <= ns; j += 4) {
    const float* c0 = panel.column(j);
    const float* c1 = panel.column(j + 1);
    const float* c2 = panel.column(j + 2);
    const float* c3 = panel.column(j + 3);
    const double y0 = t[j] * inverse[j];
    const double y1 = (t[j + 1] - c0[j + 1] * y0) * inverse[j + 1];
    const double y2 = (t[j + 2] - c0[j + 2] * y0 - c1[j + 2] * y1) * inverse[j + 2];
    const double y3 = (t[j + 3] - c0[j + 3] * y0 - c1[j + 3] * y1 - c2[j + 3] * y2) * inverse[j + 3];
    t[j] = y0;
    t[j + 1] = y1;
    t[j + 2] = y2;
    t[j + 3] = y3;
    // What is read next lies before column j + 3.
    const float* ahead = c3 + j - prefetched;
    int i = j + 4;
    for (; i + 4 <= nf; i += 4, ahead -= 16) {
      __builtin_prefetch(ahead);
      store(t + i, load(t + i) - ((load(c0 + i) * y0 + load(c1 + i) * y1) + (load(c2 + i) * y2 + load(c3 + i) * y3)));
    }
    for (; i < nf; ++i) t[i] -= (c0[i] * y0 + c1[i] * y1) + (c2[i] * y2 + c3[i] * y3);
  }
  for (; j < ns; ++j) {
    const float* c = panel.column(j);
    const double y = t[j] * inverse[j];
    t[j] = y;
    for (int i = j + 1; i < nf; ++i) t[i] -= c[i] * y;
  }
}

DEM_CLONES void backward(const Panel<const float>& panel, const double* inverse, double* t) {
  const int ns = panel.ns, nf = panel.nf;
  int j = ns;
  for (; j % 4 != 0; --j) {
    const float* c = panel.column(j - 1);
    double s = 0;
    for (int i = j; i < nf; ++i) s += c[i] * t[i];
    t[j - 1] = (t[j - 1] - s) * inverse[j - 1];
  }
  for (j -= 4; j >= 0; j -= 4) {
    const float* c0 = panel.column(j);
    const float* c1 = panel.column(j + 1);
    const float* c2 = panel.column(j + 2);
    const float* c3 = panel.column(j + 3);
    // What is read next lies behind column j; columns are too short for the processor to see that by itself.
    const float* ahead = c0 + nf + prefetched;
    V4 s0{}, s1{}, s2{}, s3{};
    int i = j + 4;
    for (; i + 4 <= nf; i += 4, ahead += 16) {
      __builtin_prefetch(ahead);
      const V4 x = load(t + i);
      s0 += load(c0 + i) * x;
      s1 += load(c1 + i) * x;
      s2 += load(c2 + i) * x;
      s3 += load(c3 + i) * x;
    }
    double r0 = sum(s0), r1 = sum(s1), r2 = sum(s2), r3 = sum(s3);
    for (; i < nf; ++i) {
      r0 += c0[i] * t[i];
      r1 += c1[i] * t[i];
      r2 += c2[i] * t[i];
      r3 += c3[i] * t[i];
    }
    const double x3 = (t[j + 3] - r3) * inverse[j + 3];
    const double x2 = (t[j + 2] - r2 - c2[j + 3] * x3) * inverse[j + 2];
    const double x1 = (t[j + 1] - r1 - c1[j + 2] * x2 - c1[j + 3] * x3) * inverse[j + 1];
    const double x0 = (t[j] - r0 - c0[j + 1] * x1 - c0[j + 2] * x2 - c0[j + 3] * x3) * inverse[j];
    t[j] = x0;
    t[j + 1] = x1;
    t[j + 2] = x2;
    t[j + 3] = x3;
  }
}

DEM_CLONES double dot_of(const double* a, const double* b, std::size_t n) {
  V4 s0{}, s1{};
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    s0 += load(a + i) * load(b + i);
    s1 += load(a + i + 4) * load(b + i + 4);
  }
  double r = sum(s0) + sum(s1);
  for (; i < n; ++i) r += a[i] * b[i];
  return r;
}

}  // namespace

int partial_cholesky(const Panel<float>& panel, const Packed<float>& rest, std::span<const float> diagonal,
                     PivotRule rule) {
  const Front front{panel, rest};
  const int ns = panel.ns, nf = panel.nf;
  int negative = 0;
  float triangle[block * block];
  std::vector<float> packed;
  for (int k = 0; k < ns; k += block) {
    const int w = std::min(block, ns - k);
    negative += factor_triangle(front, k, w, diagonal.data(), static_cast<float>(rule.floor),
                                static_cast<float>(rule.raised), triangle);
    const int first = k + w;
    const int m = nf - first;
    if (m <= 0) continue;
    const int stripes = (m + stripe - 1) / stripe;
    const auto size = static_cast<std::size_t>(stripe * w);
    packed.resize(static_cast<std::size_t>(stripes) * size);
    std::fill(packed.end() - static_cast<std::ptrdiff_t>(size), packed.end(), 0.0F);
    for (int c = 0; c < w; ++c) {
      const float* in = front.column(k + c) + first;
      for (int s = 0; s < stripes; ++s) {
        std::copy(in + stripe * s, in + std::min(m, stripe * (s + 1)),
                  packed.data() + static_cast<std::size_t>(s) * size + stripe * c);
      }
    }
    for (int s = 0; s < stripes; ++s) solve_stripe(packed.data() + static_cast<std::size_t>(s) * size, w, triangle);
    for (int c = 0; c < w; ++c) {
      float* out = front.column(k + c) + first;
      for (int s = 0; s < stripes; ++s) {
        const float* in = packed.data() + static_cast<std::size_t>(s) * size + stripe * c;
        std::copy(in, in + std::min(stripe, m - stripe * s), out + stripe * s);
      }
    }
    update_trailing(front, first, w, packed.data());
  }
  return negative;
}

void panel_forward(const Panel<const float>& panel, const double* inverse, double* t) { forward(panel, inverse, t); }
void panel_backward(const Panel<const float>& panel, const double* inverse, double* t) { backward(panel, inverse, t); }
double dot(const double* a, const double* b, std::size_t n) { return dot_of(a, b, n); }

}  // namespace dem::sheet
