#pragma once
// Exact Newton iterations in small boxes of the sheet, everything outside held. After a spring breaks, what a linear
// step leaves unbalanced sits around the break, and where slivers bend: patches remove it for a fraction of a global
// solve.
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "engine/sheet/factor.h"
#include "engine/sheet/sheet.h"

namespace dem::sheet {

class Patches {
 public:
  /// The box of 48 particles a side around a particle, moved inside the lattice where it would stick out.
  [[nodiscard]] static LatticeBox around(const Lattice& lattice, int column, int row);
  /// True when the particle is far enough inside the box for what its patch pushes over the rim to be small.
  [[nodiscard]] static bool covers(const Lattice& lattice, const LatticeBox& box, int column, int row);

  /// Iterates in each box in turn (in those that do not touch, side by side) until no particle of it is unbalanced by
  /// more than `small` (a force), or by little of what it was, or progress ends. `forces` are brought up to date.
  /// Same bits for any number of threads.
  void relax(Sheet& sheet, Forces& forces, std::span<const LatticeBox> boxes, double small);

  /// Brings a box to rest by damped dynamics (FIRE: Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006), everything outside
  /// held, until no particle of it is unbalanced by more than `small`, or not after many steps. Slow beside Newton's
  /// steps, but downhill wherever it goes: for places where the tangent leads astray, as where a particle swings about
  /// two springs.
  static void settle(Sheet& sheet, Forces& forces, const LatticeBox& box, double small);

  explicit Patches(int threads) : threads_(threads) {}
  void set_threads(int threads) { threads_ = threads; }

 private:
  struct Local;
  using Shape = std::tuple<int, int, bool>;
  static Shape shape_of(const Sheet& sheet, const LatticeBox& box);
  Local& local(const Shape& shape, std::size_t which);
  static void relax(Sheet& sheet, Forces& forces, const LatticeBox& box, double small, Local& local);

  int threads_;
  std::map<Shape, std::vector<std::shared_ptr<Local>>> locals_;  // as many of each shape as were needed at once
};

}  // namespace dem::sheet
