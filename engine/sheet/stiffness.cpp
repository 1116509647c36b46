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

void TangentOperator::update(const Sheet& s, const Forces& f) {
  sheet_ = &s;
  for (auto* v : {&xx_, &xy_, &yy_}) v->resize(f.tension.size());
  const int n = s.particles(), rows = s.lattice.rows;
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (int row = 0; row < rows; ++row) {
    for (int d = 0; d < 3; ++d) {
      const Lattice::Line line = s.lattice.line(row, d);
      for (int i = line.begin; i < line.end; ++i) {
        const Block b = tangent_block(s, f, d * n + i);
        const auto k = static_cast<std::size_t>(d * n + i);
        xx_[k] = b[0], xy_[k] = b[1], yy_[k] = b[2];
      }
    }
  }
  std::vector<std::vector<Held>> found(static_cast<std::size_t>(rows));
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (int row = 0; row < rows; ++row) {
    const int columns = s.lattice.columns, shift = s.lattice.shifted(row) ? 1 : 0;
    for (int i = row * columns, c = 0; c < columns; ++i, ++c) {
      Block sum{0, 0, 0};
      double stiffest = 0;
      bool loose = false;
      const auto add = [&](int slot) {  // slots without a neighbour have no stiffness
        const auto k = static_cast<std::size_t>(slot);
        sum[0] += xx_[k], sum[1] += xy_[k], sum[2] += yy_[k];
        stiffest = std::max(stiffest, s.stiffness[k]);
        loose = loose || (s.stiffness[k] > 0 && !active(s, f, slot));
      };
      for (int d = 0; d < 3; ++d) add(d * n + i);
      if (c > 0) add(i - 1);
      const int south_west = i - columns + shift - 1;
      if (row > 0 && c + shift > 0) add(n + south_west);
      if (row > 0 && c + shift < columns) add(2 * n + south_west + 1);
      Block held = sum;
      hold(held, stiffest, loose);
      if (held != sum)
        found[static_cast<std::size_t>(row)].push_back({i, {held[0] - sum[0], held[1] - sum[1], held[2] - sum[2]}});
    }
  }
  held_.clear();
  for (const auto& row : found) held_.insert(held_.end(), row.begin(), row.end());
}

void TangentOperator::apply(std::span<const double> vx, std::span<const double> vy, std::span<double> out_x,
                            std::span<double> out_y) const {
  const Sheet& s = *sheet_;
  const auto n = static_cast<std::size_t>(s.particles()), columns = static_cast<std::size_t>(s.lattice.columns);
  const int rows = s.lattice.rows;
  constexpr int band = 16;  // each computes the row below its first one again
  const int bands = (rows + band - 1) / band;
#pragma omp parallel num_threads(threads_)
  {
    std::vector<double> buffer(12 * columns);
#pragma omp for schedule(static)
    for (int b = 0; b < bands; ++b) {
      for (int r = std::max(0, b * band - 1); r < std::min(rows, (b + 1) * band); ++r) {
        double* own = buffer.data() + static_cast<std::size_t>(r % 2) * 6 * columns;
        const double* lower = buffer.data() + static_cast<std::size_t>((r + 1) % 2) * 6 * columns;
        const auto start = static_cast<std::size_t>(r) * columns;
        std::fill_n(own, 6 * columns, 0.0);
        for (std::size_t d = 0; d < 3; ++d) {
          const Lattice::Line line = s.lattice.line(r, static_cast<int>(d));
          const double *xx = xx_.data() + d * n, *xy = xy_.data() + d * n, *yy = yy_.data() + d * n;
          double *tx = own + 2 * d * columns, *ty = tx + columns;
#pragma GCC ivdep
          for (int i = line.begin; i < line.end; ++i) {
            const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(i + line.offset);
            const double dx = vx[p] - vx[q], dy = vy[p] - vy[q];
            tx[p - start] = xx[p] * dx + xy[p] * dy;
            ty[p - start] = xy[p] * dx + yy[p] * dy;
          }
        }
        if (r < b * band) continue;
        const bool shifted = s.lattice.shifted(r);
        for (std::size_t c = 0; c < columns; ++c) {
          double x = (own[c] + own[2 * columns + c]) + own[4 * columns + c];
          double y = (own[columns + c] + own[3 * columns + c]) + own[5 * columns + c];
          if (c > 0) x -= own[c - 1], y -= own[columns + c - 1];
          const std::size_t east = shifted ? c + 1 : c;  // of the two below
          if (r > 0 && east > 0) x -= lower[2 * columns + east - 1], y -= lower[3 * columns + east - 1];
          if (r > 0 && east < columns) x -= lower[4 * columns + east], y -= lower[5 * columns + east];
          const auto i = start + c;
          out_x[i] = (s.fixed[i] & 1) ? 0.0 : x;
          out_y[i] = (s.fixed[i] & 2) ? 0.0 : y;
        }
      }
    }
  }
  for (const Held& h : held_) {
    const auto i = static_cast<std::size_t>(h.particle);
    if (!(s.fixed[i] & 1)) out_x[i] += h.extra[0] * vx[i] + h.extra[1] * vy[i];
    if (!(s.fixed[i] & 2)) out_y[i] += h.extra[1] * vx[i] + h.extra[2] * vy[i];
  }
}

}  // namespace dem::sheet
