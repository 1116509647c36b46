#pragma once
// An assembly of bonded spheres in explicit motion: the solver of the grain texture model.
//
// Velocities stand half a step out of phase (leapfrog), for translation and rotation; local damping puts a force
// -alpha |F| sign(v) on each component, and the same for moments (Potyondy & Cundall 2004). New contacts are linear and
// frictional. The energy account is kept so that it closes to the order of the step squared: kinetic energy m v- . v+ / 2,
// damping with the centred velocity, platen work by the mean force over the drift, slip and breaking heat as the exact
// drop of stored energy.
//
// Particles must come ordered in slabs along z (order_in_slabs). A slab is thicker than the reach of a contact, so that
// slabs are worked on in parallel, then the contacts between even and odd pairs of slabs: every particle receives its
// forces in one fixed order, and the bits do not depend on the number of threads.
#include <array>
#include <cstdint>
#include <vector>

#include "engine/texture/laws/flat_joint.h"
#include "engine/texture/laws/properties.h"
#include "engine/texture/solver/kernels.h"

namespace dem::texture {

using Vec3 = std::array<double, 3>;

/// Eight doubles in one cache line.
struct alignas(64) Row8 {
  double v[8];
};

/// One contact as installed: free of stress at the present distance.
struct BondSpec {
  std::int32_t first = 0, second = 0;
  bool boundary = false;    ///< true: parallel bond (between grains), false: flat joint (inside)
  bool frictional = false;  ///< true: no bond at all, only the linear part
  ContactGroup group;
};

struct AssemblyInput {
  std::vector<Vec3> position;         ///< m, ordered in slabs along z
  std::vector<double> radius;         ///< m
  std::vector<double> density;        ///< kg/m^3
  std::vector<std::int32_t> mineral;  ///< index into `fresh` and wall_modulus
  std::vector<BondSpec> bonds;
  std::vector<std::vector<ContactGroup>> fresh;  ///< [mineral][mineral]: linear parts of contacts that form later
  std::vector<double> wall_modulus;              ///< E_c of each mineral, Pa: platen contacts have k = E_c pi r
  std::vector<std::int8_t> grip;                 ///< 0 free, 1 held by the lower grip, 2 by the upper; empty: none
  bool platens = false;                          ///< frictionless rigid planes at z_low and z_high
  double z_low = 0, z_high = 0;                  ///< m; lower and upper platen (or grip face)
  double jacket_radius = 0;       ///< m; frictionless cylindrical wall round the z axis, for confine(); 0: none
  double damping = 0.7;           ///< alpha
  double time_step_factor = 0.8;  ///< of the critical step from the stiffness sums
  int slabs = 0;                  ///< 0: chosen
};

/// Broken bonds or joint elements, as they happen.
struct Crack {
  double step = 0;
  std::int32_t contact = 0;  ///< index into AssemblyInput::bonds
  std::int8_t shear = 0;     ///< 1: shear, 0: tension
  std::int8_t boundary = 0;  ///< 1: between grains
  Vec3 position{};           ///< m
  Vec3 normal{};
  double area = 0;  ///< m^2
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
  std::array<double, 2> force{};  ///< z-force of the lower and upper platen (or grip) on the specimen, N
  std::array<double, 2> place{};  ///< z of the two, m
  double jacket_radius = 0;       ///< m
  double confining_pressure = 0;  ///< of the jacket on the specimen: its force over its area, Pa
  Ledger ledger;
};

class Assembly {
 public:
  Assembly(const AssemblyInput& input, int threads);

  /// Speeds of the lower and upper platen or grip along z (m/s), reached linearly over `ramp` steps from now.
  void drive(double lower, double upper, std::int64_t ramp);
  /// Confining pressure (Pa) on the jacket, and on both platens until they are driven, reached linearly over `ramp` steps
  /// from now. These walls have no mass: at each step each of them goes to where its contacts carry the pressure, by one
  /// Newton step from the forces of the step before; the jacket foresees that particles go on pushing as they did.
  void confine(double pressure, std::int64_t ramp);
  /// Advances by `steps` steps and samples at the last of them.
  Sample advance(std::int64_t steps);

  [[nodiscard]] double time_step() const { return dt_; }  ///< s
  [[nodiscard]] std::int64_t step() const { return step_; }
  [[nodiscard]] std::size_t particles() const { return pose_.size(); }
  [[nodiscard]] const std::vector<Row8>& poses() const { return pose_; }      ///< x y z radius | w x y z
  [[nodiscard]] std::vector<Row8>& velocities() { return velocity_; }         ///< vx vy vz 0 | wx wy wz 0
  [[nodiscard]] const std::vector<Crack>& cracks() const { return cracks_; }  ///< ordered by step
  [[nodiscard]] double mass(std::size_t particle) const { return inertia_[particle].mass; }
  [[nodiscard]] std::size_t fresh_contacts() const;  ///< contacts formed after installation
  void set_threads(int threads) { threads_ = threads; }
  void set_kernels(const Kernels& set) { kernels_ = &set; }

  struct Counts {
    std::int64_t joints = 0, bonds = 0, broken_joints = 0, fresh = 0;
    std::int64_t bytes = 0;  ///< of all contact records
  };
  [[nodiscard]] Counts counts() const;

  template <class Archive>
  void archive(Archive& a) {
    a(step_, walls_, pose_, velocity_, force_, near_, blocks_, cracks_, wall_contacts_, sums_, jacket_,
      jacket_contacts_);
  }

 private:
  struct FreshContact {
    std::int32_t first = 0, second = 0;
    double normal = 0, shear = 0, friction = 0;  ///< N/m, N/m, -
    double length = 0;                           ///< distance without stress, m
    Triple<double> slide{0, 0, 0};               ///< elastic shear displacement, m
    double energy = 0;                           ///< J
    std::int8_t alive = 1;
  };
  struct WallContact {
    std::int32_t particle = 0;
    std::int8_t upper = 0;
    double gap_at_rest = 0;  ///< m
    double stiffness = 0;    ///< N/m
  };
  struct Wall {
    double z = 0, z_before = 0;
    double drift_before = 0;                 ///< m, of the step before
    double speed = 0, target = 0, gain = 0;  ///< m/s, m/s, m/s a step
    double stiffness = 0;                    ///< of all its first contacts, N/m
    std::int64_t servo = 0;                  ///< 1: moved by the confining pressure, not by its speed
  };
  struct JacketContact {
    std::int32_t particle = 0;
    double gap_at_rest = 0;  ///< m
    double stiffness = 0;    ///< N/m
  };
  struct Jacket {
    double radius = 0, radius_before = 0;       ///< m
    double pressure = 0, target = 0, gain = 0;  ///< Pa, Pa, Pa a step
    double stiffness = 0;                       ///< of all its first contacts, N/m
    double force_before = 0, drift = 0;         ///< N, m: of the step before
  };
  /// Contacts of one slab, or between two neighbouring slabs.
  struct Block {
    std::vector<FlatJointPack> joints;
    std::vector<std::int32_t> joint_contact;  ///< slot -> contact, -1 padding
    std::vector<ParallelBondPack> bonds;
    std::vector<std::int32_t> bond_contact;
    std::vector<PartlyBrokenJoint> broken;
    std::vector<FreshContact> fresh;
    std::vector<std::array<std::int32_t, 2>> candidates;  ///< near pairs without contact
    std::vector<std::int32_t> flagged;
    std::vector<OpenJointPack> watch;  ///< of `broken`, in its order; made anew when `watched` is not its size
    std::int64_t watched = 0;
    std::vector<std::int32_t> active;  ///< broken joints that do not stay open in this step
    std::vector<Crack> cracks;
    double friction = 0, bond_tension = 0, bond_shear = 0, elastic = 0;
    template <class Archive>
    void archive(Archive& a) {
      watched = -1;
      a(joints, joint_contact, bonds, bond_contact, broken, fresh, candidates, flagged, cracks, friction, bond_tension,
        bond_shear, elastic);
    }
  };
  /// Sums of a slab, added up in slab order when asked for.
  struct SlabSums {
    std::array<double, 2> force{}, force_before{};  ///< of the platens or grips on the specimen
    double work = 0, damping = 0, kinetic = 0, elastic = 0;
    double late_damping = 0;            ///< heat of the second half of the present kick
    std::array<double, 2> stiffness{};  ///< of the platen contacts that bear, N/m
    double jacket_force = 0, jacket_force_before = 0, jacket_stiffness = 0;  ///< sums over radial forces
  };

  void install(const AssemblyInput& input);
  void choose_time_step(const AssemblyInput& input);
  void forces(Block& block, std::int64_t step, bool look_for_contacts);
  void find_active(Block& block) const;
  void roll(Block& block, PartlyBrokenJoint& joint, const Action<double>& action);
  void roll(Block& block, ParallelBondPack& pack, int lane);
  void joint_events(Block& block, std::int32_t count);
  void bond_events(Block& block, std::int64_t step, std::int32_t count);
  void wall_forces(std::size_t slab);
  double hold(std::size_t slab);
  void integrate(std::size_t slab);
  double block_elastic(const Block& block) const;
  void move_walls();
  void maintain();
  void find_near_pairs();
  Pose<double> pose(std::int32_t particle) const;
  void add(std::int32_t first, std::int32_t second, const Action<double>& action);
  double half_work(std::int32_t first, std::int32_t second, const Action<double>& action) const;
  int block_of(std::int32_t first, std::int32_t second) const;

  // fixed after installation
  int threads_ = 1;
  const Kernels* kernels_ = nullptr;
  double damping_ = 0;
  std::vector<Inertia> inertia_;
  std::vector<std::int32_t> mineral_, slab_;
  std::vector<std::int8_t> grip_;
  std::vector<std::vector<ContactGroup>> fresh_;
  std::vector<double> wall_modulus_;
  std::vector<BondSpec> specs_;
  std::vector<std::int32_t> slab_begin_;  ///< slabs + 1
  bool platens_ = false;
  std::vector<std::vector<std::int32_t>> held_;  ///< by slab; empty without grips
  double skin_ = 0;                              ///< m

  // state
  std::int64_t step_ = 0;
  double dt_ = 0;
  std::array<Wall, 2> walls_{};
  std::vector<Row8> pose_, velocity_, force_;
  std::vector<Row8> near_;     ///< positions when the near pairs were last found
  std::vector<Block> blocks_;  ///< slabs, then pairs of neighbours, then one for the rest
  std::vector<Crack> cracks_;
  std::vector<std::vector<WallContact>> wall_contacts_;  ///< by slab
  std::vector<SlabSums> sums_;
  Jacket jacket_;
  std::vector<std::vector<JacketContact>> jacket_contacts_;  ///< by slab
};

/// An order of particles in slabs thicker than the largest contact (along z), and along a Morton curve inside a slab:
/// order[new] = old. The number of slabs follows from heights and radii only.
std::vector<std::int32_t> order_in_slabs(const std::vector<Vec3>& position, const std::vector<double>& radius);

}  // namespace dem::texture
