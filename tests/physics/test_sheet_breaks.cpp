// The converged solver against a plain Newton reference, and what must hold after every break.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/sheet/experiment.h"
#include "sheet_reference.h"

namespace {

using namespace dem::sheet;

Loading shear(int breaks) {
  Loading loading;
  loading.steps = 40;
  loading.most_breaks = breaks;
  loading.substeps = 1;
  return loading;
}

std::vector<int> order(const ExperimentState& state) {
  std::vector<int> slots;
  for (const auto& b : state.breaks) slots.push_back(b.slot);
  return slots;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) { return a == b; }

}  // namespace

TEST_CASE("500 springs break in the order of exact Newton with a new factor for every step") {
  const Sheet start = reference::polycrystal(50);
  const auto expected = reference::run(start, 500);
  CHECK(expected.worst <= 1e-8);
  CHECK(expected.contacts > 0);  // broken pairs in contact are part of the comparison
  Sheet sheet = start;
  ConvergedSolver solver(sheet, {});
  Experiment experiment(sheet, solver, shear(500), 1);
  experiment.run();
  const auto got = order(experiment.state());
  REQUIRE(got.size() == expected.slots.size());
  for (std::size_t b = 0; b < got.size(); ++b) {
    CAPTURE(b);
    REQUIRE(got[b] == expected.slots[b]);
    REQUIRE(experiment.state().breaks[b].step == expected.steps[b]);
  }
  CHECK(experiment.state().equilibrium.missed == 0);
  CHECK(experiment.state().equilibrium.worst <= 1e-8);
}

TEST_CASE("energy is accounted for through failure: work = elastic + released") {
  for (const auto kind : {LoadingKind::pure_shear, LoadingKind::extension, LoadingKind::growth}) {
    Sheet sheet = reference::polycrystal(40);
    ConvergedSolver solver(sheet, {});
    Loading loading = shear(1 << 30);
    loading.kind = kind;
    loading.steps = 10;
    loading.substeps = 4;
    loading.grows.assign(sheet.x.size(), 0);
    for (std::size_t i = 0; i < sheet.x.size(); ++i) loading.grows[i] = sheet.grain[i] % 6 == 0 ? 0.001 : 0;
    Experiment experiment(sheet, solver, loading, 1);
    experiment.run();
    const auto& last = experiment.state().samples.back();
    CAPTURE(static_cast<int>(kind));
    CAPTURE(last.breaks);
    CHECK(last.breaks > 30);
    CHECK(last.released > 0);
    CHECK(experiment.energy_residual() <= 1e-4);
    MESSAGE("breaks " << last.breaks << ", energy residual " << experiment.energy_residual());
  }
}

TEST_CASE("a run ends at the break by which the stress falls below its share of the peak") {
  Sheet sheet = reference::polycrystal(40);
  ConvergedSolver solver(sheet, {});
  Loading loading = shear(1 << 30);
  loading.stop_share = 0.8;
  Experiment experiment(sheet, solver, loading, 1);
  std::vector<double> stress;
  experiment.run([&](const Experiment& e) {
    const WallStress wall = wall_stress(e.sheet(), e.forces());
    stress.push_back(std::fabs(wall.xx - wall.yy));
    return true;
  });
  const double peak = *std::max_element(stress.begin(), stress.end());
  CHECK(experiment.state().peak_stress == peak);
  CHECK(experiment.state().step < loading.steps);
  CHECK(stress.back() < 0.8 * peak);
  // Amid a load step: the break before left more than that.
  CHECK(stress[stress.size() - 2] >= 0.8 * peak);
  CHECK(experiment.state().samples.back().breaks == static_cast<int>(experiment.state().breaks.size()));
  CHECK(experiment.energy_residual() <= 1e-4);
}

TEST_CASE("one or three threads give the same bits") {
  std::vector<double> x[2];
  std::vector<int> slots[2];
  for (const int threads : {1, 3}) {
    Sheet sheet = reference::polycrystal(60);
    ConvergedSettings settings;
    settings.threads = threads;
    ConvergedSolver solver(sheet, settings);
    Experiment experiment(sheet, solver, shear(60), threads);
    experiment.run();
    x[threads / 2] = sheet.x;
    slots[threads / 2] = order(experiment.state());
  }
  CHECK(same_bits(x[0], x[1]));
  CHECK(slots[0] == slots[1]);
}

TEST_CASE("a run that is cut between two breaks and taken up again gives the same bits") {
  const Sheet start = reference::polycrystal(40);
  Sheet whole = start;
  ConvergedSolver one(whole, {});
  Experiment straight(whole, one, shear(120), 1);
  straight.run();

  Sheet first = start;
  ConvergedSolver before(first, {});
  Experiment cut(first, before, shear(120), 1);
  cut.run([](const Experiment& e) { return e.state().breaks.size() < 47; });
  const ExperimentState kept = cut.snapshot();
  const ConvergedState factor = before.state();

  Sheet second = start;
  ConvergedSolver after(second, {});
  Experiment resumed(second, after, shear(120), 1);
  resumed.restore(kept);
  after.restore(second, factor);
  resumed.run();
  CHECK(order(resumed.state()) == order(straight.state()));
  CHECK(same_bits(second.x, whole.x));
  CHECK(same_bits(second.y, whole.y));
  CHECK(resumed.energy_residual() == straight.energy_residual());
}

// Gradual or abrupt is told by shares: a wide distribution breaks more than twice as many springs by the same strain,
// so that counts of springs would set unlike things side by side.
TEST_CASE("wide strength distributions break earlier and more gradually than narrow ones") {
  constexpr int seeds = 3;
  double onset[2] = {0, 0}, burst[2] = {0, 0}, drop[2] = {0, 0}, broken[2] = {0, 0};  // means over seeds
  for (const int wide : {0, 1}) {
    for (int seed = 1; seed <= seeds; ++seed) {
      Sheet sheet = reference::polycrystal(40, static_cast<std::uint64_t>(seed), wide ? 0.95 : 0.2);
      ConvergedSolver solver(sheet, {});
      Loading loading = shear(1 << 30);
      loading.step = 0.00025;
      loading.steps = 24;  // to 0.006, where stress has stopped rising
      Experiment experiment(sheet, solver, loading, 1);
      experiment.run();
      const auto& breaks = experiment.state().breaks;
      double peak = 0, most_lost = 0;
      int most = 0, before = 0;
      for (const Sample& s : experiment.state().samples) {
        const double loaded = s.peak_xx - s.peak_yy;
        peak = std::max(peak, loaded);
        most_lost = std::max(most_lost, loaded - (s.stress_xx - s.stress_yy));
        most = std::max(most, s.breaks - before);
        before = s.breaks;
      }
      onset[wide] += breaks.front().step * loading.step / seeds;
      burst[wide] += static_cast<double>(most) / static_cast<double>(breaks.size()) / seeds;
      drop[wide] += most_lost / peak / seeds;
      broken[wide] += static_cast<double>(breaks.size()) / seeds;
    }
  }
  CHECK(onset[1] < 0.25 * onset[0]);
  CHECK(burst[1] < 0.6 * burst[0]);  // share of all broken springs that break in one load step
  CHECK(drop[1] < 0.6 * drop[0]);    // share of the peak stress that is lost in one load step
  MESSAGE("narrow, wide: first break at strain " << onset[0] << ", " << onset[1] << "; springs broken " << broken[0]
                                                 << ", " << broken[1] << "; share in the worst step " << burst[0]
                                                 << ", " << burst[1] << "; stress lost in it " << drop[0] << ", "
                                                 << drop[1]);
}

TEST_CASE("the historical sweep stops where its rule says, far from equilibrium") {
  Sheet sheet = reference::polycrystal(50);
  HistoricalSolver solver({}, 1);
  Experiment experiment(sheet, solver, shear(30), 1);
  experiment.run();
  CHECK(experiment.state().equilibrium.missed == 0);
  CHECK(experiment.state().equilibrium.worst > 1e-6);  // its own rule is met, force balance is not
  CHECK(experiment.state().breaks.size() == 30);
}
