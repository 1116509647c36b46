#pragma once
// The account of an assembly: the energy ledger, its samples, cracks in the order in which they happened.
//
// The ledger closes to the order of the step squared: kinetic energy m v- . v+ / 2, damping with the centred velocity,
// work of the walls by the mean force over the drift, slip and breaking heat as the exact drop of stored energy.
#include <array>
#include <cstdint>
#include <vector>

#include "engine/texture/solver/input.h"

namespace dem::texture {

/// Broken bonds or joint elements, as they happen.
struct Crack {
  double step = 0;
  std::int32_t contact = 0;  ///< index into AssemblyInput::bonds
  std::int8_t shear = 0;     ///< 1: shear, 0: tension
  std::int8_t boundary = 0;  ///< 1: between grains
  Vec3 position{};           ///< m
  Vec3 normal{};
  double area = 0;      ///< m^2
  double released = 0;  ///< J, as the ledger counts it
  Vec3 force{};         ///< N: what the bond did on its second particle just before, less what it does after
};

/// The energy account, J. residual = work - everything else.
struct Ledger {
  double work = 0;  ///< of platens or grips, and of the jacket
  double elastic = 0, kinetic = 0;
  double damping = 0, friction = 0;
  double bond_tension = 0, bond_shear = 0;  ///< released by cracks
  [[nodiscard]] double residual() const {
    return work - elastic - kinetic - damping - friction - bond_tension - bond_shear;
  }
};

/// What a sample tells about the assembly at one instant.
struct Sample {
  double step = 0, time = 0;      ///< -, s
  std::array<double, 2> force{};  ///< of the lower and upper platen (or grip) on the specimen, along their motion, N
  std::array<double, 2> place{};  ///< of the two, along their motion, m
  double jacket_radius = 0;       ///< m
  double confining_pressure = 0;  ///< of the jacket on the specimen: its force over its area, Pa
  double normal_force = 0;        ///< of an upper grip that is free along z on the specimen, N, downwards
  double rise = 0;                ///< of that grip since installation, m
  Ledger ledger;
};

/// What the contacts of a block have turned into heat since the beginning, J; what they store at the sample; and their
/// cracks since the last one.
struct BlockAccount {
  double friction = 0, bond_tension = 0, bond_shear = 0, elastic = 0;
  std::vector<Crack> cracks;
  template <class Archive>
  void archive(Archive& a) {
    a(friction, bond_tension, bond_shear, elastic, cracks);
  }
};

/// What damping has taken from the particles of a slab since the beginning, and their kinetic energy, J.
struct MotionAccount {
  double damping = 0, kinetic = 0;
  double late_damping = 0;  ///< heat of the second half of the present kick, which a sample does not count yet
};

struct Block;

/// Adds slabs and blocks up in their order.
void add_up(const std::vector<MotionAccount>& slabs, Ledger& ledger);
void add_up(const std::vector<Block>& blocks, Ledger& ledger);

/// Moves the cracks of the blocks to the end of `cracks`, by step and, within a step, by block.
void collect_cracks(std::vector<Block>& blocks, std::vector<Crack>& cracks);

}  // namespace dem::texture
