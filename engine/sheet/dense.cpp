#include "engine/sheet/dense.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "engine/core/instruction_set.h"

// Bodies of kernels, each built for several sets of instructions (Built): element-wise operations and a fixed order of sums
// make them agree to the last bit.
#define DEM_BODY inline __attribute__((always_inline))

namespace dem::sheet {
namespace {

typedef double V4 __attribute__((vector_size(32)));
typedef float F4 __attribute__((vector_size(16)));
typedef float F8 __attribute__((vector_size(32)));
typedef float F16 __attribute__((vector_size(64)));
typedef std::int32_t I8 __attribute__((vector_size(32)));

constexpr int block = 48;         // columns eliminated together
constexpr int stripe = 16;        // rows packed together
constexpr int shared_rows = 192;  // left in a front that several threads work on
constexpr int ahead = 64;         // lines that a sweep asks for ahead
constexpr float steps = 32700;    // of sixteen bits, a little less than they hold: rounding is carried on

DEM_BODY V4 load(const double* p) {
  V4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
DEM_BODY V4 load(const float* p) {
  F4 v;
  std::memcpy(&v, p, sizeof v);
  return __builtin_convertvector(v, V4);
}
DEM_BODY F8 load8(const float* p) {
  F8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
// Eight rows of two columns in sixteen bits, the first in the lower half of a word; both as whole numbers times 2^16.
struct Two {
  F8 first, second;
};
DEM_BODY Two load_two(const unsigned char* p) {
  I8 v;
  std::memcpy(&v, p, sizeof v);
  return {__builtin_convertvector(v << 16, F8), __builtin_convertvector(v & -65536, F8)};
}
DEM_BODY void store(float* p, const F8& v) { std::memcpy(p, &v, sizeof v); }
DEM_BODY double sum(const V4& v) { return (v[0] + v[2]) + (v[1] + v[3]); }
// {sum of a[0], sum of a[1], ...}
DEM_BODY F8 sums(const F8 (&a)[8]) {
  F8 pairs[4], fours[2];
  for (int q = 0; q < 4; ++q) {
    const F8 &x = a[2 * q], &y = a[2 * q + 1];
    pairs[q] =
        __builtin_shuffle(x, y, I8{0, 8, 2, 10, 4, 12, 6, 14}) + __builtin_shuffle(x, y, I8{1, 9, 3, 11, 5, 13, 7, 15});
  }
  for (int q = 0; q < 2; ++q) {
    const F8 &x = pairs[2 * q], &y = pairs[2 * q + 1];
    fours[q] =
        __builtin_shuffle(x, y, I8{0, 1, 8, 9, 4, 5, 12, 13}) + __builtin_shuffle(x, y, I8{2, 3, 10, 11, 6, 7, 14, 15});
  }
  return __builtin_shuffle(fours[0], fours[1], I8{0, 1, 2, 3, 8, 9, 10, 11}) +
         __builtin_shuffle(fours[0], fours[1], I8{4, 5, 6, 7, 12, 13, 14, 15});
}

// The first lines of a block of a thin panel hold floats: eight scales of the sixteen bits, then the inverse of the
// triangle, column q from the diagonal down from place 8 + q (17 - q) / 2 on.
constexpr int head_lines = 3;
constexpr int head_floats = 48;
constexpr int column_of_triangle(int q) { return 8 + q * (17 - q) / 2 - q; }  // where its row 0 would be
DEM_BODY F8 triangle_column(const unsigned char* head, int q) {
  constexpr I8 rows{0, 1, 2, 3, 4, 5, 6, 7};
  F8 v;  // what lies before the diagonal belongs to other columns (or to the scales)
  std::memcpy(&v, head + 4 * column_of_triangle(q), sizeof v);
  return rows < q ? F8{} : v;
}
DEM_BODY F8 scales_of(const unsigned char* head) {
  F8 v;
  std::memcpy(&v, head, sizeof v);
  return v;
}

// visit(from, to) over [0, n) in parts of `grain`, each a task; at once where there is one part.
template <class Visit>
void in_parts(int n, int grain, const Visit& visit) {
  if (n <= grain) return visit(0, n);
#pragma omp taskgroup
  for (int from = 0; from < n; from += grain) {
#pragma omp task default(shared) firstprivate(from)
    visit(from, std::min(n, from + grain));
  }
}

// The columns of a front: first those of the panel, then those that are left for the parent.
struct Front {
  Panel<float> panel;
  Packed<float> rest;
  [[nodiscard]] float* column(int j) const {
    return j < panel.ns ? panel.column(j) : rest.column(j - panel.ns) - panel.ns;
  }
};

// The w x w triangle at column k, into `d` (column by column, leading dimension `block`) and back.
DEM_BODY int factor_triangle(const Front& front, int k, int w, const float* diagonal, float floor_of, float raised_to,
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
DEM_BODY void solve_stripe(float* x, int w, const float* d) {
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

// Columns first + [from, to) and the rows below their diagonal -= P P^T, P packed in stripes of rows, stripe by stripe,
// `at_once` columns at a time. `from` is a multiple of that.
template <class V, int at_once>
DEM_BODY void subtract_products(const Front& front, int first, int w, const float* packed, int from, int to) {
  constexpr int lanes = static_cast<int>(sizeof(V) / sizeof(float)), vectors = stripe / lanes;
  const int m = front.panel.nf - first;
  for (int j0 = from; j0 < to; j0 += at_once) {
    const float* b =
        packed + static_cast<std::size_t>(j0 / stripe) * static_cast<std::size_t>(stripe * w) + j0 % stripe;
    const int columns = std::min(at_once, m - j0);
    float* out[at_once];
    for (int q = 0; q < columns; ++q) out[q] = front.column(first + j0 + q) + first;
    for (int i0 = j0 / stripe * stripe; i0 < m; i0 += stripe) {
      const float* p = packed + static_cast<std::size_t>(i0 / stripe) * static_cast<std::size_t>(stripe * w);
      V c[at_once][vectors] = {};
      for (int k = 0; k < w; ++k) {
        V x[vectors];
        std::memcpy(x, p + stripe * k, sizeof x);
        for (int q = 0; q < at_once; ++q) {
          const float y = b[stripe * k + q];
          for (int v = 0; v < vectors; ++v) c[q][v] += x[v] * y;
        }
      }
      if (i0 >= j0 + at_once && i0 + stripe <= m && columns == at_once) {
        for (int q = 0; q < at_once; ++q) {
          V old[vectors];
          std::memcpy(old, out[q] + i0, sizeof old);
          for (int v = 0; v < vectors; ++v) old[v] -= c[q][v];
          std::memcpy(out[q] + i0, old, sizeof old);
        }
      } else {
        float tile[at_once][stripe];
        std::memcpy(tile, c, sizeof tile);
        for (int q = 0; q < columns; ++q) {
          for (int i = std::max(i0, j0 + q); i < std::min(i0 + stripe, m); ++i) out[q][i] -= tile[q][i - i0];
        }
      }
    }
  }
}

// `columns` holds eight columns of 8 * squares rows each. Vectors hold {column q row 2 k, column q row 2 k + 1, ...} of
// four columns: the x and y of a particle are rounded apart.
DEM_BODY void quantise(const float* columns, int squares, float* scale, ThinPanel::Line* out) {
  const int rows = 8 * squares;
  for (int half = 0; half < 2; ++half) {
    const float* c[4];
    F8 inverse;
    for (int q = 0; q < 4; ++q) {
      c[q] = columns + (4 * half + q) * rows;
      F8 most{};
      for (int i = 0; i < rows; i += 8) {
        const F8 v = load8(c[q] + i), size = v < 0 ? -v : v;
        most = size > most ? size : most;
      }
      float top = 0;
      for (int k = 0; k < 8; ++k) top = most[k] > top ? most[k] : top;
      scale[4 * half + q] = top / (65536 * steps);
      inverse[2 * q] = inverse[2 * q + 1] = top > 0 ? steps / top : 0.0F;
    }
    constexpr float magic = 12582912.0F;  // 1.5 2^23: adding it rounds to whole numbers
    F8 carry{};
    for (int i = 0; i < rows; i += 2) {
      const F8 in{c[0][i], c[0][i + 1], c[1][i], c[1][i + 1], c[2][i], c[2][i + 1], c[3][i], c[3][i + 1]};
      const F8 v = in * inverse + carry;
      const F8 whole = (v + magic) - magic;
      carry = v - whole;
      const I8 bits = __builtin_convertvector(whole, I8);
      for (int q = 0; q < 2; ++q) {
        unsigned char* square = out[2 * (i / 8) + half].bytes + 32 * q + 4 * (i % 8);
        const auto word = [&](int at) {
          return (static_cast<std::uint32_t>(bits[at]) & 0xffffU) | static_cast<std::uint32_t>(bits[at + 2]) << 16;
        };
        const std::uint32_t two[2] = {word(4 * q), word(4 * q + 1)};
        std::memcpy(square, two, sizeof two);
      }
    }
  }
}

DEM_BODY void forward(const ThinPanel& panel, float* t) {
  const ThinPanel::Line* at = panel.data + ThinPanel::lines(panel.ns, panel.nf);
  for (int b = 0, j = 0; b < panel.blocks(); ++b, j += 8) {
    const int squares = panel.squares(b);
    at -= 2 * squares + head_lines;
    const unsigned char* h = at->bytes;
    F8 y{};
    for (int q = 0; q < 8; ++q) y += triangle_column(h, q) * t[j + q];
    store(t + j, y);
    const F8 z = y * scales_of(h);
    float* out = t + j + 8;
    const unsigned char* in = at[head_lines].bytes;
    // What is read next lies before this block, which the processor does not see by itself.
    const std::ptrdiff_t back = 128 * squares + 64 * (ahead + head_lines);
    for (int k = 0; k < head_lines; ++k) __builtin_prefetch(in - 64 * (ahead + 2 * head_lines - k));
    for (int k = 0; k < squares; ++k, out += 8, in += 128) {
      __builtin_prefetch(in - back);
      __builtin_prefetch(in - back + 64);
      F8 v[4];
      for (int q = 0; q < 4; ++q) {
        const Two c = load_two(in + 32 * q);
        v[q] = c.first * z[2 * q] + c.second * z[2 * q + 1];
      }
      store(out, load8(out) - ((v[0] + v[1]) + (v[2] + v[3])));
    }
  }
}

DEM_BODY void backward(const ThinPanel& panel, float* t) {
  const ThinPanel::Line* at = panel.data;
  for (int b = panel.blocks() - 1, j = 8 * b; b >= 0; --b, j -= 8) {
    const int squares = panel.squares(b);
    const unsigned char* h = at->bytes;
    const unsigned char* in = at[head_lines].bytes;
    const float* x = t + j + 8;
    F8 s[8]{};
    for (int k = 0; k < squares; ++k, x += 8, in += 128) {
      __builtin_prefetch(in + 64 * ahead);
      __builtin_prefetch(in + 64 * ahead + 64);
      const F8 v = load8(x);
      for (int q = 0; q < 4; ++q) {
        const Two c = load_two(in + 32 * q);
        s[2 * q] += c.first * v;
        s[2 * q + 1] += c.second * v;
      }
    }
    at += 2 * squares + head_lines;
    const F8 v = load8(t + j) - sums(s) * scales_of(h);
    for (int q = 0; q < 8; ++q) s[q] = triangle_column(h, q) * v;
    store(t + j, sums(s));
  }
}

template <class Float>
DEM_BODY double products(const Float* a, const Float* b, std::size_t n) {
  V4 s0{}, s1{};
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    s0 += load(a + i) * load(b + i);
    s1 += load(a + i + 4) * load(b + i + 4);
  }
  double r = sum(s0) + sum(s1);
  for (; i < n; ++i) r += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return r;
}

constexpr int usual_at_once = 4;
constexpr int most_at_once = 8;  // AVX-512 has twice the registers

struct Kernels {
  decltype(&factor_triangle) triangle;
  decltype(&solve_stripe) stripe;
  decltype(&subtract_products<F8, usual_at_once>) update;
  decltype(&quantise) sixteen_bits;
  decltype(&forward) sweep_forward;
  decltype(&backward) sweep_backward;
  decltype(&products<double>) dot;
  decltype(&products<float>) dot_float;
};
constexpr Kernels with_sse2{
    Built<factor_triangle>::sse2,  Built<solve_stripe>::sse2,   Built<subtract_products<F8, usual_at_once>>::sse2,
    Built<quantise>::sse2,         Built<forward>::sse2,        Built<backward>::sse2,
    Built<products<double>>::sse2, Built<products<float>>::sse2};
constexpr Kernels with_avx2{
    Built<factor_triangle>::avx2,  Built<solve_stripe>::avx2,   Built<subtract_products<F8, usual_at_once>>::avx2,
    Built<quantise>::avx2,         Built<forward>::avx2,        Built<backward>::avx2,
    Built<products<double>>::avx2, Built<products<float>>::avx2};
// Sweeps wait for memory and triangles are small: only the products gain from AVX-512.
constexpr Kernels with_avx512 = [] {
  Kernels k = with_avx2;
  k.update = Built<subtract_products<F16, most_at_once>>::avx512;
  return k;
}();

const Kernels& kernels() {
  static const Kernels& chosen = widest_set() == InstructionSet::avx512 ? with_avx512
                                 : widest_set() == InstructionSet::avx2 ? with_avx2
                                                                        : with_sse2;
  return chosen;
}

}  // namespace

int partial_cholesky(const Panel<float>& panel, const Packed<float>& rest, std::span<const float> diagonal,
                     PivotRule rule) {
  const Kernels& use = kernels();
  const Front front{panel, rest};
  const int ns = panel.ns, nf = panel.nf;
  int negative = 0;
  float triangle[block * block];
  std::vector<float> packed;
  for (int k = 0; k < ns; k += block) {
    const int w = std::min(block, ns - k);
    negative += use.triangle(front, k, w, diagonal.data(), static_cast<float>(rule.floor),
                             static_cast<float>(rule.raised), triangle);
    const int first = k + w;
    const int m = nf - first;
    if (m <= 0) continue;
    const int stripes = (m + stripe - 1) / stripe;
    const auto size = static_cast<std::size_t>(stripe * w);
    packed.resize(static_cast<std::size_t>(stripes) * size);
    std::fill(packed.end() - static_cast<std::ptrdiff_t>(size), packed.end(), 0.0F);
    // A large front is shared among threads: every element is still made by one of them, in the same order.
    const bool shared = m >= shared_rows;
    const auto solve = [&](int from, int to) {
      for (int s = from; s < to; ++s) {
        float* x = packed.data() + static_cast<std::size_t>(s) * size;
        const int row = first + stripe * s, rows = std::min(stripe, nf - row);
        for (int c = 0; c < w; ++c) std::copy_n(front.column(k + c) + row, rows, x + stripe * c);
        use.stripe(x, w, triangle);
        for (int c = 0; c < w; ++c) std::copy_n(x + stripe * c, rows, front.column(k + c) + row);
      }
    };
    in_parts(stripes, shared ? 8 : stripes, solve);
#pragma omp taskgroup
    for (int from = 0; from < m;) {
      // Columns get shorter: the last parts are wider.
      const int part = m * m / (16 * (m - from)) / most_at_once * most_at_once;
      const int to = shared ? std::min(m, from + std::max(32, part)) : m;
#pragma omp task if (shared) default(shared) firstprivate(from, to)
      use.update(front, first, w, packed.data(), from, to);
      from = to;
    }
  }
  return negative;
}

std::size_t ThinPanel::lines(int ns, int nf) {
  const ThinPanel p{nullptr, ns, nf};
  std::size_t total = 0;
  for (int b = 0; b < p.blocks(); ++b) total += static_cast<std::size_t>(2 * p.squares(b) + head_lines);
  return total;
}

static_assert(sizeof(float[head_floats]) == head_lines * sizeof(ThinPanel::Line));

void compress(const Panel<const float>& panel, const ThinPanel& thin) {
  const Kernels& use = kernels();
  const int ns = panel.ns;
  std::vector<ThinPanel::Line*> place(static_cast<std::size_t>(thin.blocks()));
  ThinPanel::Line* end = thin.data + ThinPanel::lines(ns, panel.nf);
  for (int b = 0; b < thin.blocks(); ++b) place[static_cast<std::size_t>(b)] = end -= 2 * thin.squares(b) + head_lines;
  const auto make = [&](int from, int to) {
    std::vector<float> columns(8 * thin.vector());
    for (int b = from, j = 8 * from; b < to; ++b, j += 8) {
      const int squares = thin.squares(b), count = std::min(8, ns - j), below = std::max(0, ns - j - 8);
      float head[head_floats] = {};
      std::fill_n(columns.begin(), static_cast<std::size_t>(64 * squares), 0.0F);
      float triangle[8][8] = {};  // [column][row]
      for (int q = 0; q < count; ++q) {
        const float* in = panel.column(j + q);
        std::copy(in + j + q, in + j + count, triangle[q] + q);
        float* out = columns.data() + 8 * squares * q;
        std::copy(in + j + 8, in + j + 8 + below, out);
        std::copy(in + ns, in + panel.nf, out + thin.own() - j - 8);
      }
      for (int q = 0; q < count; ++q) {  // column q of the inverse, from the top down
        float* out = head + column_of_triangle(q);
        for (int i = q; i < count; ++i) {
          float left = i == q ? 1.0F : 0.0F;
          for (int p = q; p < i; ++p) left -= triangle[p][i] * out[p];
          out[i] = left / triangle[i][i];
        }
      }
      ThinPanel::Line* at = place[static_cast<std::size_t>(b)];
      use.sixteen_bits(columns.data(), squares, head, at + head_lines);
      std::memcpy(at, head, sizeof head);
    }
  };
  in_parts(thin.blocks(), panel.nf >= shared_rows ? 6 : thin.blocks(), make);
}

void panel_forward(const ThinPanel& panel, float* t) { kernels().sweep_forward(panel, t); }
void panel_backward(const ThinPanel& panel, float* t) { kernels().sweep_backward(panel, t); }
double dot(const double* a, const double* b, std::size_t n) { return kernels().dot(a, b, n); }
double dot(const float* a, const float* b, std::size_t n) { return kernels().dot_float(a, b, n); }

}  // namespace dem::sheet
