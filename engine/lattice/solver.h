#pragma once
// Motion of a block between two planes: leapfrog with a centred viscous force, every term of the energy ledger of
// Liu et al. 2017, section 4. SI units, tension positive. The same bits for any number of threads and any vector width.
//
// Time n is where displacements u(n) stand; w- and w+ are the displacements of the steps before and after it, and
//   m (w+ - w-) / dt^2 = F(n) - eta (w- + w+) / (2 dt),   Ek(n) = m w-.w+ / (2 dt^2),   Qv += eta |w- + w+|^2 / (4 dt)
// so that work and energy balance to rounding for straight springs. Planes move within the step from n to n+1 and do
// the work (F(n) + F(n+1)) dL / 2 (Eq. 26).
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/instruction_set.h"
#include "engine/lattice/block.h"
#include "engine/lattice/conversion.h"

namespace dem::lattice {

/// How an end layer is bound to its plane. Planes are smooth: they act along the axis only. Their bonds never break.
enum class PlaneKind {
  elastic,  ///< each end element on a spring Kn of its own
  rigid,    ///< end elements held in the plane
  plate,    ///< end elements move as one rigid plate, hung on its springs Kn (n Kn together)
};

struct Setup {
  Micro micro;
  double time_step = 1e-8;  ///< s
  double viscosity = 0;     ///< eta, N s/m
  double gravity = 0;       ///< along -z, m/s^2
  double pressure = 0;      ///< on the four sides, across the axis of loading, from the beginning, Pa
  int axis = 2;             ///< of loading
  PlaneKind planes = PlaneKind::elastic;
  double plane_stiffness = 1;  ///< of the springs between planes and end elements, over Kn
  bool unbreakable = false;
  int threads = 1;
  std::optional<InstructionSet> set;  ///< of the kernels; nothing: the widest
};

/// The state at one time, with the ledger up to it. Energies in J.
struct Sample {
  std::int64_t step = 0;
  double time = 0;
  double strain = 0;                ///< axial: mean motion of the end elements over the distance of end layers
  double between_planes = 0;        ///< motion of the planes over the same distance
  std::array<double, 2> lateral{};  ///< strains across the other two axes, in order, from the means of the faces
  std::array<double, 2> force{};    ///< of the low and the high plane on the block, N, positive where it pulls outwards
  double elastic_normal = 0, elastic_shear = 0;
  double elastic_planes = 0;  ///< springs of the planes; part of the elastic energy
  double kinetic = 0, gravity = 0;
  double viscous = 0, breaking_normal = 0, breaking_shear = 0, frictional = 0;  ///< heat
  double work = 0;                        ///< of the planes and of the pressure on the sides
  std::int64_t opening = 0, sliding = 0;  ///< bonds broken so far
  [[nodiscard]] double elastic() const { return elastic_normal + elastic_shear + elastic_planes; }
  [[nodiscard]] double heat() const { return viscous + breaking_normal + breaking_shear + frictional; }
  /// Ee + Eg + Ek + Q - W
  [[nodiscard]] double imbalance() const { return elastic() + gravity + kinetic + heat() - work; }
};

/// A bond that broke.
struct Crack {
  std::int64_t step = 0;                   ///< at which it was found past its limit
  std::int32_t element = 0;                ///< owner
  std::int32_t direction = 0;              ///< of the bond, see Block::Bond
  std::int32_t mode = 0;                   ///< 0 opening, 1 sliding
  double heat_normal = 0, heat_shear = 0;  ///< J
};

class Solver {
 public:
  /// Throws InputError for a time step above the stable limit, a viscosity below zero, fewer than one thread.
  Solver(const Block& block, const Setup& setup);
  ~Solver();
  Solver(Solver&&) noexcept;

  /// `steps` steps; in the first, the planes move by `low` and `high` (m, along +axis). Ends early after a step in
  /// which a bond broke if `stop_on_break`. Returns the number of steps made.
  int run(int steps, double low = 0, double high = 0, bool stop_on_break = false);
  /// One step with the planes moving as above; returns the state at its beginning.
  Sample sampled_step(double low = 0, double high = 0);

  [[nodiscard]] const std::vector<Crack>& cracks() const;  ///< by step, element, direction
  [[nodiscard]] std::int64_t step() const;
  /// Axial strain as in Sample, now.
  [[nodiscard]] double strain() const;
  /// Displacements by element, m.
  [[nodiscard]] std::vector<std::array<double, 3>> displacement() const;
  /// By bond of the block: 0 intact, 1 opened, 2 slid.
  [[nodiscard]] std::vector<std::int32_t> bond_state() const;
  /// Shear displacements by bond, m.
  [[nodiscard]] std::vector<std::array<double, 3>> bond_shear() const;
  /// Momentum of all elements, kg m/s, from the last step's displacements.
  [[nodiscard]] std::array<double, 3> momentum() const;
  /// Pairs not joined by a bond of the lattice that have come nearer than d: none of them is seen by the law.
  [[nodiscard]] std::int64_t unseen_contacts() const;
  /// Sets displacements and the displacements of the last step of all elements (m), for tests and initial waves.
  void set_motion(const std::vector<std::array<double, 3>>& displacement,
                  const std::vector<std::array<double, 3>>& last);

  /// The whole state as numbers, and back; the receiving solver must be made from the same block and setup.
  struct State {
    std::vector<double> real;
    std::vector<std::int32_t> code;
    std::int64_t step = 0;
    std::vector<Crack> cracks;
    template <class Archive>
    void archive(Archive& a) {
      a(real, code, step, cracks);
    }
  };
  [[nodiscard]] State state() const;
  void restore(const State& state);

  [[nodiscard]] std::size_t bytes() const;  ///< of the arrays that a step touches

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The set that moves this block fastest, from some tens of steps of copies of it: vectors hang over the ends of short
/// rows, wider ones the more. Results do not depend on it.
InstructionSet fastest_set(const Block& block, Setup setup);

}  // namespace dem::lattice
