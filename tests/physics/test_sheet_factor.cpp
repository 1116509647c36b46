// The nested-dissection factor and its low-rank changes against the matrix itself.
#include <doctest/doctest.h>

#include <cmath>

#include "engine/core/random.h"
#include "engine/sheet/modified.h"
#include "engine/sheet/stiffness.h"

namespace {

using namespace dem::sheet;

// b - K u, in elimination order, zero along held directions.
std::vector<double> residual(const Sheet& s, const Forces& f, const Dissection& d, const std::vector<double>& u,
                             const std::vector<double>& b) {
  const auto n = s.x.size();
  std::vector<double> vx(n), vy(n), kx(n), ky(n);
  for (std::size_t at = 0; at < n; ++at) {
    const auto i = static_cast<std::size_t>(d.order[at]);
    vx[i] = u[2 * at], vy[i] = u[2 * at + 1];
  }
  TangentOperator tangent(1);
  tangent.update(s, f);
  tangent.apply(vx, vy, kx, ky);
  std::vector<double> left(2 * n);
  for (std::size_t at = 0; at < n; ++at) {
    const auto i = static_cast<std::size_t>(d.order[at]);
    left[2 * at] = (s.fixed[i] & 1) ? 0 : b[2 * at] - kx[i];
    left[2 * at + 1] = (s.fixed[i] & 2) ? 0 : b[2 * at + 1] - ky[i];
  }
  return left;
}

double largest(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::fabs(x));
  return most;
}

// What each of some solves, one after the other, leaves of a random load.
std::vector<double> refine(const Sheet& s, const Forces& f, ModifiedFactor& factor, const std::vector<double>& b,
                           int solves) {
  std::vector<double> u(b.size(), 0.0), left = b, shares;
  for (int k = 0; k < solves; ++k) {
    factor.solve(left);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += left[i];
    left = residual(s, f, factor.factor().dissection(), u, b);
    shares.push_back(largest(left) / largest(b));
  }
  return shares;
}

std::vector<double> random_load(const Sheet& s, const Dissection& d) {
  dem::RandomStream random(3, dem::Purpose::test_data);
  std::vector<double> b(2 * s.x.size());
  for (std::size_t at = 0; at < s.x.size(); ++at) {
    const auto fixed = s.fixed[static_cast<std::size_t>(d.order[at])];
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    b[2 * at] = (fixed & 1) ? 0 : x;
    b[2 * at + 1] = (fixed & 2) ? 0 : y;
  }
  return b;
}

// Takes a whole spring out of the sheet and the factor; returns the coefficient that was applied.
double remove(Sheet& s, const Forces& f, ModifiedFactor& factor, int slot) {
  const auto at = static_cast<std::size_t>(slot);
  const auto i = static_cast<std::size_t>(s.first(slot)), j = static_cast<std::size_t>(s.second(slot));
  s.joined[at] = 0;
  return factor.change(-s.stiffness[at], s.first(slot), s.second(slot),
                       {(s.x[j] - s.x[i]) / f.length[at], (s.y[j] - s.y[i]) / f.length[at]}, s.fixed);
}

}  // namespace

TEST_CASE("a dissection orders every particle once, children before parents") {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {5, 3}, {17, 40}, {64, 9}}) {
    const Dissection d(Lattice{columns, rows, true});
    CHECK(d.order.size() == static_cast<std::size_t>(columns * rows));
    for (std::size_t p = 0; p < d.order.size(); ++p) {
      CHECK(d.position[static_cast<std::size_t>(d.order[p])] == static_cast<int>(p));
    }
    for (std::size_t k = 0; k + 1 < d.nodes.size(); ++k) CHECK(d.nodes[k].parent > static_cast<int>(k));
  }
}

TEST_CASE("a solve meets its load to sixteen bits, and refined ones to single precision and beyond") {
  Sheet s = make_sheet(45, 52);
  Forces f;
  compute_forces(s, f, 1);
  const Dissection d(s.lattice);
  ModifiedFactor factor(d, 1);
  CHECK(factor.factorise(assemble(s, f)) == 0);
  const auto left = refine(s, f, factor, random_load(s, d), 3);
  CHECK(left[0] < 1e-3);
  CHECK(left[2] < 1e-9);
}

TEST_CASE("changes follow broken springs: the changed factor solves the changed matrix") {
  Sheet s = make_sheet(45, 52);
  Forces f;
  compute_forces(s, f, 1);
  const Dissection d(s.lattice);
  ModifiedFactor factor(d, 1);
  factor.factorise(assemble(s, f));
  dem::RandomStream random(5, dem::Purpose::test_data);
  for (int k = 0; k < 40; ++k) {
    const int slot = static_cast<int>(random.below(static_cast<std::uint64_t>(s.slots())));
    const auto at = static_cast<std::size_t>(slot);
    if (!s.joined[at]) continue;
    const double c = remove(s, f, factor, slot);
    CHECK(c == -s.stiffness[at]);
    compute_forces(s, f, 1);
    // At rest a broken pair neither pulls nor presses: its tension is exactly or nearly nothing.
    f.tension[at] = 0;
  }
  for (int slot = 0; slot < s.slots(); ++slot) {
    if (!s.joined[static_cast<std::size_t>(slot)]) f.tension[static_cast<std::size_t>(slot)] = 0;
  }
  CHECK(factor.changes() > 30);
  const auto left = refine(s, f, factor, random_load(s, d), 3);
  CHECK(left[0] < 1e-3);
  CHECK(left[2] < 1e-9);
}

TEST_CASE("cutting a particle loose leaves a factor that still solves") {
  Sheet s = make_sheet(20, 22);
  Forces f;
  compute_forces(s, f, 1);
  const Dissection d(s.lattice);
  ModifiedFactor factor(d, 1);
  factor.factorise(assemble(s, f));
  const int particle = 11 * 20 + 10;
  bool weakened = false;
  for (int direction = 0; direction < 6; ++direction) {
    const int other = s.lattice.neighbour(particle, direction);
    const int slot = direction < 3 ? direction * s.particles() + particle : (direction - 3) * s.particles() + other;
    const double c = remove(s, f, factor, slot);
    weakened = weakened || c != -1;
  }
  CHECK(weakened);  // the last springs hold it alone: they may not vanish from the factor
  std::vector<double> u(2 * s.x.size(), 0.0);
  u[2 * static_cast<std::size_t>(d.position[static_cast<std::size_t>(particle)])] = 1;
  factor.solve(u);
  for (const double v : u) CHECK(std::isfinite(v));
}

TEST_CASE("a crushed zone, every spring of many particles removed, leaves numbers in the factor, and is told") {
  Sheet s = make_sheet(20, 22);
  Forces f;
  compute_forces(s, f, 1);
  const Dissection d(s.lattice);
  ModifiedFactor factor(d, 1);
  factor.factorise(assemble(s, f));
  for (int slot = 0; slot < s.slots(); ++slot) {
    if (s.stiffness[static_cast<std::size_t>(slot)] <= 0) continue;
    const int column = s.first(slot) % 20, row = s.first(slot) / 20;
    if (column < 7 || column > 12 || row < 8 || row > 13) continue;
    remove(s, f, factor, slot);
  }
  CHECK(factor.changes() == 108);
  CHECK(factor.weakened() > 30);  // the solver makes a new factor long before
  std::vector<double> u(2 * s.x.size(), 0.0);
  u[2 * static_cast<std::size_t>(d.position[11 * 20 + 10])] = 1;
  factor.solve(u);
  for (const double v : u) CHECK(std::isfinite(v));
}

TEST_CASE("partial Cholesky raises pivots that have lost their stiffness") {
  // Two pairs, the first without stiffness against the second. Columns from the diagonal down.
  float panel[10] = {2, -2, 0, 0, 2, 0, 0, 1, 0, 1};
  const float diagonal[4] = {2, 2, 1, 1};
  CHECK(partial_cholesky({panel, 4, 4}, {}, diagonal, {}) == 0);
  CHECK(panel[4] == doctest::Approx(std::sqrt(2e-3)));
  float b[3] = {2, -3, 2};  // a direction of negative stiffness is told
  CHECK(partial_cholesky({b, 2, 2}, {}, diagonal, {}) == 1);
}

TEST_CASE("a factor made anew in parts has the bits of one made as a whole") {
  Sheet s = make_sheet(90, 104);
  Forces f;
  compute_forces(s, f, 1);
  const Dissection d(s.lattice);
  Factor parts(d, 1, Factor::Again::parts), whole(d, 1);
  parts.factorise(assemble(s, f));
  std::vector<std::uint8_t> stale(d.nodes.size(), 0);
  for (const int slot : {50 * 90 + 31, s.particles() + 80 * 90 + 70, 2 * s.particles() + 3 * 90 + 88}) {
    s.stiffness[static_cast<std::size_t>(slot)] = 0.25;
    const int at = std::min(d.position[static_cast<std::size_t>(s.first(slot))],
                            d.position[static_cast<std::size_t>(s.second(slot))]);
    stale[static_cast<std::size_t>(d.node_of[static_cast<std::size_t>(at)])] = 1;
  }
  parts.close(stale);
  const BlockMatrix matrix = assemble(s, f);
  CHECK(parts.operations(stale) < 0.5 * parts.operations(std::vector<std::uint8_t>(stale.size(), 1)));
  parts.factorise(matrix, stale);
  whole.factorise(matrix);
  const auto load = random_load(s, d);
  std::vector<float> one(load.begin(), load.end()), other = one;
  const std::vector<std::uint8_t> active(d.nodes.size(), 1);
  parts.forward(one, active);
  parts.backward(one);
  whole.forward(other, active);
  whole.backward(other);
  CHECK(one == other);
}

TEST_CASE("one or several threads give the same factor") {
  Sheet s = make_sheet(120, 130);
  Forces f;
  compute_forces(s, f, 1);
  const Dissection d(s.lattice);
  const auto b = random_load(s, d);
  std::vector<double> one = b, three = b;
  ModifiedFactor first(d, 1), second(d, 3);
  first.factorise(assemble(s, f));
  second.factorise(assemble(s, f));
  first.solve(one);
  second.solve(three);
  CHECK(one == three);
}
