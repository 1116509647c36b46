#include "engine/sheet/patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/sheet/dense.h"
#include "engine/sheet/stiffness.h"

namespace dem::sheet {
namespace {

constexpr int most_iterations = 40, most_attempts = 12;
constexpr int side = 48, rim = 12;
constexpr double enough = 1e-3;       // of the unbalanced force at first: the rim has as much by then
constexpr double longest_step = 0.2;  // of a particle radius

int slot_between(const Sheet& s, int i, int direction, int j) {
  return direction < 3 ? direction * s.particles() + i : (direction - 3) * s.particles() + j;
}

}  // namespace

struct Patches::Local {
  Dissection dissection;
  Factor factor;
  BlockMatrix matrix;
  std::vector<std::uint8_t> active;
  std::vector<float> u;

  explicit Local(const Lattice& lattice)
      : dissection(lattice), factor(dissection, 1), active(dissection.nodes.size(), 1) {
    const auto n = static_cast<std::size_t>(lattice.particles());
    matrix.diagonal.resize(n);
    matrix.coupling.resize(3 * n);
    matrix.fixed.resize(n);
    u.resize(2 * n);
  }
};

LatticeBox Patches::around(const Lattice& lattice, int column, int row) {
  const auto fit = [](int at, int all, int& begin, int& end) {
    const int length = std::min(side, all);
    begin = std::clamp(at - length / 2, 0, all - length);
    end = begin + length;
  };
  LatticeBox box;
  fit(column, lattice.columns, box.c0, box.c1);
  fit(row, lattice.rows, box.r0, box.r1);
  return box;
}

bool Patches::covers(const Lattice& lattice, const LatticeBox& box, int column, int row) {
  const auto inside = [](int at, int begin, int end, int all) {
    return at >= (begin > 0 ? begin + rim : 0) && at < (end < all ? end - rim : all);
  };
  return inside(column, box.c0, box.c1, lattice.columns) && inside(row, box.r0, box.r1, lattice.rows);
}

Patches::Shape Patches::shape_of(const Sheet& sheet, const LatticeBox& box) {
  return {box.c1 - box.c0, box.r1 - box.r0, sheet.lattice.shifted(box.r0)};
}

Patches::Local& Patches::local(const Shape& shape, std::size_t which) {
  auto& some = locals_[shape];
  const auto [columns, rows, shifted] = shape;
  while (some.size() <= which) some.push_back(std::make_shared<Local>(Lattice{columns, rows, shifted}));
  return *some[which];
}

void Patches::relax(Sheet& sheet, Forces& forces, std::span<const LatticeBox> boxes, double small) {
  const auto apart = [](const LatticeBox& a, const LatticeBox& b) {
    constexpr int gap = 2;  // the particles next to a box feel its springs
    return a.c1 + gap <= b.c0 || b.c1 + gap <= a.c0 || a.r1 + gap <= b.r0 || b.r1 + gap <= a.r0;
  };
  for (std::size_t begin = 0; begin < boxes.size();) {
    std::size_t end = begin;
    std::map<Shape, std::size_t> taken;
    std::vector<Local*> locals;
    while (end < boxes.size() && std::all_of(boxes.begin() + static_cast<std::ptrdiff_t>(begin),
                                             boxes.begin() + static_cast<std::ptrdiff_t>(end),
                                             [&](const LatticeBox& other) { return apart(other, boxes[end]); })) {
      const Shape shape = shape_of(sheet, boxes[end]);
      locals.push_back(&local(shape, taken[shape]++));
      ++end;
    }
    // Side by side, or one with all threads.
    const bool alone = locals.size() == 1;
    for (Local* each : locals) each->factor.set_threads(alone ? threads_ : 1);
    if (alone) {
      relax(sheet, forces, boxes[begin], small, *locals.front());
    } else {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
      for (std::size_t k = begin; k < end; ++k) relax(sheet, forces, boxes[k], small, *locals[k - begin]);
    }
    begin = end;
  }
  for (const LatticeBox& box : boxes) sum_up(sheet, forces, box);
}

void Patches::relax(Sheet& sheet, Forces& forces, const LatticeBox& box, double small, Local& local) {
  const int columns = box.c1 - box.c0, n = columns * (box.r1 - box.r0);
  const auto global = [&](int i) {
    return static_cast<std::size_t>((box.r0 + i / columns) * sheet.lattice.columns + box.c0 + i % columns);
  };
  const auto inside = [&](int particle) {  // its index in the box, or -1
    const int c = particle % sheet.lattice.columns - box.c0, r = particle / sheet.lattice.columns - box.r0;
    return c >= 0 && c < columns && r >= 0 && r < box.r1 - box.r0 ? r * columns + c : -1;
  };
  const auto largest = [&] {
    double most = 0;
    for (int i = 0; i < n; ++i) {
      const auto p = global(i);
      if (!(sheet.fixed[p] & 1)) most = std::max(most, std::fabs(forces.x[p]));
      if (!(sheet.fixed[p] & 2)) most = std::max(most, std::fabs(forces.y[p]));
    }
    return most;
  };
  const auto factorise = [&](Tangent tangent) {
    for (int i = 0; i < n; ++i) {
      const auto p = static_cast<int>(global(i));
      for (int d = 0; d < 3; ++d) {
        if (sheet.lattice.neighbour(p, d) < 0) continue;
        const Block b = tangent_block(sheet, forces, d * sheet.particles() + p, tangent);
        local.matrix.coupling[static_cast<std::size_t>(d * n + i)] = {-b[0], -b[1], -b[2]};
      }
    }
    for (int i = 0; i < n; ++i) {
      const auto p = static_cast<int>(global(i));
      Block sum{0, 0, 0};
      double stiffest = 0;
      bool loose = false;
      for (int d = 0; d < 6; ++d) {
        const int j = sheet.lattice.neighbour(p, d);
        if (j < 0) continue;
        const int slot = slot_between(sheet, p, d, j), other = inside(j);
        if (d < 3 || other >= 0) {
          const Block& b = local.matrix.coupling[static_cast<std::size_t>(d < 3 ? d * n + i : (d - 3) * n + other)];
          for (std::size_t q = 0; q < 3; ++q) sum[q] -= b[q];
        } else {
          const Block b = tangent_block(sheet, forces, slot, tangent);
          for (std::size_t q = 0; q < 3; ++q) sum[q] += b[q];
        }
        stiffest = std::max(stiffest, sheet.stiffness[static_cast<std::size_t>(slot)]);
        loose = loose || (sheet.stiffness[static_cast<std::size_t>(slot)] > 0 && !active(sheet, forces, slot));
      }
      hold(sum, stiffest, loose);
      local.matrix.diagonal[static_cast<std::size_t>(i)] = sum;
      local.matrix.fixed[static_cast<std::size_t>(i)] = sheet.fixed[static_cast<std::size_t>(p)];
    }
    return local.factor.factorise(local.matrix);
  };
  std::vector<float>& u = local.u;  // load, then displacement, in elimination order; zero along held directions
  const auto each = [&](auto&& visit) {
    for (std::size_t at = 0; at < static_cast<std::size_t>(n); ++at) {
      visit(global(local.dissection.order[at]), u[2 * at], u[2 * at + 1]);
    }
  };
  const auto move = [&](double share) {
    each([&](std::size_t p, float ux, float uy) {
      sheet.x[p] += share * static_cast<double>(ux);
      sheet.y[p] += share * static_cast<double>(uy);
    });
    update_springs(sheet, forces, box);
  };
  const auto work = [&] {  // F . u
    double total = 0;
    each([&](std::size_t p, float ux, float uy) {
      if (!(sheet.fixed[p] & 1)) total += forces.x[p] * static_cast<double>(ux);
      if (!(sheet.fixed[p] & 2)) total += forces.y[p] * static_cast<double>(uy);
    });
    return total;
  };
  double open = largest();
  small = std::max(small, enough * open);
  bool stale = true;
  for (int iteration = 0; iteration < most_iterations && open > small; ++iteration) {
    if (stale && factorise(Tangent::exact) > 0) factorise(Tangent::stable);
    each([&](std::size_t p, float& ux, float& uy) {
      ux = (sheet.fixed[p] & 1) ? 0.0F : static_cast<float>(forces.x[p]);
      uy = (sheet.fixed[p] & 2) ? 0.0F : static_cast<float>(forces.y[p]);
    });
    local.factor.forward(u, local.active);
    local.factor.backward(u);
    if (!std::isfinite(dot(u.data(), u.data(), u.size()))) return;
    double most = 0;
    for (const float component : u) most = std::max(most, static_cast<double>(std::fabs(component)));
    const double limit = most > 0 ? longest_step * sheet.radius0 / most : 1.0, slope = work();
    // As in the global search, the energy falls along the step. It is lengthened where particles are held too firmly.
    double share = std::min(1.0, limit), gone = 0, now = open;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      move(share - gone);
      gone = share;
      now = largest();
      if (now < (share < 1 ? 0.9 : 0.5) * open) break;
      const double left = work();
      if (left > 0.3 * slope) {
        if (share >= limit) break;
        share = std::min(share * std::min(slope / std::max(slope - left, 1e-3 * slope), 10.0), limit);
      } else if (left >= -0.5 * std::fabs(slope)) {
        break;
      } else {
        share = std::clamp(share * slope / (slope - left), 0.1 * share, 0.7 * share);
      }
    }
    stale = now > 0.02 * open;
    open = now;
  }
}

void Patches::settle(Sheet& sheet, Forces& forces, const LatticeBox& box, double small) {
  struct Moving {
    std::size_t particle;
    double per_mass, vx, vy;
  };
  std::vector<Moving> all;
  for (int r = box.r0; r < box.r1; ++r) {
    for (int c = box.c0; c < box.c1; ++c) {
      const int p = r * sheet.lattice.columns + c;
      double stiffness = 0;  // as mass: no particle swings faster than the square root of two
      for (int d = 0; d < 6; ++d) {
        const int j = sheet.lattice.neighbour(p, d);
        if (j >= 0) stiffness += sheet.stiffness[static_cast<std::size_t>(slot_between(sheet, p, d, j))];
      }
      if (stiffness > 0) all.push_back({static_cast<std::size_t>(p), 1 / stiffness, 0, 0});
    }
  }
  constexpr int most_steps = 20000, worth = 1000, patience = 5;
  constexpr double first_step = 0.1, longest = 1.0,
                   steered = 0.1;  // of time; share of the velocity turned to the force
  double dt = first_step, steer = steered;
  double last = std::numeric_limits<double>::infinity();
  int downhill = 0;
  for (int step = 0; step < most_steps; ++step) {
    double power = 0, forces_squared = 0, velocity_squared = 0, open = 0;
    for (const Moving& m : all) {
      const double fx = (sheet.fixed[m.particle] & 1) ? 0.0 : forces.x[m.particle];
      const double fy = (sheet.fixed[m.particle] & 2) ? 0.0 : forces.y[m.particle];
      power += fx * m.vx + fy * m.vy;
      forces_squared += (fx * fx + fy * fy) * m.per_mass * m.per_mass;
      velocity_squared += m.vx * m.vx + m.vy * m.vy;
      open = std::max({open, std::fabs(fx), std::fabs(fy)});
    }
    if (open <= small) break;
    if (step % worth == 0) {  // as long as it gets anywhere
      if (open > 0.5 * last) break;
      last = open;
    }
    double keep = 0, turn = 0;  // velocity = keep velocity + turn force / mass
    if (power > 0) {
      keep = 1 - steer;
      turn = forces_squared > 0 ? steer * std::sqrt(velocity_squared / forces_squared) : 0;
      if (++downhill > patience) dt = std::min(1.1 * dt, longest), steer *= 0.99;
    } else {
      downhill = 0, dt *= 0.5, steer = steered;
    }
    double fastest = 0;
    for (Moving& m : all) {
      const double fx = (sheet.fixed[m.particle] & 1) ? 0.0 : forces.x[m.particle];
      const double fy = (sheet.fixed[m.particle] & 2) ? 0.0 : forces.y[m.particle];
      m.vx = keep * m.vx + (turn + dt) * m.per_mass * fx;
      m.vy = keep * m.vy + (turn + dt) * m.per_mass * fy;
      fastest = std::max({fastest, std::fabs(m.vx), std::fabs(m.vy)});
    }
    const double share = std::min(1.0, longest_step * sheet.radius0 / std::max(dt * fastest, 1e-300));
    for (const Moving& m : all) {
      sheet.x[m.particle] += share * dt * m.vx;
      sheet.y[m.particle] += share * dt * m.vy;
    }
    update_springs(sheet, forces, box);
  }
  sum_up(sheet, forces, box);
}

}  // namespace dem::sheet
