#include "reports/comparison/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace comparison {
namespace {

using render::Image;

struct Bounds {
  int low = 255, high = 0;
  void add(int value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// How far a value lies outside.
  [[nodiscard]] int outside(int value) const { return std::max({low - value, value - high, 0}); }
};

Bounds around(const Image& image, int column, int row, std::size_t channel) {
  Bounds bounds;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, image.height - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, image.width - 1); ++c) {
      bounds.add(image.rgb[image.at(c, r) + channel]);
    }
  }
  return bounds;
}

/// An edge that moves by less than a pixel makes no colour that is not there already, in either picture, within a pixel; a
/// line of one pixel may fade to half of its contrast. What lies further outside is another thing.
bool is_beyond(const Image& was, const Image& is, int column, int row) {
  constexpr double least = 12;  // of 255
  constexpr double share = 0.6;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const std::size_t at = was.at(column, row) + channel;
    if (std::abs(was.rgb[at] - is.rgb[at]) <= least) continue;
    const Bounds old_bounds = around(was, column, row, channel);
    const Bounds new_bounds = around(is, column, row, channel);
    const int outside = std::max(old_bounds.outside(is.rgb[at]), new_bounds.outside(was.rgb[at]));
    const int range = std::max(old_bounds.high, new_bounds.high) - std::min(old_bounds.low, new_bounds.low);
    if (outside > least && outside > share * range) return true;
  }
  return false;
}

/// The same for means of blocks: an edge that moves by half a pixel changes the mean by 1 / (2 factor) of its contrast.
bool is_block_beyond(const Image& was, const Image& is, int column, int row, int factor) {
  constexpr double least = 20;  // of 255: the steps of both, and a thin line that moves from block to block
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const std::size_t at = was.at(column, row) + channel;
    const int difference = std::abs(was.rgb[at] - is.rgb[at]);
    if (difference <= least) continue;
    const Bounds old_bounds = around(was, column, row, channel);
    const Bounds new_bounds = around(is, column, row, channel);
    const int range = std::max(old_bounds.high, new_bounds.high) - std::min(old_bounds.low, new_bounds.low);
    if (difference > least + 0.8 * range / factor) return true;
  }
  return false;
}

double grey(const Image& image, int column, int row) {
  const std::size_t at = image.at(column, row);
  return 0.299 * image.rgb[at] + 0.587 * image.rgb[at + 1] + 0.114 * image.rgb[at + 2];
}

double similarity(const Image& was, const Image& is, int left, int top, int right, int bottom) {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int row = top; row < bottom; ++row) {
    for (int column = left; column < right; ++column) {
      const double x = grey(was, column, row), y = grey(is, column, row);
      a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
    }
  }
  const double n = (right - left) * (bottom - top);
  a /= n, b /= n, aa = aa / n - a * a, bb = bb / n - b * b, ab = ab / n - a * b;
  constexpr double c1 = 6.5025, c2 = 58.5225;
  return (2 * a * b + c1) * (2 * ab + c2) / ((a * a + b * b + c1) * (aa + bb + c2));
}

}  // namespace

Image reduced_picture(const Image& image, int factor) {
  Image small((image.width + factor - 1) / factor, (image.height + factor - 1) / factor);
  for (int row = 0; row < small.height; ++row) {
    for (int column = 0; column < small.width; ++column) {
      std::array<int, 3> sum{};
      int count = 0;
      for (int r = row * factor; r < std::min((row + 1) * factor, image.height); ++r) {
        for (int c = column * factor; c < std::min((column + 1) * factor, image.width); ++c, ++count) {
          for (std::size_t k = 0; k < 3; ++k) sum[k] += image.rgb[image.at(c, r) + k];
        }
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const int step = (sum[k] + 4 * count) / (8 * count);  // to the nearest of 0, 8, 16, ...
        small.rgb[small.at(column, row) + k] = static_cast<std::uint8_t>(std::min(8 * step, 255));
      }
    }
  }
  return small;
}

PictureDifference compare_pictures(const Image& was, const Image& is, int factor) {
  PictureDifference difference;
  difference.same_size = was.width == is.width && was.height == is.height;
  if (!difference.same_size) {
    difference.changed = difference.beyond = 1;
    difference.worst = 0;
    difference.seen = true;
    return difference;
  }
  constexpr int tile = 8;
  const int enough = factor > 1 ? 1 : 4;  // pixels of a tile: a dot of three is not seen
  difference.marked = Image(is.width, is.height);
  std::size_t changed = 0, beyond = 0;
  for (int top = 0; top < is.height; top += tile) {
    for (int left = 0; left < is.width; left += tile) {
      const int bottom = std::min(top + tile, is.height), right = std::min(left + tile, is.width);
      int here = 0;
      bool any = false;
      for (int row = top; row < bottom; ++row) {
        for (int column = left; column < right; ++column) {
          const std::size_t at = is.at(column, row);
          const auto faded = static_cast<std::uint8_t>(200 + grey(is, column, row) * 55 / 255);
          std::array<std::uint8_t, 3> shown = {faded, faded, faded};
          if (!std::equal(&is.rgb[at], &is.rgb[at] + 3, &was.rgb[at])) {
            any = true;
            ++changed;
            shown = {140, 190, 230};
            if (factor > 1 ? is_block_beyond(was, is, column, row, factor) : is_beyond(was, is, column, row)) {
              ++beyond;
              ++here;
              shown = {200, 0, 110};
            }
          }
          std::copy(shown.begin(), shown.end(), &difference.marked.rgb[at]);
        }
      }
      if (here >= enough) difference.seen = true;
      if (any) difference.worst = std::min(difference.worst, similarity(was, is, left, top, right, bottom));
    }
  }
  const double pixels = static_cast<double>(is.width) * is.height;
  difference.changed = static_cast<double>(changed) / pixels;
  difference.beyond = static_cast<double>(beyond) / pixels;
  return difference;
}

}  // namespace comparison
