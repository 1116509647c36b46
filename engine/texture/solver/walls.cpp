#include "engine/texture/solver/walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/errors.h"

namespace dem::texture {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double outside = 0.5;  // of its radius: the gap to the cylinder up to which a particle is at the side
constexpr double bed = 0.5;  // thickness of what a strip is bedded in, over the radius of the particle that it bears on

// One step towards a target.
void approach(double& value, double target, double& gain) {
  const double next = value + gain;
  const bool reached = (gain >= 0) == (next >= target);
  value = reached ? target : next;
  if (reached) gain = 0;
}

double gain_over(double from, double to, std::int64_t ramp) {
  return (to - from) / static_cast<double>(std::max<std::int64_t>(ramp, 1));
}

// Where hardly anything bears yet, a share of all first contacts stands in for the stiffness.
double newton(double excess, double bearing, double all) { return excess / std::max(bearing, 0.25 * all); }

}  // namespace

Walls::Walls(const AssemblyInput& input, const Slabs& slabs)
    : platens_(input.platens),
      slides_(input.slides),
      damping_(input.damping),
      faces_(input.faces),
      modulus_(input.wall_modulus),
      platen_contacts_(slabs.count()),
      jacket_contacts_(slabs.count()),
      membrane_(slabs.count()),
      sums_(slabs.count()) {
  for (std::vector<Face>& faces : faces_) {
    if (faces.empty()) faces.emplace_back();
  }
  ends_[0].z = ends_[0].z_before = input.z_low;
  ends_[1].z = ends_[1].z_before = input.z_high;
  jacket_.radius = jacket_.radius_before = input.jacket_radius;
  if (input.membrane && input.jacket_radius > 0) lay_membrane(input, slabs);
  if (!input.grip.empty()) {
    held_.resize(slabs.count());
    for (std::size_t i = 0; i < input.grip.size(); ++i) {
      if (input.grip[i] <= 0) continue;
      held_[slabs.of_particle(i)].push_back({static_cast<std::int32_t>(i), input.grip[i] - 1});
      if (input.grip[i] == 2) lift_.mass += input.density[i] * 4 / 3 * pi * std::pow(input.radius[i], 3);
    }
  }
  for (std::size_t i = 0; any() && i < input.position.size(); ++i) {
    meet({i, slabs.of_particle(i), input.position[i], input.radius[i], static_cast<std::size_t>(input.mineral[i])}, 0,
         true);
  }
  check_strips();
}

void Walls::lay_membrane(const AssemblyInput& input, const Slabs& slabs) {
  membrane_radius_ = input.jacket_radius;
  membrane_height_ = input.z_high - input.z_low;
  membrane_area_ = 2 * pi * membrane_radius_ * membrane_height_;
  double squares = 0;
  for (std::size_t i = 0; i < input.position.size(); ++i) {
    const double r = input.radius[i], away = std::hypot(input.position[i][0], input.position[i][1]);
    if (jacket_gap(membrane_radius_, away, r) > outside * r) continue;
    membrane_[slabs.of_particle(i)].push_back({static_cast<std::int32_t>(i), r * r, away, away, 0});
    squares += r * r;
  }
  for (auto& slab : membrane_) {
    for (MembraneShare& share : slab) share.area *= membrane_area_ / squares;
  }
}

// A strip that bears on nothing would let the specimen fall.
void Walls::check_strips() const {
  for (std::size_t w = 0; w < 2; ++w) {
    for (std::size_t f = 0; f < faces_[w].size(); ++f) {
      const auto bears = [&](const PlatenContact& c) {
        return static_cast<std::size_t>(c.upper) == w && static_cast<std::size_t>(c.face) == f;
      };
      const bool any =
          std::ranges::any_of(platen_contacts_, [&](const auto& of) { return std::ranges::any_of(of, bears); });
      if (faces_[w][f].strip > 0 && !any) {
        throw CaseError(
            "a strip that the specimen is to lie on bears on no particle; take another seed or a larger specimen");
      }
    }
  }
}

void Walls::drive(double lower, double upper, std::int64_t ramp) {
  const std::array<double, 2> target = {lower, upper};
  for (std::size_t w = 0; w < 2; ++w) {
    ends_[w].servo = 0;
    ends_[w].target = target[w];
    ends_[w].gain = gain_over(ends_[w].speed, target[w], ramp);
  }
}

void Walls::confine(double pressure, std::int64_t ramp) {
  jacket_.target = pressure;
  jacket_.gain = gain_over(jacket_.pressure, pressure, ramp);
  for (End& end : ends_) end.servo = 1;
}

void Walls::press(double force, std::int64_t ramp) {
  lift_.target = force;
  lift_.gain = gain_over(lift_.force, force, ramp);
}

void Walls::press(std::size_t slab, Particles& particles) {
  if (!platens_) return;
  press_platens(slab, particles);
  if (membrane_area_ > 0) {
    press_membrane(slab, particles);
  } else {
    press_jacket(slab, particles);
  }
}

// Of the face of an end, before the gap at rest.
JawGap Walls::gap_of(std::int32_t upper, const Face& face, const Vec3& at, double radius) const {
  const double z = ends_[static_cast<std::size_t>(upper)].z, side = upper != 0 ? -1 : 1;
  if (face.jaw == 0) return {platen_gap(z, upper != 0, at[2], radius), 0, side};
  return jaw_gap(face.jaw, at[0] - face.x, at[2] - (z + side * face.jaw), radius);
}

void Walls::press_platens(std::size_t slab, Particles& particles) {
  SlabSums& sums = sums_[slab];
  sums.force_before = sums.force;
  sums.force = {};
  sums.stiffness = {};
  double elastic = 0;
  for (const PlatenContact& contact : platen_contacts_[slab]) {
    const auto p = static_cast<std::size_t>(contact.particle);
    const auto w = static_cast<std::size_t>(contact.upper);
    const Row8& pose = particles.pose[p];
    const Face& face = faces_[w][static_cast<std::size_t>(contact.face)];
    const JawGap at = gap_of(contact.upper, face, {pose.v[0], pose.v[1], pose.v[2]}, pose.v[3]);
    const WallResult result = advance(contact.law, at.gap);
    if (result.stiffness == 0) continue;
    const double f = at.z * result.push;  // on the particle, along z
    particles.force[p].v[2] += f;
    if (face.jaw != 0) particles.force[p].v[0] += at.x * result.push;
    sums.force[w] += f;
    sums.stiffness[w] += result.stiffness;
    elastic += result.energy;
  }
  for (std::size_t w = 0; w < 2; ++w) {
    sums.work += 0.5 * (sums.force[w] + sums.force_before[w]) * (ends_[w].z - ends_[w].z_before);
  }
  sums.elastic = elastic;
}

void Walls::press_jacket(std::size_t slab, Particles& particles) {
  SlabSums& sums = sums_[slab];
  sums.jacket_force_before = sums.jacket_force;
  sums.jacket_force = sums.jacket_stiffness = 0;
  double elastic = sums.elastic;
  for (const JacketContact& contact : jacket_contacts_[slab]) {
    const auto p = static_cast<std::size_t>(contact.particle);
    const Row8& pose = particles.pose[p];
    const double x = pose.v[0], y = pose.v[1], away = std::sqrt(x * x + y * y);
    const WallResult result = advance(contact.law, jacket_gap(jacket_.radius, away, pose.v[3]));
    if (result.stiffness == 0) continue;
    particles.force[p].v[0] -= result.push * x / away;
    particles.force[p].v[1] -= result.push * y / away;
    sums.jacket_force += result.push;
    sums.jacket_stiffness += result.stiffness;
    elastic += result.energy;
  }
  sums.work -= 0.5 * (sums.jacket_force + sums.jacket_force_before) * (jacket_.radius - jacket_.radius_before);
  sums.elastic = elastic;
}

void Walls::press_membrane(std::size_t slab, Particles& particles) {
  SlabSums& sums = sums_[slab];
  sums.jacket_force = sums.bulge = 0;
  const double stretch = (ends_[1].z - ends_[0].z) / membrane_height_;
  for (MembraneShare& share : membrane_[slab]) {
    const auto p = static_cast<std::size_t>(share.particle);
    const Row8& pose = particles.pose[p];
    const double x = pose.v[0], y = pose.v[1], away = std::sqrt(x * x + y * y), wide = share.area * away / share.away;
    const double force = jacket_.pressure * wide * stretch;
    particles.force[p].v[0] -= force * x / away;
    particles.force[p].v[1] -= force * y / away;
    sums.jacket_force += force;
    sums.bulge += wide;
    sums.work -= 0.5 * (force + share.force_before) * (away - share.away_before);
    share.away_before = away;
    share.force_before = force;
  }
}

void Walls::move(double step) {
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
  approach(jacket_.pressure, jacket_.target, jacket_.gain);
  const double radius = jacket_.radius, height = ends_[1].z - ends_[0].z;
  for (std::size_t w = 0; w < 2; ++w) {
    End& end = ends_[w];
    end.drift_before = end.z - end.z_before;
    end.z_before = end.z;
    if (end.servo != 0) {
      const double excess = force[w] - jacket_.pressure * pi * radius * radius;
      end.z += (w == 0 ? -1 : 1) * newton(excess, stiffness[w], end.stiffness);
      continue;
    }
    approach(end.speed, end.target, end.gain);
    end.z += end.speed * step;
  }
  if (slides_) {
    double up = 0;  // of the specimen on the grip
    for (const SlabSums& sums : sums_) up -= sums.lift;
    approach(lift_.force, lift_.target, lift_.gain);
    const double free = up - lift_.force, drag = damping_ * std::abs(free);
    lift_.drift_before = lift_.z - lift_.z_before;
    lift_.z_before = lift_.z;
    lift_.speed += step * (free - (lift_.speed > 0 ? drag : lift_.speed < 0 ? -drag : 0)) / lift_.mass;
    lift_.z += lift_.speed * step;
  }
  jacket_.radius_before = radius;
  if (membrane_area_ > 0) {
    double bulge = 0;
    for (const SlabSums& sums : sums_) bulge += sums.bulge;
    jacket_.radius = jacket_.radius_before = membrane_radius_ * bulge / membrane_area_;  // of this step already
  } else if (radius > 0) {
    // What the particles alone did to the force in the last step, they will do again in the next.
    const double moved = jacket_force - jacket_.force_before + jacket_stiffness * jacket_.drift;
    const double excess = jacket_force + moved - jacket_.pressure * 2 * pi * radius * height;
    jacket_.drift = newton(excess, jacket_stiffness, jacket_.stiffness);
    jacket_.force_before = jacket_force;
    jacket_.radius += jacket_.drift;
  }
}

double Walls::hold(std::size_t slab, Particles& particles) {
  if (held_.empty()) return 0;
  SlabSums& sums = sums_[slab];
  sums.force_before = sums.force;
  sums.force = {};
  sums.lift_before = sums.lift;
  sums.lift = 0;
  double kinetic = 0;
  for (const Held& held : held_[slab]) {
    const auto i = static_cast<std::size_t>(held.particle);
    const auto w = static_cast<std::size_t>(held.upper);
    const double speed = ends_[w].speed;
    const double rise = slides_ && w == 1 ? lift_.speed : 0;
    sums.force[w] -= particles.force[i].v[slides_ ? 0 : 2];
    if (w == 1) sums.lift -= particles.force[i].v[2];
    particles.force[i] = Row8{};
    particles.velocity[i] = slides_ ? Row8{{speed, 0, rise, 0, 0, 0, 0, 0}} : Row8{{0, 0, speed, 0, 0, 0, 0, 0}};
    kinetic += particles.inertia[i].mass * speed * speed + particles.inertia[i].mass * rise * rise;
  }
  for (std::size_t w = 0; w < 2; ++w) {
    sums.work += 0.5 * (sums.force[w] + sums.force_before[w]) * ends_[w].drift_before;
  }
  if (slides_) sums.work += 0.5 * (sums.lift + sums.lift_before) * lift_.drift_before;
  return kinetic;
}

void Walls::meet(const Particles& particles, const Slabs& slabs, double skin) {
  for (std::size_t i = 0; any() && i < particles.size(); ++i) {
    const Row8& p = particles.pose[i];
    meet({i, slabs.of_particle(i), {p.v[0], p.v[1], p.v[2]}, p.v[3], static_cast<std::size_t>(particles.mineral[i])},
         skin, false);
  }
}

void Walls::meet(const Near& sphere, double reach, bool first) {
  const auto is_known = [&](const auto& contacts, const auto& same) {
    return !first && std::any_of(contacts.begin(), contacts.end(), same);
  };
  const double k = wall_stiffness(modulus_[sphere.mineral], sphere.radius);
  for (std::int16_t upper = 0; platens_ && upper < 2; ++upper) {
    const std::vector<Face>& faces = faces_[static_cast<std::size_t>(upper)];
    for (std::int16_t f = 0; f < static_cast<std::int16_t>(faces.size()); ++f) {
      const Face& face = faces[static_cast<std::size_t>(f)];
      if (face.strip > 0 && std::abs(sphere.x[0] - face.x) > face.strip) continue;
      std::vector<PlatenContact>& contacts = platen_contacts_[sphere.slab];
      const auto particle = static_cast<std::int32_t>(sphere.particle);
      const auto same = [&](const PlatenContact& c) {
        return c.particle == particle && c.upper == upper && c.face == f;
      };
      const double gap = gap_of(upper, face, sphere.x, sphere.radius).gap;
      const bool bedded = first && face.strip > 0;
      if (gap > (bedded ? bed * sphere.radius : reach) || is_known(contacts, same)) continue;
      contacts.push_back({particle, upper, f, {first ? gap : 0, k}});
      if (first) ends_[static_cast<std::size_t>(upper)].stiffness += k;
    }
  }
  if (jacket_.radius > 0 && membrane_area_ == 0) {
    std::vector<JacketContact>& contacts = jacket_contacts_[sphere.slab];
    const auto particle = static_cast<std::int32_t>(sphere.particle);
    const auto same = [&](const JacketContact& c) { return c.particle == particle; };
    const double gap = jacket_gap(jacket_.radius, std::hypot(sphere.x[0], sphere.x[1]), sphere.radius);
    if (gap > reach || is_known(contacts, same)) return;
    contacts.push_back({particle, {first ? gap : 0, k}});
    if (first) jacket_.stiffness += k;
  }
}

void Walls::add_stiffness(std::vector<std::array<double, 6>>& diagonal) const {
  for (const auto& slab : platen_contacts_) {
    for (const PlatenContact& contact : slab) {
      const std::size_t w = contact.upper != 0 ? 1 : 0;
      std::array<double, 6>& of = diagonal[static_cast<std::size_t>(contact.particle)];
      of[2] += contact.law.stiffness;
      if (faces_[w][static_cast<std::size_t>(contact.face)].jaw != 0) of[0] += contact.law.stiffness;
    }
  }
  for (const auto& slab : jacket_contacts_) {
    for (const JacketContact& contact : slab) {
      for (const std::size_t axis : {0, 1}) {
        diagonal[static_cast<std::size_t>(contact.particle)][axis] += contact.law.stiffness;
      }
    }
  }
}

void Walls::report(Sample& sample) const {
  for (std::size_t w = 0; w < 2; ++w) sample.place[w] = ends_[w].z_before;
  sample.jacket_radius = jacket_.radius_before;
  sample.rise = lift_.z_before;
  double jacket_force = 0;
  for (const SlabSums& sums : sums_) {
    jacket_force += sums.jacket_force;
    if (slides_) sample.normal_force -= sums.lift;
    for (std::size_t w = 0; w < 2; ++w) sample.force[w] += sums.force[w];
    sample.ledger.work += sums.work;
    sample.ledger.elastic += sums.elastic;
  }
  if (sample.jacket_radius > 0) {
    sample.confining_pressure = jacket_force / (2 * pi * sample.jacket_radius * (sample.place[1] - sample.place[0]));
  }
}

}  // namespace dem::texture
