// As test_sheet_breaks, on 100 columns: minutes.
#include <doctest/doctest.h>

#include "engine/sheet/experiment.h"
#include "sheet_reference.h"

TEST_CASE("at 100 columns 500 springs break in the order of exact Newton") {
  using namespace dem::sheet;
  const Sheet start = reference::polycrystal(100);
  const auto expected = reference::run(start, 500);
  Sheet sheet = start;
  ConvergedSolver solver(sheet, {});
  Loading loading;
  loading.steps = 40;
  loading.most_breaks = 500;
  loading.substeps = 1;
  Experiment experiment(sheet, solver, loading, 1);
  experiment.run();
  const auto& breaks = experiment.state().breaks;
  REQUIRE(breaks.size() == expected.slots.size());
  for (std::size_t b = 0; b < breaks.size(); ++b) {
    CAPTURE(b);
    REQUIRE(breaks[b].slot == expected.slots[b]);
  }
  CHECK(experiment.state().equilibrium.worst <= 1e-8);
}
