#pragma once
// A factor followed through broken springs: (K0 + sum c b b^T)^-1 by the Sherman-Morrison-Woodbury formula on path
// vectors. Each change costs one sparse forward sweep; K0 is factorised anew by the rule of the solver that owns it.
#include <array>
#include <vector>

#include "engine/sheet/factor.h"

namespace dem::sheet {

class ModifiedFactor {
 public:
  ModifiedFactor(const Dissection& dissection, int threads, Factor::Again again = Factor::Again::whole)
      : factor_(dissection, threads, again), threads_(threads) {}
  void set_threads(int threads) {
    threads_ = threads;
    factor_.set_threads(threads);
  }

  /// Takes a new K0 and forgets all changes; returns the number of negative pivots.
  int factorise(const BlockMatrix& matrix, PivotRule rule = {});
  /// The same where K0 changed in the nodes of `stale` only (see Factor).
  int factorise(const BlockMatrix& matrix, std::span<const std::uint8_t> stale, PivotRule rule = {});

  /// Adds c b b^T with b = (n at particle i, -n at particle j), entries along held directions left out.
  /// A change that would leave K without stiffness along b is weakened to keep it positive definite.
  /// Returns the coefficient that was applied.
  double change(double c, int i, int j, std::array<double, 2> n, std::span<const std::uint8_t> fixed);

  /// Solves K x = b in place; x and y of each particle in elimination order, b zero along held directions.
  void solve(std::span<double> b);

  [[nodiscard]] int changes() const { return static_cast<int>(paths_.size()); }
  /// Removals since the factorisation that left nothing to hold a pair, and were made in part.
  [[nodiscard]] int weakened() const { return weakened_; }
  [[nodiscard]] Factor& factor() { return factor_; }

 private:
  void correct(std::span<float> y) const;

  Factor factor_;
  int threads_;
  std::vector<PathVector> paths_;           // Y = L^-1 B
  std::vector<std::vector<double>> lower_;  // rows of the unit lower factor of S = C^-1 + Y^T Y = L D L^T
  std::vector<double> pivots_;              // D
  int weakened_ = 0;
  std::vector<std::uint8_t> active_;
  std::vector<float> y_;
};

}  // namespace dem::sheet
