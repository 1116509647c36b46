#include <array>

#include "render/style.h"

namespace render {

Colour palette(std::size_t index) {
  static constexpr std::array<Colour, 8> colours{
      {{0.000, 0.447, 0.698},    // blue
       {0.835, 0.369, 0.000},    // vermilion
       {0.000, 0.620, 0.451},    // bluish green
       {0.800, 0.475, 0.655},    // reddish purple
       {0.902, 0.624, 0.000},    // orange
       {0.337, 0.706, 0.914},    // sky blue
       {0.000, 0.000, 0.000},    // black
       {0.720, 0.720, 0.100}}};  // yellow, darker than theirs for white paper
  return colours[index % colours.size()];
}

}  // namespace render
