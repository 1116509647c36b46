#pragma once
// What holds a specimen from outside: platens or grips at its ends, a jacket round its sides.
//
// Platens are rigid and without friction, each a plane or some strips of it or a hollow jaw (Face); the jacket is a frictionless
// cylinder round the z axis (laws/wall_contact.h). Walls
// that carry a pressure have no mass: at each step each of them goes to where its contacts carry the pressure, by one
// Newton step from the forces of the step before; the jacket foresees that particles go on pushing as they did.
// A membrane in the place of the rigid jacket: each particle at the side of the specimen has a share of its surface, in
// proportion to the square of its radius, that grows with its distance from the axis and the height of the specimen. The
// pressure on that share pushes the particle towards the axis, wherever it goes. So the specimen may bulge; what breaks off
// behind these particles meets no wall.
// Particles in a grip follow it without turning. Grips move along z, or along x (AssemblyInput::slides): then the upper is a
// rigid body, with the mass of its particles and their local damping, that a normal force presses down.
//
// The work of a wall is the mean of its force before and after a drift, times the drift.
#include <array>
#include <cstdint>
#include <vector>

#include "engine/texture/laws/wall_contact.h"
#include "engine/texture/solver/account.h"
#include "engine/texture/solver/particles.h"
#include "engine/texture/solver/slabs.h"

namespace dem::texture {

class Walls {
 public:
  Walls(const AssemblyInput& input, const Slabs& slabs);

  /// Speeds of the lower and upper platen or grip along z (m/s), reached linearly over `ramp` steps from now.
  void drive(double lower, double upper, std::int64_t ramp);
  /// Pressure (Pa) on the jacket, and on both platens until they are driven, reached linearly over `ramp` steps from
  /// now.
  void confine(double pressure, std::int64_t ramp);

  /// Normal force (N) that presses an upper grip down which slides, reached linearly over `ramp` steps from now.
  void press(double force, std::int64_t ramp);

  // A step, slab by slab but for move(). Of one slab: by one thread at a time.
  /// Adds what platens and jacket do to the particles of a slab.
  void press(std::size_t slab, Particles& particles);
  /// Moves all walls on by a step; after press() of all slabs, before hold() of any.
  void move(double step);
  /// Takes the forces on the held particles of a slab for those of their grips, and gives them the speed of it. Returns
  /// twice their kinetic energy, J: it is not part of the account.
  double hold(std::size_t slab, Particles& particles);

  /// Particles that have come nearer to a wall than `skin` (m) get a contact with it.
  void meet(const Particles& particles, const Slabs& slabs, double skin);

  /// Adds the stiffness (N/m) of the contacts to the diagonals of their particles (three translations, three
  /// rotations).
  void add_stiffness(std::vector<std::array<double, 6>>& diagonal) const;
  /// Forces and places of the walls, the confining pressure, work and stored energy of the contacts, at the last step.
  void report(Sample& sample) const;

  template <class Archive>
  void archive(Archive& a) {
    a(ends_, jacket_, lift_, platen_contacts_, jacket_contacts_, membrane_, sums_);
  }

 private:
  /// A platen or a grip.
  struct End {
    double z = 0, z_before = 0;              ///< m
    double drift_before = 0;                 ///< m, of the step before
    double speed = 0, target = 0, gain = 0;  ///< m/s, m/s, m/s a step
    double stiffness = 0;                    ///< of all its first contacts, N/m
    std::int64_t servo = 0;                  ///< 1: moved by the confining pressure, not by its speed
  };
  struct Jacket {
    double radius = 0, radius_before = 0;       ///< m
    double pressure = 0, target = 0, gain = 0;  ///< Pa, Pa, Pa a step
    double stiffness = 0;                       ///< of all its first contacts, N/m
    double force_before = 0, drift = 0;         ///< N, m: of the step before
  };
  /// The motion along z of an upper grip that slides.
  struct Lift {
    double mass = 0;                         ///< kg, of its particles
    double force = 0, target = 0, gain = 0;  ///< N, N, N a step: presses it down
    double z = 0, z_before = 0, drift_before = 0, speed = 0;
  };
  struct PlatenContact {
    std::int32_t particle = 0;
    std::int16_t upper = 0, face = 0;
    WallContact law;
  };
  struct JacketContact {
    std::int32_t particle = 0;
    WallContact law;
  };
  struct MembraneShare {
    std::int32_t particle = 0;
    double area = 0, away = 0;                 ///< m^2, m from the axis: at installation
    double away_before = 0, force_before = 0;  ///< m, N: of the step before
  };
  struct Held {
    std::int32_t particle = 0;
    std::int32_t upper = 0;
  };
  /// Of a slab; added up in the order of slabs.
  struct SlabSums {
    std::array<double, 2> force{}, force_before{};  ///< of the platens or grips on the specimen, along z, N
    std::array<double, 2> stiffness{};              ///< of the platen contacts that bear, N/m
    double lift = 0, lift_before = 0;               ///< force of an upper grip that slides on the specimen, along z, N
    double jacket_force = 0, jacket_force_before = 0, jacket_stiffness = 0;  ///< sums over radial forces
    double bulge = 0;              ///< shares of a membrane, each times its growth away from the axis, m^2
    double work = 0, elastic = 0;  ///< J; work since the beginning
  };

  /// A sphere of a slab, as a wall meets it.
  struct Near {
    std::size_t particle, slab;
    Vec3 x;         ///< m
    double radius;  ///< m
    std::size_t mineral;
  };
  /// Gives it contacts with the walls that it is nearer to than `reach` and has none with yet. The first ones, at
  /// installation, start free of stress.
  void meet(const Near& sphere, double reach, bool first);
  void check_strips() const;
  [[nodiscard]] bool any() const { return platens_ || jacket_.radius > 0; }
  [[nodiscard]] JawGap gap_of(std::int32_t upper, const Face& face, const Vec3& at, double radius) const;
  void press_platens(std::size_t slab, Particles& particles);
  void press_jacket(std::size_t slab, Particles& particles);
  void press_membrane(std::size_t slab, Particles& particles);
  void lay_membrane(const AssemblyInput& input, const Slabs& slabs);

  // fixed after installation
  bool platens_ = false, slides_ = false;
  double damping_ = 0;
  double membrane_area_ = 0, membrane_radius_ = 0, membrane_height_ = 0;  ///< m^2, m, m at installation; 0: none
  std::array<std::vector<Face>, 2> faces_{};
  std::vector<double> modulus_;          ///< E_c of each mineral, Pa
  std::vector<std::vector<Held>> held_;  ///< by slab; empty without grips

  // state
  std::array<End, 2> ends_{};
  Jacket jacket_;
  Lift lift_;
  std::vector<std::vector<PlatenContact>> platen_contacts_;  ///< by slab
  std::vector<std::vector<JacketContact>> jacket_contacts_;  ///< by slab
  std::vector<std::vector<MembraneShare>> membrane_;         ///< by slab
  std::vector<SlabSums> sums_;
};

}  // namespace dem::texture
