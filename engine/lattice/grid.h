#pragma once
// The padded arrays behind Solver: rows of elements with guards, and the pointers that the kernels follow.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "engine/lattice/block.h"
#include "engine/lattice/kernel.h"

namespace dem::lattice {

/// Zeroed doubles on cache line boundaries.
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::size_t size);
  [[nodiscard]] double* data() const { return data_.get(); }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double, Free> data_;
  std::size_t size_ = 0;
};

/// The rows of one thread: [first, last). Those from `early` on are evaluated before any row of the step moves, because
/// rows of the next thread need their forces, and they read motion of the next thread. Meanwhile the last thread, which
/// has no such rows, evaluates those before `lead`: otherwise it would wait.
struct Share {
  int first = 0, lead = 0, early = 0, last = 0;
};

class Grid {
 public:
  Grid(const Block& block, int lanes, int threads, bool pushed);
  Grid(const Grid&) = delete;
  Grid& operator=(const Grid&) = delete;

  int rows_per_layer = 0, pitch = 0, force_pitch = 0, chunks = 0;
  std::vector<Row> rows;               ///< by layer * rows_per_layer + row; those without elements are never visited
  std::vector<int> length;             ///< elements in each row
  std::vector<Share> shares;           ///< by thread
  std::vector<int> row_of, column_of;  ///< by element

  /// Component i of an element: 0-2 displacement, 3-5 displacement of the last step.
  double& motion(std::size_t element, int i);
  [[nodiscard]] double motion(std::size_t element, int i) const;
  double& shear(std::size_t element, int direction, int i);
  [[nodiscard]] double shear(std::size_t element, int direction, int i) const;
  [[nodiscard]] int bond_bits(std::size_t element, int direction) const;  ///< 1 intact, 2 broken, 0 none
  void set_bond(std::size_t element, int direction, bool intact);
  /// Gives the elements of a plane their arrays.
  void bind_plane(const std::vector<std::int32_t>& elements, double stiffness, bool held);
  /// A constant force on an element along axis i, beside those that it has.
  void add_push(std::size_t element, int i, double newton);
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] std::size_t shear_place(std::size_t element, int direction, int i) const;
  void share_rows(int threads);
  void connect();
  Buffer motion_, shear_, force_, sum_, scalars_, planes_, pushes_, zero_;
  std::vector<Bits> bits_;
};

}  // namespace dem::lattice
