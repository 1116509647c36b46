#pragma once
// Blocks of the close-packed lattice. Layers A B A ... along z; an A layer has `rows` rows along y holding ny, ny-1,
// ..., ny elements; a B layer sits in its hollows (x shifted by sqrt(3)/6 d) with rows-1 rows holding ny-1, ny, ...
// Spacings: d along y, sqrt(3)/2 d between rows, sqrt(2/3) d between layers. This reproduces every published count.
#include <array>
#include <cstdint>
#include <vector>

namespace dem::lattice {

/// Size of a block in elements.
struct BlockShape {
  int ny = 12;      ///< elements along y, at least 2
  int rows = 13;    ///< of an A layer; odd
  int layers = 15;  ///< odd
  /// The single tetrahedral unit (ny = 2): three elements in layer A, one on top.
  [[nodiscard]] bool unit() const { return ny == 2; }
};

/// The published block with `ny` elements along y (2, 4, 6, 8, 10, 12, 16, 20, 24, 30); for other values the odd
/// numbers of rows and layers that come nearest to a cube. `rows` or `layers` other than 0 override. Throws InputError
/// for ny below 2, and for even or too small numbers of rows or layers.
BlockShape block_shape(int ny, int rows = 0, int layers = 0);

/// An element's place in the lattice.
struct Site {
  std::int32_t layer, row, column;
};

/// Elements and bonds at rest; lengths in m. Elements are numbered by layer, row, column.
struct Block {
  BlockShape shape;
  double diameter = 0;
  std::vector<Site> site;
  std::vector<std::array<double, 3>> position;
  struct Bond {
    std::int32_t a, b;       ///< elements; a owns the bond
    std::int32_t direction;  ///< 0: +y, 1-2: next row, 3-5: layer above
  };
  std::vector<Bond> bonds;  ///< by owner, then direction

  [[nodiscard]] std::array<double, 3> extent() const;  ///< of the box of element centres
  /// Elements of the outermost plane of sites across `axis` (0, 1, 2), low or high side, in order of number.
  [[nodiscard]] std::vector<std::int32_t> face(int axis, bool high) const;
};

/// Elements of a block, without making it.
std::int64_t element_count(const BlockShape& shape);

Block make_block(const BlockShape& shape, double diameter);

// How the lattice looks from one site; the fast loop and the graph above are both made of these.

/// Number of elements in a row; 0 where there is none.
int row_length(const BlockShape& shape, int layer, int row);
/// The site across the bond `direction` of a site; it need not exist.
Site neighbour(const Site& site, int direction);
/// Reference vector of a bond for unit diameter; `layer_kind` 0: A, 1: B.
std::array<double, 3> bond_vector(int layer_kind, int direction);

}  // namespace dem::lattice
