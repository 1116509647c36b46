#include "engine/sheet/stiffness.h"

#include <algorithm>

namespace dem::sheet {
namespace {

constexpr double tether = 1e-3;

}  // namespace

Block tangent_block(const Sheet& s, const Forces& f, int slot, Tangent tangent) {
  if (!active(s, f, slot)) return {0, 0, 0};
  const auto k = static_cast<std::size_t>(slot);
  const auto i = static_cast<std::size_t>(s.first(slot)), j = static_cast<std::size_t>(s.second(slot));
  const double d = f.length[k];
  const double nx = (s.x[j] - s.x[i]) / d, ny = (s.y[j] - s.y[i]) / d;
  const double true_g = f.tension[k] / d, g = tangent == Tangent::stable ? std::max(true_g, 0.0) : true_g;
  const double along = s.stiffness[k] - g;
  return {along * nx * nx + g, along * nx * ny, along * ny * ny + g};
}

Block diagonal_of(const Sheet& s, const BlockMatrix& m, int particle) {
  Block sum{0, 0, 0};
  double stiffest = 0;
  int springs = 0;
  for (int d = 0; d < 6; ++d) {
    const int other = s.lattice.neighbour(particle, d);
    if (other < 0) continue;
    const auto slot = static_cast<std::size_t>(d < 3 ? d * s.particles() + particle : (d - 3) * s.particles() + other);
    const Block& b = m.coupling[slot];
    for (std::size_t q = 0; q < 3; ++q) sum[q] -= b[q];
    stiffest = std::max(stiffest, s.stiffness[slot]);
    springs += b == Block{0, 0, 0} ? 0 : 1;
  }
  if (springs <= 2) sum[0] += tether * stiffest, sum[2] += tether * stiffest;
  return sum;
}

BlockMatrix assemble(const Sheet& s, const Forces& f, Tangent tangent) {
  const auto n = static_cast<std::size_t>(s.particles());
  BlockMatrix m;
  m.coupling.assign(3 * n, {0, 0, 0});
  m.fixed = s.fixed;
  for (int slot = 0; slot < s.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (s.stiffness[k] <= 0) continue;
    const Block b = tangent_block(s, f, slot, tangent);
    m.coupling[k] = {-b[0], -b[1], -b[2]};
  }
  m.diagonal.resize(n);
  for (int i = 0; i < s.particles(); ++i) m.diagonal[static_cast<std::size_t>(i)] = diagonal_of(s, m, i);
  return m;
}

void apply_tangent(const Sheet& s, const Forces& f, std::span<const double> vx, std::span<const double> vy,
                   std::span<double> out_x, std::span<double> out_y, int threads) {
  const int n = s.particles();
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int i = 0; i < n; ++i) {
    const auto p = static_cast<std::size_t>(i);
    double sx = 0, sy = 0;
    for (int d = 0; d < 6; ++d) {
      const int j = s.lattice.neighbour(i, d);
      if (j < 0) continue;
      const Block b = tangent_block(s, f, d < 3 ? d * n + i : (d - 3) * n + j);
      const double dx = vx[p] - vx[static_cast<std::size_t>(j)], dy = vy[p] - vy[static_cast<std::size_t>(j)];
      sx += b[0] * dx + b[1] * dy;
      sy += b[1] * dx + b[2] * dy;
    }
    out_x[p] = (s.fixed[p] & 1) ? 0.0 : sx;
    out_y[p] = (s.fixed[p] & 2) ? 0.0 : sy;
  }
}

}  // namespace dem::sheet
