#include "render/image.h"

#include <cmath>
#include <stdexcept>

namespace render {

Image shrink(const Image& image, int factor) {
  if (factor < 1 || image.width % factor != 0 || image.height % factor != 0)
    throw std::invalid_argument("shrink: the image's sides are no multiples of the factor");
  if (factor == 1) return image;
  Image small(image.width / factor, image.height / factor);
  const int count = factor * factor;
  for (int row = 0; row < small.height; ++row)
    for (int column = 0; column < small.width; ++column) {
      int sum[3] = {0, 0, 0};
      for (int dy = 0; dy < factor; ++dy) {
        const std::uint8_t* from = &image.rgb[image.at(column * factor, row * factor + dy)];
        for (int dx = 0; dx < factor; ++dx, from += 3)
          for (int c = 0; c < 3; ++c) sum[c] += from[c];
      }
      for (int c = 0; c < 3; ++c)
        small.rgb[small.at(column, row) + static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>((sum[c] + count / 2) / count);
    }
  return small;
}

Image mix(const Image& a, const Image& b, double share) {
  if (a.width != b.width || a.height != b.height) throw std::invalid_argument("mix: images differ in size");
  Image result(a.width, a.height);
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    result.rgb[i] = static_cast<std::uint8_t>(std::lround((1 - share) * a.rgb[i] + share * b.rgb[i]));
  return result;
}

Image stacked(const Image& above, const Image& below) {
  Image both = above;
  both.height += below.height;
  both.rgb.insert(both.rgb.end(), below.rgb.begin(), below.rgb.end());
  return both;
}

}  // namespace render
