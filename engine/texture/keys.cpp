// The scenario keys of the grain texture model, and the settings made of them. Tests declare and read their own.
#include "engine/texture/keys.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/texture/loading/test.h"
#include "engine/texture/model.h"

namespace dem::texture {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Key number(const char* path, const char* unit, double low, double high, const char* standard, const char* help) {
  return {path, KeyType::real, unit, low, high, {}, standard, help};
}

// The rock, its specimen and the solver.
std::vector<Key> declare_rock() {
  using enum KeyType;
  return {
      Key{"rock",
          text,
          "",
          -inf,
          inf,
          {},
          "\"\"",
          "name of the rock; published numbers stand beside ours for the rock that they belong to"},
      number("specimen.diameter", "mm", 1, 1000, "", "diameter of the cylinder"),
      number("specimen.height", "mm", 1, 2000, "", "height of the cylinder, along the loading axis z"),
      number("packing.minimum_radius", "mm", 0.01, 100, "", "R_min of the sub-grain particles (Table 4)"),
      number("packing.radius_ratio", "", 1, 5, "1.66", "R_max / R_min (Table 4)"),
      number("packing.modulus", "GPa", 0.01, 1000, "", "E* of the sub-grain particles while they are packed (Table 4)"),
      number("packing.pressure_ratio", "", 1e-4, 0.1, "0.01",
             "material pressure over packing.modulus; not in the paper"),
      number("packing.porosity", "", 0.25, 0.6, "0.3325",
             "porosity of the cloud as drawn; sets the number of particles"),
      Key{"mineral[].name", text, "", -inf, inf, {}, "", "name of the mineral"},
      number("mineral[].share", "%", 0, 100, "", "C_m, volume share of the grain seeds; the shares add to 100 %"),
      number("mineral[].diameter_min", "mm", 0.01, 1000, "", "D_min of the grain seeds"),
      number("mineral[].diameter_max", "mm", 0.01, 1000, "", "D_max of the grain seeds"),
      number("mineral[].density", "kg/m^3", 100, 30000, "", "rho"),
      number("mineral[].modulus", "GPa", 0.001, 2000, "", "E_c, effective modulus"),
      number("mineral[].stiffness_ratio", "", 0.1, 100, "", "k_c, normal over shear stiffness"),
      number("mineral[].friction", "", 0, 10, "", "mu_c, friction coefficient"),
      number("mineral[].bond_modulus", "GPa", 0.001, 2000, "", "E_b, bonded effective modulus"),
      number("mineral[].bond_stiffness_ratio", "", 0.1, 100, "", "k_b, bonded normal over shear stiffness"),
      number("mineral[].tensile_strength", "MPa", 0, 1e5, "", "sigma_t,b, bonded tensile strength"),
      number("mineral[].cohesion", "MPa", 0, 1e5, "", "C_b, bonded cohesion"),
      number("mineral[].friction_angle", "deg", 0, 89, "", "phi_b, bonded friction angle"),
      number("interaction.modulus", "", 0.001, 10, "1.0", "alpha_E (Eq. 7)"),
      number("interaction.stiffness_ratio", "", 0.001, 100, "1.0", "alpha_k (Eq. 7)"),
      number("interaction.friction", "", 0, 10, "1.0", "alpha_mu (Tables 1 and 4)"),
      number("interaction.tensile_strength", "", 0, 10, "1.0", "alpha_t (Eq. 8)"),
      number("interaction.cohesion", "", 0, 10, "1.0", "alpha_C (Eq. 8)"),
      number("interaction.friction_angle", "", 0, 1.5, "1.0", "alpha_phi (Eq. 8)"),
      number("texture.aspect_ratio", "", 1, 20, "1.0", "AR, long over short axis of the grains (Eq. 6)"),
      number("texture.dip", "deg", 0, 90, "\"0 deg\"", "dip of the long axes, from the horizontal"),
      number("texture.dip_direction", "deg", -360, 360, "\"0 deg\"", "azimuth of the long axes, from x"),
      number("texture.seed_scale", "", 0.1, 10, "1.0", "factor on the diameters of the grain seeds"),
      Key{"texture.growth",
          text,
          "",
          -inf,
          inf,
          {"most_contacts", "deepest_contact"},
          "\"most_contacts\"",
          "whose grain a gap particle takes that touches several: most of its neighbours, or the deepest contact"},
      Key{"texture.flat_joint_modulus",
          text,
          "",
          -inf,
          inf,
          {"sum", "linear"},
          "\"sum\"",
          "modulus of the flat joint: E_c + E_b, or E_c alone"},
      Key{"texture.same_mineral_boundaries",
          boolean,
          "",
          -inf,
          inf,
          {},
          "true",
          "grains of one mineral meet in parallel bonds; false: in flat joints"},
      Key{"texture.only_mineral",
          text,
          "",
          -inf,
          inf,
          {},
          "\"\"",
          "name of a mineral: the specimen is of it alone, joined by flat joints throughout; empty: all minerals"},
      number("solver.damping", "", 0, 0.95, "0.7", "local damping alpha"),
      number("solver.time_step_factor", "", 0.01, 1, "0.8", "of the critical step from the stiffness sums"),
  };
}

// What is read off, and which tests are run on which specimens.
std::vector<Key> declare_study() {
  using enum KeyType;
  std::vector<std::string> names;
  for (const TestEntry& test : tests()) names.emplace_back(test.name);
  return {
      number("measure.gauge", "", 0.1, 1, "0.6", "length of the strain gauge over the height"),
      number("measure.stiffness_departure", "", 0.001, 0.5, "0.02",
             "share by which the axial stiffness leaves its plateau at crack initiation"),
      Key{"tests", texts, "", -inf, inf, names, "",
          "tests to run on each specimen; genesis makes it and does not load it"},
      Key{"repeats",
          KeyType::integer,
          "",
          1,
          1000,
          {},
          "1",
          "specimens of each kind, with seed, seed + 1, ...: tells a trend from scatter"},
      Key{"sweep.aspect_ratio",
          reals,
          "",
          1,
          20,
          {},
          "[]",
          "aspect ratios, one specimen each; empty: texture.aspect_ratio"},
      Key{"sweep.dip", reals, "deg", 0, 90, {}, "[]", "dips of the long axes, one specimen each; empty: texture.dip"},
      Key{"sweep.confining_pressure",
          reals,
          "MPa",
          0,
          1000,
          {},
          "[]",
          "confining pressures of the compression tests; empty: compression.confining_pressure"},
      Key{"sweep.mineral",
          texts,
          "",
          -inf,
          inf,
          {},
          "[]",
          "names of minerals, one specimen of each alone; empty: texture.only_mineral"},
      number("extra[].aspect_ratio", "", 1, 20, "1.0", "aspect ratio of a specimen beside the sweep"),
      number("extra[].seed_scale", "", 0.1, 10, "1.0", "seed scale of a specimen beside the sweep"),
      Key{"extra[].growth",
          text,
          "",
          -inf,
          inf,
          {"most_contacts", "deepest_contact"},
          "\"most_contacts\"",
          "rule of growth of a specimen beside the sweep"},
  };
}

}  // namespace

std::span<const Key> keys() {
  static const std::vector<Key> declared = [] {
    std::vector<Key> all = declare_rock();
    const auto append = [&](const std::vector<Key>& more) { all.insert(all.end(), more.begin(), more.end()); };
    for (const TestEntry& test : tests()) append(test.keys());
    append(declare_study());
    return all;
  }();
  return declared;
}

Settings read_settings(const Scenario& s, std::string_view test) {
  Settings r;
  r.packing.vessel = {s.real("specimen.diameter"), s.real("specimen.height")};
  r.packing.radius_min = s.real("packing.minimum_radius");
  r.packing.radius_ratio = s.real("packing.radius_ratio");
  r.packing.modulus = s.real("packing.modulus");
  r.packing.pressure = s.real("packing.pressure_ratio") * r.packing.modulus;
  r.packing.porosity = s.real("packing.porosity");
  r.packing.seed = s.seed();
  if (r.packing.vessel.diameter < 8 * r.packing.radius_min) {
    throw s.error("specimen.diameter", "the specimen is too narrow for its particles",
                  fmt::format("write at least {:.3g} mm, eight minimum radii", 8e3 * r.packing.radius_min));
  }
  if (r.packing.vessel.height < r.packing.vessel.diameter) {
    throw s.error("specimen.height", "the specimen is wider than high", "the height must be at least the diameter");
  }
  double sum = 0;
  const std::string& only = s.text("texture.only_mineral");
  const std::size_t count = s.count("mineral");
  for (std::size_t i = 0; i < count; ++i) {
    const auto key = [i](const char* name) { return fmt::format("mineral[{}].{}", i, name); };
    const auto get = [&](const char* name) { return s.real(key(name)); };
    Mineral m{s.text(key("name")),     get("share"),
              get("diameter_min"),     get("diameter_max"),
              get("density"),          get("modulus"),
              get("stiffness_ratio"),  get("friction"),
              get("bond_modulus"),     get("bond_stiffness_ratio"),
              get("tensile_strength"), get("cohesion"),
              get("friction_angle")};
    if (m.diameter_max < m.diameter_min) {
      throw s.error(key("diameter_max"), "it is smaller than diameter_min", "the range runs from diameter_min up");
    }
    if (m.diameter_min * s.real("texture.seed_scale") > r.packing.vessel.diameter) {
      throw s.error(key("diameter_min"), "the grains are larger than the specimen",
                    "choose grains that fit its diameter");
    }
    for (const Mineral& other : r.minerals) {
      if (other.name == m.name)
        throw s.error(key("name"), "two minerals are called '" + m.name + "'", "give each its own name");
    }
    sum += m.share;
    r.minerals.push_back(std::move(m));
  }
  if (count == 0)
    throw InputError({s.file(), 0, 0}, "mineral", "no mineral is given", "write at least one [[mineral]] table");
  if (std::abs(sum - 1) > 1e-6) {
    throw s.error(fmt::format("mineral[{}].share", count - 1),
                  fmt::format("the shares of the minerals add to {:.6g} %", 100 * sum), "they must add to 100 %");
  }
  if (!only.empty()) {
    std::vector<std::string> names;
    for (const Mineral& m : r.minerals) names.push_back(m.name);
    std::erase_if(r.minerals, [&](const Mineral& m) { return m.name != only; });
    if (r.minerals.empty()) {
      throw s.error("texture.only_mineral", "there is no mineral '" + only + "'",
                    fmt::format("given are {}", fmt::join(names, ", ")));
    }
    r.minerals.front().share = 1;
    r.one_mineral = true;
  }
  r.interaction = {s.real("interaction.modulus"),  s.real("interaction.stiffness_ratio"),
                   s.real("interaction.friction"), s.real("interaction.tensile_strength"),
                   s.real("interaction.cohesion"), s.real("interaction.friction_angle")};
  r.shape = {s.real("texture.aspect_ratio"), s.real("texture.dip"), s.real("texture.dip_direction")};
  r.seed_scale = s.real("texture.seed_scale");
  r.growth = s.text("texture.growth") == "deepest_contact" ? GrowthRule::deepest_contact : GrowthRule::most_contacts;
  r.joint_modulus = s.text("texture.flat_joint_modulus") == "sum" ? JointModulus::sum : JointModulus::linear;
  r.same_mineral_boundaries = s.boolean("texture.same_mineral_boundaries") && !r.one_mineral;
  r.damping = s.real("solver.damping");
  r.time_step_factor = s.real("solver.time_step_factor");
  r.test = test_entry(test).read(s);
  r.gauge = s.real("measure.gauge");
  r.stiffness_departure = s.real("measure.stiffness_departure");
  return r;
}

}  // namespace dem::texture
