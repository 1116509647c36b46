#pragma once
// A sheet under load. Each load step moves walls and particles affinely (or grows the marked grains), relaxes, and then
// breaks one spring at a time - the one with the largest tension over threshold - relaxing after each, until none is
// over its threshold. Energy is accounted for as it goes:
//   boundary work + growth work = elastic energy + energy released by breaking + energy released by jumps
// Work is the sum over parts of a load step of mean wall force times wall motion (trapezoid), growth work that of
// -dE/dr dr. A part that this does not account for is done again in halves: contacts open and close on the way, which
// smaller parts follow; or the sheet jumps (a fragment snaps from one equilibrium to another, as a shallow arch does),
// which no part is small enough for. What the smallest part loses, if it is more than the trapezoid can be wrong by and
// the sheet is in equilibrium, is energy that a jump released.
#include <functional>
#include <vector>

#include "engine/core/threads.h"
#include "engine/sheet/solver.h"

namespace dem::sheet {

enum class LoadingKind {
  pure_shear,   ///< shortened along y by the step, lengthened along x to keep the area
  extension,    ///< lengthened along x, y walls held
  compression,  ///< shortened along x, y walls held
  growth,       ///< walls held, marked grains grow
};

struct Loading {
  LoadingKind kind = LoadingKind::pure_shear;
  double step = 0.001;        ///< strain of one step; for growth the largest share in `grows`
  int steps = 10;             ///< at most
  int most_breaks = 1 << 30;  ///< the run ends after so many
  double stop_share = 0;      ///< ends after the break by which the differential stress falls below this share of its
                              ///< peak, amid a load step; 0: never
  int substeps = 4;           ///< of a step, once springs are broken (contacts open and close on the way)
  double work_tolerance = 0;  ///< share of the work so far by which energies of a part may disagree before it is halved
                              ///< (once springs are broken); 0: never
  std::vector<double> grows;  ///< growth of each particle's radius in a step, as a share; for growth
};

/// One broken spring.
struct Break {
  int slot = 0;
  int step = 0;         ///< load step, from 1
  double x = 0, y = 0;  ///< middle of the pair, undeformed sheet, box widths
  double angle = 0;     ///< of the crack (across the spring), 0 ... pi from the x axis, in the deformed state
  double ratio = 0;     ///< tension over threshold when it broke
  double margin = 0;    ///< how much nearer to failure than the next spring, as a share
};

/// State after a load step and all its breaks.
struct Sample {
  int step = 0;
  double strain = 0;                    ///< step times steps (growth: of the radii)
  double stress_xx = 0, stress_yy = 0;  ///< on the walls, after the breaks, tension positive
  double peak_xx = 0, peak_yy = 0;      ///< the same before the breaks of this step
  double elastic = 0, released = 0, jumped = 0, boundary_work = 0, growth_work = 0;
  int breaks = 0;      ///< so far
  int iterations = 0;  ///< solves or sweeps so far
};

/// How far the run met the solver's criterion.
struct Equilibrium {
  double worst = 0;  ///< largest unbalanced over largest spring force after any relaxation
  int relaxations = 0, missed = 0;
};

/// All that a checkpoint must keep besides the sheet's make-up and the solver.
struct ExperimentState {
  std::vector<double> x, y, radius;
  std::vector<std::uint8_t> joined;
  std::vector<Break> breaks;
  std::vector<Sample> samples;
  Equilibrium equilibrium;
  int step = 0;                                ///< load step being done
  bool breaking = false;                       ///< between two breaks of that step
  std::int64_t left = 0, size = 0, whole = 0;  ///< of its load: what is not applied yet, the next part, all of it
  int jumps = 0;                               ///< parts of load steps in which the sheet jumped
  double jumped = 0;                           ///< energy released by that
  double released = 0, boundary_work = 0, growth_work = 0, energy_loaded = 0, peak_xx = 0, peak_yy = 0, peak_stress = 0;
  bool finished = false;

  template <class Archive>
  void archive(Archive& a) {
    a(x, y, radius, joined, breaks, samples, equilibrium, step, breaking, left, size, whole, jumps, jumped, released,
      boundary_work, growth_work, energy_loaded, peak_xx, peak_yy, peak_stress, finished);
  }
};

class Experiment {
 public:
  Experiment(Sheet& sheet, Solver& solver, Loading loading, int threads);

  /// Goes on to the next part of a load applied or spring broken; false when the run has ended.
  bool advance();
  /// Runs to the end; `between` is asked after every relaxation and may stop the run by returning false.
  void run(const std::function<bool(const Experiment&)>& between = {});

  [[nodiscard]] const Sheet& sheet() const { return *sheet_; }
  [[nodiscard]] const Forces& forces() const { return forces_; }
  [[nodiscard]] const ExperimentState& state() const { return state_; }
  [[nodiscard]] bool finished() const { return state_.finished; }
  [[nodiscard]] double strain() const { return state_.step * loading_.step; }
  /// Neither loading nor breaking.
  [[nodiscard]] bool between_steps() const { return !state_.breaking && state_.left == 0; }
  /// Share of energy that is unaccounted for: |work - elastic - released - jumped| over the work so far.
  [[nodiscard]] double energy_residual() const;

  [[nodiscard]] ExperimentState snapshot() const;
  void restore(const ExperimentState& state);

 private:
  void load_part();
  void loaded();
  bool break_one();
  [[nodiscard]] bool failed() const;
  void close_step();
  struct Part {
    Relaxation relaxation;
    double boundary = 0, growth = 0;  // work
    double lost = 0;                  // work that is not elastic energy afterwards
    double error = 0;                 // of the trapezoid, at most
  };
  Part apply(double from, double to);
  void relaxed(const Relaxation& r);

  Sheet* sheet_;
  Solver* solver_;
  Loading loading_;
  int threads_;  // at most
  Pace pace_;    // and how many of them it takes now
  Forces forces_;
  ExperimentState state_;
  std::vector<double> start_x_, start_y_;  // undeformed, for the places of cracks
};

}  // namespace dem::sheet
