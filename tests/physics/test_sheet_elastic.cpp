// The uncracked sheet: elastic constants, patches of homogeneous strain, the growing disc.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "engine/sheet/experiment.h"
#include "engine/sheet/fractures.h"
#include "engine/sheet/patch.h"
#include "tests/support/near.h"

namespace {

using namespace dem::sheet;

double largest_strain(const Sheet& s, const Forces& f) {
  double most = 0;
  for (int slot = 0; slot < s.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (s.stiffness[k] <= 0) continue;
    most = std::max(most, f.tension[k] / s.stiffness[k] / (f.length[k] - f.tension[k] / s.stiffness[k]));
  }
  return most;
}

// Values here are small against one: doctest's Approx, whose margin has a floor of epsilon, would pass anything.
double off(double value, double expected) { return std::fabs(value / expected - 1); }

}  // namespace

TEST_CASE("E = 2k/sqrt(3) and nu = 1/3 from uniaxial strain and pure shear, with half-weight wall springs") {
  // Half the difference of stretching and compressing: what goes with the square of the strain drops out. The strain itself
  // is large enough for the tolerance of the solver to lie above the rounding of places.
  const double k = 1.7, e = 1e-6;
  const double young = 2 * k / std::numbers::sqrt3, nu = 1.0 / 3;
  for (const auto kind : {LoadingKind::extension, LoadingKind::pure_shear}) {
    double xx = 0, yy = 0, density = 0;
    for (const double sign : {1.0, -1.0}) {
      Sheet sheet = make_sheet(24, 28, 0.5);
      for (double& stiffness : sheet.stiffness) stiffness *= k;
      ConvergedSolver solver(sheet, {});
      Loading loading;
      loading.kind = kind;
      loading.step = sign * e;
      loading.steps = 1;
      Experiment experiment(sheet, solver, loading, 1);
      experiment.run();
      CHECK(experiment.state().equilibrium.missed == 0);
      const auto& s = experiment.state().samples.front();
      xx += 0.5 * sign * s.stress_xx;
      yy += 0.5 * sign * s.stress_yy;
      density += 0.5 * s.elastic / (sheet.width * sheet.height);
    }
    // Plane stress: sigma = E / (1 - nu^2) (eps + nu eps_other)
    const double c = young / (1 - nu * nu);
    const double ex = e, ey = kind == LoadingKind::pure_shear ? -e : 0.0;
    CHECK(off(xx, c * (ex + nu * ey)) < 1e-6);
    CHECK(off(yy, c * (ey + nu * ex)) < 1e-6);
    if (kind == LoadingKind::extension) {
      const double ratio = yy / xx;
      CHECK(off(ratio, nu) < 1e-6);
      CHECK(off(xx / e * (1 - ratio * ratio), young) < 1e-6);
    }
    CHECK(off(density, 0.5 * (xx * ex + yy * ey)) < 1e-5);
  }
}

TEST_CASE("whole wall springs make the sheet stiffer by about one over the columns") {
  const auto stress = [](double weight) {
    Sheet sheet = make_sheet(40, 46, weight);
    ConvergedSolver solver(sheet, {});
    Loading loading;
    loading.kind = LoadingKind::extension;
    loading.step = 1e-6;
    loading.steps = 1;
    Experiment experiment(sheet, solver, loading, 1);
    experiment.run();
    return experiment.state().samples.front().stress_xx;
  };
  const double excess = stress(1.0) / stress(0.5) - 1;
  CHECK(excess > 0.2 / 40);
  CHECK(excess < 2.0 / 40);
}

TEST_CASE("particles away from walls feel the stress of the walls") {
  Sheet sheet = make_sheet(30, 34, 0.5);
  ConvergedSolver solver(sheet, {});
  Loading loading;
  loading.step = 1e-6;
  loading.steps = 1;
  Experiment experiment(sheet, solver, loading, 1);
  experiment.run();
  const Stress stress = particle_stress(sheet, experiment.forces());
  const WallStress wall = wall_stress(sheet, experiment.forces());
  const auto middle = static_cast<std::size_t>(17 * 30 + 15);
  CHECK(off(stress.xx[middle], wall.xx) < 1e-4);
  CHECK(off(stress.yy[middle], wall.yy) < 1e-4);
  CHECK(std::fabs(stress.xy[middle]) < 1e-6 * std::fabs(wall.xx));
}

TEST_CASE("a disc that grows by 0.2 % strains the sheet as converged computations say") {
  const std::pair<int, double> expected[] = {{50, 1.08e-3}, {100, 1.20e-3}, {200, 1.30e-3}, {400, 1.40e-3}};
  for (const auto& [columns, strain] : expected) {
    Sheet sheet = make_sheet(columns);
    // The middle is half a width from the first particle, as in the computations set beside: which particles the edge
    // takes in changes the largest strain by up to a tenth.
    const double x = sheet.x[0] + 0.5, y = sheet.y[0] + 0.5;
    for (int i = 0; i < sheet.particles(); ++i) {
      const auto p = static_cast<std::size_t>(i);
      if (std::hypot(sheet.x[p] - x, sheet.y[p] - y) < 0.1) sheet.radius[p] *= 1.002;
    }
    ConvergedSolver solver(sheet, {});
    Forces forces;
    const Relaxation r = solver.relax(sheet, forces, {});
    CHECK(r.reached);
    CAPTURE(columns);
    CHECK(off(largest_strain(sheet, forces), strain) < 0.01);
    MESSAGE(columns << " columns: largest strain " << largest_strain(sheet, forces));
  }
}

TEST_CASE("a fragment that nothing holds does not keep the sheet from its equilibrium") {
  // All springs around a square of 7 by 7 particles are cut: it may lie anywhere in its hole, and its stiffness against
  // being moved is nothing. The walls go on to move by ten times the strain of a break.
  Sheet sheet = make_sheet(60);
  const auto inside = [&](int i) {
    const int c = i % 60, r = i / 60;
    return c >= 27 && c < 34 && r >= 30 && r < 37;
  };
  for (int slot = 0; slot < sheet.slots(); ++slot) {
    if (sheet.stiffness[static_cast<std::size_t>(slot)] > 0 && inside(sheet.first(slot)) != inside(sheet.second(slot)))
      sheet.joined[static_cast<std::size_t>(slot)] = 0;
  }
  ConvergedSolver solver(sheet, {});
  Forces forces;
  for (int step = 0; step < 10; ++step) {
    for (std::size_t i = 0; i < sheet.x.size(); ++i) {
      sheet.x[i] *= 1.003;
      sheet.y[i] *= 0.998;
    }
    const Relaxation r = solver.relax(sheet, forces, {});
    CHECK(r.reached);
    CHECK(r.iterations < 60);
  }
  CHECK(forces.largest > 1e-4);
}

TEST_CASE("forces brought up to date in a box are those computed anew") {
  Sheet sheet = make_sheet(30);
  Forces forces;
  compute_forces(sheet, forces, 1);
  for (const LatticeBox& box : {LatticeBox{11, 19, 7, 16}, {0, 5, 0, 3}, {26, 30, 30, sheet.lattice.rows}}) {
    for (int r = box.r0; r < box.r1; ++r) {
      for (int c = box.c0; c < box.c1; ++c) {
        const auto i = static_cast<std::size_t>(r * 30 + c);
        sheet.x[i] += 1e-4 * std::sin(3.0 * r + 5.0 * c);
        sheet.y[i] += 1e-4 * std::cos(7.0 * r + 2.0 * c);
        sheet.joined[i] = (r + c) % 3 == 0 ? 0 : sheet.joined[i];
      }
    }
    update_forces(sheet, forces, box);
    Forces anew;
    compute_forces(sheet, anew, 1);
    CHECK(forces.x == anew.x);
    CHECK(forces.y == anew.y);
    CHECK(forces.tension == anew.tension);
    CHECK(forces.length == anew.length);
    CHECK(forces.largest == anew.largest);
    CHECK(forces.unbalanced == anew.unbalanced);
    CHECK(forces.worst == anew.worst);
  }
}

TEST_CASE("slivers that bend come to rest in their patches, side by side as one after the other") {
  // Two strips of two columns, held at their lower ends only, their tops pushed aside by three diameters.
  Sheet bent = make_sheet(120);
  const int columns = bent.lattice.columns, bottom = 30, top = 50;
  const auto strip_of = [&](int particle) {
    const int c = particle % columns, r = particle / columns;
    return r < bottom || r >= top ? 0 : c == 30 || c == 31 ? 1 : c == 90 || c == 91 ? 2 : 0;
  };
  const auto beside = [&](int p) {  // taken away, so that the strips have room
    const int c = p % columns, r = p / columns;
    return r >= bottom && r < top + 1 && strip_of(p) == 0 && ((c > 24 && c < 37) || (c > 84 && c < 97));
  };
  for (int slot = 0; slot < bent.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (bent.stiffness[k] <= 0) continue;
    const int i = bent.first(slot), j = bent.second(slot);
    const bool root = std::min(i, j) / columns < bottom;
    if (beside(i) || beside(j) || (strip_of(i) != strip_of(j) && !root)) bent.stiffness[k] = 0;
  }
  for (int p = 0; p < bent.particles(); ++p) {
    const double up = p / columns - bottom + 1;
    if (beside(p)) bent.fixed[static_cast<std::size_t>(p)] = 3;
    if (strip_of(p)) bent.x[static_cast<std::size_t>(p)] += 6 * bent.radius0 * up * up / 400;
  }
  const std::vector<LatticeBox> boxes = {Patches::around(bent.lattice, 30, 40), Patches::around(bent.lattice, 90, 40)};
  Forces before;
  compute_forces(bent, before, 1);
  const auto relaxed = [&](int threads, std::vector<std::vector<LatticeBox>> rounds) {
    std::pair<Sheet, Forces> state{bent, before};
    Patches patches(threads);
    for (const auto& round : rounds) patches.relax(state.first, state.second, round, 0.0);
    return state;
  };
  const auto [sheet, forces] = relaxed(1, {boxes});
  Forces anew;
  compute_forces(sheet, anew, 1);
  CHECK(forces.x == anew.x);
  CHECK(forces.unbalanced == anew.unbalanced);
  CHECK(forces.largest == anew.largest);
  const Sheet whole = make_sheet(120);
  for (const int column : {30, 90}) {  // they stand upright again
    const auto i = static_cast<std::size_t>((top - 1) * columns + column);
    CHECK(std::max(std::fabs(forces.x[i]), std::fabs(forces.y[i])) < 1e-3 * before.unbalanced);
    CHECK(std::fabs(sheet.x[i] - whole.x[i]) < 0.01 * std::fabs(bent.x[i] - whole.x[i]));
  }
  const auto on_two = relaxed(2, {boxes});
  const auto in_turn = relaxed(1, {{boxes[0]}, {boxes[1]}});
  CHECK(on_two.first.x == sheet.x);
  CHECK(on_two.second.y == forces.y);
  CHECK(in_turn.first.x == sheet.x);
  CHECK(in_turn.second.unbalanced == forces.unbalanced);
}

TEST_CASE("fractures through a layer are counted, their spacing is set beside chance") {
  // Springs of rows a unit times sqrt(3)/2 apart; the layer holds five rows: a fracture through all spans four.
  std::vector<Break> breaks;
  const double row = 0.5 * std::numbers::sqrt3;
  const auto fracture = [&](double x, int rows) {
    for (int r = 0; r < rows; ++r) breaks.push_back({.x = x + 0.5 * r, .y = 10 + row * r});
  };
  for (const double x : {10.0, 30.0, 60.0, 70.0}) fracture(x, 5);
  fracture(45, 3);  // not through
  const Crossing c = crossing(breaks, 1.0, 10 - 0.5 * row, 10 + 4.5 * row);
  REQUIRE(c.places.size() == 4);
  CHECK(c.places[0] == test::near(11.0));
  CHECK(c.mean_spacing == test::near(20.0));
  CHECK(c.scatter == test::near(std::sqrt(200.0 / 3) / 20));
  CHECK(c.chance == test::near(std::sqrt(0.5)));
}
