#pragma once
// Sparse Cholesky factor of the sheet's stiffness by nested dissection of the lattice (George 1973), multifrontal
// (Duff & Reid 1983). The lattice gives the dissection and the pattern, once for all: neither a graph partitioner nor a
// BLAS is needed, and the result is the same bits for any number of threads and any vector width.
//
// Solves may start from few loaded particles: the forward sweep then visits only the path from their leaves to the
// root, which is what makes a broken spring cheap (see modified.h).
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/sheet/dense.h"

namespace dem::sheet {

/// A patch of a triangular lattice: rows along x, every other row shifted right by half a spacing.
/// Particle (column c, row r) has index r * columns + c.
struct Lattice {
  int columns = 0;
  int rows = 0;
  bool first_row_shifted = false;

  [[nodiscard]] int particles() const { return columns * rows; }
  [[nodiscard]] bool shifted(int row) const { return (row % 2 != 0) != first_row_shifted; }
  /// The particles [begin, end) of a row that have a neighbour in direction 0 to 2: `offset` further on.
  struct Line {
    int begin, end, offset;
  };
  [[nodiscard]] Line line(int row, int direction) const;
  /// Neighbour in direction 0 east, 1 north-east, 2 north-west, 3 west, 4 south-west, 5 south-east; -1 outside.
  [[nodiscard]] int neighbour(int particle, int direction) const;
};

/// Symmetric 2 x 2 block {xx, xy, yy}.
using Block = std::array<double, 3>;

/// The stiffness matrix by blocks: `diagonal` of each particle, `coupling[direction * particles + i]` (directions 0-2)
/// the block between i and its neighbour, already with its sign. `fixed` bit 0: x held, bit 1: y held.
struct BlockMatrix {
  std::vector<Block> diagonal;
  std::vector<Block> coupling;
  std::vector<std::uint8_t> fixed;
};

/// The elimination tree of a lattice: what does not change when the numbers do.
class Dissection {
 public:
  explicit Dissection(const Lattice& lattice, int leaf_particles = 30);

  struct Node {
    int begin = 0, end = 0;  ///< positions (particles, in elimination order) eliminated here
    int parent = -1;
    int child[2] = {-1, -1};
    int first = 0;              ///< first node of the subtree; the subtree is [first, itself]
    std::vector<int> boundary;  ///< positions coupled to the subtree from outside, ascending
    struct Entry {
      int coupling;     ///< index into BlockMatrix::coupling
      int row, column;  ///< in particles, within the front
    };
    std::vector<Entry> entries;
    [[nodiscard]] int own() const { return end - begin; }
    [[nodiscard]] int front() const { return own() + static_cast<int>(boundary.size()); }
    [[nodiscard]] int rest() const { return static_cast<int>(boundary.size()); }
    /// Row (in particles) of a position in the front.
    [[nodiscard]] int row_of(int at) const;
  };
  /// Particles that lie side by side in two places: `count` of them from `from` in one and from `to` in the other. The
  /// boundary of a box has few of these, and sweeps copy them as they are.
  struct Run {
    int from, to, count;
  };
  [[nodiscard]] std::span<const Run> gathered(int node) const;   ///< from positions to rows of the node's boundary
  [[nodiscard]] std::span<const Run> handed_up(int node) const;  ///< from these to rows of the parent's front; none
                                                                 ///< reaches over the end of the parent's own
  Lattice lattice;
  std::vector<Node> nodes;    ///< children before parents; the last is the root
  std::vector<int> order;     ///< particle at each position
  std::vector<int> position;  ///< position of each particle
  std::vector<int> node_of;   ///< node that eliminates each position
  /// Of each node. Panels lie from the root down, the way the backward sweep reads them; offsets and size in lines.
  std::vector<std::size_t> panel_offset, update_offset;
  std::size_t panel_size = 0, update_size = 0;

 private:
  int divide(int c0, int c1, int r0, int r1, int leaf);
  void connect(int node, int c0, int c1, int r0, int r1);
  void find_runs();

  std::vector<Run> gathers_, hand_ups_;                      // of one node after the other
  std::vector<std::size_t> gathers_begin_, hand_ups_begin_;  // of each node, and the end
};

/// The entries of L^-1 b for a load b on few particles: nonzero on the path from their nodes to the root.
struct PathVector {
  std::vector<int> nodes;     ///< ascending
  std::vector<float> values;  ///< of each node's positions, x and y, one node after the other
};

/// The numeric factor, made in single precision and kept in sixteen bits (see ThinPanel). Vectors hold x and y of each
/// particle, in elimination order.
class Factor {
 public:
  /// Whether parts of the tree can be factorised anew later: costs about the memory of the panels once more.
  enum class Again { whole, parts };
  Factor(const Dissection& dissection, int threads, Again again = Again::whole);

  /// Factorises `matrix`; returns the number of negative pivots (see partial_cholesky).
  int factorise(const BlockMatrix& matrix, PivotRule rule = {});

  /// A flag a node, closed so that `factorise` below may take it: what is flagged takes its whole small subtree and all
  /// nodes up to the root with it.
  void close(std::vector<std::uint8_t>& stale) const;
  /// Factorises only the nodes of `stale` (closed) anew; the rest of `matrix` must be as it was. Same bits as the
  /// whole.
  int factorise(const BlockMatrix& matrix, std::span<const std::uint8_t> stale, PivotRule rule = {});
  /// Operations (multiplications, about) that factorising the nodes of `stale` takes.
  [[nodiscard]] double operations(std::span<const std::uint8_t> stale) const;

  /// y = L^-1 y for the nodes in `active` (a flag a node, closed towards the root); y is zero elsewhere and stays so.
  void forward(std::span<float> y, std::span<const std::uint8_t> active);
  /// x = L^-T x, everywhere.
  void backward(std::span<float> x);
  /// L^-1 b for a load on a few particles ({position, {x, y}}).
  [[nodiscard]] PathVector forward_path(std::span<const std::pair<int, std::array<double, 2>>> load);

  [[nodiscard]] const Dissection& dissection() const { return *dissection_; }
  void set_threads(int threads) { threads_ = threads; }  ///< no result hangs on their number
  /// Bytes that a sweep over all reads.
  [[nodiscard]] std::size_t bytes() const { return sizeof(ThinPanel::Line) * panels_.size(); }

 private:
  struct Job {
    const BlockMatrix& matrix;
    std::span<const std::uint8_t> stale;
    PivotRule rule;
    std::vector<int> raised;
  };
  [[nodiscard]] int subtree(int node) const;  // particles
  [[nodiscard]] bool small(int node) const;   // always factorised with all below it
  void visit(int node, Job& job);
  void eliminate(int node, Job& job);
  [[nodiscard]] ThinPanel panel(int node);
  void forward_node(int node, float* y, const std::uint8_t* active, std::vector<float>& t);
  void hand_up(int node, const ThinPanel& panel, std::span<const int> children, std::vector<float>& t);
  void backward_node(int node, float* x, std::vector<float>& t);
  void visit_up(int node, float* y, const std::uint8_t* active);
  void visit_down(int node, float* x);

  const Dissection* dissection_;
  int threads_;
  Again again_;
  std::vector<ThinPanel::Line> panels_;
  std::vector<std::vector<float>> schur_;  // what a node hands to its parent in the factorisation
  std::vector<float> updates_;             // what a node hands to its parent in a forward sweep
};

}  // namespace dem::sheet
