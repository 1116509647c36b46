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

constexpr int block = 48;  // columns eliminated together

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
inline __attribute__((always_inline)) void store(double* p, const V4& v) { std::memcpy(p, &v, sizeof v); }
inline __attribute__((always_inline)) double sum(const V4& v) { return (v[0] + v[2]) + (v[1] + v[3]); }

// Columns [k, k + w) of the front, rows from their diagonal down: left-looking inside the block.
DEM_CLONES int factor_block(double* a, std::size_t ld, int k, int w, int nf, const double* diagonal, double floor_of,
                            double raised_to) {
  int negative = 0;
  for (int j = k; j < k + w; ++j) {
    double* column = a + static_cast<std::size_t>(j) * ld;
    for (int p = k; p < j; ++p) {
      const double* previous = a + static_cast<std::size_t>(p) * ld;
      const double factor = previous[j];
#pragma GCC ivdep
      for (int i = j; i < nf; ++i) column[i] -= previous[i] * factor;
    }
    double pivot = column[j];
    if (!(pivot > floor_of * diagonal[j])) {
      if (pivot < -floor_of * diagonal[j]) ++negative;
      pivot = raised_to * diagonal[j];
    }
    const double root = std::sqrt(pivot);
    const double inverse = 1.0 / root;
    column[j] = root;
#pragma GCC ivdep
    for (int i = j + 1; i < nf; ++i) column[i] *= inverse;
  }
  return negative;
}

// a[first.., first..] -= P P^T (lower part), P packed in stripes of 8 rows, stripe by stripe, column by column.
DEM_CLONES void update_trailing(double* a, std::size_t ld, int first, int nf, int w, const double* packed) {
  const int m = nf - first;
  for (int j0 = 0; j0 < m; j0 += 4) {
    const double* b = packed + static_cast<std::size_t>(j0 / 8) * 8 * static_cast<std::size_t>(w) + j0 % 8;
    const int columns = std::min(4, m - j0);
    for (int i0 = j0 / 8 * 8; i0 < m; i0 += 8) {
      const double* p = packed + static_cast<std::size_t>(i0 / 8) * 8 * static_cast<std::size_t>(w);
      V4 c[4][2] = {};
      for (int k = 0; k < w; ++k) {
        const V4 x0 = load(p + 8 * k), x1 = load(p + 8 * k + 4);
        for (int q = 0; q < 4; ++q) {
          const double y = b[8 * k + q];
          c[q][0] += x0 * y;
          c[q][1] += x1 * y;
        }
      }
      double* out = a + static_cast<std::size_t>(first + j0) * ld + static_cast<std::size_t>(first + i0);
      if (i0 >= j0 + 4 && i0 + 8 <= m && columns == 4) {
        for (int q = 0; q < 4; ++q, out += ld) {
          store(out, load(out) - c[q][0]);
          store(out + 4, load(out + 4) - c[q][1]);
        }
      } else {
        double tile[4][8];
        for (int q = 0; q < 4; ++q) store(tile[q], c[q][0]), store(tile[q] + 4, c[q][1]);
        for (int q = 0; q < columns; ++q) {
          for (int i = std::max(i0, j0 + q); i < std::min(i0 + 8, m); ++i) {
            out[static_cast<std::size_t>(q) * ld + static_cast<std::size_t>(i - i0)] -= tile[q][i - i0];
          }
        }
      }
    }
  }
}

template <class Stored>
inline __attribute__((always_inline)) void forward(const Stored* panel, std::size_t ld, int ns, int nf,
                                                   const double* inverse, double* t) {
  int j = 0;
  for (; j + 4 <= ns; j += 4) {
    const Stored* c0 = panel + static_cast<std::size_t>(j) * ld;
    const Stored* c1 = c0 + ld;
    const Stored* c2 = c1 + ld;
    const Stored* c3 = c2 + ld;
    const double y0 = t[j] * inverse[j];
    const double y1 = (t[j + 1] - c0[j + 1] * y0) * inverse[j + 1];
    const double y2 = (t[j + 2] - c0[j + 2] * y0 - c1[j + 2] * y1) * inverse[j + 2];
    const double y3 = (t[j + 3] - c0[j + 3] * y0 - c1[j + 3] * y1 - c2[j + 3] * y2) * inverse[j + 3];
    t[j] = y0;
    t[j + 1] = y1;
    t[j + 2] = y2;
    t[j + 3] = y3;
    int i = j + 4;
    for (; i + 4 <= nf; i += 4) {
      store(t + i, load(t + i) - ((load(c0 + i) * y0 + load(c1 + i) * y1) + (load(c2 + i) * y2 + load(c3 + i) * y3)));
    }
    for (; i < nf; ++i) t[i] -= (c0[i] * y0 + c1[i] * y1) + (c2[i] * y2 + c3[i] * y3);
  }
  for (; j < ns; ++j) {
    const Stored* c = panel + static_cast<std::size_t>(j) * ld;
    const double y = t[j] * inverse[j];
    t[j] = y;
    for (int i = j + 1; i < nf; ++i) t[i] -= c[i] * y;
  }
}

template <class Stored>
inline __attribute__((always_inline)) void backward(const Stored* panel, std::size_t ld, int ns, int nf,
                                                    const double* inverse, double* t) {
  int j = ns;
  for (; j % 4 != 0; --j) {
    const Stored* c = panel + static_cast<std::size_t>(j - 1) * ld;
    double s = 0;
    for (int i = j; i < nf; ++i) s += c[i] * t[i];
    t[j - 1] = (t[j - 1] - s) * inverse[j - 1];
  }
  for (j -= 4; j >= 0; j -= 4) {
    const Stored* c0 = panel + static_cast<std::size_t>(j) * ld;
    const Stored* c1 = c0 + ld;
    const Stored* c2 = c1 + ld;
    const Stored* c3 = c2 + ld;
    V4 s0{}, s1{}, s2{}, s3{};
    int i = j + 4;
    for (; i + 4 <= nf; i += 4) {
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

DEM_CLONES void forward_float(const float* p, std::size_t ld, int ns, int nf, const double* inverse, double* t) {
  forward(p, ld, ns, nf, inverse, t);
}
DEM_CLONES void forward_double(const double* p, std::size_t ld, int ns, int nf, const double* inverse, double* t) {
  forward(p, ld, ns, nf, inverse, t);
}
DEM_CLONES void backward_float(const float* p, std::size_t ld, int ns, int nf, const double* inverse, double* t) {
  backward(p, ld, ns, nf, inverse, t);
}
DEM_CLONES void backward_double(const double* p, std::size_t ld, int ns, int nf, const double* inverse, double* t) {
  backward(p, ld, ns, nf, inverse, t);
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

int partial_cholesky(double* a, std::size_t ld, int ns, int nf, std::span<const double> diagonal, PivotRule rule) {
  int negative = 0;
  std::vector<double> packed;
  for (int k = 0; k < ns; k += block) {
    const int w = std::min(block, ns - k);
    negative += factor_block(a, ld, k, w, nf, diagonal.data(), rule.floor, rule.raised);
    const int first = k + w;
    const int m = nf - first;
    if (m <= 0) continue;
    const int stripes = (m + 7) / 8;
    packed.assign(static_cast<std::size_t>(stripes) * 8 * static_cast<std::size_t>(w), 0.0);
    for (int s = 0; s < stripes; ++s) {
      double* out = packed.data() + static_cast<std::size_t>(s) * 8 * static_cast<std::size_t>(w);
      const int rows = std::min(8, m - 8 * s);
      for (int c = 0; c < w; ++c) {
        const double* in = a + static_cast<std::size_t>(k + c) * ld + static_cast<std::size_t>(first + 8 * s);
        std::copy(in, in + rows, out + 8 * c);
      }
    }
    update_trailing(a, ld, first, nf, w, packed.data());
  }
  return negative;
}

void panel_forward(const float* p, std::size_t ld, int ns, int nf, const double* inverse, double* t) {
  forward_float(p, ld, ns, nf, inverse, t);
}
void panel_forward(const double* p, std::size_t ld, int ns, int nf, const double* inverse, double* t) {
  forward_double(p, ld, ns, nf, inverse, t);
}
void panel_backward(const float* p, std::size_t ld, int ns, int nf, const double* inverse, double* t) {
  backward_float(p, ld, ns, nf, inverse, t);
}
void panel_backward(const double* p, std::size_t ld, int ns, int nf, const double* inverse, double* t) {
  backward_double(p, ld, ns, nf, inverse, t);
}
double dot(const double* a, const double* b, std::size_t n) { return dot_of(a, b, n); }

}  // namespace dem::sheet
