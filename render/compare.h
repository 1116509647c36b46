#pragma once
// Pictures against pictures.
#include <filesystem>

namespace render {

/// Comparison of two PNG files: 0 same, 1 black against white or not of one size. Throws dem::EnvironmentError when
/// unreadable.
struct ImageDifference {
  double mean = 0;   ///< mean absolute difference of channels
  double worst = 0;  ///< of a channel, mean over 8 x 8 pixels: a shifted line shows, a smoothed edge does not
  bool same_size = true;
};
ImageDifference compare_png(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace render
