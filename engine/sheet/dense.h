#pragma once
// Dense kernels of the sheet's factorisation: the partial Cholesky of a front, and the triangular solves with its
// panel. Every element is accumulated in one fixed order, so results are the same bits for every vector width.
#include <cstddef>
#include <span>

namespace dem::sheet {

/// What to do with a pivot that has lost its stiffness (a mechanism: a detached fragment, a buckling chain).
/// A pivot below `floor` times its diagonal before elimination is raised to `raised` times that diagonal: the factor
/// stays positive definite and serves as a preconditioner, while equilibrium itself is judged by the true forces.
struct PivotRule {
  double floor = 1e-6;
  double raised = 1e-3;
};

/// Factorises the leading `ns` columns of the symmetric front `a` (lower part, column by column, leading dimension
/// `ld`, order `nf`) in place, a = L L^T, and subtracts their contribution from the rest. `diagonal` holds the ns
/// diagonal entries before any elimination. Returns how many pivots were below minus
/// `floor`: the matrix has directions of negative stiffness, and raising them makes the entries after them grow.
int partial_cholesky(double* a, std::size_t ld, int ns, int nf, std::span<const double> diagonal, PivotRule rule);

/// t[0..ns) = L_ss^-1 t[0..ns); t[ns..nf) -= L_bs t[0..ns). `inverse` holds 1 / L_jj.
void panel_forward(const float* panel, std::size_t ld, int ns, int nf, const double* inverse, double* t);
void panel_forward(const double* panel, std::size_t ld, int ns, int nf, const double* inverse, double* t);
/// t[0..ns) = L_ss^-T (t[0..ns) - L_bs^T t[ns..nf)).
void panel_backward(const float* panel, std::size_t ld, int ns, int nf, const double* inverse, double* t);
void panel_backward(const double* panel, std::size_t ld, int ns, int nf, const double* inverse, double* t);

/// Sum of a[i] b[i] in a fixed order.
double dot(const double* a, const double* b, std::size_t n);

}  // namespace dem::sheet
