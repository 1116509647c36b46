#pragma once
// An assembly of bonded spheres in explicit motion: the solver of the grain texture model.
//
// It composes the parts of a step and runs them on threads: the forces of blocks of contacts (forces.h) with the events
// among them (events.h), the walls (walls.h), the motion of the particles (motion.h), the account (account.h), and now
// and then the search for new neighbours (neighbours.h). Slabs (slabs.h) say what may run side by side; the bits do not
// depend on the number of threads.
#include <cstdint>
#include <vector>

#include "engine/core/threads.h"
#include "engine/texture/solver/account.h"
#include "engine/texture/solver/block.h"
#include "engine/texture/solver/input.h"
#include "engine/texture/solver/kernels.h"
#include "engine/texture/solver/neighbours.h"
#include "engine/texture/solver/particles.h"
#include "engine/texture/solver/slabs.h"
#include "engine/texture/solver/walls.h"

namespace dem::texture {

class Assembly {
 public:
  /// Throws std::logic_error when particles are not ordered in slabs or nothing touches.
  Assembly(const AssemblyInput& input, int threads);

  /// See Walls.
  void drive(double lower, double upper, std::int64_t ramp) { walls_.drive(lower, upper, ramp); }
  void confine(double pressure, std::int64_t ramp) { walls_.confine(pressure, ramp); }
  void press(double force, std::int64_t ramp) { walls_.press(force, ramp); }
  /// Advances by `steps` steps and samples at the last of them.
  Sample advance(std::int64_t steps);

  [[nodiscard]] double time_step() const { return particles_.step; }  ///< s
  [[nodiscard]] std::int64_t step() const { return step_; }
  [[nodiscard]] std::size_t particles() const { return particles_.size(); }
  [[nodiscard]] const std::vector<Row8>& poses() const { return particles_.pose; }  ///< see Particles
  [[nodiscard]] std::vector<Row8>& velocities() { return particles_.velocity; }     ///< see Particles
  [[nodiscard]] const std::vector<Crack>& cracks() const { return cracks_; }        ///< ordered by step
  [[nodiscard]] double mass(std::size_t particle) const { return particles_.inertia[particle].mass; }
  [[nodiscard]] ContactCounts counts() const { return count(blocks_); }
  /// Contacts formed after installation.
  [[nodiscard]] std::size_t fresh_contacts() const { return static_cast<std::size_t>(counts().fresh); }
  void set_threads(int threads) { threads_ = threads; }
  void set_kernels(const Kernels& set) { kernels_ = &set; }

  template <class Archive>
  void archive(Archive& a) {
    a(step_, particles_, walls_, blocks_, neighbours_, motion_, cracks_);
  }

 private:
  void run(std::int64_t steps, bool sampled, int threads);
  void work_on(std::size_t block, std::int64_t step);
  void move_slab(std::size_t slab);
  Sample sample();
  void maintain();

  // fixed after installation
  int threads_ = 1;  ///< at most
  Pace pace_;        ///< and how many of them it takes now
  const Kernels* kernels_ = nullptr;
  double damping_ = 0;
  Slabs slabs_;
  ContactRules rules_;

  // state
  std::int64_t step_ = 0;
  Particles particles_;
  Walls walls_;
  std::vector<Block> blocks_;  ///< slabs, then pairs of neighbours, then one for the rest
  Neighbours neighbours_;
  std::vector<MotionAccount> motion_;  ///< by slab
  std::vector<Crack> cracks_;
};

}  // namespace dem::texture
