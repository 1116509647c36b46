// A sheet that jumps from one equilibrium to another amid a load step: the energy that it loses is found and accounted
// for. The sheet is a shallow arch (a toggle of von Mises): two springs, from an apex to two feet on one line, pushed
// through that line by a third, soft one.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/sheet/experiment.h"
#include "engine/sheet/patch.h"
#include "sheet_reference.h"

namespace {

using namespace dem::sheet;

constexpr double rise = 0.05, half_span = 0.2, reach = 0.2, soft = 0.02;  // box widths; k = 1 for the arch
constexpr double step = 0.005;
constexpr int steps = 120;

int slot_between(const Sheet& s, int a, int b) {
  for (int slot = 0; slot < s.slots(); ++slot) {
    const int i = s.first(slot), j = s.second(slot);
    if ((i == a && j == b) || (i == b && j == a)) return slot;
  }
  return -1;
}

// Apex in the middle of 3 x 3 particles, feet above and below it, the pusher beside it. All but the apex are held. One
// more spring, between held particles, breaks at once: only then are parts of a load step looked at.
Sheet arch() {
  Sheet s = make_sheet(3, 3, 1.0);
  const int apex = 4, below = 1, above = 7, pusher = 5, idle = 0, other = 3;
  for (std::size_t i = 0; i < s.x.size(); ++i) s.fixed[i] = static_cast<int>(i) == apex ? 0 : 3;
  s.stiffness.assign(s.stiffness.size(), 0.0);
  s.joined.assign(s.joined.size(), 0);
  s.threshold.assign(s.threshold.size(), std::numeric_limits<double>::infinity());
  const double middle = s.y[4];
  const auto place = [&](int i, double x, double y, double radius) {
    const auto k = static_cast<std::size_t>(i);
    s.x[k] = x, s.y[k] = y, s.radius[k] = radius;
  };
  const double small = 0.01, length = std::hypot(rise, half_span);
  place(apex, 0.5 + rise, middle, small);
  place(below, 0.5, middle - half_span, length - small);
  place(above, 0.5, middle + half_span, length - small);
  place(pusher, 0.5 + rise + reach, middle, reach - small);
  const auto join = [&](int a, int b, double stiffness) {
    const int slot = slot_between(s, a, b);
    REQUIRE(slot >= 0);
    s.stiffness[static_cast<std::size_t>(slot)] = stiffness;
    s.joined[static_cast<std::size_t>(slot)] = 1;
    return static_cast<std::size_t>(slot);
  };
  join(apex, below, 1);
  join(apex, above, 1);
  join(apex, pusher, soft);
  s.radius[idle] = s.radius[other] = 0.01;
  s.threshold[join(idle, other, 1e-12)] = 1e-15;  // and next to no energy
  return s;
}

struct Path {
  double jumped = 0;
  int jumps = 0;
};

// The same in one dimension: the place u of the apex where its force vanishes, followed in small moves of the pusher.
Path follow_arch() {
  const double length = std::hypot(rise, half_span);
  const auto energy = [&](double u, double p) {
    const double stretch = std::hypot(u, half_span) - length, squeeze = p - u - reach;
    return stretch * stretch + 0.5 * soft * squeeze * squeeze;
  };
  const auto force = [&](double u, double p) {
    const double now = std::hypot(u, half_span);
    return -2 * (now - length) * u / now + soft * (p - u - reach);
  };
  Path path;
  double u = rise;
  const double start = rise + reach, end = start * std::pow(1 - step, steps);
  constexpr int moves = 20000;
  for (int m = 1; m <= moves; ++m) {
    const double p = start + (end - start) * m / moves, from = u, before = energy(u, p);
    for (int iteration = 0; iteration < 100000 && std::fabs(force(u, p)) > 1e-14; ++iteration) u += 0.5 * force(u, p);
    if (std::fabs(u - from) > 0.01) ++path.jumps, path.jumped += before - energy(u, p);
  }
  return path;
}

Loading push(double work_tolerance) {
  Loading loading;
  loading.kind = LoadingKind::compression;
  loading.step = step;
  loading.steps = steps;
  loading.work_tolerance = work_tolerance;
  return loading;
}

}  // namespace

TEST_CASE("the energy of a jump is found: a shallow arch that snaps through") {
  const Path expected = follow_arch();
  REQUIRE(expected.jumps == 1);
  Sheet sheet = arch();
  ConvergedSolver solver(sheet, {});
  Experiment experiment(sheet, solver, push(3e-6), 1);
  experiment.run();
  const ExperimentState& state = experiment.state();
  CHECK(state.equilibrium.missed == 0);
  CHECK(state.step == steps);
  CHECK(state.jumps == 1);
  CHECK(state.jumped == doctest::Approx(expected.jumped).epsilon(1e-3));
  CHECK(experiment.energy_residual() <= 1e-5);
  CHECK(sheet.x[4] < 0.5);  // it went through
}

TEST_CASE("parts of a load step that are not halved lose that energy, and the account shows it") {
  Sheet sheet = arch();
  ConvergedSolver solver(sheet, {});
  Experiment experiment(sheet, solver, push(0), 1);
  experiment.run();
  CHECK(experiment.state().jumps == 0);
  CHECK(experiment.state().jumped == 0);
  CHECK(experiment.energy_residual() > 1e-2);
}

TEST_CASE("a run that is cut amid a load step goes on as if it had not been") {
  const auto end = [](bool cut) {
    Sheet sheet = arch();
    ConvergedSolver solver(sheet, {});
    Experiment experiment(sheet, solver, push(3e-6), 1);
    experiment.run([&](const Experiment& e) { return !cut || e.state().jumps == 0; });
    if (!cut) return experiment.snapshot();
    CHECK_FALSE(experiment.between_steps());
    const ExperimentState kept = experiment.snapshot();
    Sheet again = arch();
    ConvergedSolver other(again, {});
    Experiment resumed(again, other, push(3e-6), 1);
    resumed.restore(kept);
    other.restore(again, solver.state());
    resumed.run();
    return resumed.snapshot();
  };
  const ExperimentState whole = end(false), parts = end(true);
  CHECK(whole.x == parts.x);
  CHECK(whole.jumped == parts.jumped);
  CHECK(whole.boundary_work == parts.boundary_work);
}

TEST_CASE("damped dynamics finds the equilibrium that Newton's steps find, where springs are broken as well") {
  Sheet start = reference::polycrystal(40);
  for (std::size_t slot = 100; slot < 400; slot += 7) start.joined[slot] = 0;
  for (std::size_t i = 0; i < start.x.size(); ++i) start.x[i] = 0.5 + (start.x[i] - 0.5) * 1.002;
  Sheet newton = start, dynamics = start;
  Forces forces;
  ConvergedSolver solver(newton, {});
  REQUIRE(solver.relax(newton, forces, {}).reached);
  compute_forces(dynamics, forces, 1);
  const double energy = elastic_energy(dynamics, forces), open = forces.unbalanced;
  Patches::settle(dynamics, forces, {0, dynamics.lattice.columns, 0, dynamics.lattice.rows}, 1e-10 * forces.largest);
  CHECK(open > 1e-3 * forces.largest);
  CHECK(forces.unbalanced <= 1e-10 * forces.largest);
  CHECK(elastic_energy(dynamics, forces) < energy);
  double apart = 0;
  for (std::size_t i = 0; i < start.x.size(); ++i)
    apart = std::max({apart, std::fabs(newton.x[i] - dynamics.x[i]), std::fabs(newton.y[i] - dynamics.y[i])});
  CHECK(apart <= 1e-5 * start.radius0);
}

TEST_CASE("damped dynamics in a box leaves what lies outside where it was") {
  Sheet sheet = reference::polycrystal(40);
  for (std::size_t i = 0; i < sheet.x.size(); ++i) sheet.x[i] = 0.5 + (sheet.x[i] - 0.5) * 1.002;
  const Sheet before = sheet;
  Forces forces;
  compute_forces(sheet, forces, 1);
  const LatticeBox box{10, 30, 12, 28};
  const double small = 1e-9 * forces.largest;
  Patches::settle(sheet, forces, box, small);
  double moved = 0;
  for (int i = 0; i < sheet.particles(); ++i) {
    const auto p = static_cast<std::size_t>(i);
    const int c = i % sheet.lattice.columns, r = i / sheet.lattice.columns;
    if (c >= box.c0 && c < box.c1 && r >= box.r0 && r < box.r1) {
      moved = std::max(moved, std::fabs(sheet.x[p] - before.x[p]));
      CHECK(std::max(std::fabs(forces.x[p]), std::fabs(forces.y[p])) <= small);
    } else {
      REQUIRE(sheet.x[p] == before.x[p]);
      REQUIRE(sheet.y[p] == before.y[p]);
    }
  }
  CHECK(moved > 0);
  Forces again;
  compute_forces(sheet, again, 1);
  CHECK(again.x == forces.x);  // forces are those of the result
}
