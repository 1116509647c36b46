#include "engine/sheet/sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/instruction_set.h"

namespace dem::sheet {
namespace {

struct SpringLine {
  const double *x, *y, *radius, *stiffness;
  const std::uint8_t* joined;
  double *tension, *length, *fx, *fy;
};

// No branch and no sum in the first loop: it is vector code. Returns the largest force.
inline __attribute__((always_inline)) double spring_line(const SpringLine& s, int begin, int end, int offset) {
#pragma GCC ivdep
  for (int i = begin; i < end; ++i) {
    const double dx = s.x[i + offset] - s.x[i], dy = s.y[i + offset] - s.y[i];
    const double d = std::sqrt(dx * dx + dy * dy);
    const double f = s.stiffness[i] * (d - (s.radius[i] + s.radius[i + offset]));
    const double most = 1e300 * s.joined[i];  // no tension where a spring is broken
    const double held = f > most ? most : f;
    const double per_length = held / d;
    s.tension[i] = held;
    s.length[i] = d;
    s.fx[i] = per_length * dx;
    s.fy[i] = per_length * dy;
  }
  double largest = 0;
#pragma omp simd reduction(max : largest)
  for (int i = begin; i < end; ++i) {
    const double size = std::fabs(s.tension[i]);
    largest = size > largest ? size : largest;
  }
  return largest;
}

// With AVX-512 it takes as long as with AVX2: it waits for its quotients and for memory.
decltype(&spring_line) spring_line_here() {
  static const auto chosen = widest_set() == InstructionSet::sse2 ? Built<spring_line>::sse2 : Built<spring_line>::avx2;
  return chosen;
}

// A row's largest values from forces that are up to date.
Forces::Row look_along(const Sheet& s, const Forces& f, int row) {
  const auto n = static_cast<std::size_t>(s.particles()), columns = static_cast<std::size_t>(s.lattice.columns);
  const auto start = static_cast<std::size_t>(row) * columns;
  Forces::Row found;
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t k = d * n + start; k < d * n + start + columns; ++k) {
      found.largest = std::max(found.largest, std::fabs(f.tension[k]));
    }
  }
  for (std::size_t i = start; i < start + columns; ++i) {
    const double x = (s.fixed[i] & 1) ? 0.0 : std::fabs(f.x[i]), y = (s.fixed[i] & 2) ? 0.0 : std::fabs(f.y[i]);
    const double size = std::max(x, y);
    if (size > found.unbalanced) found.unbalanced = size, found.worst = static_cast<int>(i);
  }
  return found;
}

void sum_up(Forces& f) {
  f.largest = f.unbalanced = 0;
  f.worst = -1;
  for (const auto& row : f.rows) {
    f.largest = std::max(f.largest, row.largest);
    if (row.unbalanced > f.unbalanced) f.unbalanced = row.unbalanced, f.worst = row.worst;
  }
}

}  // namespace

Sheet make_sheet(int columns, int rows, double wall_weight) {
  Sheet s;
  s.radius0 = 0.5 / columns;
  const double spacing = std::numbers::sqrt3 * s.radius0;
  if (rows <= 0) rows = std::max(2, static_cast<int>(std::lround(1.0 / spacing)));
  s.lattice = {columns, rows, false};
  const auto n = static_cast<std::size_t>(s.lattice.particles());
  s.x.resize(n);
  s.y.resize(n);
  s.radius.assign(n, s.radius0);
  s.fixed.assign(n, 0);
  s.grain.assign(n, 0);
  s.stiffness.assign(3 * n, 0.0);
  s.threshold.assign(3 * n, std::numeric_limits<double>::infinity());
  s.joined.assign(3 * n, 0);
  s.between.assign(3 * n, 0);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const auto i = static_cast<std::size_t>(r * columns + c);
      s.x[i] = s.radius0 * ((s.lattice.shifted(r) ? 2 : 1) + 2 * c);
      s.y[i] = s.radius0 + spacing * r;
      if (c == 0 || c == columns - 1) s.fixed[i] |= 1;
      if (r == 0 || r == rows - 1) s.fixed[i] |= 2;
    }
  }
  s.width = extent(s).x;
  s.height = extent(s).y;
  for (int slot = 0; slot < s.slots(); ++slot) {
    if (s.second(slot) < 0) continue;
    s.stiffness[static_cast<std::size_t>(slot)] = along_wall(s, slot) ? wall_weight : 1.0;
    s.joined[static_cast<std::size_t>(slot)] = 1;
  }
  return s;
}

bool along_wall(const Sheet& s, int slot) {
  const int i = s.first(slot), j = s.second(slot), columns = s.lattice.columns;
  const auto same = [](int a, int b, int value) { return a == value && b == value; };
  return same(i / columns, j / columns, 0) || same(i / columns, j / columns, s.lattice.rows - 1) ||
         same(i % columns, j % columns, 0) || same(i % columns, j % columns, columns - 1);
}

void compute_forces(const Sheet& s, Forces& f, int threads) {
  const auto n = static_cast<std::size_t>(s.particles());
  static_assert(sizeof(std::size_t) == 8);
  if (f.x.size() != n) {
    f.x.assign(n, 0);
    f.y.assign(n, 0);
    f.tension.assign(3 * n, 0);
    f.length.assign(3 * n, 1);
  }
  const int rows = s.lattice.rows, columns = s.lattice.columns;
  // A row needs its own springs and those of the row below. Each band of rows recomputes the row below its first one.
  constexpr int band = 16;
  const int bands = (rows + band - 1) / band;
  f.rows.resize(static_cast<std::size_t>(rows));
  const auto force_line = spring_line_here();
#pragma omp parallel num_threads(threads)
  {
    std::vector<double> buffer(12 * static_cast<std::size_t>(columns), 0.0),
        scrap(2 * static_cast<std::size_t>(columns));
#pragma omp for schedule(static)
    for (int b = 0; b < bands; ++b) {
      for (int r = std::max(0, b * band - 1); r < std::min(rows, (b + 1) * band); ++r) {
        double most = 0, open = 0;
        int at = -1;
        const bool outside = r < b * band;  // only its forces on the first row of the band are wanted
        const auto here = static_cast<std::size_t>(r % 2) * 6 * static_cast<std::size_t>(columns);
        const auto below = static_cast<std::size_t>((r + 1) % 2) * 6 * static_cast<std::size_t>(columns);
        const auto start = static_cast<std::size_t>(r) * static_cast<std::size_t>(columns);
        std::fill_n(buffer.begin() + static_cast<std::ptrdiff_t>(here), 6 * static_cast<std::size_t>(columns), 0.0);
        for (int d = 0; d < 3; ++d) {
          const Lattice::Line line = s.lattice.line(r, d);
          const auto base = static_cast<std::size_t>(d) * n + start;
          double* fx = buffer.data() + here + static_cast<std::size_t>(2 * d) * static_cast<std::size_t>(columns);
          const SpringLine springs{s.x.data() + start,
                                   s.y.data() + start,
                                   s.radius.data() + start,
                                   s.stiffness.data() + base,
                                   s.joined.data() + base,
                                   outside ? scrap.data() : f.tension.data() + base,
                                   outside ? scrap.data() + columns : f.length.data() + base,
                                   fx,
                                   fx + columns};
          const int row_start = r * columns;
          const double top = force_line(springs, line.begin - row_start, line.end - row_start, line.offset);
          most = std::max(most, top);
        }
        if (outside) continue;
        const bool shifted = s.lattice.shifted(r);
        const auto own = [&](int d, int c) {
          return buffer[here + static_cast<std::size_t>(d) * static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(c)];
        };
        const auto lower = [&](int d, int c) {
          return buffer[below + static_cast<std::size_t>(d) * static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(c)];
        };
        for (int c = 0; c < columns; ++c) {
          const int sw = shifted ? c : c - 1, se = shifted ? c + 1 : c;
          double fx = (own(0, c) + own(2, c)) + own(4, c), fy = (own(1, c) + own(3, c)) + own(5, c);
          if (c > 0) fx -= own(0, c - 1), fy -= own(1, c - 1);
          if (r > 0 && sw >= 0) fx -= lower(2, sw), fy -= lower(3, sw);
          if (r > 0 && se < columns) fx -= lower(4, se), fy -= lower(5, se);
          const auto i = start + static_cast<std::size_t>(c);
          f.x[i] = fx;
          f.y[i] = fy;
          const double free_x = (s.fixed[i] & 1) ? 0.0 : std::fabs(fx), free_y = (s.fixed[i] & 2) ? 0.0 : std::fabs(fy);
          const double size = std::max(free_x, free_y);
          if (size > open) open = size, at = static_cast<int>(i);
        }
        f.rows[static_cast<std::size_t>(r)] = {most, open, at};
      }
    }
  }
  sum_up(f);
}

void update_springs(const Sheet& s, Forces& f, const LatticeBox& box) {
  const int columns = s.lattice.columns, n = s.particles();
  const int r0 = std::max(0, box.r0 - 1), r1 = std::min(s.lattice.rows, box.r1 + 1);
  const int c0 = std::max(0, box.c0 - 1), c1 = std::min(columns, box.c1 + 1);
  const auto inside = [&](int i) {
    const int c = i % columns, r = i / columns;
    return c >= box.c0 && c < box.c1 && r >= box.r0 && r < box.r1;
  };
  const auto slot_of = [&](int i, int direction, int j) {
    return static_cast<std::size_t>(direction < 3 ? direction * n + i : (direction - 3) * n + j);
  };
  for (int r = r0; r < box.r1; ++r) {
    for (int i = r * columns + c0; i < r * columns + c1; ++i) {
      const bool here = inside(i);
      for (int d = 0; d < 3; ++d) {
        const int j = s.lattice.neighbour(i, d);
        if (j < 0 || (!here && !inside(j))) continue;
        const auto k = slot_of(i, d, j), p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
        const double dx = s.x[q] - s.x[p], dy = s.y[q] - s.y[p];
        const double length = std::sqrt(dx * dx + dy * dy);
        const double tension = s.stiffness[k] * (length - (s.radius[p] + s.radius[q]));
        f.length[k] = length;
        f.tension[k] = (s.joined[k] == 0 && tension > 0) ? 0.0 : tension;
      }
    }
  }
  for (int r = r0; r < r1; ++r) {
    for (int i = r * columns + c0; i < r * columns + c1; ++i) {
      const auto p = static_cast<std::size_t>(i);
      double fx = 0, fy = 0;
      for (int d = 0; d < 6; ++d) {
        const int j = s.lattice.neighbour(i, d);
        if (j < 0) continue;
        const auto k = slot_of(i, d, j), q = static_cast<std::size_t>(j);
        const double per_length = f.tension[k] / f.length[k];
        fx += per_length * (s.x[q] - s.x[p]);
        fy += per_length * (s.y[q] - s.y[p]);
      }
      f.x[p] = fx;
      f.y[p] = fy;
    }
  }
}

void sum_up(const Sheet& s, Forces& f, const LatticeBox& box) {
  for (int r = std::max(0, box.r0 - 1); r < std::min(s.lattice.rows, box.r1 + 1); ++r) {
    f.rows[static_cast<std::size_t>(r)] = look_along(s, f, r);
  }
  sum_up(f);
}

void update_forces(const Sheet& s, Forces& f, const LatticeBox& box) {
  update_springs(s, f, box);
  sum_up(s, f, box);
}

double elastic_energy(const Sheet& s, const Forces& f) {
  double total = 0;
  for (std::size_t slot = 0; slot < f.tension.size(); ++slot) {
    if (s.stiffness[slot] > 0) total += 0.5 * f.tension[slot] * f.tension[slot] / s.stiffness[slot];
  }
  return total;
}

Critical most_critical(const Sheet& s, const Forces& f, int threads) {
  const auto n = static_cast<std::size_t>(s.particles());
  const auto columns = static_cast<std::size_t>(s.lattice.columns);
  const int lines = 3 * s.lattice.rows;
  const auto ratio = [&](std::size_t slot) {
    if (!s.joined[slot] || f.tension[slot] <= 0) return 0.0;
    const double rest = f.length[slot] - f.tension[slot] / s.stiffness[slot];
    return f.tension[slot] / (rest * s.threshold[slot]);
  };
  std::vector<double> most(static_cast<std::size_t>(lines));
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int line = 0; line < lines; ++line) {
    const auto begin = static_cast<std::size_t>(line) * columns;
    double top = 0;
    for (std::size_t slot = begin; slot < begin + columns; ++slot) top = std::max(top, ratio(slot));
    most[static_cast<std::size_t>(line)] = top;
  }
  Critical found;
  const double top = *std::max_element(most.begin(), most.end());
  if (top <= 0) return found;
  const double tied = top * (1 - 1e-6);
  for (std::size_t line = 0; line < most.size(); ++line) {
    if (most[line] < std::min(tied, top * 0.9)) continue;
    for (std::size_t slot = line * columns; slot < std::min((line + 1) * columns, 3 * n); ++slot) {
      const double value = ratio(slot);
      if (value >= tied && found.slot < 0) {
        found.slot = static_cast<int>(slot);
        found.ratio = value;
      } else {
        found.next = std::max(found.next, value);
      }
    }
  }
  return found;
}

Stress particle_stress(const Sheet& s, const Forces& f) {
  const auto n = static_cast<std::size_t>(s.particles());
  Stress stress{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  const double area = 2 * std::numbers::sqrt3 * s.radius0 * s.radius0;
  for (int slot = 0; slot < s.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (s.stiffness[k] <= 0 || f.tension[k] == 0) continue;
    const auto i = static_cast<std::size_t>(s.first(slot)), j = static_cast<std::size_t>(s.second(slot));
    const double dx = s.x[j] - s.x[i], dy = s.y[j] - s.y[i];
    const double half = 0.5 * f.tension[k] / (f.length[k] * area);
    for (const auto p : {i, j}) {
      stress.xx[p] += half * dx * dx;
      stress.yy[p] += half * dy * dy;
      stress.xy[p] += half * dx * dy;
    }
  }
  return stress;
}

Extent extent(const Sheet& s) {
  // Side walls zigzag: their mean line is the mean of their particles. Rows alternate, so both sides average alike.
  const int rows = s.lattice.rows, columns = s.lattice.columns;
  double left = 0, right = 0;
  for (int r = 0; r < rows; ++r) {
    left += s.x[static_cast<std::size_t>(r * columns)];
    right += s.x[static_cast<std::size_t>(r * columns + columns - 1)];
  }
  return {(right - left) / rows, s.y[static_cast<std::size_t>((rows - 1) * columns)] - s.y[0]};
}

WallStress wall_stress(const Sheet& s, const Forces& f) {
  const int rows = s.lattice.rows, columns = s.lattice.columns;
  double left = 0, right = 0, bottom = 0, top = 0;
  for (int r = 0; r < rows; ++r) {
    left += f.x[static_cast<std::size_t>(r * columns)];
    right += f.x[static_cast<std::size_t>(r * columns + columns - 1)];
  }
  for (int c = 0; c < columns; ++c) {
    bottom += f.y[static_cast<std::size_t>(c)];
    top += f.y[static_cast<std::size_t>((rows - 1) * columns + c)];
  }
  const Extent size = extent(s);
  // Springs pull the left wall to the right when the sheet is in tension.
  return {0.5 * (left - right) / size.y, 0.5 * (bottom - top) / size.x};
}

}  // namespace dem::sheet
