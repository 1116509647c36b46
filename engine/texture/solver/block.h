#pragma once
// The contacts of one slab, or between two neighbouring slabs: all that one thread works on at a time.
#include <array>
#include <cstdint>
#include <vector>

#include "engine/texture/laws/flat_joint.h"
#include "engine/texture/laws/linear_contact.h"
#include "engine/texture/solver/account.h"
#include "engine/texture/solver/kernels.h"
#include "engine/texture/solver/particles.h"

namespace dem::texture {

/// Two spheres that touch without a bond.
struct SphereContact {
  std::int32_t first = 0, second = 0;
  LinearContact law;
  double energy = 0;  ///< stored, J
  std::int8_t alive = 1;
};

struct Block {
  std::vector<FlatJointPack> joints;        ///< intact
  std::vector<std::int32_t> joint_contact;  ///< slot (8 * pack + lane) -> contact, -1 padding
  std::vector<ParallelBondPack> bonds;      ///< intact and broken
  std::vector<std::int32_t> bond_contact;
  std::vector<PartlyBrokenJoint> broken;
  std::vector<SphereContact> spheres;
  std::vector<std::array<std::int32_t, 2>> candidates;  ///< near pairs without contact
  std::vector<std::int32_t> flagged;                    ///< of the kernel that ran last
  std::vector<OpenJointPack> watch;  ///< of `broken`, in its order; made anew when `watched` is not its size
  std::int64_t watched = 0;
  std::vector<std::int32_t> active;  ///< broken joints that do not stay open in this step
  BlockAccount account;

  template <class Archive>
  void archive(Archive& a) {
    watched = -1;
    a(joints, joint_contact, bonds, bond_contact, broken, spheres, candidates, flagged, account);
  }
};

/// What contacts take from the materials when they break or form.
struct ContactRules {
  std::vector<double> friction;                  ///< mu of each installed contact, once it is broken
  std::vector<std::vector<ContactGroup>> fresh;  ///< [mineral][mineral]: linear parts of contacts that form later
};

struct ContactCounts {
  std::int64_t joints = 0, bonds = 0, broken_joints = 0, fresh = 0;
  std::int64_t bytes = 0;  ///< of all contact records
};

struct Slabs;

/// The bonds of the input in blocks, each bond free of stress at the present distance.
std::vector<Block> install_contacts(const AssemblyInput& input, const Slabs& slabs);

/// Takes contacts without bond whose particles have parted out of the block.
void drop_parted(Block& block, const Particles& particles);

ContactCounts count(const std::vector<Block>& blocks);

}  // namespace dem::texture
