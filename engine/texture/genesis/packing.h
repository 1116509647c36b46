#pragma once
// Random dense packings of spheres in a cylinder, at a given wall pressure: the routine behind pack() and
// seed_grains().
#include <cstdint>
#include <vector>

#include "engine/core/random.h"
#include "engine/texture/genesis/relax.h"
#include "engine/texture/genesis/specimen.h"

namespace dem::texture {

/// Wanted state of rest.
struct SettleGoal {
  double pressure = 0.01;            ///< mean wall pressure over modulus
  double pressure_tolerance = 2e-3;  ///< relative
  double unbalance = 1e-4;           ///< mean net force over mean contact force
  bool remove_floaters = true;       ///< take out spheres with fewer than three contacts, walls counted
};

/// Spheres at rest; lengths in m, pressure over modulus.
struct Settled {
  std::vector<Sphere> spheres;      ///< in space_filling_order()
  std::vector<std::size_t> origin;  ///< index in the cloud of each sphere
  PileState state;                  ///< forces in modulus * m^2
  double radius_scale = 1;
  int floaters_removed = 0;
  std::int64_t steps = 0;
};

/// Relaxes a cloud without friction, then scales all radii together until the wall pressure meets the goal.
/// Throws CaseError when that does not come about, Interrupted when context.stopped().
Settled settle(const Cylinder& vessel, std::vector<Sphere> cloud, const SettleGoal& goal, RunContext& context);

/// Indices of the spheres in an order that keeps neighbours near in memory: slabs of three mean diameters from the
/// bottom up, inside a slab by the Morton code of cells of half a mean diameter. Ties by index.
std::vector<std::size_t> space_filling_order(const std::vector<Sphere>& spheres);

/// A point for the centre of a sphere of radius `r`, uniform over the places where it lies within the vessel.
Vec3 random_place(const Cylinder& vessel, double r, std::uint64_t seed, Purpose purpose, std::uint32_t index);

double expected_spheres(const PackingSettings& settings);  ///< of the cloud that is drawn, in the mean
double volume(const Cylinder& vessel);                     ///< m3
double sphere_volume(double radius);                       ///< m3

}  // namespace dem::texture
