#pragma once
// Contact of a sphere with a rigid wall without friction: platens, jaws and the jacket.
//
// As published (Cundall & Strack 1979): the linear law without friction. The stiffness follows the rule of the contacts of
// spheres, A E_c / L (linear_contact.h), where one side is rigid: A = pi R^2, L = R.
//   k = pi R E_c                                 N/m
//   F = -k g  where g < 0, else nothing acts     N, away from the wall; gap g, m
//
// As coded: the gap is that between the surface of the sphere and the wall, less the gap g0 <= 0 at installation,
//   platen at height z_w:    g = +-(z_w - z) - R - g0      force along z
//   jacket of radius R_j:    g = R_j - |(x, y)| - R - g0   force towards the axis
//   hollow jaw of radius R_f with its axis along y, at a distance d in the plane (x, z) from the centre of the sphere:
//                            g = R_f - d - R - g0           force towards its axis
// Stored energy U = k g^2 / 2. Without friction the force passes through the centre: there is neither moment nor heat.
// The reaction on the wall is -F.
//
// Departures: contacts that are there at installation start free of stress (g0); the curvature of the jacket has no
// part in k.
#include <numbers>

#include "engine/texture/laws/vector_math.h"

namespace dem::texture {

/// Parameters of a contact. It has no state.
struct WallContact {
  double gap_at_rest = 0;  ///< g0, m
  double stiffness = 0;    ///< k, N/m
};

/// k for a sphere of radius R (m) and modulus E_c (Pa).
DEM_INLINE double wall_stiffness(double modulus, double radius) { return modulus * std::numbers::pi * radius; }

/// Gap between a platen at height `wall` and the surface of a sphere at height z below (upper) or above it, m.
DEM_INLINE double platen_gap(double wall, bool upper, double z, double radius) {
  return (upper ? wall - z : z - wall) - radius;
}

/// Gap between a jacket and the surface of a sphere whose centre is `away` from its axis, m.
DEM_INLINE double jacket_gap(double jacket, double away, double radius) { return jacket - away - radius; }

/// A hollow jaw as a sphere meets it.
struct JawGap {
  double gap = 0;       ///< m
  double x = 0, z = 0;  ///< direction in which the face pushes
};

/// `jaw`: its radius, m. (dx, dz): from its axis to the centre of the sphere, m.
DEM_INLINE JawGap jaw_gap(double jaw, double dx, double dz, double sphere) {
  const double away = root(dx * dx + dz * dz);
  return {jaw - away - sphere, -dx / away, -dz / away};
}

/// What the wall does to the sphere.
struct WallResult {
  double push = 0;       ///< F, N, never negative
  double stiffness = 0;  ///< -dF/dg, N/m: k where the contact bears
  double energy = 0;     ///< U, J
};

/// The contact at the gap (m) that platen_gap() or jacket_gap() gives.
DEM_INLINE WallResult advance(const WallContact& contact, double surface_gap) {
  const double gap = surface_gap - contact.gap_at_rest;
  if (gap >= 0) return {};
  return {-contact.stiffness * gap, contact.stiffness, 0.5 * contact.stiffness * gap * gap};
}

}  // namespace dem::texture
