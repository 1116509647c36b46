#include "engine/lattice/grid.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace dem::lattice {
namespace {

constexpr std::size_t line = 8;  // doubles in a cache line

std::size_t whole_lines(std::size_t n) { return (n + line - 1) / line * line; }

}  // namespace

Buffer::Buffer(std::size_t size) : size_(whole_lines(size)) {
  data_.reset(static_cast<double*>(std::aligned_alloc(64, std::max(size_, line) * sizeof(double))));
  if (!data_) throw std::bad_alloc();
  std::memset(data_.get(), 0, std::max(size_, line) * sizeof(double));
}

Grid::Grid(const Block& block, int lanes, int threads, bool pushed) {
  const BlockShape& shape = block.shape;
  rows_per_layer = shape.rows;
  pitch = (shape.ny + lanes - 1) / lanes * lanes;
  force_pitch = pitch + lanes;
  chunks = pitch / lanes;
  const int count = shape.layers * shape.rows;
  const auto size = static_cast<std::size_t>(count), wide = static_cast<std::size_t>(pitch);

  rows.resize(size);
  length.resize(size);
  bits_.assign(size * static_cast<std::size_t>(chunks), Bits{});
  // Rows above the last and a vector on each side are read, and masked, through the bonds that do not exist.
  motion_ = Buffer((size + static_cast<std::size_t>(shape.rows) + 2) * 6 * wide + 4 * line);
  shear_ = Buffer(size * 3 * directions * wide);
  sum_ = Buffer(size * 3 * wide);
  scalars_ = Buffer(size * 6 * wide);
  planes_ = Buffer(size * 4 * wide);
  if (pushed) pushes_ = Buffer(size * 3 * wide);
  for (int g = 0; g < count; ++g) {
    const auto i = static_cast<std::size_t>(g);
    length[i] = row_length(shape, g / shape.rows, g % shape.rows);
    Row& row = rows[i];
    row.index = g;
    row.layer_kind = g / shape.rows & 1;
    row.self = motion_.data() + 2 * line + i * 6 * wide;
    row.shear = shear_.data() + i * 3 * directions * wide;
    row.sum = sum_.data() + i * 3 * wide;
    row.viscous = scalars_.data() + i * 6 * wide;
    row.friction = row.viscous + wide;
    row.sample = row.viscous + 2 * wide;
    row.bits = bits_.data() + i * static_cast<std::size_t>(chunks);
    row.push = pushed ? pushes_.data() + i * 3 * wide : nullptr;
    row.plane_stiffness = row.held = nullptr;
    row.plane_position = row.plane_force = nullptr;
  }
  for (const Site& s : block.site) {
    row_of.push_back(s.layer * shape.rows + s.row);
    column_of.push_back(s.column);
  }
  for (const Block::Bond& bond : block.bonds) set_bond(static_cast<std::size_t>(bond.a), bond.direction, true);
  share_rows(threads);
  connect();
}

void Grid::share_rows(int threads) {
  const int count = static_cast<int>(rows.size());
  const auto filled = std::count_if(length.begin(), length.end(), [](int n) { return n > 0; });
  const int used = static_cast<int>(std::clamp<long>(threads, 1, filled));
  int g = 0;
  long passed = 0;
  for (int t = 0; t < used; ++t) {
    Share share;
    share.first = g;
    const long until = filled * (t + 1) / used;
    while (g < count && (passed < until || t + 1 == used)) passed += length[static_cast<std::size_t>(g++)] > 0;
    share.last = g;
    const int across = rows_per_layer + 1;  // rows that bonds reach; the ring of forces holds two more
    share.early = t + 1 == used ? share.last : std::max(share.first, share.last - across);
    share.lead = t > 0 && t + 1 == used ? std::min(share.last, share.first + across) : share.first;
    shares.push_back(share);
  }
}

void Grid::connect() {
  // Forces live only until the rows that they act on have moved: a ring of rows for each thread, early rows apart.
  const auto row_size = static_cast<std::size_t>(3 * (directions - 1) * force_pitch) + 2 * line;
  const int ring = rows_per_layer + 3;
  std::size_t needed = 0;
  for (const Share& s : shares) needed += static_cast<std::size_t>(ring + s.last - s.early);
  force_ = Buffer(needed * row_size);
  zero_ = Buffer(row_size);
  std::size_t used = 0;
  for (const Share& s : shares) {
    for (int g = s.first; g < s.last; ++g) {
      const auto place = used + static_cast<std::size_t>(g < s.early ? g % ring : ring + g - s.early);
      rows[static_cast<std::size_t>(g)].force = force_.data() + place * row_size + line;
    }
    used += static_cast<std::size_t>(ring + s.last - s.early);
  }
  const int per = rows_per_layer;
  const int layers = static_cast<int>(rows.size()) / per;
  for (int g = 0; g < static_cast<int>(rows.size()); ++g) {
    Row& row = rows[static_cast<std::size_t>(g)];
    const int layer = g / per, r = g % per;
    row.other[0] = row.self + 1;
    row.source[0] = nullptr;
    for (int k = 1; k < directions; ++k) {
      // A site of this row at column 0, and the site whose bond k would end there.
      const Site far = neighbour({layer, r, 0}, k);
      row.other[k] = row.self + static_cast<std::ptrdiff_t>((far.layer * per + far.row - g) * 6 * pitch + far.column);
      const int from_layer = k < 3 ? layer : layer - 1;
      const int from_row = k < 3 ? r - 1 : (k < 5 ? r : (layer & 1 ? r + 1 : r - 1));
      const bool exists = from_layer >= 0 && from_layer < layers && from_row >= 0 && from_row < per &&
                          length[static_cast<std::size_t>(from_layer * per + from_row)] > 0;
      const double* force =
          exists ? rows[static_cast<std::size_t>(from_layer * per + from_row)].force : zero_.data() + line;
      row.source[k] = exists ? force - neighbour({from_layer, from_row, 0}, k).column : force;
    }
  }
}

double& Grid::motion(std::size_t e, int i) {
  return rows[static_cast<std::size_t>(row_of[e])].self[i * pitch + column_of[e]];
}
double Grid::motion(std::size_t e, int i) const {
  return rows[static_cast<std::size_t>(row_of[e])].self[i * pitch + column_of[e]];
}
std::size_t Grid::shear_place(std::size_t e, int k, int i) const {
  const int lanes = pitch / chunks, column = column_of[e];
  return static_cast<std::size_t>((column / lanes * 3 * directions + 3 * k + i) * lanes + column % lanes);
}
double& Grid::shear(std::size_t e, int k, int i) {
  return rows[static_cast<std::size_t>(row_of[e])].shear[shear_place(e, k, i)];
}
double Grid::shear(std::size_t e, int k, int i) const {
  return rows[static_cast<std::size_t>(row_of[e])].shear[shear_place(e, k, i)];
}

int Grid::bond_bits(std::size_t e, int k) const {
  const int lanes = pitch / chunks, lane = column_of[e] % lanes;
  const Bits& bits = rows[static_cast<std::size_t>(row_of[e])].bits[column_of[e] / lanes];
  return (bits.intact[k] >> lane & 1) + 2 * (bits.broken[k] >> lane & 1);
}

void Grid::set_bond(std::size_t e, int k, bool intact) {
  const int lanes = pitch / chunks, bit = 1 << column_of[e] % lanes;
  Bits& bits = rows[static_cast<std::size_t>(row_of[e])].bits[column_of[e] / lanes];
  unsigned char& set = intact ? bits.intact[k] : bits.broken[k];
  unsigned char& clear = intact ? bits.broken[k] : bits.intact[k];
  set = static_cast<unsigned char>(set | bit);
  clear = static_cast<unsigned char>(clear & ~bit);
}

void Grid::bind_plane(const std::vector<std::int32_t>& elements, double stiffness, bool held) {
  for (const std::int32_t element : elements) {
    const auto e = static_cast<std::size_t>(element);
    Row& row = rows[static_cast<std::size_t>(row_of[e])];
    double* base = planes_.data() + static_cast<std::size_t>(row.index) * 4 * static_cast<std::size_t>(pitch);
    row.plane_stiffness = base;
    row.plane_position = base + pitch;
    row.held = base + 2 * pitch;
    row.plane_force = base + 3 * pitch;
    base[column_of[e]] = stiffness;
    base[2 * pitch + column_of[e]] = held ? 1.0 : 0.0;
  }
}

void Grid::add_push(std::size_t element, int i, double newton) {
  pushes_.data()[static_cast<std::size_t>((row_of[element] * 3 + i) * pitch + column_of[element])] += newton;
}

std::size_t Grid::bytes() const {
  return (motion_.size() + shear_.size() + force_.size() + sum_.size() +
          rows.size() * 2 * static_cast<std::size_t>(pitch)) *
             sizeof(double) +
         bits_.size() * sizeof(Bits);
}

}  // namespace dem::lattice
