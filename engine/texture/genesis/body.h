#pragma once
// The body that is tested: the packing as it was made, laid on its side, or a piece cut out of it. SI units.
//
// A body lies in a box from -x/2 to x/2, -y/2 to y/2 and 0 to z. It is loaded along z and seen along y, whatever it is.
// Sides that the vessel moulded are smooth: particles touch them. Cut sides are rough by a radius: a particle belongs
// to the body when its centre does.
#include "engine/texture/genesis/specimen.h"

namespace dem::texture {

struct Body {
  enum class Shape {
    cylinder,   ///< upright, as it was packed: diameter x = y, height z
    disc,       ///< a packing on its side: diameter x = z, thickness y
    half_disc,  ///< the upper half of a disc: diameter x, thickness y, radius z; cut below
    bar         ///< a block, cut out of a cylinder with its axis along x
  };
  Shape shape = Shape::cylinder;
  Vec3 size{};       ///< m
  double notch = 0;  ///< m: a cut without width, from below, in the plane x = 0

  [[nodiscard]] bool holds(const Vec3& at) const;
  [[nodiscard]] double volume() const;    ///< m^3
  [[nodiscard]] double smallest() const;  ///< of its size, m
  /// Whether a straight line between two points of the body goes through the notch.
  [[nodiscard]] bool notched(const Vec3& one, const Vec3& two) const;
};

/// The vessel of the packing that it is made of; `margin` (m) is cut off where sides are cut all round.
Cylinder vessel_of(const Body& body, double margin);

/// Lays packing and seeds as the body lies, and keeps what belongs to it: particles with three contacts at least.
/// Coordination and porosity are those of what is kept. Seeds keep their number.
void cut_out(const Body& body, const Cylinder& vessel, Genesis& genesis);

}  // namespace dem::texture
