#pragma once
// Dense kernels of the sheet's factorisation: the partial Cholesky of a front, and the triangular solves with its
// panel. Every element is accumulated in one fixed order, so results are the same bits for every vector width.
//
// Fronts are in single precision: they precondition, equilibrium itself is judged by the true forces in double. A
// panel keeps its columns from the diagonal down, the last column first: the backward sweep, which visits every node
// from the root down, then reads memory once from one end to the other.
#include <cstddef>
#include <span>

namespace dem::sheet {

/// Where row 0 of column j of a panel would be: column(j)[i] is element (i, j), i >= j. `ns` columns, `nf` rows.
template <class Float>
struct Panel {
  Float* data = nullptr;
  int ns = 0, nf = 0;

  [[nodiscard]] Float* column(int j) const {
    const auto n = static_cast<std::ptrdiff_t>(ns), f = static_cast<std::ptrdiff_t>(nf), c = std::ptrdiff_t{j};
    return data + ((n - 1 - c) * f - ((n - 1) * n - c * (c + 1)) / 2 - c);
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

/// t[0..ns) = L_ss^-1 t[0..ns); t[ns..nf) -= L_bs t[0..ns). `inverse` holds 1 / L_jj.
void panel_forward(const Panel<const float>& panel, const double* inverse, double* t);
/// t[0..ns) = L_ss^-T (t[0..ns) - L_bs^T t[ns..nf)).
void panel_backward(const Panel<const float>& panel, const double* inverse, double* t);

/// Sum of a[i] b[i] in a fixed order.
double dot(const double* a, const double* b, std::size_t n);

}  // namespace dem::sheet
