#include <algorithm>
#include <cmath>

#include "engine/sheet/solver.h"

namespace dem::sheet {

// The sweep is in place and in index order, so it is sequential by definition: one thread, the same bits always.
Relaxation HistoricalSolver::relax(Sheet& s, Forces& forces, std::span<const int>) {
  const int n = s.particles();
  Relaxation result;
  ++work_.relaxations;
  while (result.iterations < settings_.most_sweeps) {
    double largest = 0;
    for (int i = 0; i < n; ++i) {
      const auto p = static_cast<std::size_t>(i);
      double fx = 0, fy = 0, stiffness = 0;
      for (int d = 0; d < 6; ++d) {
        const int j = s.lattice.neighbour(i, d);
        if (j < 0) continue;
        const auto q = static_cast<std::size_t>(j);
        const auto slot = static_cast<std::size_t>(d < 3 ? d * n + i : (d - 3) * n + j);
        const double dx = s.x[q] - s.x[p], dy = s.y[q] - s.y[p];
        const double length = std::sqrt(dx * dx + dy * dy);
        const double stretch = length - (s.radius[p] + s.radius[q]);
        if (!s.joined[slot] && stretch >= 0) continue;
        const double f = s.stiffness[slot] * stretch / length;
        fx += f * dx;
        fy += f * dy;
        stiffness += s.stiffness[slot];
      }
      if (stiffness <= 0) continue;
      const double share = settings_.relaxation / stiffness;
      const double mx = (s.fixed[p] & 1) ? 0.0 : share * fx, my = (s.fixed[p] & 2) ? 0.0 : share * fy;
      s.x[p] += mx;
      s.y[p] += my;
      largest = std::max(largest, std::sqrt(mx * mx + my * my));
    }
    ++result.iterations;
    if (largest <= settings_.stop) {
      result.reached = true;
      break;
    }
  }
  work_.solves += result.iterations;
  compute_forces(s, forces, threads_);
  result.unbalanced = forces.largest > 0 ? forces.unbalanced / forces.largest : 0;
  return result;
}

}  // namespace dem::sheet
