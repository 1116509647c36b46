#pragma once
// Pictures against pictures, as an eye sees them: what the smoothing of edges can explain is no difference.
#include "render/image.h"

namespace comparison {

struct PictureDifference {
  bool same_size = true;
  double changed = 0;    ///< share of the pixels that differ at all
  double beyond = 0;     ///< share of the pixels that differ by more than an edge that moved by half a pixel
  double worst = 1;      ///< structural similarity (Wang et al. 2004) of the tile of 8 x 8 pixels that fits least
  bool seen = false;     ///< a tile has so many pixels beyond that it shows
  render::Image marked;  ///< the new picture, faded; beyond: strong, explained by edges: pale
};

/// `factor` 1: pictures as drawn; more: both are made by reduced_picture() with it.
PictureDifference compare_pictures(const render::Image& was, const render::Image& is, int factor);

/// Each pixel the mean of factor x factor, in 32 steps a channel: what a reference keeps.
render::Image reduced_picture(const render::Image& image, int factor);

}  // namespace comparison
