// The step of an assembly: forces, events, motion, account.
#include "engine/texture/solver/lanes.h"  // first: see there

#include "engine/core/cell_grid.h"
#include "engine/texture/solver/assembly.h"
#include "engine/texture/solver/packs.h"
#include "engine/texture/laws/parallel_bond.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dem::texture {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::int64_t look_interval = 10;  // steps between looks at near pairs
constexpr double parted = 0.05;             // a broken contact open by this share of its length is dropped

using Row = Lanes4;
Row& row(Row8& r, int half) { return *reinterpret_cast<Row*>(r.v + 4 * half); }
Triple<double> triple(const Row8& r, int half) { return {r.v[4 * half], r.v[4 * half + 1], r.v[4 * half + 2]}; }
Vec3 array(const Triple<double>& t) { return {t.x, t.y, t.z}; }
// For closed_joints(): what stays_open() needs. A lane without a living joint is always open.
void watch(OpenJointPack& pack, std::size_t lane, const PartlyBrokenJoint& joint, bool alive) {
  const double reach = joint.open != 0 ? 4 * joint.law.rho * joint.law.rho : infinite;
  pack.length[lane] = alive ? joint.reference_length : -infinite;
  pack.reach[lane] = alive ? reach : 0;
  pack.first[lane] = joint.first;
  pack.second[lane] = joint.second;
}

}  // namespace

Pose<double> Assembly::pose(std::int32_t particle) const {
  const Row8& p = pose_[static_cast<std::size_t>(particle)];
  return {{p.v[0], p.v[1], p.v[2]}, {p.v[4], p.v[5], p.v[6], p.v[7]}};
}

void Assembly::add(std::int32_t first, std::int32_t second, const Action<double>& a) {
  Row8& one = force_[static_cast<std::size_t>(first)];
  Row8& two = force_[static_cast<std::size_t>(second)];
  row(one, 0) -= Row{a.force.x, a.force.y, a.force.z, 0};
  row(one, 1) += Row{a.moment_1.x, a.moment_1.y, a.moment_1.z, 0};
  row(two, 0) += Row{a.force.x, a.force.y, a.force.z, 0};
  row(two, 1) += Row{a.moment_2.x, a.moment_2.y, a.moment_2.z, 0};
}

// The force that a crack takes away at the end of a step would have done half of its work over that step; what is taken
// away with it was never stored. (Work of the action over half of the last drift, J; negative while a bond is stretched.)
double Assembly::half_work(std::int32_t first, std::int32_t second, const Action<double>& a) const {
  const Row8& v1 = velocity_[static_cast<std::size_t>(first)];
  const Row8& v2 = velocity_[static_cast<std::size_t>(second)];
  return 0.5 * dt_ *
         (dot(a.force, triple(v2, 0) - triple(v1, 0)) + dot(a.moment_1, triple(v1, 1)) +
          dot(a.moment_2, triple(v2, 1)));
}

void Assembly::drive(double lower, double upper, std::int64_t ramp) {
  const std::array<double, 2> target = {lower, upper};
  for (std::size_t w = 0; w < 2; ++w) {
    walls_[w].servo = 0;
    walls_[w].target = target[w];
    walls_[w].gain = (target[w] - walls_[w].speed) / static_cast<double>(std::max<std::int64_t>(ramp, 1));
  }
}

void Assembly::confine(double pressure, std::int64_t ramp) {
  jacket_.target = pressure;
  jacket_.gain = (pressure - jacket_.pressure) / static_cast<double>(std::max<std::int64_t>(ramp, 1));
  for (Wall& wall : walls_) wall.servo = 1;
}

void Assembly::move_walls() {
  double jacket_force = 0, jacket_stiffness = 0;
  std::array<double, 2> force{}, stiffness{};
  for (const SlabSums& sums : sums_) {
    jacket_force += sums.jacket_force;
    jacket_stiffness += sums.jacket_stiffness;
    for (std::size_t w = 0; w < 2; ++w) {
      force[w] += std::abs(sums.force[w]);
      stiffness[w] += sums.stiffness[w];
    }
  }
  // Where hardly anything bears yet, a share of all first contacts stands in for the stiffness.
  const auto newton = [](double excess, double bearing, double all) { return excess / std::max(bearing, 0.25 * all); };
  const double next_pressure = jacket_.pressure + jacket_.gain;
  const bool reached = (jacket_.gain >= 0) == (next_pressure >= jacket_.target);
  jacket_.pressure = reached ? jacket_.target : next_pressure;
  if (reached) jacket_.gain = 0;
  const double radius = jacket_.radius, height = walls_[1].z - walls_[0].z;
  for (std::size_t w = 0; w < 2; ++w) {
    Wall& wall = walls_[w];
    wall.drift_before = wall.z - wall.z_before;
    wall.z_before = wall.z;
    if (wall.servo != 0) {
      const double excess = force[w] - jacket_.pressure * std::numbers::pi * radius * radius;
      wall.z += (w == 0 ? -1 : 1) * newton(excess, stiffness[w], wall.stiffness);
      continue;
    }
    const double next = wall.speed + wall.gain;
    const bool arrived = (wall.gain >= 0) == (next >= wall.target);
    wall.speed = arrived ? wall.target : next;
    if (arrived) wall.gain = 0;
    wall.z += wall.speed * dt_;
  }
  jacket_.radius_before = radius;
  if (radius > 0) {
    // What the particles alone did to the force in the last step, they will do again in the next.
    const double moved = jacket_force - jacket_.force_before + jacket_stiffness * jacket_.drift;
    const double excess = jacket_force + moved - jacket_.pressure * 2 * std::numbers::pi * radius * height;
    jacket_.drift = newton(excess, jacket_stiffness, jacket_.stiffness);
    jacket_.force_before = jacket_force;
    jacket_.radius += jacket_.drift;
  }
}

// Which broken joints have to be looked at: most are open, and show without further work that they still are.
void Assembly::find_active(Block& block) const {
  const auto count = static_cast<std::int64_t>(block.broken.size());
  if (block.watched != count) {
    block.watch.resize((block.broken.size() + pack_width - 1) / pack_width);
    for (std::size_t at = 0; at < block.watch.size() * pack_width; ++at) {
      const PartlyBrokenJoint& joint = block.broken[std::min(at, block.broken.size() - 1)];
      watch(block.watch[at / pack_width], at % pack_width, joint, joint.alive && at < block.broken.size());
    }
    block.watched = count;
  }
  block.active.resize(block.watch.size() * pack_width);
  block.active.resize(static_cast<std::size_t>(kernels_->closed_joints(
      block.watch.data(), static_cast<std::int32_t>(count), pose_.front().v, block.active.data())));
}

void Assembly::forces(Block& block, std::int64_t step, bool look_for_contacts) {
  BondLoop loop{pose_.front().v, force_.front().v, block.flagged.data(), 0, 0};
  if (!block.joints.empty()) {
    kernels_->flat_joints(block.joints.data(), static_cast<std::int32_t>(block.joints.size()), loop);
    if (loop.flagged_count > 0) joint_events(block, loop.flagged_count);
  }
  if (!block.bonds.empty()) {
    kernels_->parallel_bonds(block.bonds.data(), static_cast<std::int32_t>(block.bonds.size()), loop);
    block.friction += loop.heat;
    if (loop.flagged_count > 0) bond_events(block, step, loop.flagged_count);
  }
  find_active(block);
  if (!block.active.empty()) {
    kernels_->broken_joints(block.broken.data(), block.active.data(), static_cast<std::int32_t>(block.active.size()),
                            loop);
    block.friction += loop.heat;
  } else {
    loop.flagged_count = 0;
  }
  for (std::int32_t k = 0; k < loop.flagged_count; ++k) {
    PartlyBrokenJoint& joint = block.broken[static_cast<std::size_t>(block.flagged[static_cast<std::size_t>(k)])];
    const Pose<double> one = pose(joint.first), two = pose(joint.second);
    const bool was_broken = joint.broken();
    const JointResult result = texture::advance(joint, one, two);
    block.friction += result.friction_heat;
    if (was_broken) {
      roll(block, joint, result.action);
      continue;
    }
    add(joint.first, joint.second, result.action);
    for (int b = 0; b < result.breaks; ++b) {
      const ElementBreak& e = result.broke[b];
      const double r = joint.law.rho / flat_joint_arm;
      (e.shear ? block.bond_shear : block.bond_tension) += e.released + half_work(joint.first, joint.second, e.removed);
      block.cracks.push_back({static_cast<double>(step), joint.contact, static_cast<std::int8_t>(e.shear), 0,
                              array(e.position), array(e.normal), std::numbers::pi * r * r / 3});
    }
  }
  for (const std::int32_t k : block.active) {
    const auto at = static_cast<std::size_t>(k);
    const PartlyBrokenJoint& joint = block.broken[at];
    watch(block.watch[at / pack_width], at % pack_width, joint, joint.alive);
  }
  for (FreshContact& contact : block.fresh) {
    if (contact.alive == 0) continue;
    const Row8& one = pose_[static_cast<std::size_t>(contact.first)];
    const Row8& two = pose_[static_cast<std::size_t>(contact.second)];
    const Triple<double> d = triple(two, 0) - triple(one, 0);
    const double length = root(dot(d, d));
    const Triple<double> n = (1 / length) * d;
    const double gap = length - contact.length;
    if (gap > 0) {
      // What shear was left when the contact opened, by the same rule: the mean of F and nothing, over the slide.
      block.friction += 0.5 * contact.shear * dot(contact.slide, contact.slide);
      contact.slide = {0, 0, 0};
      contact.energy = 0;
      continue;
    }
    const Row8& v1 = velocity_[static_cast<std::size_t>(contact.first)];
    const Row8& v2 = velocity_[static_cast<std::size_t>(contact.second)];
    const double share = one.v[3] / (one.v[3] + two.v[3]);
    const Triple<double> turn = share * triple(v1, 1) + (1 - share) * triple(v2, 1);
    const Triple<double> v = triple(v2, 0) - triple(v1, 0) - cross(turn, d);
    Triple<double> slide = contact.slide + dt_ * v;
    slide = slide - dot(slide, n) * n;
    const double normal = -contact.normal * gap, limit = contact.friction * normal;
    const double size = root(dot(slide, slide)), trial = contact.shear * size;
    if (trial > limit) {
      const double keep = limit / trial;
      const Triple<double> kept = keep * slide;
      block.friction += (0.5 * contact.shear) * dot(contact.slide + kept, slide - kept);
      slide = kept;
    }
    contact.slide = slide;
    contact.energy = 0.5 * (contact.normal * gap * gap + contact.shear * dot(slide, slide));
    const Triple<double> f = normal * n - contact.shear * slide;
    const Triple<double> twist = cross(d, f);
    add(contact.first, contact.second, {f, -share * twist, -(1 - share) * twist});
  }
  if (!look_for_contacts) return;
  for (auto& [first, second] : block.candidates) {
    if (first < 0) continue;
    const Row8& one = pose_[static_cast<std::size_t>(first)];
    const Row8& two = pose_[static_cast<std::size_t>(second)];
    const Triple<double> d = triple(two, 0) - triple(one, 0);
    const double both = one.v[3] + two.v[3], squared = dot(d, d);
    if (squared >= both * both) continue;
    const double r = std::min(one.v[3], two.v[3]);
    const ContactGroup& g = fresh_[static_cast<std::size_t>(mineral_[static_cast<std::size_t>(first)])]
                                  [static_cast<std::size_t>(mineral_[static_cast<std::size_t>(second)])];
    FreshContact contact;
    contact.first = first;
    contact.second = second;
    contact.normal = std::numbers::pi * r * r * g.modulus / both;
    contact.shear = contact.normal / g.stiffness_ratio;
    contact.friction = g.friction;
    contact.length = root(squared);  // free of stress: the motion of a few steps before the look costs no energy
    block.fresh.push_back(contact);
    first = -1;
  }
}

// Joints whose bound was passed: looked at element by element. One that breaks leaves the packs for good.
// A broken joint whose faces have lost each other becomes a contact of spheres, with the same stiffness and distance at rest.
// Its shear and its couples are let go: what they had stored turns into heat (never less than nothing, as the mean over the
// elements of a convex energy is at least the energy of the mean gap).
void Assembly::roll(Block& block, PartlyBrokenJoint& joint, const Action<double>& action) {
  const Pose<double> one = pose(joint.first), two = pose(joint.second);
  const Motion<double> m = motion(one, two, joint.reference, joint.share_one, joint.reference_length);
  const double closed = std::min(m.gap, 0.0);
  const Action<double> kept =
      action_at_contact(m, joint.share_one, (-joint.law.normal * closed) * m.n, Triple<double>{0, 0, 0});
  block.friction += stored(joint, one, two) - 0.5 * joint.law.normal * closed * closed +
                    half_work(joint.first, joint.second, action - kept);
  FreshContact contact;
  contact.first = joint.first;
  contact.second = joint.second;
  contact.normal = joint.law.normal;
  contact.shear = joint.law.normal * joint.law.inverse_ratio;
  contact.friction = joint.friction;
  contact.length = joint.reference_length;
  block.fresh.push_back(contact);
  joint.alive = false;
}

// The same for a broken parallel bond: its linear part goes on as it is, shear included.
void Assembly::roll(Block& block, ParallelBondPack& pack, int lane) {
  using F = ParallelBondPack;
  const auto get = [&](F::Field f) { return pack.field[f][lane]; };
  FreshContact contact;
  contact.first = pack.first[lane];
  contact.second = pack.second[lane];
  contact.normal = get(F::linear_normal);
  contact.shear = contact.normal * get(F::linear_inverse_ratio);
  contact.friction = get(F::friction);
  contact.length = get(F::length);
  const Motion<double> m = motion(pose(contact.first), pose(contact.second), {get(F::dx), get(F::dy), get(F::dz)},
                                  get(F::share_one), get(F::length));
  const Triple<double> shear{get(F::shear_x), get(F::shear_y), get(F::shear_z)};
  // Take back what the pack added: the contact acts with the others of its kind, in this same step, after the slide of it.
  const Triple<double> f = (-contact.normal * std::min(m.gap, 0.0)) * m.n - contact.shear * shear;
  add(contact.first, contact.second,
      Action<double>{} - action_at_contact(m, get(F::share_one), f, Triple<double>{0, 0, 0}));
  const Row8& v1 = velocity_[static_cast<std::size_t>(contact.first)];
  const Row8& v2 = velocity_[static_cast<std::size_t>(contact.second)];
  const Triple<double> d = m.length * m.n;
  const Triple<double> turn = get(F::share_one) * triple(v1, 1) + (1 - get(F::share_one)) * triple(v2, 1);
  contact.slide = shear - dt_ * (triple(v2, 0) - triple(v1, 0) - cross(turn, d));
  block.fresh.push_back(contact);
  pack.field[F::linear_normal][lane] = 0;
  pack.field[F::cohesion][lane] = huge;
}

void Assembly::joint_events(Block& block, std::int32_t count) {
  using F = FlatJointPack;
  for (std::int32_t k = 0; k < count; ++k) {
    const std::int32_t slot = block.flagged[static_cast<std::size_t>(k)];
    FlatJointPack& pack = block.joints[static_cast<std::size_t>(slot / pack_width)];
    const int lane = slot % pack_width;
    const auto get = [&](F::Field f) { return pack.field[f][lane]; };
    PartlyBrokenJoint joint;
    joint.first = pack.first[lane];
    joint.second = pack.second[lane];
    joint.contact = block.joint_contact[static_cast<std::size_t>(slot)];
    joint.reference = {get(F::dx), get(F::dy), get(F::dz)};
    joint.share_one = get(F::share_one);
    joint.reference_length = get(F::length);
    joint.law = {get(F::normal),  get(F::inverse_ratio), get(F::rho),
                 get(F::opening), get(F::cohesion),      get(F::tan_phi)};
    joint.friction = specs_[static_cast<std::size_t>(joint.contact)].group.friction;
    joint.zero_angle = any_perpendicular(joint.reference);
    const Pose<double> one = pose(joint.first), two = pose(joint.second);
    PartlyBrokenJoint probe = joint;
    if (texture::advance(probe, one, two).breaks == 0) continue;
    // Take back what the pack added; the joint is evaluated with the partly broken ones, in this same step.
    const Motion<double> m = motion(one, two, joint.reference, joint.share_one, joint.reference_length);
    const Action<double> intact = action(m, stiffness(joint.law));
    add(joint.first, joint.second, Action<double>{} - intact);
    retire(pack, static_cast<std::size_t>(lane));
    block.broken.push_back(joint);
  }
}

void Assembly::bond_events(Block& block, std::int64_t step, std::int32_t count) {
  using F = ParallelBondPack;
  for (std::int32_t k = 0; k < count; ++k) {
    const std::int32_t slot = block.flagged[static_cast<std::size_t>(k)];
    ParallelBondPack& pack = block.bonds[static_cast<std::size_t>(slot / pack_width)];
    const int lane = slot % pack_width;
    const auto get = [&](F::Field f) { return pack.field[f][lane]; };
    if (get(F::normal) == 0) {
      roll(block, pack, lane);
      continue;
    }
    const std::int32_t first = pack.first[lane], second = pack.second[lane];
    const Pose<double> one = pose(first), two = pose(second);
    const ParallelBond<double> bond = {get(F::linear_normal), get(F::linear_inverse_ratio),
                                       get(F::friction),      get(F::normal),
                                       get(F::inverse_ratio), get(F::radius),
                                       get(F::opening),       get(F::cohesion),
                                       get(F::tan_phi)};
    const Motion<double> m = motion(one, two, {get(F::dx), get(F::dy), get(F::dz)}, get(F::share_one), get(F::length));
    const bool shear = !(m.gap > bond.opening);
    const Action<double> removed = action(m, stiffness(bond));
    add(first, second, Action<double>{} - removed);
    (shear ? block.bond_shear : block.bond_tension) += energy(m, stiffness(bond)) + half_work(first, second, removed);
    block.cracks.push_back({static_cast<double>(step), block.bond_contact[static_cast<std::size_t>(slot)],
                            static_cast<std::int8_t>(shear), 1, array(one.x + (get(F::share_one) * m.length) * m.n),
                            array(m.n), std::numbers::pi * bond.radius * bond.radius});
    retire(pack, static_cast<std::size_t>(lane));
  }
}

void Assembly::wall_forces(std::size_t slab) {
  SlabSums& sums = sums_[slab];
  sums.force_before = sums.force;
  sums.force = {};
  sums.stiffness = {};
  double elastic = 0;
  for (const WallContact& contact : wall_contacts_[slab]) {
    const auto p = static_cast<std::size_t>(contact.particle);
    const double z = pose_[p].v[2];
    const double gap = (contact.upper ? walls_[1].z - z : z - walls_[0].z) - pose_[p].v[3] - contact.gap_at_rest;
    if (gap >= 0) continue;
    const double f = (contact.upper ? 1 : -1) * contact.stiffness * gap;  // on the particle, along z
    force_[p].v[2] += f;
    sums.force[static_cast<std::size_t>(contact.upper)] += f;
    sums.stiffness[static_cast<std::size_t>(contact.upper)] += contact.stiffness;
    elastic += 0.5 * contact.stiffness * gap * gap;
  }
  for (std::size_t w = 0; w < 2; ++w) {
    sums.work += 0.5 * (sums.force[w] + sums.force_before[w]) * (walls_[w].z - walls_[w].z_before);
  }
  sums.jacket_force_before = sums.jacket_force;
  sums.jacket_force = sums.jacket_stiffness = 0;
  for (const JacketContact& contact : jacket_contacts_[slab]) {
    const auto p = static_cast<std::size_t>(contact.particle);
    const double x = pose_[p].v[0], y = pose_[p].v[1], away = std::sqrt(x * x + y * y);
    const double gap = jacket_.radius - away - pose_[p].v[3] - contact.gap_at_rest;
    if (gap >= 0) continue;
    const double f = contact.stiffness * gap;  // on the particle, outwards: negative
    force_[p].v[0] += f * x / away;
    force_[p].v[1] += f * y / away;
    sums.jacket_force -= f;
    sums.jacket_stiffness += contact.stiffness;
    elastic += 0.5 * contact.stiffness * gap * gap;
  }
  sums.work -= 0.5 * (sums.jacket_force + sums.jacket_force_before) * (jacket_.radius - jacket_.radius_before);
  sums.elastic = elastic;
}

// Held particles follow their grip; what the rest of the specimen does to them is the force of the grip. Their kinetic
// energy is not part of the account: it is returned, to be taken off.
double Assembly::hold(std::size_t slab) {
  SlabSums& sums = sums_[slab];
  sums.force_before = sums.force;
  sums.force = {};
  double kinetic = 0;
  for (const std::int32_t particle : held_[slab]) {
    const auto i = static_cast<std::size_t>(particle);
    const auto w = static_cast<std::size_t>(grip_[i] - 1);
    sums.force[w] -= force_[i].v[2];
    force_[i] = Row8{};
    velocity_[i] = Row8{{0, 0, walls_[w].speed, 0, 0, 0, 0, 0}};
    kinetic += inertia_[i].mass * walls_[w].speed * walls_[w].speed;
  }
  for (std::size_t w = 0; w < 2; ++w) {
    sums.work += 0.5 * (sums.force[w] + sums.force_before[w]) * walls_[w].drift_before;
  }
  return kinetic;
}

void Assembly::integrate(std::size_t slab) {
  SlabSums& sums = sums_[slab];
  const auto begin = static_cast<std::size_t>(slab_begin_[slab]), end = static_cast<std::size_t>(slab_begin_[slab + 1]);
  const double held_kinetic = held_.empty() ? 0.0 : hold(slab);
  MotionLoop loop{pose_[begin].v,
                  velocity_[begin].v,
                  force_[begin].v,
                  &inertia_[begin],
                  static_cast<std::int64_t>(end - begin),
                  dt_,
                  damping_,
                  0,
                  0,
                  0};
  kernels_->integrate(loop);
  sums.late_damping = 0.5 * dt_ * loop.late_heat;
  sums.damping += 0.5 * dt_ * loop.heat;
  sums.kinetic = 0.5 * (loop.kinetic - held_kinetic);
}

double Assembly::block_elastic(const Block& block) const {
  double sum = 0;
  const double* poses = pose_.front().v;
  if (!block.joints.empty()) {
    sum += kernels_->flat_joint_energy(block.joints.data(), static_cast<std::int32_t>(block.joints.size()), poses);
  }
  if (!block.bonds.empty()) {
    sum += kernels_->parallel_bond_energy(block.bonds.data(), static_cast<std::int32_t>(block.bonds.size()), poses);
  }
  for (const PartlyBrokenJoint& joint : block.broken) {
    if (joint.alive) sum += stored(joint, pose(joint.first), pose(joint.second));
  }
  for (const FreshContact& contact : block.fresh) sum += contact.alive ? contact.energy : 0.0;
  return sum;
}

Sample Assembly::advance(std::int64_t steps) {
  const int slabs = static_cast<int>(sums_.size()), pairs = slabs - 1;
  const std::int64_t first = step_;
  const bool rest = !blocks_.back().fresh.empty() || !blocks_.back().candidates.empty();
#pragma omp parallel num_threads(threads_)
  for (std::int64_t step = first; step < first + steps; ++step) {
    const bool sampling = step + 1 == first + steps, look = step % look_interval == 0;
    // 1. inside slabs; the slabs of a thread are the same here and in the integration, so that no barrier is needed between
#pragma omp for schedule(static, 1) nowait
    for (int slab = 0; slab < slabs; ++slab) {
      forces(blocks_[static_cast<std::size_t>(slab)], step, look);
      if (platens_) wall_forces(static_cast<std::size_t>(slab));
    }
#pragma omp barrier
#pragma omp single nowait
    move_walls();
    // 2. between slabs: even pairs, then odd ones
#pragma omp for schedule(dynamic, 1)
    for (int pair = 0; pair < pairs; pair += 2) forces(blocks_[static_cast<std::size_t>(slabs + pair)], step, look);
#pragma omp for schedule(dynamic, 1)
    for (int pair = 1; pair < pairs; pair += 2) forces(blocks_[static_cast<std::size_t>(slabs + pair)], step, look);
    if (rest) {  // contacts that failure made between slabs further apart
#pragma omp single
      forces(blocks_.back(), step, look);
    }
    if (sampling) {
#pragma omp for schedule(dynamic, 1)
      for (int b = 0; b < static_cast<int>(blocks_.size()); ++b) {
        Block& block = blocks_[static_cast<std::size_t>(b)];
        block.elastic = block_elastic(block);
      }
    }
    // 3. motion
#pragma omp for schedule(static, 1) nowait
    for (int slab = 0; slab < slabs; ++slab) integrate(static_cast<std::size_t>(slab));
  }
  step_ += steps;

  Sample sample;
  sample.step = static_cast<double>(step_ - 1);
  sample.time = sample.step * dt_;
  for (std::size_t w = 0; w < 2; ++w) sample.place[w] = walls_[w].z_before;
  sample.jacket_radius = jacket_.radius_before;
  double jacket_force = 0;
  Ledger& ledger = sample.ledger;
  for (const SlabSums& sums : sums_) {
    jacket_force += sums.jacket_force;
    for (std::size_t w = 0; w < 2; ++w) sample.force[w] += sums.force[w];
    ledger.work += sums.work;
    ledger.damping += sums.damping - sums.late_damping;
    ledger.kinetic += sums.kinetic;
    ledger.elastic += sums.elastic;
  }
  if (sample.jacket_radius > 0) {
    sample.confining_pressure =
        jacket_force / (2 * std::numbers::pi * sample.jacket_radius * (sample.place[1] - sample.place[0]));
  }
  const auto older = static_cast<std::ptrdiff_t>(cracks_.size());
  for (Block& block : blocks_) {
    ledger.elastic += block.elastic;
    ledger.friction += block.friction;
    ledger.bond_tension += block.bond_tension;
    ledger.bond_shear += block.bond_shear;
    cracks_.insert(cracks_.end(), block.cracks.begin(), block.cracks.end());
    block.cracks.clear();
  }
  std::stable_sort(cracks_.begin() + older, cracks_.end(),
                   [](const Crack& a, const Crack& b) { return a.step < b.step; });
  for (Block& block : blocks_) {
    close_ranks(block.joints, block.joint_contact);
    close_ranks(block.bonds, block.bond_contact);
  }
  maintain();
  return sample;
}

// Drops broken contacts that have parted, and looks for near pairs again when particles have moved far enough.
void Assembly::maintain() {
  double most = 0;
  for (std::size_t i = 0; i < pose_.size(); ++i) {
    const Triple<double> moved = triple(pose_[i], 0) - triple(near_[i], 0);
    most = std::max(most, dot(moved, moved));
  }
  if (2 * std::sqrt(most) < 0.8 * skin_) return;
  for (Block& block : blocks_) {
    for (PartlyBrokenJoint& joint : block.broken) {
      if (!joint.alive || !joint.broken()) continue;
      const Triple<double> d = pose(joint.second).x - pose(joint.first).x;
      joint.alive = root(dot(d, d)) < (1 + parted) * joint.reference_length;
    }
    std::erase_if(block.broken, [](const PartlyBrokenJoint& joint) { return !joint.alive; });
    block.watched = -1;
    using F = ParallelBondPack;
    for (std::size_t slot = 0; slot < block.bond_contact.size(); ++slot) {
      ParallelBondPack& pack = block.bonds[slot / pack_width];
      const std::size_t lane = slot % pack_width;
      if (pack.field[F::normal][lane] > 0 || pack.field[F::linear_normal][lane] == 0) continue;
      const Triple<double> d = pose(pack.second[lane]).x - pose(pack.first[lane]).x;
      if (root(dot(d, d)) >= (1 + parted) * pack.field[F::length][lane]) pack.field[F::linear_normal][lane] = 0;
    }
    for (FreshContact& contact : block.fresh) {
      const Triple<double> d = pose(contact.second).x - pose(contact.first).x;
      contact.alive = root(dot(d, d)) < (1 + parted) * contact.length;
    }
    std::erase_if(block.fresh, [](const FreshContact& contact) { return contact.alive == 0; });
  }
  find_near_pairs();
}

void Assembly::find_near_pairs() {
  near_ = pose_;
  const std::size_t n = pose_.size();
  // Pairs that have a contact already, as sorted keys.
  std::vector<std::uint64_t> known;
  const auto key = [](std::int32_t a, std::int32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
  };
  double largest = 0;
  for (const Row8& p : pose_) largest = std::max(largest, p.v[3]);
  for (Block& block : blocks_) {
    block.candidates.clear();
    for (std::size_t slot = 0; slot < block.joint_contact.size(); ++slot) {
      const FlatJointPack& pack = block.joints[slot / pack_width];
      const std::size_t lane = slot % pack_width;
      if (pack.field[FlatJointPack::normal][lane] > 0) known.push_back(key(pack.first[lane], pack.second[lane]));
    }
    for (std::size_t slot = 0; slot < block.bond_contact.size(); ++slot) {
      const ParallelBondPack& pack = block.bonds[slot / pack_width];
      const std::size_t lane = slot % pack_width;
      if (pack.field[ParallelBondPack::linear_normal][lane] > 0)
        known.push_back(key(pack.first[lane], pack.second[lane]));
    }
    for (const PartlyBrokenJoint& joint : block.broken) known.push_back(key(joint.first, joint.second));
    for (const FreshContact& contact : block.fresh) known.push_back(key(contact.first, contact.second));
  }
  std::sort(known.begin(), known.end());

  // Cells as wide as the reach; fragments far out share the rim cells.
  const auto place = [&](std::size_t i) { return array(triple(pose_[i], 0)); };
  const CellGrid grid(n, 2 * largest + skin_, place, 200);
  for (std::size_t i = 0; i < n; ++i) {
    grid.around(place(i), [&](std::int32_t j) {
      if (static_cast<std::size_t>(j) <= i) return;
      const Triple<double> d = triple(pose_[static_cast<std::size_t>(j)], 0) - triple(pose_[i], 0);
      const double limit = pose_[i].v[3] + pose_[static_cast<std::size_t>(j)].v[3] + skin_;
      const auto first = static_cast<std::int32_t>(i);
      if (dot(d, d) >= limit * limit || std::binary_search(known.begin(), known.end(), key(first, j))) return;
      blocks_[static_cast<std::size_t>(block_of(first, j))].candidates.push_back({first, j});
    });
  }

  // Particles that have come near a platen since.
  for (std::size_t i = 0; platens_ && i < n; ++i) {
    auto& slab = wall_contacts_[static_cast<std::size_t>(slab_[i])];
    for (int upper = 0; upper < 2; ++upper) {
      const double gap = (upper ? walls_[1].z - pose_[i].v[2] : pose_[i].v[2] - walls_[0].z) - pose_[i].v[3];
      const auto same = [&](const WallContact& c) {
        return c.particle == static_cast<std::int32_t>(i) && c.upper == upper;
      };
      if (gap > skin_ || std::any_of(slab.begin(), slab.end(), same)) continue;
      const double k = wall_modulus_[static_cast<std::size_t>(mineral_[i])] * std::numbers::pi * pose_[i].v[3];
      slab.push_back({static_cast<std::int32_t>(i), static_cast<std::int8_t>(upper), 0, k});
    }
  }
  for (std::size_t i = 0; jacket_.radius > 0 && i < n; ++i) {
    const double gap = jacket_.radius - std::hypot(pose_[i].v[0], pose_[i].v[1]) - pose_[i].v[3];
    if (gap > skin_) continue;
    auto& slab = jacket_contacts_[static_cast<std::size_t>(slab_[i])];
    const auto same = [&](const JacketContact& c) { return c.particle == static_cast<std::int32_t>(i); };
    if (std::any_of(slab.begin(), slab.end(), same)) continue;
    slab.push_back({static_cast<std::int32_t>(i), 0,
                    wall_modulus_[static_cast<std::size_t>(mineral_[i])] * std::numbers::pi * pose_[i].v[3]});
  }
}

std::size_t Assembly::fresh_contacts() const {
  std::size_t count = 0;
  for (const Block& block : blocks_) count += block.fresh.size();
  return count;
}

Assembly::Counts Assembly::counts() const {
  Counts c;
  for (const Block& block : blocks_) {
    const auto real = [](const std::vector<std::int32_t>& slots) {
      return std::count_if(slots.begin(), slots.end(), [](std::int32_t contact) { return contact >= 0; });
    };
    c.joints += real(block.joint_contact);
    c.bonds += real(block.bond_contact);
    c.broken_joints += static_cast<std::int64_t>(block.broken.size());
    c.fresh += static_cast<std::int64_t>(block.fresh.size());
    c.bytes += static_cast<std::int64_t>(
        block.joints.size() * sizeof(FlatJointPack) + block.bonds.size() * sizeof(ParallelBondPack) +
        block.broken.size() * sizeof(PartlyBrokenJoint) + block.fresh.size() * sizeof(FreshContact));
  }
  return c;
}

}  // namespace dem::texture
