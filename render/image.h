#pragma once
// Pixels in memory.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace render {

/// 8-bit RGB, rows from the top down.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  Image() = default;
  Image(int w, int h) : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 255) {}
  [[nodiscard]] std::size_t at(int column, int row) const {
    return 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column));
  }
};

/// Mean of blocks of factor x factor pixels: smooths edges drawn at `factor` times the size. Sizes must divide.
Image shrink(const Image& image, int factor);

/// One below the other; they must be of one width.
Image stacked(const Image& above, const Image& below);

/// (1 - share) a + share b, pixel by pixel; sizes must agree.
Image mix(const Image& a, const Image& b, double share);

}  // namespace render
