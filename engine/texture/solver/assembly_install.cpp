// Setting an assembly up: slabs, packs of bonds, masses, the time step.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/core/space_filling.h"
#include "engine/texture/solver/assembly.h"
#include "engine/texture/solver/packs.h"

namespace dem::texture {
namespace {

constexpr double pi = std::numbers::pi;

struct SlabRule {
  double low = 0, thickness = 1;
  int count = 1;
};

// Slabs 1.3 times as thick as the largest particle: a contact never reaches past the next slab before failure.
SlabRule slab_rule(const std::vector<Vec3>& position, const std::vector<double>& radius, int wanted) {
  SlabRule rule;
  if (position.empty()) return rule;
  double low = huge, high = -huge, largest = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    low = std::min(low, position[i][2]);
    high = std::max(high, position[i][2]);
    largest = std::max(largest, radius[i]);
  }
  const int most = static_cast<int>((high - low) / (2.6 * largest));
  rule.count = std::max(1, wanted > 0 ? std::min(wanted, most) : most);
  if (rule.count > 1 && rule.count % 2 == 1) --rule.count;  // even: two threads share alike
  rule.low = low;
  rule.thickness = (high - low) / rule.count * (1 + 1e-12);
  if (!(rule.thickness > 0)) rule.thickness = 1;
  return rule;
}

int slab_at(const SlabRule& rule, double z) {
  return std::clamp(static_cast<int>((z - rule.low) / rule.thickness), 0, rule.count - 1);
}

void fill_lane(FlatJointPack& pack, int lane, const BondSpec& spec, const Triple<double>& d, double share_one, double r,
               double both) {
  using F = FlatJointPack;
  const double length = root(dot(d, d));
  const double kn = spec.group.bond_modulus / both;  // Pa/m
  const double values[F::fields] = {d.x,
                                    d.y,
                                    d.z,
                                    share_one,
                                    length,
                                    kn * pi * r * r,
                                    1 / spec.group.bond_stiffness_ratio,
                                    flat_joint_arm * r,
                                    spec.group.tensile_strength / kn,
                                    spec.group.cohesion / kn,
                                    std::tan(spec.group.friction_angle)};
  for (int f = 0; f < F::fields; ++f) pack.field[f][lane] = values[f];
}

void fill_lane(ParallelBondPack& pack, int lane, const BondSpec& spec, const Triple<double>& d, double share_one,
               double r, double both) {
  using F = ParallelBondPack;
  const double length = root(dot(d, d)), area = pi * r * r;
  const ContactGroup& g = spec.group;
  const double kbn = g.bond_modulus / both;
  const double values[F::fields] = {d.x,
                                    d.y,
                                    d.z,
                                    share_one,
                                    length,
                                    area * g.modulus / both,
                                    1 / g.stiffness_ratio,
                                    g.friction,
                                    spec.frictional ? 0.0 : area * kbn,
                                    spec.frictional ? 0.0 : 1 / g.bond_stiffness_ratio,
                                    r,
                                    spec.frictional ? huge : g.tensile_strength / kbn,
                                    spec.frictional ? huge : g.cohesion / kbn,
                                    spec.frictional ? 0.0 : std::tan(g.friction_angle),
                                    0,
                                    0,
                                    0,
                                    0,
                                    0,
                                    0};
  for (int f = 0; f < F::fields; ++f) pack.field[f][lane] = values[f];
}

}  // namespace

std::vector<std::int32_t> order_in_slabs(const std::vector<Vec3>& position, const std::vector<double>& radius) {
  const SlabRule rule = slab_rule(position, radius, 0);
  double largest = 0, x0 = huge, y0 = huge;
  for (std::size_t i = 0; i < position.size(); ++i) {
    largest = std::max(largest, radius[i]);
    x0 = std::min(x0, position[i][0]);
    y0 = std::min(y0, position[i][1]);
  }
  const auto cell = [&](double a, double from) { return static_cast<std::uint32_t>((a - from) / largest); };
  return slab_order<std::int32_t>(position.size(), [&](std::size_t i) -> SlabCell {
    const auto& [x, y, z] = position[i];
    const int slab = slab_at(rule, z);
    const double z0 = rule.low + slab * rule.thickness;
    return {static_cast<std::uint32_t>(slab), cell(x, x0), cell(y, y0), cell(std::max(z, z0), z0)};
  });
}

Assembly::Assembly(const AssemblyInput& input, int threads)
    : threads_(std::max(threads, 1)),
      kernels_(&kernels()),
      damping_(input.damping),
      mineral_(input.mineral),
      grip_(input.grip),
      fresh_(input.fresh),
      wall_modulus_(input.wall_modulus),
      specs_(input.bonds),
      platens_(input.platens) {
  install(input);
  choose_time_step(input);
  find_near_pairs();
}

void Assembly::install(const AssemblyInput& input) {
  const std::size_t n = input.position.size();
  const SlabRule rule = slab_rule(input.position, input.radius, input.slabs);
  slab_begin_.assign(static_cast<std::size_t>(rule.count) + 1, 0);
  double smallest = huge;
  for (std::size_t i = 0; i < n; ++i) {
    const double r = input.radius[i], mass = input.density[i] * 4 / 3 * pi * r * r * r;
    inertia_.push_back({mass, 0.4 * mass * r * r, 0, 0});
    pose_.push_back({{input.position[i][0], input.position[i][1], input.position[i][2], r, 1, 0, 0, 0}});
    const int slab = slab_at(rule, input.position[i][2]);
    if (!slab_.empty() && slab < slab_.back()) throw std::logic_error("Assembly: particles are not ordered in slabs");
    slab_.push_back(slab);
    ++slab_begin_[static_cast<std::size_t>(slab) + 1];
    smallest = std::min(smallest, r);
  }
  for (std::size_t s = 1; s < slab_begin_.size(); ++s) slab_begin_[s] += slab_begin_[s - 1];
  velocity_.assign(n, Row8{});
  force_.assign(n, Row8{});
  skin_ = 0.3 * smallest;
  if (!grip_.empty()) {
    held_.resize(static_cast<std::size_t>(rule.count));
    for (std::size_t i = 0; i < n; ++i) {
      if (grip_[i] > 0) held_[static_cast<std::size_t>(slab_[i])].push_back(static_cast<std::int32_t>(i));
    }
  }
  walls_[0].z = walls_[0].z_before = input.z_low;
  walls_[1].z = walls_[1].z_before = input.z_high;
  sums_.resize(static_cast<std::size_t>(rule.count));
  wall_contacts_.resize(static_cast<std::size_t>(rule.count));
  blocks_.resize(2 * static_cast<std::size_t>(rule.count));  // slabs, pairs of neighbours, the rest

  for (std::size_t c = 0; c < input.bonds.size(); ++c) {
    const BondSpec& spec = input.bonds[c];
    const Row8& one = pose_[static_cast<std::size_t>(spec.first)];
    const Row8& two = pose_[static_cast<std::size_t>(spec.second)];
    const Triple<double> d{two.v[0] - one.v[0], two.v[1] - one.v[1], two.v[2] - one.v[2]};
    const double r1 = one.v[3], r2 = two.v[3], length = root(dot(d, d));
    const double share_one = 0.5 * (length + r1 - r2) / length;  // the face lies in the middle of the overlap
    const double r = std::min(r1, r2);
    Block& block = blocks_[static_cast<std::size_t>(block_of(spec.first, spec.second))];
    const auto place = [&](auto& packs, std::vector<std::int32_t>& contact) {
      const int lane = static_cast<int>(contact.size() % pack_width);
      if (lane == 0) packs.emplace_back();
      fill_lane(packs.back(), lane, spec, d, share_one, r, r1 + r2);
      packs.back().first[lane] = spec.first;
      packs.back().second[lane] = spec.second;
      contact.push_back(static_cast<std::int32_t>(c));
    };
    if (spec.boundary) {
      place(block.bonds, block.bond_contact);
    } else {
      place(block.joints, block.joint_contact);
    }
  }
  for (Block& block : blocks_) {
    pad(block.joints, block.joint_contact);
    pad(block.bonds, block.bond_contact);
    block.flagged.resize(std::max(block.joint_contact.size(), block.bond_contact.size()));
  }
  for (std::size_t i = 0; platens_ && i < n; ++i) {  // platen contacts start free of stress, like bonds
    const Row8& p = pose_[i];
    for (int upper = 0; upper < 2; ++upper) {
      const double gap = (upper ? walls_[1].z - p.v[2] : p.v[2] - walls_[0].z) - p.v[3];
      if (gap > 0) continue;
      const double k = wall_modulus_[static_cast<std::size_t>(mineral_[i])] * pi * p.v[3];
      wall_contacts_[static_cast<std::size_t>(slab_[i])].push_back(
          {static_cast<std::int32_t>(i), static_cast<std::int8_t>(upper), gap, k});
      walls_[static_cast<std::size_t>(upper)].stiffness += k;
    }
  }
  jacket_contacts_.resize(sums_.size());
  jacket_.radius = jacket_.radius_before = input.jacket_radius;
  for (std::size_t i = 0; jacket_.radius > 0 && i < n; ++i) {
    const Row8& p = pose_[i];
    const double gap = jacket_.radius - std::hypot(p.v[0], p.v[1]) - p.v[3];
    if (gap > 0) continue;
    const double k = wall_modulus_[static_cast<std::size_t>(mineral_[i])] * pi * p.v[3];
    jacket_contacts_[static_cast<std::size_t>(slab_[i])].push_back({static_cast<std::int32_t>(i), gap, k});
    jacket_.stiffness += k;
  }
}

int Assembly::block_of(std::int32_t first, std::int32_t second) const {
  const int count = static_cast<int>(slab_begin_.size()) - 1;
  const int a = slab_[static_cast<std::size_t>(first)], b = slab_[static_cast<std::size_t>(second)];
  if (a == b) return a;
  if (a - b == 1 || b - a == 1) return count + std::min(a, b);
  return 2 * count - 1;
}

// Potyondy & Cundall 2004, Eqs. 13-14: the smallest sqrt(m/k) over the particles, with k the diagonal of the particle's
// stiffness (sums over its contacts), for translation and for rotation; dt is a fraction of it.
void Assembly::choose_time_step(const AssemblyInput& input) {
  const std::size_t n = pose_.size();
  std::vector<std::array<double, 6>> k(n, std::array<double, 6>{});
  for (const BondSpec& spec : input.bonds) {
    const Row8& one = pose_[static_cast<std::size_t>(spec.first)];
    const Row8& two = pose_[static_cast<std::size_t>(spec.second)];
    Triple<double> d{two.v[0] - one.v[0], two.v[1] - one.v[1], two.v[2] - one.v[2]};
    const double length = root(dot(d, d)), both = one.v[3] + two.v[3], r = std::min(one.v[3], two.v[3]);
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
    const std::array<double, 3> unit = {d.x / length, d.y / length, d.z / length};
    for (const std::int32_t p : {spec.first, spec.second}) {
      const double share =
          p == spec.first ? 0.5 * (length + one.v[3] - two.v[3]) : 0.5 * (length + two.v[3] - one.v[3]);
      auto& sum = k[static_cast<std::size_t>(p)];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double along = unit[axis] * unit[axis];
        sum[axis] += normal * along + shear * (1 - along);
        sum[3 + axis] += (shear * share * share + bending) * (1 - along) + twisting * along;
      }
    }
  }
  for (const auto& slab : wall_contacts_) {
    for (const WallContact& contact : slab) k[static_cast<std::size_t>(contact.particle)][2] += contact.stiffness;
  }
  for (const auto& slab : jacket_contacts_) {
    for (const JacketContact& contact : slab) {
      for (const std::size_t axis : {0, 1}) k[static_cast<std::size_t>(contact.particle)][axis] += contact.stiffness;
    }
  }
  double least = huge;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t axis = 0; axis < 6; ++axis) {
      if (k[i][axis] > 0) least = std::min(least, (axis < 3 ? inertia_[i].mass : inertia_[i].moment) / k[i][axis]);
    }
  }
  if (least == huge) throw std::logic_error("Assembly: no contact, no time step");
  dt_ = input.time_step_factor * std::sqrt(least);
  for (Inertia& inertia : inertia_) {
    inertia.step_over_mass = dt_ / inertia.mass;
    inertia.step_over_moment = dt_ / inertia.moment;
  }
}

}  // namespace dem::texture
