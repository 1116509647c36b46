#pragma once
// The spring sheet: particles on a triangular lattice, joined by linear springs along their lines of centres.
//
// Units: the box is 1 wide, so lengths are in box widths; spring constants are numbers (k = 1 stands for 10 GPa);
// forces are k times a length, and stresses (per unit thickness) have the unit of k.
//   spring          f = k (d - (r_i + r_j)), tension positive, no shear, no moment
//   pair not joined f = k min(0, d - (r_i + r_j)): contact without friction, between neighbours of the lattice only
//   elasticity      E = 2 k / sqrt(3), nu = 1/3 in the plane (Flekkoy et al. 2002)
#include <cstdint>
#include <vector>

#include "engine/sheet/factor.h"

namespace dem::sheet {

/// State of the sheet. Springs are numbered slot = direction * particles + i: direction 0 east, 1 north-east,
/// 2 north-west of particle i. Slots without a neighbour have no stiffness.
struct Sheet {
  Lattice lattice;
  double radius0 = 0;            ///< 0.5 / columns; row spacing sqrt(3) radius0
  double width = 0, height = 0;  ///< undeformed distance between opposite walls' outer faces
  std::vector<double> x, y;      ///< centres
  std::vector<double> radius;
  std::vector<std::uint8_t> fixed;    ///< bit 0: x held by a side wall, bit 1: y held by the bottom or top wall
  std::vector<std::int32_t> grain;    ///< of each particle
  std::vector<double> stiffness;      ///< k of each slot; 0: no neighbour
  std::vector<double> threshold;      ///< breaking stress of each slot, k (d - l)/l at failure; infinite: never
  std::vector<std::uint8_t> joined;   ///< 1: spring whole
  std::vector<std::uint8_t> between;  ///< 1: spring between two grains

  [[nodiscard]] int particles() const { return lattice.particles(); }
  [[nodiscard]] int slots() const { return 3 * lattice.particles(); }
  [[nodiscard]] int first(int slot) const { return slot % lattice.particles(); }
  [[nodiscard]] int second(int slot) const { return lattice.neighbour(first(slot), slot / lattice.particles()); }
};

/// A sheet at rest: all springs whole with k = 1 and never breaking, one grain, walls of one row on each side.
/// Rows of 0: as many as make the box nearest to square. `wall_weight` scales the springs that lie along a wall;
/// 0.5 makes the sheet a cut of an infinite one.
Sheet make_sheet(int columns, int rows = 0, double wall_weight = 1.0);

/// True for a spring that joins two particles of the same wall (these do not break).
bool along_wall(const Sheet& sheet, int slot);

/// Forces of a state. `tension` is kept for every slot.
struct Forces {
  std::vector<double> x, y;     ///< sum of spring forces on each particle, wall reactions not included
  std::vector<double> tension;  ///< of each slot, positive in tension
  std::vector<double> length;   ///< of each slot, distance of centres
  double largest = 0;           ///< largest spring force
  double unbalanced = 0;        ///< largest force component on a particle along a free direction
  int worst = -1;               ///< particle where `unbalanced` is found
  struct Row {                  ///< the same of the slots and particles of a row of the lattice
    double largest = 0, unbalanced = 0;
    int worst = -1;
  };
  std::vector<Row> rows;
};

/// Computes forces with fixed summation order: the same bits for any number of threads.
void compute_forces(const Sheet& sheet, Forces& forces, int threads);

/// Columns [c0, c1) and rows [r0, r1) of the lattice.
struct LatticeBox {
  int c0 = 0, c1 = 0, r0 = 0, r1 = 0;
};

/// Brings forces up to date where only particles and springs of `box` changed: the bits of compute_forces.
void update_forces(const Sheet& sheet, Forces& forces, const LatticeBox& box);
/// Its two halves: forces in and next to the box (boxes two particles apart may be done side by side), then the largest
/// values of its rows and of all.
void update_springs(const Sheet& sheet, Forces& forces, const LatticeBox& box);
void sum_up(const Sheet& sheet, Forces& forces, const LatticeBox& box);

/// Half of k (d - l)^2 over all springs and contacts, in one order.
double elastic_energy(const Sheet& sheet, const Forces& forces);

/// The spring nearest to failure: the largest k (d - l)/l over threshold. Springs within one part in 10^6 of the
/// largest are taken as tied, and the lowest slot is chosen: the order does not hang on rounding.
struct Critical {
  int slot = -1;
  double ratio = 0;  ///< 1 or more: fails
  double next = 0;   ///< the next ratio, for how near the decision was
};
Critical most_critical(const Sheet& sheet, const Forces& forces, int threads);

/// Stress of each particle from its springs (virial over its lattice cell), tension positive.
struct Stress {
  std::vector<double> xx, yy, xy;
};
Stress particle_stress(const Sheet& sheet, const Forces& forces);

/// Mean stress on the walls: force over the present length of the wall, tension positive.
struct WallStress {
  double xx = 0, yy = 0;
};
WallStress wall_stress(const Sheet& sheet, const Forces& forces);

/// Present extent between the mean lines of opposite walls.
struct Extent {
  double x = 0, y = 0;
};
Extent extent(const Sheet& sheet);

}  // namespace dem::sheet
