#pragma once
// What brings a sheet to equilibrium after its walls moved or a spring broke. Two solvers, named in every report:
//   converged   force equilibrium: the largest unbalanced force is at most 1e-8 of the largest spring force
//   historical  the sweep of the old program: every particle in turn moves 0.9 (sum F)/(sum k), until no move exceeds
//               1.4e-7 of the box
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/sheet/modified.h"
#include "engine/sheet/sheet.h"

namespace dem::sheet {

/// How one relaxation went.
struct Relaxation {
  bool reached = false;   ///< the solver's own criterion was met
  double unbalanced = 0;  ///< largest unbalanced force over the largest spring force, at the end
  int iterations = 0;     ///< global solves (converged) or sweeps (historical)
};

/// What a solver did since it was made.
struct SolverWork {
  std::int64_t relaxations = 0, solves = 0, patches = 0, factorisations = 0, changes = 0, searches = 0,
               negative_pivots = 0, settled = 0;
};

class Solver {
 public:
  virtual ~Solver() = default;
  /// Moves the free particles of `sheet` to equilibrium; `forces` are those of the result.
  /// `near` lists slots that broke since the last call (an empty list: the load moved).
  virtual Relaxation relax(Sheet& sheet, Forces& forces, std::span<const int> near) = 0;
  [[nodiscard]] virtual SolverWork work() const = 0;
  /// Of the relaxations that follow; no result hangs on their number.
  virtual void set_threads(int threads) = 0;
};

struct ConvergedSettings {
  double tolerance = 1e-8;       ///< largest unbalanced force over the largest spring force
  int most_solves = 2000;        ///< in one relaxation, before it is given up
  bool refactor_always = false;  ///< a plain reference: a new factor for every step of every relaxation
  int threads = 1;
};

/// All that the next result of a converged solver hangs on besides the sheet: for checkpoints.
struct ConvergedState {
  std::vector<Block> coupling;  ///< of the matrix that the factor holds (its parts may stem from different times)
  struct Change {
    double coefficient;  ///< asked for: the factor may have made less of it
    int slot;
    double nx, ny;
    bool active;
  };
  std::vector<Change> changes;  ///< since the last factorisation, in order
  std::vector<double> heat;     ///< where the factor was seen to fall short
  double extra_solves = 0;      ///< counted towards the next one
  double worth = 0;             ///< solves that cost as much as the last one
  bool load_moved = false;      ///< since the last factorisation

  template <class Archive>
  void archive(Archive& a) {
    a(coupling, changes, heat, extra_solves, worth, load_moved);
  }
};

class ConvergedSolver final : public Solver {
 public:
  ConvergedSolver(const Sheet& sheet, ConvergedSettings settings);
  ~ConvergedSolver() override;
  Relaxation relax(Sheet& sheet, Forces& forces, std::span<const int> near) override;
  [[nodiscard]] SolverWork work() const override;
  void set_threads(int threads) override;
  [[nodiscard]] ConvergedState state() const;
  void restore(const Sheet& sheet, const ConvergedState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

struct HistoricalSettings {
  double relaxation = 0.9;  ///< share of (sum F)/(sum k) that a particle moves
  double stop = 1.4e-7;     ///< largest move that counts as equilibrium, in box widths
  int most_sweeps = 1000000;
};

class HistoricalSolver final : public Solver {
 public:
  explicit HistoricalSolver(HistoricalSettings settings, int threads) : settings_(settings), threads_(threads) {}
  Relaxation relax(Sheet& sheet, Forces& forces, std::span<const int> near) override;
  [[nodiscard]] SolverWork work() const override { return work_; }
  void set_threads(int threads) override { threads_ = threads; }

 private:
  HistoricalSettings settings_;
  int threads_;
  SolverWork work_;
};

}  // namespace dem::sheet
