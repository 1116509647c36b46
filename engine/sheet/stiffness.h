#pragma once
// The tangent stiffness of a sheet: k n n^T + (f/d)(1 - n n^T) of every active spring or contact, as blocks.
#include <vector>

#include "engine/sheet/sheet.h"

namespace dem::sheet {

/// True when the slot carries force: a whole spring, or a broken pair pressed together.
inline bool active(const Sheet& sheet, const Forces& forces, int slot) {
  const auto k = static_cast<std::size_t>(slot);
  return sheet.stiffness[k] > 0 && (sheet.joined[k] || forces.tension[k] < 0);
}

/// `stable` leaves out the second term where it is compression: then no direction has a negative stiffness, as one may
/// have in the exact tangent of a sheet that buckles.
enum class Tangent { exact, stable };

/// The block of one slot (positive: its share of the diagonal).
Block tangent_block(const Sheet& sheet, const Forces& forces, int slot, Tangent tangent = Tangent::exact);

/// Makes the diagonal block of a particle hold it: at least a ten-thousandth of its stiffest spring along its softest
/// direction, and a little more than nothing beside an open crack (`loose`), where it may belong to a fragment that
/// nothing holds. No force: it shortens steps along mechanisms, so that the matrix can be factorised.
void hold(Block& diagonal, double stiffest, bool loose);

/// The sum of the couplings of a particle in `matrix`, held (see above).
Block diagonal_of(const Sheet& sheet, const BlockMatrix& matrix, int particle);

/// Assembles the whole matrix.
BlockMatrix assemble(const Sheet& sheet, const Forces& forces, Tangent tangent = Tangent::exact);

/// The tangent of a state, to be applied to many vectors.
class TangentOperator {
 public:
  explicit TangentOperator(int threads) : threads_(threads) {}
  void set_threads(int threads) { threads_ = threads; }
  /// Takes the tangent of this state. The sheet must last as long as it is applied, and is the same in every call.
  void update(const Sheet& sheet, const Forces& forces);
  /// out = K v (particles held as in `assemble`), zero along held directions. Same bits for any number of threads.
  void apply(std::span<const double> vx, std::span<const double> vy, std::span<double> out_x,
             std::span<double> out_y) const;

 private:
  const Sheet* sheet_ = nullptr;
  int threads_;
  std::vector<double> xx_, xy_, yy_;  // of each slot
  struct Held {
    int particle;
    Block extra;
  };
  std::vector<Held> held_;
};

}  // namespace dem::sheet
