#pragma once
// The hot loops over bonds and particles, built for several instruction sets from one source (kernels.inc).
// All of them give the same bits: element-wise operations only, forces added in the order of the bonds.
#include <cstdint>
#include <string_view>

namespace dem {
enum class InstructionSet;  // instruction_set.h has inline functions, which sources with -mavx512f must not build
}

namespace dem::texture {

inline constexpr int pack_width = 8;

/// Eight intact flat joints, field by field. Dead lanes have zero stiffness and huge strengths.
struct alignas(64) FlatJointPack {
  enum Field { dx, dy, dz, share_one, length, normal, inverse_ratio, rho, opening, cohesion, tan_phi, fields };
  double field[fields][pack_width];
  std::int32_t first[pack_width], second[pack_width];
};

/// Eight grain-boundary contacts: parallel bond (bonded or broken) with its linear part and its slip.
struct alignas(64) ParallelBondPack {
  enum Field {
    dx,
    dy,
    dz,
    share_one,
    length,
    linear_normal,
    linear_inverse_ratio,
    friction,
    normal,
    inverse_ratio,
    radius,
    opening,
    cohesion,
    tan_phi,
    slip_x,
    slip_y,
    slip_z,
    shear_x,
    shear_y,
    shear_z,
    fields
  };
  double field[fields][pack_width];
  std::int32_t first[pack_width], second[pack_width];
};

/// Positions and rotations: rows of 8 doubles, x y z radius | w x y z. 64-byte aligned, as are forces and velocities.
/// Forces: rows of 8 doubles, Fx Fy Fz 0 | Mx My Mz 0.
struct BondLoop {
  const double* pose;
  double* force;
  std::int32_t* flagged;       ///< out: slots (8 * pack + lane) that may have broken
  std::int32_t flagged_count;  ///< out
  double heat;                 ///< out: friction heat of this pass, J
};

/// Mass and moment of inertia of a particle, and the time step over each.
struct alignas(32) Inertia {
  double mass, moment;  ///< kg, kg m^2
  double step_over_mass, step_over_moment;
};

/// A range of particles and their step in time, with local damping. Velocities: rows of 8 doubles, vx vy vz 0 | wx wy wz 0.
struct MotionLoop {
  double* pose;
  double* velocity;
  double* force;  ///< set to zero
  const Inertia* inertia;
  std::int64_t count;
  double step;  ///< s
  double damping;
  /// Out, J: what damping took from the velocities before and after together times two; with those after alone; and
  /// twice the kinetic energy in the middle of the step.
  double heat, late_heat, kinetic;
};

struct PartlyBrokenJoint;

/// What it takes to see that eight broken joints stay open. A joint that is not open has an infinite reach, one that was
/// dropped none and a length of minus infinity.
struct alignas(64) OpenJointPack {
  double length[pack_width];  ///< distance at rest, m
  double reach[pack_width];   ///< (2 rho)^2, m^2
  std::int32_t first[pack_width], second[pack_width];
};

struct Kernels {
  const char* name;  ///< "sse2", "avx2", "avx512"
  void (*flat_joints)(const FlatJointPack*, std::int32_t packs, BondLoop&);
  void (*parallel_bonds)(ParallelBondPack*, std::int32_t packs, BondLoop&);
  double (*flat_joint_energy)(const FlatJointPack*, std::int32_t packs, const double* pose);
  double (*parallel_bond_energy)(const ParallelBondPack*, std::int32_t packs, const double* pose);
  void (*integrate)(MotionLoop&);
  /// Those of `count` joints that do not stay open in this step, by number and in order, into `active`; returns how many.
  std::int32_t (*closed_joints)(const OpenJointPack*, std::int32_t count, const double* pose, std::int32_t* active);
  /// Those joints of `list` in which no element breaks and whose broken faces still match; the others are flagged by their
  /// number in `joints` and left alone.
  void (*broken_joints)(PartlyBrokenJoint* joints, const std::int32_t* list, std::int32_t count, BondLoop&);
};

const Kernels& kernels(InstructionSet set);
/// The widest is the fastest at every size that was measured (packs have eight lanes with any of them).
const Kernels& kernels();
/// By name, "wide" included: eight lanes in SSE2. nullptr when unknown or not possible here.
const Kernels* kernels(std::string_view name);

}  // namespace dem::texture
