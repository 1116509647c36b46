#include "engine/sheet/patch.h"

#include <algorithm>
#include <cmath>

#include "engine/sheet/dense.h"
#include "engine/sheet/stiffness.h"

namespace dem::sheet {
namespace {

constexpr int most_iterations = 10;
constexpr int side = 48, rim = 12;
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

  Local(const Lattice& lattice, int threads)
      : dissection(lattice), factor(dissection, threads), active(dissection.nodes.size(), 1) {
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

void Patches::relax(Sheet& sheet, Forces& forces, const LatticeBox& box, double small) {
  const Lattice lattice{box.c1 - box.c0, box.r1 - box.r0, sheet.lattice.shifted(box.r0)};
  auto& entry = shapes_[{lattice.columns, lattice.rows, lattice.first_row_shifted}];
  if (!entry) entry = std::make_shared<Local>(lattice, threads_);
  Local& local = *entry;
  const int n = lattice.particles();
  const auto global = [&](int i) {
    return static_cast<std::size_t>((box.r0 + i / lattice.columns) * sheet.lattice.columns + box.c0 +
                                    i % lattice.columns);
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
  double open = largest();
  bool stale = true;
  for (int iteration = 0; iteration < most_iterations && open > small; ++iteration) {
    const auto factorise = [&](Tangent tangent) {
      for (int i = 0; i < n; ++i) {
        const auto p = global(i);
        Block sum{0, 0, 0};
        double stiffest = 0;
        bool loose = false;
        for (int d = 0; d < 6; ++d) {
          const int j = sheet.lattice.neighbour(static_cast<int>(p), d);
          if (j < 0) continue;
          const int slot = slot_between(sheet, static_cast<int>(p), d, j);
          const Block b = tangent_block(sheet, forces, slot, tangent);
          for (std::size_t q = 0; q < 3; ++q) sum[q] += b[q];
          stiffest = std::max(stiffest, sheet.stiffness[static_cast<std::size_t>(slot)]);
          loose = loose || (sheet.stiffness[static_cast<std::size_t>(slot)] > 0 && !active(sheet, forces, slot));
          if (d < 3) local.matrix.coupling[static_cast<std::size_t>(d * n + i)] = {-b[0], -b[1], -b[2]};
        }
        hold(sum, stiffest, loose);
        local.matrix.diagonal[static_cast<std::size_t>(i)] = sum;
        local.matrix.fixed[static_cast<std::size_t>(i)] = sheet.fixed[p];
      }
      return local.factor.factorise(local.matrix);
    };
    if (stale && factorise(Tangent::exact) > 0) factorise(Tangent::stable);
    double most = 0;
    for (int at = 0; at < n; ++at) {
      const auto p = global(local.dissection.order[static_cast<std::size_t>(at)]);
      local.u[2 * static_cast<std::size_t>(at)] = (sheet.fixed[p] & 1) ? 0.0F : static_cast<float>(forces.x[p]);
      local.u[2 * static_cast<std::size_t>(at) + 1] = (sheet.fixed[p] & 2) ? 0.0F : static_cast<float>(forces.y[p]);
    }
    local.factor.forward(local.u, local.active);
    local.factor.backward(local.u);
    for (const float u : local.u) most = std::max(most, static_cast<double>(std::fabs(u)));
    if (!std::isfinite(dot(local.u.data(), local.u.data(), local.u.size()))) return;
    const double longest = longest_step * sheet.radius0;
    const double share = most > longest ? longest / most : 1.0;
    const auto step = [&](double part) {
      for (int at = 0; at < n; ++at) {
        const auto p = global(local.dissection.order[static_cast<std::size_t>(at)]);
        sheet.x[p] += part * static_cast<double>(local.u[2 * static_cast<std::size_t>(at)]);
        sheet.y[p] += part * static_cast<double>(local.u[2 * static_cast<std::size_t>(at) + 1]);
      }
      update_forces(sheet, forces, box);
    };
    step(share);
    const double now = largest();
    if (now > open) {  // a contact opened or closed, or a mechanism: leave it to the global search
      step(-share);
      return;
    }
    stale = now > 0.02 * open;
    open = now;
  }
}

}  // namespace dem::sheet
