// The parts of a step, one after the other and side by side.
#include "engine/texture/solver/assembly.h"

#include <omp.h>

#include <algorithm>

#include "engine/core/threads.h"
#include "engine/texture/solver/forces.h"
#include "engine/texture/solver/motion.h"
#include "engine/texture/solver/packs.h"

namespace dem::texture {
namespace {

constexpr std::int64_t look_interval = 10;  // steps between looks at near pairs

ContactRules rules_of(const AssemblyInput& input) {
  ContactRules rules;
  for (const BondSpec& bond : input.bonds) rules.friction.push_back(bond.group.friction);
  rules.fresh = input.fresh;
  return rules;
}

double smallest(const std::vector<double>& radius) {
  return radius.empty() ? huge : *std::min_element(radius.begin(), radius.end());
}

}  // namespace

Assembly::Assembly(const AssemblyInput& input, int threads)
    : threads_(std::max(threads, 1)),
      kernels_(&kernels()),
      damping_(input.damping),
      slabs_(cut_in_slabs(input.position, input.radius, input.slabs)),
      rules_(rules_of(input)),
      particles_(particles_of(input)),
      walls_(input, slabs_),
      blocks_(install_contacts(input, slabs_)),
      neighbours_(0.3 * smallest(input.radius)),
      motion_(slabs_.count()) {
  set_step(particles_, input.time_step_factor * critical_step(input, particles_, walls_));
  neighbours_.find(particles_, slabs_, blocks_);
  walls_.meet(particles_, slabs_, neighbours_.skin());
}

void Assembly::work_on(std::size_t block, std::int64_t step) {
  add_forces(blocks_[block], particles_, rules_, *kernels_, step);
  if (step % look_interval == 0) form_contacts(blocks_[block], particles_, rules_);
}

void Assembly::move_slab(std::size_t slab) {
  const double held_kinetic = walls_.hold(slab, particles_);
  integrate(particles_, slabs_.begin[slab], slabs_.begin[slab + 1], damping_, held_kinetic, *kernels_, motion_[slab]);
}

Sample Assembly::advance(std::int64_t steps) {
  // In short stretches, between which the number of threads may change: the bits do not depend on it.
  for (std::int64_t left = steps; left > 0;) {
    const std::int64_t stretch = threads_ > 1 ? std::min(left, look_interval) : left;
    left -= stretch;
    run(stretch, left == 0, pace_.begin(threads_));
    pace_.done(static_cast<double>(stretch));
  }
  const Sample taken = sample();
  for (Block& block : blocks_) {
    close_ranks(block.joints, block.joint_contact);
    close_ranks(block.bonds, block.bond_contact);
  }
  maintain();
  return taken;
}

void Assembly::run(std::int64_t steps, bool sampled, int threads) {
  const std::size_t slabs = slabs_.count(), pairs = slabs - 1;
  const std::int64_t end = step_ + steps;
  const bool rest = !blocks_.back().spheres.empty() || !blocks_.back().candidates.empty();
  Barrier barrier;  // spins less than OpenMP's own, and asks the system only when a thread sleeps
#pragma omp parallel num_threads(threads)
  {
#pragma omp single
    barrier.set_threads(omp_get_num_threads());
    for (std::int64_t step = step_; step < end; ++step) {
      // 1. inside slabs; the slabs of a thread are the same here and in the motion, so that no barrier is needed between
#pragma omp for schedule(static, 1) nowait
      for (std::size_t slab = 0; slab < slabs; ++slab) {
        work_on(slab, step);
        walls_.press(slab, particles_);
      }
      barrier.wait();
#pragma omp single nowait
      walls_.move(particles_.step);
      // 2. between slabs: even pairs, then odd ones
#pragma omp for schedule(dynamic, 1) nowait
      for (std::size_t pair = 0; pair < pairs; pair += 2) work_on(slabs + pair, step);
      barrier.wait();
#pragma omp for schedule(dynamic, 1) nowait
      for (std::size_t pair = 1; pair < pairs; pair += 2) work_on(slabs + pair, step);
      barrier.wait();
      if (rest) {  // contacts that failure made between slabs further apart
#pragma omp single nowait
        work_on(slabs_.blocks() - 1, step);
        barrier.wait();
      }
      if (sampled && step + 1 == end) {
#pragma omp for schedule(dynamic, 1) nowait
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
          blocks_[b].account.elastic = stored_energy(blocks_[b], particles_, *kernels_);
        }
        barrier.wait();
      }
      // 3. motion
#pragma omp for schedule(static, 1) nowait
      for (std::size_t slab = 0; slab < slabs; ++slab) move_slab(slab);
    }
  }
  step_ = end;
}

Sample Assembly::sample() {
  Sample sample;
  sample.step = static_cast<double>(step_ - 1);
  sample.time = sample.step * particles_.step;
  walls_.report(sample);
  add_up(motion_, sample.ledger);
  add_up(blocks_, sample.ledger);
  collect_cracks(blocks_, cracks_);
  return sample;
}

// Drops contacts that have parted, and looks for near pairs again when particles have moved far enough.
void Assembly::maintain() {
  if (!neighbours_.due(particles_)) return;
  for (Block& block : blocks_) drop_parted(block, particles_);
  neighbours_.find(particles_, slabs_, blocks_);
  walls_.meet(particles_, slabs_, neighbours_.skin());
}

}  // namespace dem::texture
