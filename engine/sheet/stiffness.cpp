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

BlockMatrix assemble(const Sheet& s, const Forces& f, Tangent tangent) {
  const auto n = static_cast<std::size_t>(s.particles());
  BlockMatrix m;
  m.diagonal.assign(n, {0, 0, 0});
  m.coupling.assign(3 * n, {0, 0, 0});
  m.fixed = s.fixed;
  std::vector<double> stiffest(n, 0.0);
  std::vector<std::uint8_t> springs(n, 0);
  for (int slot = 0; slot < s.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (s.stiffness[k] <= 0) continue;
    const Block b = tangent_block(s, f, slot, tangent);
    const bool on = active(s, f, slot);
    for (const int p : {s.first(slot), s.second(slot)}) {
      const auto i = static_cast<std::size_t>(p);
      for (std::size_t q = 0; q < 3; ++q) m.diagonal[i][q] += b[q];
      stiffest[i] = std::max(stiffest[i], s.stiffness[k]);
      springs[i] = static_cast<std::uint8_t>(springs[i] + (on ? 1 : 0));
    }
    m.coupling[k] = {-b[0], -b[1], -b[2]};
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (springs[i] > 2) continue;
    m.diagonal[i][0] += tether * stiffest[i];
    m.diagonal[i][2] += tether * stiffest[i];
  }
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
