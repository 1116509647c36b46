#include "engine/lattice/block.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/errors.h"
#include "engine/lattice/kernel.h"

namespace dem::lattice {
namespace {

const double row_spacing = std::sqrt(3.0) / 2;
const double layer_spacing = std::sqrt(2.0 / 3.0);

int nearest_odd(double value) { return 2 * static_cast<int>(std::lround((value - 1) / 2)) + 1; }

int half_shifted(int layer, int row) { return (layer + row) & 1; }  // rows that start half a diameter along y

void need_odd(int value, const char* what) {
  if (value < 3 || value % 2 == 0) {
    throw InputError(
        fmt::format("the number of {} is {}", what, value),
        "it must be an odd number of at least 3: rows and layers alternate, and only then are both faces full");
  }
}

}  // namespace

BlockShape block_shape(int ny, int rows, int layers) {
  if (ny < 2) throw InputError(fmt::format("the number of elements along y is {}", ny), "it must be 2 or more");
  if (ny == 2) return {2, 2, 2};
  BlockShape shape{ny, nearest_odd(1 + (ny - 1) / row_spacing), nearest_odd(1 + (ny - 1) / layer_spacing)};
  if (ny == 10) shape.layers = 11;  // published: 1105 elements, one pair of layers below the nearest to a cube
  shape.rows = std::max(shape.rows, 3);
  shape.layers = std::max(shape.layers, 3);
  if (rows != 0) shape.rows = rows;
  if (layers != 0) shape.layers = layers;
  need_odd(shape.rows, "rows");
  need_odd(shape.layers, "layers");
  return shape;
}

int row_length(const BlockShape& s, int layer, int row) {
  if (layer < 0 || layer >= s.layers || row < 0) return 0;
  if (s.unit()) return layer == 0 ? (row < 2 ? 2 - row : 0) : (row == 0 ? 1 : 0);
  if (row >= s.rows - (layer & 1)) return 0;
  return s.ny - half_shifted(layer, row);
}

Site neighbour(const Site& s, int direction) {
  const int shifted = half_shifted(s.layer, s.row);
  const bool layer_b = s.layer & 1;
  switch (direction) {
    case 0:
      return {s.layer, s.row, s.column + 1};
    case 1:
      return {s.layer, s.row + 1, s.column - 1 + shifted};
    case 2:
      return {s.layer, s.row + 1, s.column + shifted};
    case 3:
      return {s.layer + 1, s.row, s.column - 1 + shifted};
    case 4:
      return {s.layer + 1, s.row, s.column + shifted};
    default:
      return {s.layer + 1, layer_b ? s.row + 1 : s.row - 1, s.column};
  }
}

std::array<double, 3> bond_vector(int layer_kind, int direction) {
  const double side = layer_kind == 0 ? 1.0 : -1.0;  // B layers look up into the hollows from the other side
  switch (direction) {
    case 0:
      return {0, 1, 0};
    case 1:
      return {row_spacing, -0.5, 0};
    case 2:
      return {row_spacing, 0.5, 0};
    case 3:
      return {side * row_spacing / 3, -0.5, layer_spacing};
    case 4:
      return {side * row_spacing / 3, 0.5, layer_spacing};
    default:
      return {-side * 2 * row_spacing / 3, 0, layer_spacing};
  }
}

std::int64_t element_count(const BlockShape& shape) {
  std::array<std::int64_t, 2> of_layer{};  // the even layers are alike, and so are the odd ones
  for (std::size_t layer = 0; layer < 2; ++layer) {
    for (int row = 0; row < shape.rows; ++row) of_layer[layer] += row_length(shape, static_cast<int>(layer), row);
  }
  return of_layer[0] * ((shape.layers + 1) / 2) + of_layer[1] * (shape.layers / 2);
}

Block make_block(const BlockShape& shape, double d) {
  Block block;
  block.shape = shape;
  block.diameter = d;
  std::vector<std::int32_t> first(static_cast<std::size_t>(shape.layers * shape.rows), -1);
  for (int layer = 0; layer < shape.layers; ++layer) {
    for (int row = 0; row < shape.rows; ++row) {
      first[static_cast<std::size_t>(layer * shape.rows + row)] = static_cast<std::int32_t>(block.site.size());
      for (int column = 0; column < row_length(shape, layer, row); ++column) {
        block.site.push_back({layer, row, column});
        block.position.push_back({d * (row + (layer & 1 ? 1.0 / 3 : 0.0)) * row_spacing,
                                  d * (column + 0.5 * half_shifted(layer, row)), d * layer * layer_spacing});
      }
    }
  }
  for (std::size_t a = 0; a < block.site.size(); ++a) {
    for (int k = 0; k < directions; ++k) {
      const Site s = neighbour(block.site[a], k);
      if (s.column < 0 || s.row < 0 || s.row >= shape.rows || s.column >= row_length(shape, s.layer, s.row)) continue;
      const auto b = first[static_cast<std::size_t>(s.layer * shape.rows + s.row)] + s.column;
      block.bonds.push_back({static_cast<std::int32_t>(a), b, k});
    }
  }
  return block;
}

std::array<double, 3> Block::extent() const {
  return {(shape.rows - 1) * row_spacing * diameter, (shape.ny - 1) * diameter,
          (shape.layers - 1) * layer_spacing * diameter};
}

std::vector<std::int32_t> Block::face(int axis, bool high) const {
  const double at = high ? extent()[static_cast<std::size_t>(axis)] : 0.0;
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (std::abs(position[i][static_cast<std::size_t>(axis)] - at) < 0.1 * diameter) {
      found.push_back(static_cast<std::int32_t>(i));
    }
  }
  return found;
}

}  // namespace dem::lattice
