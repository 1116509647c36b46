#pragma once
// Points sorted into cubic cells, so that near pairs are found without a look at all pairs.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace dem {

class CellGrid {
 public:
  /// Cells of this `edge` over the box of `count` points; place(i) is point i as std::array<double, 3>, in the unit of the
  /// edge. Where an axis would need more cells than `most`, points further out share the last one: a few that flew far
  /// cost no memory. A point that is not a number lies in the first cell.
  template <class Place>
  CellGrid(std::size_t count, double edge, const Place& place, int most = std::numeric_limits<int>::max())
      : edge_(edge) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 3> high{-far, -far, -far};
    origin_ = {far, far, far};
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<double, 3> at = place(i);
      for (std::size_t a = 0; a < 3; ++a) {
        origin_[a] = std::min(origin_[a], at[a]);
        high[a] = std::max(high[a], at[a]);
      }
    }
    for (std::size_t a = 0; a < 3; ++a) {
      count_[a] = 1 + static_cast<int>(std::max(0.0, std::min((high[a] - origin_[a]) / edge, most - 1.0)));
    }
    first_.assign(row(0, count_[2]) + 1, 0);
    std::vector<std::size_t> cell(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<int, 3> c = cell_of(place(i));
      cell[i] = row(c[1], c[2]) + static_cast<std::size_t>(c[0]);
      ++first_[cell[i] + 1];
    }
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    member_.resize(count);
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < count; ++i) {
      member_[static_cast<std::size_t>(next[cell[i]]++)] = static_cast<std::int32_t>(i);
    }
  }

  /// Calls visit(j) for the points in the cell of `at` and in the 26 around it, all those within `edge` among them. The
  /// order is fixed: cells with x running fastest and z slowest, points of a cell by number.
  template <class Visit>
  void around(const std::array<double, 3>& at, const Visit& visit) const {
    const std::array<int, 3> cell = cell_of(at);
    const auto low = [&](std::size_t a) { return std::max(cell[a] - 1, 0); };
    const auto high = [&](std::size_t a) { return std::min(cell[a] + 1, count_[a] - 1); };
    for (int z = low(2); z <= high(2); ++z) {
      for (int y = low(1); y <= high(1); ++y) {
        // Cells along x are neighbours in memory: three of them are one run.
        const std::int32_t begin = first_[row(y, z) + static_cast<std::size_t>(low(0))];
        const std::int32_t end = first_[row(y, z) + static_cast<std::size_t>(high(0)) + 1];
        for (std::int32_t n = begin; n < end; ++n) visit(member_[static_cast<std::size_t>(n)]);
      }
    }
  }

 private:
  // The first cell of a row along x.
  [[nodiscard]] std::size_t row(int y, int z) const {
    const auto each = static_cast<std::size_t>(count_[0]);
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(y)) * each;
  }
  [[nodiscard]] std::array<int, 3> cell_of(const std::array<double, 3>& at) const {
    std::array<int, 3> cell{};
    for (std::size_t a = 0; a < 3; ++a) {
      // In this order of operands a NaN becomes 0.
      cell[a] = static_cast<int>(std::max(0.0, std::min((at[a] - origin_[a]) / edge_, count_[a] - 1.0)));
    }
    return cell;
  }

  double edge_;
  std::array<double, 3> origin_{};
  std::array<int, 3> count_{};
  std::vector<std::int32_t> first_;  // members of cell c: member_[first_[c]] ... member_[first_[c + 1]]
  std::vector<std::int32_t> member_;
};

}  // namespace dem
