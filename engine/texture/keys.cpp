// The scenario keys of the grain texture model, and the settings made of them. Tests declare and read their own.
#include "engine/texture/keys.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/model/case.h"
#include "engine/scenario/units.h"
#include "engine/texture/loading/test.h"
#include "engine/texture/model.h"
#include "engine/texture/quantities.h"

namespace dem::texture {
namespace {

constexpr double least_across = 5;   // particles across the specimen
constexpr double least_grain = 1.5;  // mean diameter of the grains, over that of the particles

// The rock, its specimen and the solver.
std::vector<Key> declare_rock() {
  return {
      {.path = "rock",
       .type = KeyType::text,
       .standard = "\"\"",
       .affects = Affects::drawing,
       .help = "name of the rock; published numbers stand beside ours for the rock that they belong to"},
      {.path = "specimen.diameter",
       .unit = "mm",
       .low = 1,
       .high = 1000,
       .affects = Affects::specimen,
       .help = "diameter of the cylinder, at least 13 times packing.minimum_radius"},
      {.path = "specimen.height",
       .unit = "mm",
       .low = 1,
       .high = 2000,
       .affects = Affects::specimen,
       .help = "height of the cylinder, along the loading axis z"},
      {.path = "packing.minimum_radius",
       .unit = "mm",
       .low = 0.01,
       .high = 100,
       .affects = Affects::specimen,
       .help = "R_min of the sub-grain particles (Table 4)"},
      {.path = "packing.radius_ratio",
       .low = 1,
       .high = 5,
       .standard = "1.66",
       .affects = Affects::specimen,
       .help = "R_max / R_min (Table 4)"},
      {.path = "packing.modulus",
       .unit = "GPa",
       .low = 0.01,
       .high = 1000,
       .affects = Affects::specimen,
       .help = "E* of the sub-grain particles while they are packed (Table 4)"},
      {.path = "packing.pressure_ratio",
       .low = 1e-4,
       .high = 0.1,
       .standard = "0.01",
       .affects = Affects::specimen,
       .help = "material pressure over packing.modulus; not in the paper"},
      {.path = "packing.porosity",
       .low = 0.25,
       .high = 0.6,
       .standard = "0.3325",
       .affects = Affects::specimen,
       .help = "porosity of the cloud as drawn; sets the number of particles"},
      {.path = "mineral[].name",
       .type = KeyType::text,
       .form = Form::name,
       .affects = Affects::specimen,
       .help = "name of the mineral: up to 40 letters, digits, blanks and - _ ( ) +"},
      {.path = "mineral[].colour",
       .type = KeyType::text,
       .standard = "\"\"",
       .affects = Affects::drawing,
       .help = "in the figures, as \"#c0a080\" (red, green, blue); not given: by the mineral's place in the list"},
      {.path = "mineral[].share",
       .unit = "%",
       .low = 0,
       .high = 100,
       .affects = Affects::specimen,
       .help = "C_m, volume share of the grain seeds; the shares add to 100 %"},
      {.path = "mineral[].diameter_min",
       .unit = "mm",
       .low = 0.01,
       .high = 1000,
       .affects = Affects::specimen,
       .help = "D_min of the grain seeds"},
      {.path = "mineral[].diameter_max",
       .unit = "mm",
       .low = 0.01,
       .high = 1000,
       .affects = Affects::specimen,
       .help = "D_max of the grain seeds"},
      {.path = "mineral[].density",
       .unit = "kg/m^3",
       .low = 100,
       .high = 30000,
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "rho"},
      {.path = "mineral[].modulus",
       .unit = "GPa",
       .low = 0.001,
       .high = 2000,
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "E_c, effective modulus"},
      {.path = "mineral[].stiffness_ratio",
       .low = 0.1,
       .high = 100,
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "k_c, normal over shear stiffness"},
      {.path = "mineral[].friction",
       .low = 0,
       .high = 10,
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "mu_c, friction coefficient"},
      {.path = "mineral[].bond_modulus",
       .unit = "GPa",
       .low = 0.001,
       .high = 2000,
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "E_b, bonded effective modulus"},
      {.path = "mineral[].bond_stiffness_ratio",
       .low = 0.1,
       .high = 100,
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "k_b, bonded normal over shear stiffness"},
      {.path = "mineral[].tensile_strength",
       .unit = "MPa",
       .low = 0,
       .high = 1e5,
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "sigma_t,b, bonded tensile strength"},
      {.path = "mineral[].cohesion",
       .unit = "MPa",
       .low = 0,
       .high = 1e5,
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "C_b, bonded cohesion"},
      {.path = "mineral[].friction_angle",
       .unit = "deg",
       .low = 0,
       .high = 89,
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "phi_b, bonded friction angle"},
      {.path = "interaction.modulus",
       .low = 0.001,
       .high = 10,
       .standard = "1.0",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "alpha_E (Eq. 7)"},
      {.path = "interaction.stiffness_ratio",
       .low = 0.001,
       .high = 100,
       .standard = "1.0",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "alpha_k (Eq. 7)"},
      {.path = "interaction.friction",
       .low = 0,
       .high = 10,
       .standard = "1.0",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "alpha_mu (Tables 1 and 4)"},
      {.path = "interaction.tensile_strength",
       .low = 0,
       .high = 10,
       .standard = "1.0",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "alpha_t (Eq. 8)"},
      {.path = "interaction.cohesion",
       .low = 0,
       .high = 10,
       .standard = "1.0",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "alpha_C (Eq. 8)"},
      {.path = "interaction.friction_angle",
       .low = 0,
       .high = 1.5,
       .standard = "1.0",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "alpha_phi (Eq. 8)"},
      {.path = "interaction.between",
       .type = KeyType::text,
       .choices = {"minerals", "grains"},
       .standard = "\"minerals\"",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "where the coefficients act: on boundaries between different minerals, or between any two grains"},
      {.path = "texture.aspect_ratio",
       .low = 1,
       .high = 20,
       .standard = "1.0",
       .affects = Affects::specimen,
       .help = "AR, long over short axis of the grains (Eq. 6)"},
      {.path = "texture.dip",
       .unit = "deg",
       .low = 0,
       .high = 90,
       .standard = "\"0 deg\"",
       .affects = Affects::specimen,
       .help = "dip of the long axes, from the horizontal"},
      {.path = "texture.dip_direction",
       .unit = "deg",
       .low = -360,
       .high = 360,
       .standard = "\"0 deg\"",
       .affects = Affects::specimen,
       .help = "azimuth of the long axes, from x"},
      {.path = "texture.seed_scale",
       .low = 0.1,
       .high = 10,
       .standard = "1.0",
       .affects = Affects::specimen,
       .help = "factor on the diameters of the grain seeds"},
      {.path = "texture.growth",
       .type = KeyType::text,
       .choices = {"most_contacts", "deepest_contact"},
       .standard = "\"deepest_contact\"",
       .affects = Affects::specimen,
       .help = "whose grain a gap particle takes that touches several: most of its neighbours, or the deepest contact"},
      {.path = "texture.flat_joint_modulus",
       .type = KeyType::text,
       .choices = {"sum", "linear"},
       .standard = "\"sum\"",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "modulus of the flat joint: E_c + E_b, or E_c alone"},
      {.path = "texture.same_mineral_boundaries",
       .type = KeyType::boolean,
       .standard = "true",
       .affects = Affects::specimen,
       .help = "grains of one mineral meet in parallel bonds; false: in flat joints"},
      {.path = "texture.only_mineral",
       .type = KeyType::text,
       .form = Form::name,
       .standard = "\"\"",
       .affects = Affects::specimen,
       .help = "name of a mineral: the specimen is of it alone, joined by flat joints throughout; empty: all minerals"},
      {.path = "solver.damping",
       .low = 0,
       .high = 0.95,
       .standard = "0.7",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "local damping alpha"},
      {.path = "solver.time_step_factor",
       .low = 0.01,
       .high = 1,
       .standard = "0.8",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "of the critical step from the stiffness sums"},
  };
}

// What is read off, and which tests are run on which specimens.
std::vector<Key> declare_study() {
  std::vector<std::string> names;
  for (const TestEntry& test : tests()) names.emplace_back(test.name);
  return {
      {.path = "measure.gauge",
       .low = 0.1,
       .high = 1,
       .standard = "0.6",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "length of the strain gauge over the height; of a disc: its diameter over the disc's radius"},
      {.path = "measure.stiffness_departure",
       .low = 0.001,
       .high = 0.5,
       .standard = "0.02",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "share by which the axial stiffness leaves its plateau at crack initiation"},
      {.path = "measure.rate_bias",
       .low = 0.001,
       .high = 1,
       .standard = "0.03",
       .affects = Affects::test,
       .when = {"loaded"},
       .help = "share by which fast loading may move strengths and moduli before the check quasi_static fails"},
      {.path = "emission.window",
       .low = 1,
       .high = 100,
       .standard = "5.0",
       .affects = Affects::drawing,
       .help = "acoustic emission: how far cracks of one event lie from its first, in mean particle diameters"},
      {.path = "emission.duration",
       .low = 0.01,
       .high = 100,
       .standard = "1.0",
       .affects = Affects::drawing,
       .help = "acoustic emission: longest pause in one event, in times that a shear wave takes across the window"},
      {.path = "tests",
       .type = KeyType::texts,
       .choices = names,
       .affects = Affects::cases,
       .help = "tests to run on each specimen; genesis makes it and does not load it"},
      repeats_key(),
      {.path = "sweep.aspect_ratio",
       .type = KeyType::reals,
       .low = 1,
       .high = 20,
       .standard = "[]",
       .affects = Affects::cases,
       .help = "aspect ratios, one specimen each; empty: texture.aspect_ratio"},
      {.path = "sweep.dip",
       .type = KeyType::reals,
       .unit = "deg",
       .low = 0,
       .high = 90,
       .standard = "[]",
       .affects = Affects::cases,
       .help = "dips of the long axes, one specimen each; empty: texture.dip"},
      {.path = "sweep.confining_pressure",
       .type = KeyType::reals,
       .unit = "MPa",
       .low = 0,
       .high = 1000,
       .standard = "[]",
       .affects = Affects::cases,
       .help = "confining pressures of the compression tests; empty: compression.confining_pressure"},
      {.path = "sweep.mineral",
       .type = KeyType::texts,
       .form = Form::name,
       .standard = "[]",
       .affects = Affects::cases,
       .help = "names of minerals, one specimen of each alone; empty: texture.only_mineral"},
      {.path = "sweep.raised",
       .type = KeyType::texts,
       .standard = "[]",
       .affects = Affects::cases,
       .help = "parameters that are raised, one at a time, each beside the specimen as it is: \"cohesion\" (of all "
               "minerals), \"quartz.cohesion\", \"interaction.cohesion\"; what moves together is raised together"},
      {.path = "sensitivity.parameter",
       .type = KeyType::text,
       .standard = "\"\"",
       .affects = Affects::cases,
       .help = "the parameter that is raised in every specimen, where sweep.raised names none; empty: none is"},
      {.path = "sensitivity.factor",
       .low = 1.01,
       .high = 2,
       .standard = "1.2",
       .affects = Affects::cases,
       .help = "what a raised parameter is multiplied by"},
      {.path = "extra[].aspect_ratio",
       .low = 1,
       .high = 20,
       .otherwise = "texture.aspect_ratio",
       .affects = Affects::cases,
       .help = "aspect ratio of a specimen beside the sweep"},
      {.path = "extra[].seed_scale",
       .low = 0.1,
       .high = 10,
       .otherwise = "texture.seed_scale",
       .affects = Affects::cases,
       .help = "seed scale of a specimen beside the sweep"},
      {.path = "extra[].growth",
       .type = KeyType::text,
       .choices = {"most_contacts", "deepest_contact"},
       .otherwise = "texture.growth",
       .affects = Affects::cases,
       .help = "rule of growth of a specimen beside the sweep"},
      {.path = "extra[].between",
       .type = KeyType::text,
       .choices = {"minerals", "grains"},
       .otherwise = "interaction.between",
       .affects = Affects::cases,
       .help = "interaction.between of a specimen beside the sweep"},
      {.path = "extra[].pressure_ratio",
       .low = 1e-4,
       .high = 0.1,
       .otherwise = "packing.pressure_ratio",
       .affects = Affects::cases,
       .help = "packing pressure of a specimen beside the sweep"},
  };
}

// How the rock is brought to what was measured (dem-report calibrate).
std::vector<Key> declare_calibration() {
  return {
      {.path = "calibrate.parameters",
       .type = KeyType::texts,
       .standard = "[]",
       .affects = Affects::drawing,
       .help = "what calibrate may move: \"cohesion\" (one factor for all minerals), \"quartz.cohesion\", "
               "\"interaction.cohesion\"; empty: what the measured values determine"},
      {.path = "calibrate.ranges",
       .type = KeyType::texts,
       .standard = "[]",
       .affects = Affects::drawing,
       .help = "how far, as multiples of the value at the start: \"cohesion 0.5-2\""},
      {.path = "calibrate.budget",
       .type = KeyType::integer,
       .low = 4,
       .high = 10000,
       .standard = "40",
       .affects = Affects::drawing,
       .help = "tests that calibrate may run for a mineral; for a rock of several minerals twice as "
               "many, and half as many again for each confining pressure that is tested"},
      {.path = "calibrate.seeds",
       .type = KeyType::integer,
       .low = 2,
       .high = 1000,
       .standard = "5",
       .affects = Affects::drawing,
       .help =
           "fresh seeds of the last round, by which calibrate confirms what it has found; two more are tested at each "
           "step before it"},
  };
}

// What laboratories have measured, of the rock or of a mineral alone ("mineral[].").
std::vector<Key> declare_measured(const std::string& of) {
  std::vector<Key> keys;
  if (of.empty()) {
    keys.push_back({.path = "measured.source",
                    .type = KeyType::text,
                    .standard = "\"\"",
                    .affects = Affects::drawing,
                    .help = "where the measured values come from, in a few words: stands beside them in the report"});
  }
  const std::string whose = of.empty() ? "" : " of the mineral alone";
  for (const Measurable& one : measurables()) {
    const std::string table = of + "measured.";
    keys.push_back({.path = table + std::string(one.key),
                    .type = one.confined ? KeyType::measured_at : KeyType::measured,
                    .unit = std::string(one.unit),
                    .at_unit = one.confined ? "MPa" : "",
                    .low = one.low,
                    .high = one.high,
                    .standard = one.confined ? "[]" : "\"\"",
                    .affects = Affects::drawing,
                    .help = std::string(one.meaning) + whose + ", with its uncertainty"});
    if (one.by.empty()) continue;
    std::vector<std::string> readings;
    for (const Reading& reading : quantity::initiation_readings) readings.emplace_back(reading.id);
    keys.push_back({.path = table + std::string(one.by),
                    .type = KeyType::text,
                    .choices = readings,
                    .standard = "\"one_percent_of_cracks\"",
                    .affects = Affects::drawing,
                    .help = "which reading of ours " + std::string(one.key) + " is compared with"});
  }
  return keys;
}

}  // namespace

std::span<const Key> keys() {
  static const std::vector<Key> declared = [] {
    std::vector<Key> all = declare_rock();
    const auto append = [&](const std::vector<Key>& more) { all.insert(all.end(), more.begin(), more.end()); };
    for (const TestEntry& test : tests()) append(test.keys());
    append(declare_study());
    append(declare_measured("mineral[]."));
    append(declare_measured(""));
    append(declare_calibration());
    return all;
  }();
  return declared;
}

namespace {

// Particles must be small beside the specimen and its grains: else what is measured is their packing, not the rock.
void check_fineness(const Scenario& s, const Settings& r) {
  const double particle = r.packing.radius_min * (1 + r.packing.radius_ratio);  // mean diameter
  const double smallest = body_of(r).smallest(), across = smallest / particle;
  if (across < least_across) {
    throw s.error("packing.minimum_radius",
                  fmt::format("only {:.1f} particles lie across the specimen: their mean diameter is {:.3g} mm", across,
                              1e3 * particle),
                  fmt::format("write at most {:.3g} mm, for {:.0f} across; with fewer there is no inside that the "
                              "platens and the jacket do not hold",
                              1e3 * smallest / (least_across * (1 + r.packing.radius_ratio)), least_across));
  }
  if (r.one_mineral) return;  // its grains are no boundaries
  double grain = 0;
  for (const Mineral& m : r.minerals) grain += m.share * 0.5 * (m.diameter_min + m.diameter_max) * r.seed_scale;
  if (grain < least_grain * particle) {
    throw s.error("packing.minimum_radius",
                  fmt::format("grains of {:.3g} mm hold no more than a particle or two of {:.3g} mm", 1e3 * grain,
                              1e3 * particle),
                  fmt::format("write at most {:.3g} mm, or larger grains: with one particle a grain there is no inside "
                              "of grains, and no shape",
                              1e3 * grain / (least_grain * (1 + r.packing.radius_ratio))));
  }
}

}  // namespace

Settings read_settings(const Scenario& s, std::string_view test) {
  Settings r;
  r.packing.vessel = {s.real("specimen.diameter"), s.real("specimen.height")};
  r.packing.radius_min = s.real("packing.minimum_radius");
  r.packing.radius_ratio = s.real("packing.radius_ratio");
  r.packing.modulus = s.real("packing.modulus");
  r.packing.pressure = s.real("packing.pressure_ratio") * r.packing.modulus;
  r.packing.porosity = s.real("packing.porosity");
  r.packing.seed = s.seed();
  r.test = test_entry(test).read(s);
  const double particle = r.packing.radius_min * (1 + r.packing.radius_ratio);  // mean diameter
  if (r.test.body) r.packing.vessel = vessel_of(*r.test.body, particle);
  if (!r.test.body && r.packing.vessel.height < r.packing.vessel.diameter) {
    throw s.error("specimen.height", "the specimen is wider than high", "the height must be at least the diameter");
  }
  // Packings of granite's particles at 11.4 minimum radii do not come to rest for three seeds of four, at 12.9 they do.
  constexpr double narrowest = 13;
  const double smallest = body_of(r).smallest();
  if (smallest < narrowest * r.packing.radius_min * (1 - 1e-9)) {
    throw s.error(
        r.test.size_key,
        fmt::format("{} is too narrow for its particles: the packing would not come to rest", in_unit(smallest, "mm")),
        fmt::format("write at least {:.4g} mm, {:g} times packing.minimum_radius",
                    1e3 * narrowest * r.packing.radius_min, narrowest));
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
    const std::string& colour = s.text(key("colour"));
    const bool hexadecimal = colour.size() == 7 && colour.front() == '#' &&
                             colour.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (!colour.empty() && !hexadecimal) {
      throw s.error(key("colour"), "\"" + colour + "\" is no colour",
                    "write # and six hexadecimal digits, two each for red, green and blue: \"#c0a080\"");
    }
    if (m.diameter_max < m.diameter_min) {
      throw s.error(key("diameter_max"), "it is smaller than diameter_min", "the range runs from diameter_min up");
    }
    if (m.diameter_min * s.real("texture.seed_scale") > smallest) {
      throw s.error(key("diameter_min"), "the grains are larger than the specimen",
                    "choose grains that fit its diameter");
    }
    for (const Mineral& other : r.minerals) {
      if (other.name == m.name)
        throw s.error(key("name"), "two minerals are called '" + m.name + "'", "give each its own name");
      if (id_part(other.name) == id_part(m.name)) {
        throw s.error(key("name"),
                      "'" + m.name + "' and '" + other.name + "' give the same name of folders, " + id_part(m.name),
                      "let them differ in letters or digits");
      }
    }
    sum += m.share;
    r.minerals.push_back(std::move(m));
  }
  if (count == 0) throw s.error("model", "no mineral is given", "this model needs at least one [[mineral]] table");
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
  r.attenuated = s.text("interaction.between") == "grains" ? Attenuated::all_boundaries : Attenuated::unlike_minerals;
  r.shape = {s.real("texture.aspect_ratio"), s.real("texture.dip"), s.real("texture.dip_direction")};
  r.seed_scale = s.real("texture.seed_scale");
  r.growth = s.text("texture.growth") == "deepest_contact" ? GrowthRule::deepest_contact : GrowthRule::most_contacts;
  r.joint_modulus = s.text("texture.flat_joint_modulus") == "sum" ? JointModulus::sum : JointModulus::linear;
  r.same_mineral_boundaries = s.boolean("texture.same_mineral_boundaries") && !r.one_mineral;
  r.damping = s.real("solver.damping");
  r.time_step_factor = s.real("solver.time_step_factor");
  r.gauge = s.real("measure.gauge");
  r.rate_bias = s.real("measure.rate_bias");
  r.stiffness_departure = s.real("measure.stiffness_departure");
  check_fineness(s, r);
  return r;
}

}  // namespace dem::texture
