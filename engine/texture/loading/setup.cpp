#include "engine/texture/loading/setup.h"

#include <algorithm>

#include "engine/texture/solver/slabs.h"

namespace dem::texture {

namespace {

/// Coefficients for contacts of two minerals, by their places in the list.
Interaction coefficients(std::size_t one, std::size_t two, const Settings& settings) {
  const bool own_values = one == two && settings.attenuated == Attenuated::unlike_minerals;
  return own_values ? Interaction{} : settings.interaction;
}

}  // namespace

std::vector<BondSpec> group_contacts(const Packing& packing, const GrainMap& grains, const Settings& settings) {
  std::vector<BondSpec> bonds;
  bonds.reserve(packing.contacts.size());
  for (const auto& [i, j] : packing.contacts) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const auto m = static_cast<std::size_t>(grains.mineral[a]), n = static_cast<std::size_t>(grains.mineral[b]);
    const Mineral &one = settings.minerals[m], &two = settings.minerals[n];
    BondSpec spec;
    spec.first = i;
    spec.second = j;
    spec.boundary = grains.grain[a] != grains.grain[b] && (m != n || settings.same_mineral_boundaries);
    spec.group = spec.boundary ? between(one, two, coefficients(m, n, settings)) : inside(one, settings.joint_modulus);
    bonds.push_back(spec);
  }
  return bonds;
}

namespace {

std::vector<MineralGrains> grains_of(const Settings& settings) {
  std::vector<MineralGrains> minerals;
  for (const Mineral& m : settings.minerals) minerals.push_back({m.share, m.diameter_min, m.diameter_max});
  return minerals;
}

// Seeds of which nothing is left in the body.
void drop_empty_grains(Specimen& specimen) {
  GrainSeeds& seeds = specimen.seeds;
  std::vector<std::int32_t> place(seeds.radius.size(), -1);
  for (const std::int32_t grain : specimen.grains.grain) place[static_cast<std::size_t>(grain)] = 0;
  std::size_t kept = 0;
  for (std::size_t g = 0; g < place.size(); ++g) {
    if (place[g] < 0) continue;
    place[g] = static_cast<std::int32_t>(kept);
    seeds.position[kept] = seeds.position[g];
    seeds.radius[kept] = seeds.radius[g];
    seeds.mineral[kept] = seeds.mineral[g];
    ++kept;
  }
  seeds.position.resize(kept);
  seeds.radius.resize(kept);
  seeds.mineral.resize(kept);
  for (std::int32_t& grain : specimen.grains.grain) grain = place[static_cast<std::size_t>(grain)];
}

}  // namespace

std::vector<std::string> specimen_files(const Settings& settings) {
  return genesis_files(settings.packing, grains_of(settings), settings.seed_scale);
}

void keep_specimen(const Settings& settings, RunContext& context) {
  (void)genesis(settings.packing, grains_of(settings), settings.seed_scale, context);
}

Body body_of(const Settings& settings) {
  const Cylinder& vessel = settings.packing.vessel;
  return settings.test.body.value_or(Body{.size = {vessel.diameter, vessel.diameter, vessel.height}});
}

Specimen make_specimen(const Settings& settings, RunContext& context) {
  Genesis made = genesis(settings.packing, grains_of(settings), settings.seed_scale, context);
  const Body body = body_of(settings);
  if (body.shape != Body::Shape::cylinder) cut_out(body, settings.packing.vessel, made);
  const std::vector<std::int32_t> order = order_in_slabs(made.packing.position, made.packing.radius);
  Specimen specimen;
  specimen.seeds = std::move(made.seeds);
  specimen.packing = made.packing;
  std::vector<std::int32_t> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto old = static_cast<std::size_t>(order[k]);
    place[old] = static_cast<std::int32_t>(k);
    specimen.packing.position[k] = made.packing.position[old];
    specimen.packing.radius[k] = made.packing.radius[old];
  }
  for (auto& [i, j] : specimen.packing.contacts) {
    i = place[static_cast<std::size_t>(i)];
    j = place[static_cast<std::size_t>(j)];
    if (i > j) std::swap(i, j);
  }
  std::sort(specimen.packing.contacts.begin(), specimen.packing.contacts.end());
  specimen.grains = grow_grains(specimen.packing, specimen.seeds, settings.shape, settings.growth);
  if (body.shape != Body::Shape::cylinder) drop_empty_grains(specimen);
  std::erase_if(specimen.packing.contacts, [&](const auto& pair) {
    const auto at = [&](std::int32_t i) { return specimen.packing.position[static_cast<std::size_t>(i)]; };
    return body.notched(at(pair[0]), at(pair[1]));
  });
  specimen.bonds = group_contacts(specimen.packing, specimen.grains, settings);
  return specimen;
}

AssemblyInput assembly_input(const Specimen& specimen, const Settings& settings) {
  AssemblyInput input;
  input.position = specimen.packing.position;
  input.radius = specimen.packing.radius;
  input.mineral = specimen.grains.mineral;
  for (const std::int32_t m : input.mineral) {
    input.density.push_back(settings.minerals[static_cast<std::size_t>(m)].density);
  }
  input.bonds = specimen.bonds;
  for (std::size_t m = 0; m < settings.minerals.size(); ++m) {
    const Mineral& one = settings.minerals[m];
    input.fresh.emplace_back();
    for (std::size_t n = 0; n < settings.minerals.size(); ++n)
      input.fresh.back().push_back(between(one, settings.minerals[n], coefficients(m, n, settings)));
    input.wall_modulus.push_back(one.modulus);
  }
  input.damping = settings.damping;
  input.time_step_factor = settings.time_step_factor;
  const Body body = body_of(settings);
  input.z_low = 0;
  input.z_high = body.size[settings.test.motion == Axis::x ? 0 : 2];
  input.slides = settings.test.motion == Axis::x;
  const Test& test = settings.test;
  if (test.confining_pressure > 0) input.jacket_radius = settings.packing.vessel.diameter / 2;
  input.membrane = test.membrane;
  input.platens = test.hold == Hold::platens;
  input.faces = test.faces;
  if (test.hold == Hold::grips) {
    for (const Vec3& p : input.position) input.grip.push_back(test.gripped(test, body, p));
  }
  return input;
}

}  // namespace dem::texture
