#include "engine/texture/genesis/packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/space_filling.h"

namespace dem::texture {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int max_steps = 60'000;         // of one relaxation
constexpr int max_adjustments = 60;       // of the radii
constexpr double first_unbalance = 3e-2;  // of the cloud, before the radii are touched
// Neighbour lists reach this far beyond touch, in mean radii.
constexpr double coarse_skin = 0.4;
constexpr double skin = 0.2;
constexpr double largest_change = 0.02;  // of the radii at once
// d(P/E) / d(ln radius) of an affine deformation, solid fraction 0.667 and 7 contacts a sphere: solid * Z / 4.
constexpr double affine_slope = 1.17;
// Mean contact force over pressure and squared mean radius, from the same numbers: 4 pi / (solid * Z).
constexpr double typical_force = 2.7;
constexpr double force_floor = 0.01;  // contacts below this part of the typical force are as good as none

double mean_radius(const std::vector<Sphere>& spheres) {
  double sum = 0;
  for (const Sphere& s : spheres) sum += s.r;
  return sum / static_cast<double>(spheres.size());
}

std::vector<Sphere> in_order(const std::vector<Sphere>& spheres, const std::vector<std::size_t>& order, double factor) {
  std::vector<Sphere> sorted;
  sorted.reserve(spheres.size());
  for (const std::size_t i : order) {
    const Sphere& s = spheres[i];
    sorted.push_back({s.x * factor, s.y * factor, s.z * factor, s.r * factor});
  }
  return sorted;
}

/// The search for the radii at which the pile meets the goal.
class Settling {
 public:
  Settling(const Cylinder& vessel, const std::vector<Sphere>& cloud, const SettleGoal& goal, RunContext& context)
      : goal_(goal),
        context_(context),
        unit_(mean_radius(cloud)),
        origin_(space_filling_order(cloud)),
        pile_(vessel.diameter / unit_, vessel.height / unit_, in_order(cloud, origin_, 1 / unit_),
              force_floor * typical_force * goal.pressure, context.threads) {}

  Settled run() {
    // The radii are found on a pile roughly at rest, which costs little, and followed as it comes to rest.
    relax(first_unbalance, coarse_skin);
    for (const double unbalance : {1e-2, 1e-3}) {
      if (unbalance > goal_.unbalance) meet_pressure(unbalance);
      progress_ += 0.2;
    }
    meet_pressure(goal_.unbalance);
    progress_ = 0.9;
    while (goal_.remove_floaters && remove_floaters()) meet_pressure(goal_.unbalance);
    const std::vector<std::size_t> order = space_filling_order(pile_.spheres());
    Settled settled{in_order(pile_.spheres(), order, unit_), {}, pile_.state(), scale_, removed_, pile_.steps()};
    for (const std::size_t i : order) settled.origin.push_back(origin_[i]);
    settled.state.mean_contact_force *= unit_ * unit_;
    settled.state.mean_unbalanced *= unit_ * unit_;
    return settled;
  }

 private:
  void relax(double unbalance, double reach) {
    const bool at_rest = pile_.relax(unbalance, reach, max_steps, [this](const PileState&) {
      if (context_.stopped()) throw Interrupted{};
      Progress now;
      now.stage = "packing";
      now.step = pile_.steps();
      now.fraction = progress_;
      context_.report(now);
    });
    if (!at_rest)
      throw CaseError(
          fmt::format("the packing does not come to rest: after {} steps the mean net force is still {:.1e} "
                      "of the mean contact force",
                      pile_.steps(), pile_.unbalance()));
  }

  /// Secant search: the slope comes from the last two states, and from the affine estimate at first.
  void meet_pressure(double unbalance) {
    relax(unbalance, skin);
    double slope = slope_;
    for (int n = 0; n < max_adjustments; ++n) {
      const double before = pile_.state().wall_pressure;
      const double missing = goal_.pressure - before;
      if (std::abs(missing) <= goal_.pressure_tolerance * goal_.pressure) return;
      const double change = std::clamp(missing / slope, -largest_change, largest_change);
      pile_.scale_radii(1 + change);
      scale_ *= 1 + change;
      relax(unbalance, skin);
      const double measured = (pile_.state().wall_pressure - before) / change;
      slope = std::clamp(measured, 0.3 * affine_slope, 3 * affine_slope);
      slope_ = slope;
    }
    throw CaseError(fmt::format("the packing does not meet its pressure: {:.4g} of the modulus instead of {:.4g}",
                                pile_.state().wall_pressure, goal_.pressure));
  }

  bool remove_floaters() {
    const std::vector<int> contacts = pile_.contact_counts();
    std::vector<bool> keep(contacts.size());
    for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = contacts[i] >= 3;
    const auto floaters = std::count(keep.begin(), keep.end(), false);
    if (floaters == 0) return false;
    removed_ += static_cast<int>(floaters);
    pile_.keep_only(keep);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (keep[i]) origin_[kept++] = origin_[i];
    origin_.resize(kept);
    if (pile_.spheres().empty()) throw CaseError("the packing fell apart: no particle has three contacts");
    return true;
  }

  SettleGoal goal_;
  RunContext& context_;
  double unit_;                      // m: mean radius of the cloud, the pile's unit of length
  std::vector<std::size_t> origin_;  // index in the cloud of each sphere of the pile
  Pile pile_;
  double scale_ = 1;
  double slope_ = affine_slope;
  double progress_ = 0;
  int removed_ = 0;
};

double wanted_volume(const PackingSettings& settings) { return (1 - settings.porosity) * volume(settings.vessel); }

std::vector<Sphere> draw_cloud(const PackingSettings& settings) {
  const double wanted = wanted_volume(settings);
  std::vector<Sphere> cloud;
  double filled = 0;
  RandomStream radii(settings.seed, Purpose::packing_radii);
  for (;;) {
    const double r = settings.radius_min * radii.uniform(1, settings.radius_ratio);
    const double v = sphere_volume(r);
    // The last sphere is taken when that comes nearer to the wanted volume.
    if (filled + v / 2 > wanted) break;
    filled += v;
    const Vec3 at = random_place(settings.vessel, r, settings.seed, Purpose::packing_positions,
                                 static_cast<std::uint32_t>(cloud.size()));
    cloud.push_back({at[0], at[1], at[2], r});
  }
  return cloud;
}

/// Pairs i < j that touch, sorted.
std::vector<std::array<std::int32_t, 2>> touching(const std::vector<Sphere>& spheres) {
  double largest = 0;
  for (const Sphere& s : spheres) largest = std::max(largest, s.r);
  const CellGrid grid = cells_of(spheres, 2 * largest);
  std::vector<std::array<std::int32_t, 2>> pairs;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Sphere& s = spheres[i];
    const std::size_t first = pairs.size();
    grid.around({s.x, s.y, s.z}, [&](std::int32_t j) {
      if (j <= static_cast<std::int32_t>(i)) return;
      const Sphere& t = spheres[j];
      const double dx = s.x - t.x, dy = s.y - t.y, dz = s.z - t.z;
      if (std::sqrt(dx * dx + dy * dy + dz * dz) <= s.r + t.r) pairs.push_back({static_cast<std::int32_t>(i), j});
    });
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end());
  }
  return pairs;
}

}  // namespace

double expected_spheres(const PackingSettings& settings) {
  // Radii are uniform from R_min to q R_min: the mean of their cubes is R_min^3 (1 + q) (1 + q^2) / 4.
  const double q = settings.radius_ratio;
  return wanted_volume(settings) / (sphere_volume(settings.radius_min) * (1 + q) * (1 + q * q) / 4);
}

double volume(const Cylinder& vessel) { return pi / 4 * vessel.diameter * vessel.diameter * vessel.height; }

double sphere_volume(double radius) { return 4.0 / 3.0 * pi * radius * radius * radius; }

Vec3 random_place(const Cylinder& vessel, double r, std::uint64_t seed, Purpose purpose, std::uint32_t index) {
  RandomStream stream(seed, purpose, index);
  const double room = vessel.diameter / 2 - r;
  const double axis = room * std::sqrt(stream.uniform());
  const double angle = 2 * pi * stream.uniform();
  const double z = stream.uniform(r, vessel.height - r);
  return {axis * std::cos(angle), axis * std::sin(angle), z};
}

std::vector<std::size_t> space_filling_order(const std::vector<Sphere>& spheres) {
  if (spheres.empty()) return {};
  const double radius = mean_radius(spheres);
  double low_x = spheres[0].x, low_y = spheres[0].y, low_z = spheres[0].z;
  for (const Sphere& s : spheres) {
    low_x = std::min(low_x, s.x);
    low_y = std::min(low_y, s.y);
    low_z = std::min(low_z, s.z);
  }
  const auto cell = [radius](double from_low) { return static_cast<std::uint32_t>(from_low / radius); };
  return slab_order<std::size_t>(spheres.size(), [&](std::size_t i) -> SlabCell {
    const Sphere& s = spheres[i];
    const std::uint32_t z = cell(s.z - low_z);
    return {z / 6, cell(s.x - low_x), cell(s.y - low_y), z % 6};
  });
}

Settled settle(const Cylinder& vessel, std::vector<Sphere> cloud, const SettleGoal& goal, RunContext& context) {
  if (cloud.empty()) throw CaseError("the vessel has room for no sphere");
  for (const Sphere& s : cloud)
    if (2 * s.r > std::min(vessel.diameter, vessel.height))
      throw CaseError(fmt::format("a sphere of {:.3g} mm does not fit in a cylinder of {:.3g} x {:.3g} mm", 2e3 * s.r,
                                  1e3 * vessel.diameter, 1e3 * vessel.height));
  return Settling(vessel, cloud, goal, context).run();
}

Packing pack(const PackingSettings& settings, RunContext& context) {
  SettleGoal goal;
  goal.pressure = settings.pressure / settings.modulus;
  const Settled settled = settle(settings.vessel, draw_cloud(settings), goal, context);

  Packing packing;
  double solid = 0;
  for (const Sphere& s : settled.spheres) {
    packing.position.push_back({s.x, s.y, s.z});
    packing.radius.push_back(s.r);
    solid += sphere_volume(s.r);
  }
  packing.contacts = touching(settled.spheres);
  packing.pressure = settled.state.wall_pressure * settings.modulus;
  packing.coordination = 2 * static_cast<double>(packing.contacts.size()) / static_cast<double>(settled.spheres.size());
  packing.porosity = 1 - solid / volume(settings.vessel);
  packing.radius_scale = settled.radius_scale;
  packing.floaters_removed = settled.floaters_removed;
  return packing;
}

}  // namespace dem::texture
