#include <algorithm>
#include <cmath>

#include "engine/sheet/solver.h"
#include "engine/sheet/stiffness.h"

namespace dem::sheet {
namespace {

constexpr int usual_solves = 3;        // of a relaxation with a good factor
constexpr int refactor_after = 60;     // solves beyond the usual ones that are worth a new factor
constexpr int most_changes = 300;      // rank beyond which corrections cost more than a new factor
constexpr double longest_step = 0.2;   // of a particle radius, in one step

}  // namespace

struct ConvergedSolver::Impl {
  ConvergedSettings settings;
  Dissection dissection;
  ModifiedFactor factor;
  bool factorised = false;
  SolverWork done;
  ConvergedState kept;
  // What the factor holds for each slot: whether it is in, and along which direction.
  std::vector<std::uint8_t> held;
  std::vector<double> nx, ny;
  std::vector<int> watched;   // slots that are not joined
  std::vector<double> bx, by, ux, uy;
  std::vector<double> px, py, qx, qy, zx, zy;

  Impl(const Sheet& sheet, ConvergedSettings s)
      : settings(s), dissection(sheet.lattice), factor(dissection, s.threads) {
    const auto n = static_cast<std::size_t>(sheet.particles());
    for (auto* v : {&bx, &by, &ux, &uy, &px, &py, &qx, &qy, &zx, &zy}) v->assign(n, 0.0);
  }

  void factorise(const Sheet& sheet, const Forces& forces) {
    done.raised_pivots += factor.factorise(assemble(sheet, forces));
    ++done.factorisations;
    const auto slots = static_cast<std::size_t>(sheet.slots());
    held.assign(slots, 0);
    nx.resize(slots);
    ny.resize(slots);
    watched.clear();
    for (int slot = 0; slot < sheet.slots(); ++slot) {
      const auto k = static_cast<std::size_t>(slot);
      if (sheet.stiffness[k] <= 0) continue;
      const auto i = static_cast<std::size_t>(sheet.first(slot)), j = static_cast<std::size_t>(sheet.second(slot));
      nx[k] = (sheet.x[j] - sheet.x[i]) / forces.length[k];
      ny[k] = (sheet.y[j] - sheet.y[i]) / forces.length[k];
      held[k] = active(sheet, forces, slot) ? 1 : 0;
      if (!sheet.joined[k]) watched.push_back(slot);
    }
    kept = {sheet.x, sheet.y, sheet.radius, sheet.joined, {}, 0};
    factorised = true;
  }

  void change(const Sheet& sheet, ConvergedState::Change c) {
    const auto k = static_cast<std::size_t>(c.slot);
    nx[k] = c.nx;
    ny[k] = c.ny;
    held[k] = c.active ? 1 : 0;
    c.coefficient = factor.change(c.coefficient, sheet.first(c.slot), sheet.second(c.slot), {c.nx, c.ny}, sheet.fixed);
    kept.changes.push_back(c);
    ++done.changes;
  }

  // Brings the factor up to date with springs that broke and contacts that opened or closed.
  void follow(const Sheet& sheet, const Forces& forces) {
    for (const int slot : watched) {
      const auto k = static_cast<std::size_t>(slot);
      const bool on = active(sheet, forces, slot);
      if (on == (held[k] != 0)) continue;
      if (!on) {
        change(sheet, {-sheet.stiffness[k], slot, nx[k], ny[k], false});
        continue;
      }
      const auto i = static_cast<std::size_t>(sheet.first(slot)), j = static_cast<std::size_t>(sheet.second(slot));
      change(sheet, {sheet.stiffness[k], slot, (sheet.x[j] - sheet.x[i]) / forces.length[k],
                     (sheet.y[j] - sheet.y[i]) / forces.length[k], true});
    }
  }

  // The unbalanced forces along free directions; what is far below `small` is left for later steps to keep loads few.
  void load(const Sheet& sheet, const Forces& forces, double small) {
    const auto n = bx.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double fx = (sheet.fixed[i] & 1) ? 0.0 : forces.x[i], fy = (sheet.fixed[i] & 2) ? 0.0 : forces.y[i];
      const bool counts = std::max(std::fabs(fx), std::fabs(fy)) > small;
      bx[i] = counts ? fx : 0.0;
      by[i] = counts ? fy : 0.0;
    }
  }

  void precondition(std::span<const double> rx, std::span<const double> ry, std::span<double> x, std::span<double> y) {
    factor.solve(rx, ry, x, y);
    ++done.solves;
  }

  double work_of(const Sheet& sheet, const Forces& forces) const {  // F . u along free directions
    double total = 0;
    for (std::size_t i = 0; i < ux.size(); ++i) {
      if (!(sheet.fixed[i] & 1)) total += forces.x[i] * ux[i];
      if (!(sheet.fixed[i] & 2)) total += forces.y[i] * uy[i];
    }
    return total;
  }

  void move(Sheet& sheet, double share) const {
    for (std::size_t i = 0; i < ux.size(); ++i) {
      sheet.x[i] += share * ux[i];
      sheet.y[i] += share * uy[i];
    }
  }

  double limit(const Sheet& sheet) const {  // share of the step that no particle exceeds longest_step with
    double most = 0;
    for (std::size_t i = 0; i < ux.size(); ++i) most = std::max(most, std::max(std::fabs(ux[i]), std::fabs(uy[i])));
    const double longest = longest_step * sheet.radius0;
    return most > longest ? longest / most : 1.0;
  }

  // Conjugate gradients on the true tangent: u = K^-1 b to `share` of the first residual. Returns solves made.
  int newton_direction(const Sheet& sheet, const Forces& forces, double share, int most) {
    std::vector<double> rx = bx, ry = by;
    std::fill(ux.begin(), ux.end(), 0.0);
    std::fill(uy.begin(), uy.end(), 0.0);
    const auto product = [](std::span<const double> ax, std::span<const double> ay, std::span<const double> cx,
                            std::span<const double> cy) {
      return dot(ax.data(), cx.data(), ax.size()) + dot(ay.data(), cy.data(), ay.size());
    };
    const auto largest = [&] {
      double m = 0;
      for (std::size_t i = 0; i < rx.size(); ++i) m = std::max(m, std::max(std::fabs(rx[i]), std::fabs(ry[i])));
      return m;
    };
    const double start = largest();
    int solves = 0;
    double rz = 0;
    while (solves < most) {
      precondition(rx, ry, zx, zy);
      ++solves;
      const double next = product(rx, ry, zx, zy);
      const double beta = solves == 1 ? 0.0 : next / rz;
      rz = next;
      for (std::size_t i = 0; i < px.size(); ++i) {
        px[i] = zx[i] + beta * px[i];
        py[i] = zy[i] + beta * py[i];
      }
      apply_tangent(sheet, forces, px, py, qx, qy, settings.threads);
      const double curvature = product(px, py, qx, qy);
      if (curvature <= 1e-6 * rz) {  // a direction without stiffness: keep what is known, or step along it
        if (solves == 1) ux = px, uy = py;
        break;
      }
      const double alpha = rz / curvature;
      for (std::size_t i = 0; i < px.size(); ++i) {
        ux[i] += alpha * px[i];
        uy[i] += alpha * py[i];
        rx[i] -= alpha * qx[i];
        ry[i] -= alpha * qy[i];
      }
      if (largest() <= share * start) break;
    }
    return solves;
  }

  // Moves along (ux, uy); shortens the step while the energy would rise along it.
  void search(Sheet& sheet, Forces& forces) {
    const double before = forces.unbalanced;
    const double slope = work_of(sheet, forces);
    double share = limit(sheet);
    double at = 0;
    for (int attempt = 0; attempt < 12; ++attempt) {
      move(sheet, share - at);
      at = share;
      compute_forces(sheet, forces, settings.threads);
      if (forces.unbalanced < 0.9 * before) return;
      const double now = work_of(sheet, forces);
      if (now >= -0.5 * std::fabs(slope)) return;
      ++done.searches;
      share = std::clamp(share * slope / (slope - now), 0.1 * share, 0.7 * share);
    }
  }

  Relaxation relax(Sheet& sheet, Forces& forces, std::span<const int> near) {
    ++done.relaxations;
    compute_forces(sheet, forces, settings.threads);
    watched.insert(watched.end(), near.begin(), near.end());
    Relaxation result;
    int slow = 0;
    bool fresh = false;
    const auto balanced = [&] { return forces.unbalanced <= settings.tolerance * forces.largest; };
    if (!factorised) factorise(sheet, forces), fresh = true;
    while (!balanced() && result.iterations < settings.most_solves) {
      if (settings.refactor_always || factor.changes() > most_changes || kept.extra_solves > refactor_after) {
        factorise(sheet, forces);
        fresh = true;
      } else {
        follow(sheet, forces);
      }
      const double before = forces.unbalanced;
      load(sheet, forces, 0.05 * settings.tolerance * forces.largest);
      int solves = 1;
      if (slow < 2) {
        precondition(bx, by, ux, uy);
      } else {
        solves = newton_direction(sheet, forces, 0.02, 20);
      }
      search(sheet, forces);
      result.iterations += solves;
      if (forces.unbalanced > 0.3 * before) ++slow;
      if (!fresh) kept.extra_solves += solves;
      // A relaxation that goes on and on needs a factor of its own.
      if (result.iterations % 40 < solves && result.iterations >= 40) kept.extra_solves = refactor_after + 1;
    }
    if (!fresh) kept.extra_solves = std::max<std::int64_t>(0, kept.extra_solves - std::min(usual_solves, result.iterations));
    result.reached = balanced();
    result.unbalanced = forces.largest > 0 ? forces.unbalanced / forces.largest : 0;
    return result;
  }
};

ConvergedSolver::ConvergedSolver(const Sheet& sheet, ConvergedSettings settings)
    : impl_(std::make_unique<Impl>(sheet, settings)) {}
ConvergedSolver::~ConvergedSolver() = default;
Relaxation ConvergedSolver::relax(Sheet& sheet, Forces& forces, std::span<const int> near) {
  return impl_->relax(sheet, forces, near);
}
SolverWork ConvergedSolver::work() const { return impl_->done; }
ConvergedState ConvergedSolver::state() const { return impl_->kept; }

void ConvergedSolver::restore(const Sheet& sheet, const ConvergedState& state) {
  Sheet then = sheet;
  then.x = state.x;
  then.y = state.y;
  then.radius = state.radius;
  then.joined = state.joined;
  Forces forces;
  compute_forces(then, forces, impl_->settings.threads);
  impl_->factorise(then, forces);
  for (const auto& change : state.changes) impl_->change(then, change);
  impl_->kept.extra_solves = state.extra_solves;
  impl_->watched.clear();
  for (int slot = 0; slot < sheet.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (sheet.stiffness[k] > 0 && !sheet.joined[k]) impl_->watched.push_back(slot);
  }
}

}  // namespace dem::sheet
