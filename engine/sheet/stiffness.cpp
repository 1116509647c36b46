#include "engine/sheet/stiffness.h"

#include <algorithm>
#include <cmath>

namespace dem::sheet {
namespace {

constexpr double least_hold = 1e-4;  // of its stiffest spring: what holds a particle along any direction
constexpr double loose_hold = 1e-5;  // what holds a particle beside an open crack, which may be part of a fragment

}  // namespace

void hold(Block& diagonal, double stiffest, bool loose) {
  if (loose) diagonal[0] += loose_hold * stiffest, diagonal[2] += loose_hold * stiffest;
  const double middle = 0.5 * (diagonal[0] + diagonal[2]), half = 0.5 * (diagonal[0] - diagonal[2]);
  const double size = std::sqrt(half * half + diagonal[1] * diagonal[1]);
  const double lacks = least_hold * stiffest - (middle - size);
  if (lacks <= 0) return;
  if (size <= 1e-12 * stiffest) {
    diagonal[0] += lacks, diagonal[2] += lacks;
    return;
  }
  // Along the direction in which it is softest only: (1 - (D - middle)/size)/2 projects on it.
  diagonal[0] += 0.5 * lacks * (1 - half / size);
  diagonal[1] -= 0.5 * lacks * diagonal[1] / size;
  diagonal[2] += 0.5 * lacks * (1 + half / size);
}

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
  bool loose = false;
  for (int d = 0; d < 6; ++d) {
    const int other = s.lattice.neighbour(particle, d);
    if (other < 0) continue;
    const auto slot = static_cast<std::size_t>(d < 3 ? d * s.particles() + particle : (d - 3) * s.particles() + other);
    const Block& b = m.coupling[slot];
    for (std::size_t q = 0; q < 3; ++q) sum[q] -= b[q];
    stiffest = std::max(stiffest, s.stiffness[slot]);
    loose = loose || (s.stiffness[slot] > 0 && b == Block{0, 0, 0});
  }
  hold(sum, stiffest, loose);
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
    double sx = 0, sy = 0, stiffest = 0;
    Block sum{0, 0, 0};
    bool loose = false;
    for (int d = 0; d < 6; ++d) {
      const int j = s.lattice.neighbour(i, d);
      if (j < 0) continue;
      const int slot = d < 3 ? d * n + i : (d - 3) * n + j;
      const Block b = tangent_block(s, f, slot);
      for (std::size_t q = 0; q < 3; ++q) sum[q] += b[q];
      stiffest = std::max(stiffest, s.stiffness[static_cast<std::size_t>(slot)]);
      loose = loose || (s.stiffness[static_cast<std::size_t>(slot)] > 0 && !active(s, f, slot));
      const double dx = vx[p] - vx[static_cast<std::size_t>(j)], dy = vy[p] - vy[static_cast<std::size_t>(j)];
      sx += b[0] * dx + b[1] * dy;
      sy += b[1] * dx + b[2] * dy;
    }
    Block held = sum;
    hold(held, stiffest, loose);
    sx += (held[0] - sum[0]) * vx[p] + (held[1] - sum[1]) * vy[p];
    sy += (held[1] - sum[1]) * vx[p] + (held[2] - sum[2]) * vy[p];
    out_x[p] = (s.fixed[p] & 1) ? 0.0 : sx;
    out_y[p] = (s.fixed[p] & 2) ? 0.0 : sy;
  }
}

}  // namespace dem::sheet
