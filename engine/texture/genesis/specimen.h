#pragma once
// Specimens of the grain texture model (Zhao et al. 2021, section 2.3): packing, grain seeds, masking and growth.
// SI units; the cylinder stands on z = 0, its axis is the z axis.
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/model/model.h"

namespace dem::texture {

using Vec3 = std::array<double, 3>;

struct Cylinder {
  double diameter = 0;  ///< m
  double height = 0;    ///< m
};

/// Spheres at rest in a vessel.
struct Packing {
  std::vector<Vec3> position;
  std::vector<double> radius;
  std::vector<std::array<std::int32_t, 2>> contacts;  ///< i < j, sorted; pairs that touch: distance <= r_i + r_j
  double pressure = 0;                                ///< mean wall pressure, Pa
  double coordination = 0;                            ///< 2 contacts / particles
  double porosity = 0;                                ///< 1 - sphere volume / vessel volume
  double radius_scale = 0;                            ///< final radii over drawn radii
  int floaters_removed = 0;
};

/// A mineral as the genesis needs it.
struct MineralGrains {
  double share = 0;         ///< volume fraction of grain seeds
  double diameter_min = 0;  ///< m
  double diameter_max = 0;  ///< m
};

/// Grain seeds: spheres of the minerals, packed at random.
struct GrainSeeds {
  std::vector<Vec3> position;
  std::vector<double> radius;
  std::vector<std::int32_t> mineral;
};

/// Ellipsoids that the seeds become (Eqs. 3-6).
struct GrainShape {
  double aspect_ratio = 1;   ///< AR = lambda^3 = a/b
  double dip = 0;            ///< rad, long axis above the horizontal plane
  double dip_direction = 0;  ///< rad, azimuth of the long axis from x
};

/// The grain of each particle, and how it came by it.
struct GrainMap {
  std::vector<std::int32_t> grain;  ///< index into GrainSeeds
  std::vector<std::int32_t> mineral;
  std::vector<std::int32_t>
      growth_round;  ///< 0: masked by an ellipsoid, n: claimed in round n of growth ("gap particle")
};

struct PackingSettings {
  Cylinder vessel;
  double radius_min = 0;       ///< m
  double radius_ratio = 1.66;  ///< R_max / R_min
  double modulus = 0;          ///< E_pack, Pa: kn = E_pack pi r^2 / L
  double pressure = 0;         ///< material pressure, Pa (0.01 E_pack)
  double porosity = 0.3325;    ///< of the cloud as drawn: sets the number of particles
  std::uint64_t seed = 1;
};

/// Steps 1 and 2 of the genesis. Deterministic for any number of threads. Throw CaseError when the packing does not settle.
Packing pack(const PackingSettings& settings, RunContext& context);
GrainSeeds seed_grains(const Cylinder& vessel, const std::vector<MineralGrains>& minerals, double seed_scale,
                       std::uint64_t seed, RunContext& context);

/// Whose grain a particle takes that touches several grains in one round of growth; the paper says only "of the particle
/// that it touches". Equal claims go to the lower grain index.
enum class GrowthRule {
  most_contacts,   ///< the grain of most of its claimed neighbours: smooth boundaries, fewest inter-grain contacts
  deepest_contact  ///< the grain of the claimed neighbour with the largest overlap, the first to touch as particles grow
};

/// Step 3: masking by ellipsoids, then growth along contacts, round by round, until every particle has a grain.
/// Overlapping ellipsoids: the nearest in their metric. Particles that no contact joins to a grain: the nearest ellipsoid.
GrainMap grow_grains(const Packing& packing, const GrainSeeds& seeds, const GrainShape& shape,
                     GrowthRule rule = GrowthRule::most_contacts);

/// pack() and seed_grains(), each kept by content in context.specimens (KEY.h5, KEY the first 16 hexadecimal digits of the
/// SHA-256 of its settings); made when the file is missing or damaged. With no folder nothing is kept.
struct Genesis {
  Packing packing;
  GrainSeeds seeds;
};
Genesis genesis(const PackingSettings& settings, const std::vector<MineralGrains>& minerals, double seed_scale,
                RunContext& context);

/// The names of its two files in the folder of specimens.
std::vector<std::string> genesis_files(const PackingSettings& settings, const std::vector<MineralGrains>& minerals,
                                       double seed_scale);

}  // namespace dem::texture
