// Springs and contacts one by one as they turn and slide past each other, and what the size of the particles does to the load
// at which a notch grows.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/sheet/experiment.h"
#include "engine/sheet/grains.h"

namespace {

using namespace dem::sheet;

double off(double value, double expected) { return std::fabs(value / expected - 1); }

/// A sheet with one pair of interest: a particle inside and its neighbour to the east, moved, and no other spring or contact.
struct Pair {
  Sheet sheet = make_sheet(12, 14, 0.5);
  int a = 7 * 12 + 5, slot = a;  // direction 0: east
  Pair(bool joined, double distance, double angle) {
    for (double& k : sheet.stiffness) k = 0;
    const auto at = static_cast<std::size_t>(slot), i = static_cast<std::size_t>(a),
               j = static_cast<std::size_t>(sheet.second(slot));
    sheet.stiffness[at] = 2;
    sheet.joined[at] = joined ? 1 : 0;
    sheet.x[j] = sheet.x[i] + distance * std::cos(angle);
    sheet.y[j] = sheet.y[i] + distance * std::sin(angle);
  }
  [[nodiscard]] Forces forces() const {
    Forces f;
    compute_forces(sheet, f, 1);
    return f;
  }
};

// Stress at which the spring at the tip of a notch breaks in a uniform sheet drawn across it: the notch goes through three
// tenths as many rows as there are columns.
double stress_at_growth(int columns, double threshold) {
  Sheet sheet = make_sheet(columns, 0, 0.5);
  const double line = 0.5 + 0.25 / columns;  // between particles in every row
  const int length = 3 * columns / 10, first = (sheet.lattice.rows - length) / 2;
  const auto inside = [&](int particle) {
    const int row = particle / columns;
    return row >= first && row < first + length;
  };
  for (int slot = 0; slot < sheet.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (sheet.stiffness[k] <= 0) continue;
    const int a = sheet.first(slot), b = sheet.second(slot);
    const double left = sheet.x[static_cast<std::size_t>(a)] - line,
                 right = sheet.x[static_cast<std::size_t>(b)] - line;
    if (left * right < 0 && inside(a) && inside(b)) sheet.joined[k] = 0;
    if (!along_wall(sheet, slot)) sheet.threshold[k] = threshold;
  }
  ConvergedSolver solver(sheet, {});
  Loading loading;
  loading.kind = LoadingKind::extension;
  loading.step = 1e-5;  // far from breaking: linear to 2e-5; smaller ones drown in the rounding of positions
  loading.steps = 1;
  Experiment experiment(sheet, solver, loading, 1);
  experiment.run();
  const Critical worst = most_critical(sheet, experiment.forces(), 1);
  return experiment.state().samples.front().stress_xx / worst.ratio;
}

}  // namespace

TEST_CASE("a spring that turns keeps its force and its line") {
  const double rest = 1.0 / 12;
  for (const double angle : {0.0, 0.4, 1.3, 2.9}) {
    CAPTURE(angle);
    const Pair whole(true, rest, angle), drawn(true, 1.01 * rest, angle);
    CHECK(std::fabs(whole.forces().largest) < 1e-15);
    const Forces f = drawn.forces();
    const auto i = static_cast<std::size_t>(drawn.a);
    CHECK(off(f.tension[static_cast<std::size_t>(drawn.slot)], 2 * 0.01 * rest) < 1e-12);
    CHECK(std::fabs(f.x[i] - 0.02 * rest * std::cos(angle)) < 1e-15);
    CHECK(std::fabs(f.y[i] - 0.02 * rest * std::sin(angle)) < 1e-15);
  }
}

TEST_CASE("a broken pair that grazes past pushes along the line of centres alone, and never pulls") {
  const double rest = 1.0 / 12;
  for (double offset = -0.5; offset <= 0.5; offset += 0.1) {  // of a diameter, along x, at a height of 0.95 of it
    CAPTURE(offset);
    const double distance = rest * std::hypot(0.95, offset), angle = std::atan2(0.95, offset);
    const Forces f = Pair(false, distance, angle).forces();
    const auto i = static_cast<std::size_t>(Pair(false, distance, angle).a);
    const double push = distance < rest ? 2 * (rest - distance) : 0;
    CHECK(std::fabs(f.x[i] + push * std::cos(angle)) < 1e-15);
    CHECK(std::fabs(f.y[i] + push * std::sin(angle)) < 1e-15);
  }
}

// The spring at the tip bears the singular stress there, K over the root of the spacing, and a constant part (the T stress).
// So the load at growth comes to the root of the spacing, and is off it by a share that falls with that root too.
TEST_CASE("a finer sheet is less tough by the root of its particles' size, unless thresholds grow with it") {
  std::vector<double> at_growth;
  for (const int columns : {40, 80, 160, 320}) at_growth.push_back(stress_at_growth(columns, 0.006));
  std::vector<double> distance;  // of the ratio at half the size from the root of two
  for (std::size_t i = 1; i < at_growth.size(); ++i)
    distance.push_back(std::numbers::sqrt2 - at_growth[i - 1] / at_growth[i]);
  CHECK(distance[0] < 0.07);
  for (std::size_t i = 1; i < distance.size(); ++i) {
    CAPTURE(distance[i - 1]);
    CHECK(off(distance[i] / distance[i - 1], 1 / std::numbers::sqrt2) < 0.05);
  }
  for (const std::size_t i : {0UL, 2UL, 3UL}) {  // beside 80 columns: what is left is that constant part
    const int columns = 40 << i;
    const double scaled = stress_at_growth(columns, 0.006 * toughness_factor(columns, 80));
    CHECK(off(scaled, at_growth[1]) < off(at_growth[i], at_growth[1]) / 7);
  }
}
