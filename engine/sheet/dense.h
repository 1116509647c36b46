#pragma once
// Dense kernels of the sheet's factorisation: the partial Cholesky of a front, and the triangular solves with its
// panel. Every element is accumulated in one fixed order, so results are the same bits for every vector width.
//
// Fronts are in single precision, and what sweeps read of them in sixteen bits: they precondition, equilibrium itself
// is judged by the true forces in double. A sweep costs what it takes to read the factor once.
#include <cstddef>
#include <cstdint>
#include <span>

namespace dem::sheet {

/// The leading `ns` columns of a symmetric front of order `nf`, from the diagonal down, column by column: column(j)[i]
/// is element (i, j), i >= j.
template <class Float>
struct Panel {
  Float* data = nullptr;
  int ns = 0, nf = 0;

  [[nodiscard]] Float* column(int j) const {
    const auto f = static_cast<std::ptrdiff_t>(nf), c = std::ptrdiff_t{j};
    return data + (c * f - c * (c + 1) / 2);
  }
  [[nodiscard]] static std::size_t size(int ns, int nf) {
    const auto n = static_cast<std::size_t>(ns), f = static_cast<std::size_t>(nf);
    return n * f - n * (n - 1) / 2;
  }
};

/// The lower part of a symmetric matrix of order m, column by column: column(j)[i] is element (i, j), i >= j.
template <class Float>
struct Packed {
  Float* data = nullptr;
  int m = 0;

  [[nodiscard]] Float* column(int j) const {
    const auto n = static_cast<std::ptrdiff_t>(m), c = std::ptrdiff_t{j};
    return data + (c * n - c * (c + 1) / 2);
  }
  [[nodiscard]] static std::size_t size(int m) {
    const auto n = static_cast<std::size_t>(m);
    return n * (n + 1) / 2;
  }
};

/// What to do with a pivot that has lost its stiffness (a mechanism: a detached fragment, a buckling chain).
/// A pivot below `floor` times its diagonal before elimination is raised to `raised` times that diagonal: the factor
/// stays positive definite and serves as a preconditioner, while equilibrium itself is judged by the true forces.
struct PivotRule {
  double floor = 1e-6;
  double raised = 1e-3;
};

/// Factorises the columns of `panel` (the leading ns of a symmetric front of order nf) in place, a = L L^T, and
/// subtracts their contribution from `rest`, the nf - ns others. `diagonal` holds the ns diagonal entries before any
/// elimination. Returns how many pivots were below minus `floor`: the matrix has directions of negative stiffness, and
/// raising them makes the entries after them grow.
int partial_cholesky(const Panel<float>& panel, const Packed<float>& rest, std::span<const float> diagonal,
                     PivotRule rule);

/// A factorised panel as sweeps read it: blocks of eight columns, each three lines of what is exact (the inverse of its
/// triangle) and two lines for every eight rows below it, in sixteen bits on a scale of each column. Rounding is
/// carried on to the next row of the same direction, so that a column acts on smooth displacements nearly as it did.
/// Blocks lie last first, the way the backward sweep reads them. Own rows are padded to a multiple of eight: row ns of
/// the front is row `own()` of a vector.
struct ThinPanel {
  struct alignas(64) Line {
    unsigned char bytes[64];
  };
  Line* data = nullptr;
  int ns = 0, nf = 0;

  [[nodiscard]] int own() const { return (ns + 7) / 8 * 8; }
  [[nodiscard]] int blocks() const { return own() / 8; }
  /// Squares of eight rows below the triangle of a block.
  [[nodiscard]] int squares(int block) const { return (own() - 8 * (block + 1) + nf - ns + 7) / 8; }
  /// Length of the vector that a sweep works on: what is beyond the last row must be zero.
  [[nodiscard]] std::size_t vector() const { return static_cast<std::size_t>(own() + (nf - ns + 7) / 8 * 8); }
  [[nodiscard]] static std::size_t lines(int ns, int nf);
};

/// Writes a factorised panel into `thin`, whose ns and nf are those of the panel.
void compress(const Panel<const float>& panel, const ThinPanel& thin);

/// t[0..ns) = L_ss^-1 t[0..ns); t[own..) -= L_bs t[0..ns).
void panel_forward(const ThinPanel& panel, float* t);
/// t[0..ns) = L_ss^-T (t[0..ns) - L_bs^T t[own..)).
void panel_backward(const ThinPanel& panel, float* t);

/// Sum of a[i] b[i] in a fixed order.
double dot(const double* a, const double* b, std::size_t n);
double dot(const float* a, const float* b, std::size_t n);

}  // namespace dem::sheet
