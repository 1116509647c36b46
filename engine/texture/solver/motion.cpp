#include "engine/texture/solver/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/texture/laws/flat_joint.h"
#include "engine/texture/solver/packs.h"
#include "engine/texture/solver/walls.h"

namespace dem::texture {
namespace {

constexpr double pi = std::numbers::pi;

/// Stiffnesses of a bond as installed: N/m, N m/rad.
Stiffness<double> installed_stiffness(const BondSpec& spec, double r, double both) {
  const double area = pi * r * r;
  const ContactGroup& g = spec.group;
  double normal = spec.frictional ? 0 : area * g.bond_modulus / both;
  double shear = spec.frictional ? 0 : normal / g.bond_stiffness_ratio;
  const double arm = flat_joint_arm * r;
  double bending = 0.5 * normal * arm * arm, twisting = shear * arm * arm;
  if (spec.boundary) {
    bending = 0.25 * normal * r * r;
    twisting = 0.5 * shear * r * r;
    normal += area * g.modulus / both;
    shear += area * g.modulus / both / g.stiffness_ratio;
  }
  return {normal, shear, bending, twisting};
}

}  // namespace

Particles particles_of(const AssemblyInput& input) {
  const std::size_t n = input.position.size();
  Particles particles;
  for (std::size_t i = 0; i < n; ++i) {
    const double r = input.radius[i], mass = input.density[i] * 4 / 3 * pi * r * r * r;
    particles.inertia.push_back({mass, 0.4 * mass * r * r, 0, 0});
    particles.pose.push_back({{input.position[i][0], input.position[i][1], input.position[i][2], r, 1, 0, 0, 0}});
  }
  particles.velocity.assign(n, Row8{});
  particles.force.assign(n, Row8{});
  particles.mineral = input.mineral;
  return particles;
}

double critical_step(const AssemblyInput& input, const Particles& particles, const Walls& walls) {
  std::vector<std::array<double, 6>> k(particles.size(), std::array<double, 6>{});
  for (const BondSpec& spec : input.bonds) {
    const Triple<double> d = particles.place(spec.second) - particles.place(spec.first);
    const double r1 = particles.radius(spec.first), r2 = particles.radius(spec.second), length = root(dot(d, d));
    const Stiffness<double> bond = installed_stiffness(spec, std::min(r1, r2), r1 + r2);
    const std::array<double, 3> unit = {d.x / length, d.y / length, d.z / length};
    for (const std::int32_t p : {spec.first, spec.second}) {
      const double share = p == spec.first ? 0.5 * (length + r1 - r2) : 0.5 * (length + r2 - r1);  // m
      auto& sum = k[static_cast<std::size_t>(p)];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double along = unit[axis] * unit[axis];
        sum[axis] += bond.normal * along + bond.shear * (1 - along);
        sum[3 + axis] += (bond.shear * share * share + bond.bending) * (1 - along) + bond.twisting * along;
      }
    }
  }
  walls.add_stiffness(k);
  double least = huge;
  for (std::size_t i = 0; i < k.size(); ++i) {
    const Inertia& inertia = particles.inertia[i];
    for (std::size_t axis = 0; axis < 6; ++axis) {
      if (k[i][axis] > 0) least = std::min(least, (axis < 3 ? inertia.mass : inertia.moment) / k[i][axis]);
    }
  }
  if (least == huge) throw std::logic_error("Assembly: no contact, no time step");
  return std::sqrt(least);
}

void set_step(Particles& particles, double step) {
  particles.step = step;
  for (Inertia& inertia : particles.inertia) {
    inertia.step_over_mass = step / inertia.mass;
    inertia.step_over_moment = step / inertia.moment;
  }
}

void integrate(Particles& particles, std::int32_t begin, std::int32_t end, double damping, double held_kinetic,
               const Kernels& kernels, MotionAccount& account) {
  const auto first = static_cast<std::size_t>(begin);
  MotionLoop loop{particles.pose[first].v,
                  particles.velocity[first].v,
                  particles.force[first].v,
                  &particles.inertia[first],
                  end - begin,
                  particles.step,
                  damping,
                  0,
                  0,
                  0};
  kernels.integrate(loop);
  account.late_damping = 0.5 * particles.step * loop.late_heat;
  account.damping += 0.5 * particles.step * loop.heat;
  account.kinetic = 0.5 * (loop.kinetic - held_kinetic);
}

}  // namespace dem::texture
