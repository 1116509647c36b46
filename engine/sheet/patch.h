#pragma once
// Exact Newton iterations in a small box of the sheet, everything outside held. After a spring breaks, what a linear
// step leaves unbalanced sits around the break: a patch removes it for a fraction of a global solve.
#include <map>
#include <memory>
#include <tuple>

#include "engine/sheet/factor.h"
#include "engine/sheet/sheet.h"

namespace dem::sheet {

class Patches {
 public:
  /// The box of 48 particles a side around a particle, moved inside the lattice where it would stick out.
  [[nodiscard]] static LatticeBox around(const Lattice& lattice, int column, int row);
  /// True when the particle is far enough inside the box for what its patch pushes over the rim to be small.
  [[nodiscard]] static bool covers(const Lattice& lattice, const LatticeBox& box, int column, int row);

  /// Iterates until no particle of the box is unbalanced by more than `small` (a force), or progress ends.
  /// `forces` are brought up to date.
  void relax(Sheet& sheet, Forces& forces, const LatticeBox& box, double small);

  explicit Patches(int threads) : threads_(threads) {}

 private:
  struct Local;
  using Shape = std::tuple<int, int, bool>;
  int threads_;
  std::map<Shape, std::shared_ptr<Local>> shapes_;
};

}  // namespace dem::sheet
