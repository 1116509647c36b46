#pragma once
// How far the two sides of a band have moved against each other. Lengths in m.
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace dem::analysis {

/// A flat band with its two directions: across it, and in its plane up the loading axis z (x where the band lies level).
struct BandFrame {
  std::array<double, 3> normal{}, along{};
  double offset = 0, thickness = 0;  ///< of its middle along the normal
};
BandFrame band_frame(const std::array<double, 3>& normal, double offset, double thickness);

/// Displacement of the layer beyond the upper face of a band, half as thick as it, less that of the layer beyond the other face;
/// and how much of it the strain of the sides would give: the common slope of two straight lines, one through the points on each
/// side. What is left is the jump: none under an even strain, all of it where two stiff halves part.
struct Jump {
  struct Part {
    double moved = 0, even = 0;
    [[nodiscard]] double beyond() const { return moved - even; }
  };
  Part opening;   ///< across the band; negative: it closes
  Part slip;      ///< in its plane, along its steepest direction: up is positive
  Part sideways;  ///< in its plane, level
};
/// Points and displacements are triples. Nothing with fewer than ten points in a layer.
std::optional<Jump> jump_across(std::span<const double> point, std::span<const double> displacement,
                                const BandFrame& band);

/// Means of the displacement across and along the band by distance from its middle, of five points or more.
struct JumpProfile {
  std::vector<double> distance, across, along;
};
JumpProfile profile_across(std::span<const double> point, std::span<const double> displacement, const BandFrame& band,
                           double step, double reach);

}  // namespace dem::analysis
