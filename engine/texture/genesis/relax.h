#pragma once
// A pile of frictionless spheres in an upright cylinder, brought to rest at given radii.
//
// Contact force F = kn * overlap, kn = E pi r^2 / L with r = min(R1, R2), L = R1 + R2 between spheres and r = L = R at
// a wall. Lengths are in a unit of the caller's choice, E = 1: forces are in E * length^2, pressures in E. The cylinder
// stands on z = 0 with its axis along z.
//
// The minimiser is FIRE 2.0 (Guenole et al. 2020) with a mass per sphere proportional to its stiffness, so that one
// step suits all sizes. Every sum runs over fixed blocks of spheres: the same bits for any number of threads.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/core/cell_grid.h"

namespace dem::texture {

/// Centre and radius side by side: one gather per neighbour.
struct alignas(32) Sphere {
  double x = 0, y = 0, z = 0, r = 0;
};

/// The cells of the centres; spheres whose centres are closer than `edge` lie in neighbouring ones.
CellGrid cells_of(const std::vector<Sphere>& spheres, double edge);

/// What a force evaluation tells about the whole pile.
struct PileState {
  double mean_contact_force = 0;  ///< over sphere-sphere contacts
  double mean_unbalanced = 0;     ///< mean magnitude of the net force, over spheres
  double wall_pressure = 0;       ///< sum of all wall forces / (both ends + mantle): area-weighted over the three walls
  std::size_t contacts = 0;       ///< sphere-sphere
};

class Pile {
 public:
  Pile(double diameter, double height, std::vector<Sphere> spheres, double force_floor, int threads);

  /// Called every some tens of steps with the latest state; may throw to end the relaxation.
  using Watch = std::function<void(const PileState&)>;

  /// Moves the spheres until unbalance() <= tolerance. False when `max_steps` were not enough. Neighbour lists reach
  /// `skin` beyond touch.
  bool relax(double tolerance, double skin, int max_steps, const Watch& watch);

  /// Mean net force over mean contact force; the latter is not taken below `force_floor`, so that spheres that hardly
  /// touch count as at rest.
  [[nodiscard]] double unbalance() const;

  void scale_radii(double factor);
  /// Takes out the spheres for which keep[i] is false.
  void keep_only(const std::vector<bool>& keep);

  [[nodiscard]] const std::vector<Sphere>& spheres() const { return spheres_; }
  [[nodiscard]] const PileState& state() const { return state_; }
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  /// Contacts of each sphere, walls counted.
  [[nodiscard]] std::vector<int> contact_counts() const;

 private:
  struct Vector {
    double x = 0, y = 0, z = 0;
  };
  /// Sums over one block of spheres; `power`, `force2` and `speed2` in the metric of the masses.
  struct Sums {
    double power = 0, force2 = 0, speed2 = 0, unbalanced = 0, contact_force = 0, wall_force = 0;
    std::size_t contacts = 0;
    void add(const Sums& other);
  };

  void find_neighbours(double skin);
  Sums evaluate();
  Sums evaluate_block(std::size_t begin, std::size_t end);
  /// v = keep v + push F/m, x += dt v; returns the largest distance to the place of the last neighbour search, squared.
  double advance(double keep, double push, double dt);
  void step_back(double dt);
  [[nodiscard]] std::size_t blocks() const;
  [[nodiscard]] int workers() const;

  double radius_;  // of the vessel
  double height_;
  double force_floor_;
  int threads_;
  std::vector<Sphere> spheres_;
  std::vector<Sphere> searched_;  // where the spheres were at the last neighbour search
  std::vector<Vector> velocity_;
  std::vector<Vector> force_;
  std::vector<std::int32_t> first_;  // neighbours of i: neighbour_[first_[i]] ... neighbour_[first_[i + 1]]
  std::vector<std::int32_t> neighbour_;
  std::vector<Sums> block_sums_;
  PileState state_;
  std::int64_t steps_ = 0;
};

}  // namespace dem::texture
