#include "sheet_reference.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "engine/sheet/grains.h"

namespace reference {
namespace {

using dem::sheet::Sheet;

struct Spring {
  int slot, i, j;
};

class Newton {
 public:
  explicit Newton(Sheet& sheet) : s_(sheet) {
    for (int slot = 0; slot < s_.slots(); ++slot) {
      if (s_.stiffness[static_cast<std::size_t>(slot)] > 0) springs_.push_back({slot, s_.first(slot), s_.second(slot)});
    }
  }

  double force(const Spring& p, double& nx, double& ny, double& d) const {
    const auto i = static_cast<std::size_t>(p.i), j = static_cast<std::size_t>(p.j),
               k = static_cast<std::size_t>(p.slot);
    nx = s_.x[j] - s_.x[i];
    ny = s_.y[j] - s_.y[i];
    d = std::hypot(nx, ny);
    nx /= d;
    ny /= d;
    const double f = s_.stiffness[k] * (d - s_.radius[i] - s_.radius[j]);
    return s_.joined[k] ? f : std::min(f, 0.0);
  }

  // Iterates to 1e-9 of the largest spring force; returns what was reached.
  double relax() {
    const auto n = 2 * static_cast<Eigen::Index>(s_.particles());
    double share = 0;
    for (int iteration = 0; iteration < 60; ++iteration) {
      Eigen::VectorXd r = Eigen::VectorXd::Zero(n);
      std::vector<Eigen::Triplet<double>> entries;
      double largest = 0;
      for (const Spring& p : springs_) {
        double nx, ny, d;
        const double f = force(p, nx, ny, d);
        largest = std::max(largest, std::fabs(f));
        const Eigen::Index a = 2 * p.i, b = 2 * p.j;
        r[a] += f * nx, r[a + 1] += f * ny, r[b] -= f * nx, r[b + 1] -= f * ny;
        const auto k = static_cast<std::size_t>(p.slot);
        const bool on = s_.joined[k] || f < 0;
        const double g = f / d, c = on ? s_.stiffness[k] - g : 0.0, h = on ? g : 0.0;
        const double m[3] = {c * nx * nx + h, c * nx * ny, c * ny * ny + h};
        const auto put = [&](Eigen::Index row, Eigen::Index column, double sign) {
          const double xx = sign * m[0], xy = sign * m[1], yy = sign * m[2];
          entries.emplace_back(row, column, xx);
          entries.emplace_back(row + 1, column + 1, yy);
          entries.emplace_back(row + 1, column, xy);
          entries.emplace_back(row, column + 1, xy);
        };
        put(a, a, 1), put(b, b, 1), put(a, b, -1), put(b, a, -1);
      }
      double most = 0;
      std::vector<std::uint8_t> held(static_cast<std::size_t>(n), 0);
      for (int i = 0; i < s_.particles(); ++i) {
        const auto fixed = s_.fixed[static_cast<std::size_t>(i)];
        if (fixed & 1) r[2 * i] = 0, held[static_cast<std::size_t>(2 * i)] = 1;
        if (fixed & 2) r[2 * i + 1] = 0, held[static_cast<std::size_t>(2 * i + 1)] = 1;
      }
      most = r.cwiseAbs().maxCoeff();
      share = most / largest;
      if (share <= 1e-9) break;
      for (auto& e : entries) {
        const bool drop = held[static_cast<std::size_t>(e.row())] || held[static_cast<std::size_t>(e.col())];
        if (drop) e = {e.row(), e.col(), 0.0};
      }
      // Held directions, and particles that nothing holds, get a stiffness of their own.
      for (Eigen::Index q = 0; q < n; ++q) entries.emplace_back(q, q, held[static_cast<std::size_t>(q)] ? 1.0 : 1e-9);
      Eigen::SparseMatrix<double> k(n, n);
      k.setFromTriplets(entries.begin(), entries.end());
      if (!analysed_) solver_.analyzePattern(k), analysed_ = true;
      solver_.factorize(k);
      Eigen::VectorXd u = solver_.solve(r);
      const double longest = 0.2 * s_.radius0, top = u.cwiseAbs().maxCoeff();
      if (top > longest) u *= longest / top;
      for (int i = 0; i < s_.particles(); ++i) {
        s_.x[static_cast<std::size_t>(i)] += u[2 * i];
        s_.y[static_cast<std::size_t>(i)] += u[2 * i + 1];
      }
    }
    return share;
  }

  int critical() const {
    int found = -1;
    double top = 1;
    for (const Spring& p : springs_) {
      const auto k = static_cast<std::size_t>(p.slot);
      if (!s_.joined[k]) continue;
      double nx, ny, d;
      const double f = force(p, nx, ny, d);
      const double rest = s_.radius[static_cast<std::size_t>(p.i)] + s_.radius[static_cast<std::size_t>(p.j)];
      const double ratio = f / rest / s_.threshold[k];
      if (ratio >= top) top = ratio, found = p.slot;
    }
    return found;
  }

  int contacts() const {
    int count = 0;
    for (const Spring& p : springs_) {
      double nx, ny, d;
      if (!s_.joined[static_cast<std::size_t>(p.slot)] && force(p, nx, ny, d) < 0) ++count;
    }
    return count;
  }

 private:
  Sheet& s_;
  std::vector<Spring> springs_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analysed_ = false;
};

}  // namespace

Sheet polycrystal(int columns, std::uint64_t seed, double spread) {
  using namespace dem::sheet;
  Sheet sheet = make_sheet(columns);
  VoronoiSettings grains;
  grains.seed = seed;
  grains.lloyd = 0;
  grains.periodic = false;
  const ElleMap map = voronoi_map(grains);
  DisorderSettings disorder;
  disorder.strength_spread = spread;
  apply_disorder(sheet, cover(map, sheet), std::vector<GrainProperties>(map.flynns.size()), disorder, seed);
  return sheet;
}

Run run(Sheet sheet, int breaks) {
  Run result;
  Newton newton(sheet);
  const double cy = 0.5 * (sheet.y.front() + sheet.y.back());
  for (int step = 1; static_cast<int>(result.slots.size()) < breaks; ++step) {
    for (std::size_t i = 0; i < sheet.x.size(); ++i) {
      sheet.x[i] = 0.5 + (sheet.x[i] - 0.5) * (1 / (1 - 0.001));
      sheet.y[i] = cy + (sheet.y[i] - cy) * (1 - 0.001);
    }
    result.worst = std::max(result.worst, newton.relax());
    for (int slot = newton.critical(); slot >= 0 && static_cast<int>(result.slots.size()) < breaks;
         slot = newton.critical()) {
      sheet.joined[static_cast<std::size_t>(slot)] = 0;
      result.slots.push_back(slot);
      result.steps.push_back(step);
      result.worst = std::max(result.worst, newton.relax());
      result.contacts = std::max(result.contacts, newton.contacts());
    }
  }
  return result;
}

}  // namespace reference
