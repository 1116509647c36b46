// The motion of the close-packed lattice: ledger, momentum, waves, the same bits for any threads and vector width.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "engine/core/random.h"
#include "engine/lattice/loading.h"
#include "engine/lattice/model.h"
#include "engine/lattice/moduli.h"
#include "engine/lattice/quantities.h"
#include "tests/support/near.h"

using namespace dem::lattice;

namespace {

Setup quartzite(const Block& block, PlaneKind planes) {
  Setup s;
  s.micro = micro_of({90e9, 0.16, 25e6, 252e6, 1, 2650}, 1e-3);
  s.planes = planes;
  s.viscosity = viscosity(s.micro, static_cast<long>(block.site.size()));
  return s;
}

// Elements at rest in their places, thrown about at up to `speed` m/s.
void shake(Solver& solver, const Block& block, double speed, double time_step) {
  dem::RandomStream random(7, dem::Purpose::test_data);
  std::vector<std::array<double, 3>> still(block.site.size()), last(block.site.size());
  for (auto& w : last) {
    for (double& x : w) x = random.uniform(-speed, speed) * time_step;
  }
  solver.set_motion(still, last);
}

}  // namespace

TEST_CASE("results are the same bits for every number of threads and vector width, breaking and sliding included") {
  std::int64_t slid = 0;
  for (const PlaneKind planes : {PlaneKind::elastic, PlaneKind::rigid, PlaneKind::plate}) {
    for (const int axis : {0, 1, 2}) {
      const Block block = make_block(block_shape(7), 1e-3);
      Solver::State first;
      double kinetic = 0;
      for (const dem::InstructionSet set : dem::instruction_sets()) {
        for (const int threads : {1, 2, 3, 7}) {
          Setup s = quartzite(block, planes);
          s.axis = axis;
          s.set = set;
          s.threads = threads;
          Solver solver(block, s);
          shake(solver, block, 8.0, s.time_step);
          for (int i = 0; i < 3; ++i) solver.run(40, 1e-8, -2e-8);
          const Sample sample = solver.sampled_step();
          const Solver::State state = solver.state();
          if (first.real.empty()) {
            first = state;
            kinetic = sample.kinetic;
            CHECK(sample.opening > 20);
            slid += sample.sliding;
            CHECK(sample.frictional > 0);
          }
          CHECK(state.real == first.real);
          CHECK(state.code == first.code);
          CHECK(sample.kinetic == kinetic);
          CHECK(state.cracks.size() == first.cracks.size());
        }
      }
    }
  }
  CHECK(slid > 20);
}

TEST_CASE("the instruction set of a block is one that the processor has") {
  for (const int ny : {2, 7}) {
    const Block block = make_block(block_shape(ny), 1e-3);
    const std::vector<dem::InstructionSet> sets = dem::instruction_sets();
    const dem::InstructionSet found = fastest_set(block, quartzite(block, PlaneKind::elastic));
    CHECK(std::find(sets.begin(), sets.end(), found) != sets.end());
  }
}

TEST_CASE("energy is accounted for while bonds break, slide and part") {
  for (const PlaneKind planes : {PlaneKind::elastic, PlaneKind::rigid, PlaneKind::plate}) {
    const Block block = make_block(block_shape(6), 1e-3);
    const Setup s = quartzite(block, planes);
    Solver solver(block, s);
    shake(solver, block, 4.0, s.time_step);
    const Sample start = solver.sampled_step();
    double worst = 0;
    Sample x;
    for (int i = 0; i < 50; ++i) {
      x = solver.sampled_step(-2e-9, 2e-9);
      worst = std::max(worst, std::abs(x.imbalance() - start.imbalance()));
      solver.run(20);
    }
    const double turned_over = x.work + start.kinetic;
    CHECK(x.opening > 0);
    CHECK(x.heat() > 0.3 * turned_over);
    CHECK(worst < 1e-3 * turned_over);
  }
}

TEST_CASE("momentum changes by the force of the planes alone") {
  const Block block = make_block(block_shape(6), 1e-3);
  Setup s = quartzite(block, PlaneKind::elastic);
  s.viscosity = 0;
  Solver solver(block, s);
  shake(solver, block, 8.0, s.time_step);
  const auto before = solver.momentum();
  double impulse = 0;
  for (int i = 0; i < 200; ++i) {
    const Sample x = solver.sampled_step(1e-9, 3e-9);
    impulse += (x.force[1] - x.force[0]) * s.time_step;
  }
  const auto after = solver.momentum();
  const double scale = s.micro.mass * 8.0 * static_cast<double>(block.site.size());
  CHECK(solver.cracks().size() > 10);
  CHECK(std::abs(after[0] - before[0]) < 1e-13 * scale);
  CHECK(std::abs(after[1] - before[1]) < 1e-13 * scale);
  CHECK(std::abs(after[2] - before[2] - impulse) < 1e-12 * scale);
  CHECK(std::abs(impulse) > 1e-4 * scale);
}

TEST_CASE("a compressional wave along z has the speed of theory") {
  const Block block = make_block(BlockShape{24, 27, 21}, 1e-3);
  Setup s = quartzite(block, PlaneKind::rigid);
  s.viscosity = 0;
  Solver solver(block, s);
  const int gaps = block.shape.layers - 1;
  std::vector<std::array<double, 3>> still(block.site.size()), last(block.site.size());
  std::size_t middle = 0;
  for (std::size_t i = 0; i < last.size(); ++i) {
    last[i] = {0, 0, 1e-12 * std::sin(M_PI * block.site[i].layer / gaps)};
    if (block.site[i].layer == gaps / 2 && block.site[i].row == 13 && block.site[i].column == 12) middle = i;
  }
  solver.set_motion(still, last);
  // A standing wave between held ends: the middle turns back after a quarter of its period. The sides, free, are not
  // heard of there before that.
  double turn = 0, height = 0;
  for (int i = 1; i < 400 && turn == 0; ++i) {
    solver.run(1);
    const double now = solver.displacement()[middle][2];
    const double w = now - height;
    if (w < 0) turn = (i - 0.5 + w / 1e-12) * s.time_step;
    height = now;
  }
  const double speed = block.extent()[2] / (2 * turn);
  CHECK(speed == test::near(wave_speed_z(s.micro)).epsilon(0.01));
}

TEST_CASE("gravity is part of the ledger, and the planes carry the weight") {
  const Block block = make_block(block_shape(4), 1e-3);
  Setup s = quartzite(block, PlaneKind::elastic);
  s.gravity = 9.81e4;
  Solver solver(block, s);
  solver.run(20000);
  const Sample x = solver.sampled_step();
  const double weight = s.micro.mass * s.gravity * static_cast<double>(block.site.size());
  CHECK(x.force[1] - x.force[0] == test::near(weight).epsilon(1e-6));
  CHECK(x.gravity < 0);
  CHECK(std::abs(x.imbalance()) < 1e-6 * std::abs(x.gravity));
}

TEST_CASE("pressure on the sides: the ledger closes, and the block shortens across as an elastic one") {
  const Block block = make_block(block_shape(8), 1e-3);
  Setup s = quartzite(block, PlaneKind::elastic);
  s.pressure = 1e6;
  Solver solver(block, s);
  solver.run(30000);
  const Sample x = solver.sampled_step();
  CHECK(std::abs(x.imbalance()) < 1e-6 * x.work);
  CHECK(x.force[1] == test::near(x.force[0]).epsilon(1e-6));
  // Between the springs of the planes the axis gives a little: by hand, from E and nu along z and the axial stress.
  const double axial = 0.5 * (x.force[0] + x.force[1]) / cross_section(block, 2);
  CHECK(axial < 0);  // held back by the planes, it widens along its axis
  const double across = (-s.pressure * (1 - 0.16) - 0.16 * axial) / 90e9;
  CHECK(0.5 * (x.lateral[0] + x.lateral[1]) == test::near(across).epsilon(0.15));
}

TEST_CASE("a test goes on from its saved state with the same bits") {
  const Block block = make_block(block_shape(4), 1e-3);
  const Setup s = quartzite(block, PlaneKind::elastic);
  Loading loading;
  loading.motion = 3.4e-9;
  loading.after = 300;
  StrengthTest whole(block, s, loading), cut(block, s, loading);
  for (int i = 0; i < 100; ++i) cut.advance();
  const StrengthTest::State saved = cut.state();
  StrengthTest resumed(block, s, loading);
  resumed.restore(saved);
  while (whole.advance()) {
  }
  while (resumed.advance()) {
  }
  CHECK(whole.solver().state().real == resumed.solver().state().real);
  CHECK(whole.history().size() == resumed.history().size());
  CHECK(whole.largest_residual() == resumed.largest_residual());
}

TEST_CASE("small blocks fail as the paper says: tension by opening alone, compression by opening, then sliding") {
  const Block block = make_block(block_shape(4), 1e-3);
  const Setup s = quartzite(block, PlaneKind::elastic);
  Loading loading;
  loading.motion = 1.7e-9;
  loading.after = 2000;
  StrengthTest tension(block, s, loading);
  while (tension.advance()) {
  }
  CHECK(tension.failed());
  CHECK(tension.history().back().opening > 40);
  CHECK(tension.history().back().sliding == 0);
  CHECK(tension.history().back().elastic() < 1e-3 * tension.peak().elastic());
  CHECK(tension.largest_residual() < 1e-5);
  CHECK(tension.solver().unseen_contacts() == 0);

  loading.kind = TestKind::compression;
  loading.motion = 1.7e-8;
  loading.burst = 8;
  StrengthTest compression(block, s, loading);
  while (compression.advance()) {
  }
  CHECK(compression.failed());
  const auto& cracks = compression.solver().cracks();
  CHECK(cracks.front().mode == 0);
  std::int64_t first_slide = 0;
  for (auto c = cracks.rbegin(); c != cracks.rend(); ++c) {
    if (c->mode == 1) first_slide = c->step;
  }
  CHECK(first_slide > 2 * cracks.front().step);
  CHECK(compression.largest_residual() < 1e-5);
  CHECK(compression.stress(compression.peak()) > 150e6);
  CHECK(compression.stress(compression.peak()) < 252e6);
}

TEST_CASE("compressed along its rows a block splits between them and the rows go on carrying") {
  const Block block = make_block(block_shape(4), 1e-3);
  Setup setup = quartzite(block, PlaneKind::elastic);
  setup.axis = 1;
  Loading loading;
  loading.kind = TestKind::compression;
  loading.motion = 4e-8;
  loading.largest_strain = 4 * 252e6 / 90e9;
  StrengthTest test(block, setup, loading);
  while (test.advance()) {
  }
  CHECK_FALSE(test.failed());
  const auto state = test.solver().bond_state();
  std::size_t rows = 0, rows_whole = 0, between = 0, between_broken = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const bool in_row = block.bonds[i].direction == 0;
    (in_row ? rows : between) += 1;
    if (in_row && state[i] == 0) ++rows_whole;
    if (!in_row && state[i] != 0) ++between_broken;
  }
  CHECK(rows_whole == rows);
  CHECK(between_broken > between / 2);
}

TEST_CASE("the rate of loading is told by what it does to the block before the first bond breaks") {
  // Compression of 82 elements: 198.9, 203.5 (+2.3 %) and 228.9 MPa (+15 %) at 5, 20 and 100 times the published motion.
  const Block block = make_block(block_shape(4), 1e-3);
  double before = 0;
  for (const auto& [factor, low, high] : {std::tuple{20.0, 0.015, 0.03}, {100.0, 0.1, 0.2}}) {
    Loading loading{.kind = TestKind::compression, .motion = factor * 1.7e-9, .burst = 8, .after = 0};
    StrengthTest test(block, quartzite(block, PlaneKind::elastic), loading);
    while (test.advance()) {
    }
    CAPTURE(factor);
    CHECK(test.failed());
    CHECK(test.given_up().empty());
    CHECK(test.rate_bias() > low);
    CHECK(test.rate_bias() < high);
    CHECK(test.stress(test.peak()) > before);
    before = test.stress(test.peak());
  }
}

TEST_CASE("a strength test that does not fail is given up and leaves no strength, and nothing that is not a number") {
  const Block block = make_block(block_shape(4), 1e-3);
  for (const char* kind : {"tension", "compression"}) {
    for (const char* limit : {"loading.largest_strain", "loading.most_steps"}) {
      CAPTURE(kind);
      CAPTURE(limit);
      Settings s;
      s.test = kind;
      s.rock = {90e9, 0.16, 25e6, 252e6, 1, 2650};
      s.setup = quartzite(block, PlaneKind::elastic);
      s.micro = s.setup.micro;
      s.shape = block_shape(4);
      s.loading = {.kind = s.test == "tension" ? TestKind::tension : TestKind::compression, .motion = 1.7e-9};
      if (limit == std::string("loading.most_steps")) {
        s.loading.most_steps = 2000;
      } else {
        s.loading.largest_strain = 3e-5;
      }
      StrengthTest test(block, s.setup, s.loading);
      while (test.advance()) {
      }
      CHECK_FALSE(test.failed());
      CHECK(test.given_up() == limit);
      dem::Record record;
      record.quantities = quantities();
      add_strength(record, s, block, test);
      for (const auto& [id, value] : record.results) {
        CAPTURE(id);
        CHECK(std::isfinite(value));
        CHECK(value >= 0);
      }
      for (const dem::Quantity* q :
           {&quantity::tensile_strength, &quantity::compressive_strength, &quantity::failure_time,
            &quantity::sliding_start, &quantity::first_opening, &quantity::a1_time}) {
        CHECK_FALSE(record.has(*q));
      }
      REQUIRE(record.notes.size() == 1);
      CHECK(record.notes[0].find("No strength was found up to a strain of") == 0);
      CHECK(record.notes[0].find(limit) != std::string::npos);
    }
  }
}

TEST_CASE("an elastic series that does not come to rest, or to its strains, says so") {
  const Block block = make_block(block_shape(2), 1e-3);
  const auto check_of = [&](Settings s, const std::vector<ElasticPoint>& points) {
    s.rock = {90e9, 0.16, 25e6, 252e6, 1, 2650};
    dem::Record record;
    record.quantities = quantities();
    add_elastic(record, s, block, points);
    REQUIRE(record.checks.size() == 1);
    return record.checks[0];
  };
  Settings s;
  s.setup = quartzite(block, PlaneKind::elastic);
  s.strains = {1e-6, 1e-5};
  CHECK(check_of(s, elastic_at_rest(block, s.setup, s.strains)).held);
  Setup restless = s.setup;
  restless.viscosity = 0;
  const dem::Check check = check_of(s, elastic_at_rest(block, restless, s.strains));
  CHECK(check.id == "at_rest");
  CHECK_FALSE(check.held);
  CHECK(check.value == 2);
  s.method = ElasticMethod::steps;
  s.loading = {.kind = TestKind::compression, .motion = 1.7e-9, .most_steps = 400};
  const dem::Check cut = check_of(s, elastic_by_steps(block, s.setup, s.loading, s.strains));
  CHECK(cut.id == "strains_reached");
  CHECK_FALSE(cut.held);
  s.loading.most_steps = 0;
  CHECK(check_of(s, elastic_by_steps(block, s.setup, s.loading, s.strains)).held);
}

TEST_CASE("rocks that the lattice cannot be are refused with the line of the key") {
  const auto said = [](const std::vector<std::string>& set) -> std::string {
    try {
      model().cases(dem::Scenario::read(DEM_SOURCE_DIR "/scenarios/quartzite_strength.toml", "smoke", set,
                                        [](std::string_view) { return keys(); }));
    } catch (const dem::InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(said({}).empty());
  CHECK(said({"rock.poisson_ratio=0.2"}).find("below 0.2") != std::string::npos);
  CHECK(said({"rock.tensile_strength=\"300 MPa\""}).find("stronger in tension") != std::string::npos);
  CHECK(said({"sweep.elements_y=[400]"}).find("make a block of ") != std::string::npos);
}
