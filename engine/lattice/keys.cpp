#include "engine/lattice/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dem::lattice {
namespace {

std::vector<Key> declare() {
  const std::vector<std::string> tests{"elastic", "tension", "compression"};
  const std::vector<std::string> planes{"elastic", "rigid", "plate"};
  const std::vector<std::string> axes{"x", "y", "z"};
  return {
      {.path = "rock.young_modulus",
       .unit = "GPa",
       .low = 1e-6,
       .high = 1e6,
       .affects = Affects::specimen,
       .help = "E of the rock (Table 1)"},
      {.path = "rock.poisson_ratio",
       .low = -1,
       .high = 0.5,
       .affects = Affects::specimen,
       .help = "nu of the rock, 0 to 0.2 (Eq. 4)"},
      {.path = "rock.tensile_strength",
       .unit = "MPa",
       .low = -1e6,
       .high = 1e6,
       .affects = Affects::specimen,
       .help = "Tu of the rock (Table 1)"},
      {.path = "rock.compressive_strength",
       .unit = "MPa",
       .low = -1e6,
       .high = 1e6,
       .affects = Affects::specimen,
       .help = "Cu of the rock, positive (Table 1)"},
      {.path = "rock.internal_friction",
       .low = -10,
       .high = 100,
       .affects = Affects::specimen,
       .help = "mu_i, coefficient of internal friction (Table 1)"},
      {.path = "rock.density",
       .unit = "kg/m^3",
       .low = 1,
       .high = 30000,
       .affects = Affects::specimen,
       .help = "of the whole packing (Eq. 27)"},
      {.path = "correction.tensile_deficit",
       .unit = "%",
       .low = 0,
       .high = 90,
       .standard = "\"0 %\"",
       .affects = Affects::specimen,
       .help = "tested Tu below theory: Xb is raised to make up for it (section 6)"},
      {.path = "correction.compressive_deficit",
       .unit = "%",
       .low = 0,
       .high = 90,
       .standard = "\"0 %\"",
       .affects = Affects::specimen,
       .help = "tested Cu below theory: Fs0 is raised to make up for it (section 6)"},
      {.path = "block.element_diameter",
       .unit = "mm",
       .low = 1e-6,
       .high = 1e6,
       .standard = "\"1 mm\"",
       .affects = Affects::specimen,
       .help = "d"},
      {.path = "block.elements_y",
       .type = KeyType::integer,
       .low = 2,
       .high = 400,
       .standard = "12",
       .affects = Affects::specimen,
       .help = "elements along y of the block; the sweep sets it"},
      {.path = "block.rows",
       .type = KeyType::integer,
       .low = 0,
       .high = 1001,
       .standard = "0",
       .affects = Affects::specimen,
       .help = "rows of a layer, odd; 0: as published for elements_y"},
      {.path = "block.layers",
       .type = KeyType::integer,
       .low = 0,
       .high = 1001,
       .standard = "0",
       .affects = Affects::specimen,
       .help = "layers along z, odd; 0: as published for elements_y"},
      {.path = "motion.time_step",
       .unit = "s",
       .low = 1e-15,
       .high = 1,
       .standard = "\"1e-8 s\"",
       .affects = Affects::test,
       .help = "dt"},
      {.path = "motion.viscosity_factor",
       .low = 0,
       .high = 100,
       .standard = "1.0",
       .affects = Affects::test,
       .help = "on the viscosity of Eq. 28"},
      {.path = "motion.gravity",
       .unit = "m/s^2",
       .low = 0,
       .high = 1e7,
       .standard = "\"0 m/s^2\"",
       .affects = Affects::test,
       .help = "g, against z"},
      {.path = "planes.elastic",
       .type = KeyType::text,
       .choices = planes,
       .standard = "\"elastic\"",
       .affects = Affects::test,
       .when = {"elastic"},
       .help =
           "end elements on springs Kn to the plane, held in it, or one rigid plate on those springs: elastic tests"},
      {.path = "planes.compression",
       .type = KeyType::text,
       .choices = planes,
       .standard = "\"elastic\"",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "the same in compression: a smooth plane pushes each end element by their contact"},
      {.path = "planes.tension",
       .type = KeyType::text,
       .choices = planes,
       .standard = "\"rigid\"",
       .affects = Affects::test,
       .when = {"tension"},
       .help = "the same in tension: what pulls is glue, which holds the end elements in the plane"},
      {.path = "planes.stiffness",
       .low = 0.1,
       .high = 5,
       .standard = "1.0",
       .affects = Affects::test,
       .help = "of the springs between planes and end elements, over Kn"},
      {.path = "loading.direction",
       .type = KeyType::text,
       .choices = axes,
       .standard = "\"z\"",
       .affects = Affects::test,
       .help = "axis of loading; z is the normal of the layers"},
      {.path = "loading.moving",
       .type = KeyType::text,
       .choices = {"both", "one"},
       .standard = "\"both\"",
       .affects = Affects::test,
       .help = "planes that move"},
      {.path = "loading.confining_pressure",
       .unit = "MPa",
       .low = 0,
       .high = 1e6,
       .standard = "\"0 MPa\"",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "on the four sides, from the beginning"},
      {.path = "loading.settle",
       .type = KeyType::integer,
       .low = 1,
       .high = 1000000,
       .standard = "100",
       .affects = Affects::test,
       .help = "time steps in a loading step"},
      {.path = "loading.factor",
       .low = 1e-3,
       .high = 1e3,
       .standard = "1.0",
       .affects = Affects::test,
       .help = "on the motions below"},
      {.path = "loading.elastic_motion",
       .unit = "m",
       .low = 1e-15,
       .high = 1,
       .standard = "\"1.7e-10 m\"",
       .affects = Affects::test,
       .when = {"elastic"},
       .help = "of a plane in a loading step, elastic tests"},
      {.path = "loading.tension_motion",
       .unit = "m",
       .low = 1e-15,
       .high = 1,
       .standard = "\"1.7e-10 m\"",
       .affects = Affects::test,
       .when = {"tension"},
       .help = "of a plane in a loading step, tension"},
      {.path = "loading.compression_motion",
       .unit = "m",
       .low = 1e-15,
       .high = 1,
       .standard = "\"1.7e-9 m\"",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "of a plane in a loading step, compression"},
      {.path = "loading.largest_strain",
       .low = 0,
       .high = 0.5,
       .standard = "0.0",
       .affects = Affects::test,
       .when = {"tension", "compression"},
       .help = "a test that has not failed is given up there; 0: 8 Tu / E in tension, 4 Cu / E in compression"},
      {.path = "loading.most_steps",
       .type = KeyType::integer,
       .low = 1,
       .high = 1e12,
       .standard = "1000000000",
       .affects = Affects::test,
       .help = "time steps after which a test is given up that has not failed or come to its strains"},
      {.path = "loading.after_tension",
       .type = KeyType::integer,
       .low = 0,
       .high = 10000000,
       .standard = "10000",
       .affects = Affects::test,
       .when = {"tension"},
       .help = "time steps followed after failure in tension"},
      {.path = "loading.after_compression",
       .type = KeyType::integer,
       .low = 0,
       .high = 10000000,
       .standard = "60000",
       .affects = Affects::test,
       .when = {"compression"},
       .help = "time steps followed after failure in compression"},
      {.path = "elastic.strains",
       .type = KeyType::reals,
       .low = 1e-9,
       .high = 0.01,
       .standard = "[1e-6, 1e-5, 1e-4, 1e-3]",
       .affects = Affects::test,
       .when = {"elastic"},
       .help = "compressive strains at which E and nu are taken, rising"},
      {.path = "elastic.method",
       .type = KeyType::text,
       .choices = {"rest", "steps"},
       .standard = "\"rest\"",
       .affects = Affects::test,
       .when = {"elastic"},
       .help = "come to rest at each strain, or the paper's loading steps"},
      {.path = "measure.section",
       .type = KeyType::text,
       .choices = {"centres", "outline", "elements"},
       .standard = "\"centres\"",
       .affects = Affects::test,
       .help = "area of stress: box of element centres, outline of the spheres, or end elements times their share"},
      {.path = "measure.gauge",
       .type = KeyType::text,
       .choices = {"end_layers", "planes"},
       .standard = "\"end_layers\"",
       .affects = Affects::test,
       .help = "strain from the end layers or from the planes"},
      {.path = "measure.rate_bias",
       .low = 0.001,
       .high = 1,
       .standard = "0.03",
       .affects = Affects::test,
       .when = {"tension", "compression"},
       .help = "share by which fast loading may raise strengths before the check quasi_static fails"},
      {.path = "emission.window",
       .low = 1,
       .high = 100,
       .standard = "5.0",
       .affects = Affects::drawing,
       .help = "acoustic emission: how far bonds of one event lie from its first, in diameters of elements"},
      {.path = "emission.duration",
       .low = 0.01,
       .high = 100,
       .standard = "1.0",
       .affects = Affects::drawing,
       .help = "acoustic emission: longest pause in one event, in times that a shear wave takes across the window"},
      {.path = "tests",
       .type = KeyType::texts,
       .choices = tests,
       .affects = Affects::cases,
       .help = "tests to run on each block"},
      {.path = "sweep.elements_y",
       .type = KeyType::integers,
       .low = 2,
       .high = 400,
       .standard = "[12]",
       .affects = Affects::cases,
       .help = "blocks, by elements along y"},
      {.path = "extra[].test",
       .type = KeyType::text,
       .choices = tests,
       .affects = Affects::cases,
       .help = "a case beside the sweep"},
      {.path = "extra[].elements_y",
       .type = KeyType::integer,
       .low = 2,
       .high = 400,
       .standard = "12",
       .affects = Affects::cases,
       .help = "its block"},
      {.path = "extra[].planes",
       .type = KeyType::text,
       .choices = planes,
       .otherwise = "planes.{test}",
       .affects = Affects::cases,
       .help = "its planes"},
      {.path = "extra[].moving",
       .type = KeyType::text,
       .choices = {"both", "one"},
       .standard = "\"both\"",
       .affects = Affects::cases,
       .help = "its moving planes"},
      {.path = "extra[].direction",
       .type = KeyType::text,
       .choices = axes,
       .standard = "\"z\"",
       .affects = Affects::cases,
       .help = "its direction of loading"},
      {.path = "extra[].stiffness",
       .low = 0.1,
       .high = 5,
       .standard = "1.0",
       .affects = Affects::cases,
       .help = "the stiffness of its planes, beside planes.stiffness"},
      {.path = "extra[].factor",
       .low = 1e-3,
       .high = 1e3,
       .standard = "1.0",
       .affects = Affects::cases,
       .help = "on its motion in a loading step, beside loading.factor"},
      {.path = "extra[].confining_pressure",
       .unit = "MPa",
       .low = 0,
       .high = 1e6,
       .otherwise = "loading.confining_pressure",
       .affects = Affects::cases,
       .help = "on its sides"},
      {.path = "extra[].tensile_deficit",
       .unit = "%",
       .low = 0,
       .high = 90,
       .otherwise = "correction.tensile_deficit",
       .affects = Affects::cases,
       .help = "of Tu that its bonds make up for"},
      {.path = "extra[].compressive_deficit",
       .unit = "%",
       .low = 0,
       .high = 90,
       .otherwise = "correction.compressive_deficit",
       .affects = Affects::cases,
       .help = "of Cu that its bonds make up for"},
      {.path = "extra[].method",
       .type = KeyType::text,
       .choices = {"rest", "steps"},
       .standard = "\"rest\"",
       .affects = Affects::cases,
       .help = "its elastic method"},
  };
}

int axis_of(const std::string& direction) { return direction == "x" ? 0 : direction == "y" ? 1 : 2; }

// Rock values are checked where their formulas are; here the message gets its place in the file.
void check_rock(const Scenario& s) {
  const double nu = s.real("rock.poisson_ratio");
  if (!(nu >= 0 && nu < 0.2)) {
    throw s.error("rock.poisson_ratio", fmt::format("Poisson's ratio is {}", nu),
                  "it must lie in 0 ... 0.2, and below 0.2: there the shear stiffness of a bond Ks is zero (Eq. 4) and "
                  "bonds have no shear strength, above it is negative, and below 0 larger than Kn");
  }
  for (const char* key : {"rock.tensile_strength", "rock.compressive_strength"}) {
    if (!(s.real(key) > 0)) {
      throw s.error(key, fmt::format("the strength is {:g} MPa", 1e-6 * s.real(key)),
                    "write a positive strength, in compression too");
    }
  }
  if (s.real("rock.tensile_strength") > s.real("rock.compressive_strength")) {
    throw s.error("rock.tensile_strength",
                  fmt::format("the rock is stronger in tension, {:g} MPa, than in compression, {:g} MPa",
                              1e-6 * s.real("rock.tensile_strength"), 1e-6 * s.real("rock.compressive_strength")),
                  "no rock is: write at most rock.compressive_strength");
  }
  const double least = std::sqrt(2.0) / 4;
  if (s.real("rock.internal_friction") < least) {
    throw s.error(
        "rock.internal_friction", fmt::format("mu_i is {:g}", s.real("rock.internal_friction")),
        fmt::format("it must be at least {:.4f}: below, the friction of a contact mu_p, which lies in 0 ... 0.7071, "
                    "would be negative (Eq. B5)",
                    least));
  }
}

Micro corrected(const Scenario& s, const Rock& rock, double diameter) {
  Micro micro = micro_of(rock, diameter);
  micro.xb /= 1 - s.real("correction.tensile_deficit");
  micro.fs0 /= 1 - s.real("correction.compressive_deficit");
  return micro;
}

// Beyond this the arrays of a block take gigabytes, and its tests weeks.
constexpr std::int64_t most_elements = 5'000'000;

BlockShape shape_of(const Scenario& s) {
  const int ny = static_cast<int>(s.integer("block.elements_y"));
  const int rows = static_cast<int>(s.integer("block.rows")), layers = static_cast<int>(s.integer("block.layers"));
  for (const char* key : {"block.rows", "block.layers"}) {
    const auto n = s.integer(key);
    if (n != 0 && (n < 3 || n % 2 == 0)) {
      throw s.error(key, fmt::format("the number is {}", n),
                    "it must be odd and at least 3, so that both faces are full, or 0 for the published block");
    }
  }
  const BlockShape shape = block_shape(ny, rows, layers);
  if (const std::int64_t count = element_count(shape); count > most_elements) {
    throw s.error(
        "block.elements_y", fmt::format("{} along y make a block of {} elements", ny, count),
        fmt::format("at most {} can be run: take fewer along y, or give block.rows and block.layers", most_elements));
  }
  return shape;
}

}  // namespace

std::span<const Key> keys() {
  static const std::vector<Key> declared = declare();
  return declared;
}

Settings read_settings(const Scenario& s) {
  check_rock(s);
  Settings r;
  r.test = s.texts("tests").front();
  r.rock = {s.real("rock.young_modulus"),        s.real("rock.poisson_ratio"),     s.real("rock.tensile_strength"),
            s.real("rock.compressive_strength"), s.real("rock.internal_friction"), s.real("rock.density")};
  r.micro = corrected(s, r.rock, s.real("block.element_diameter"));
  r.shape = shape_of(s);
  r.setup.micro = r.micro;
  r.setup.time_step = s.real("motion.time_step");
  const double limit = stable_time_step(r.micro);
  if (r.setup.time_step > limit) {
    throw s.error("motion.time_step", fmt::format("the step is {:.3g} s", r.setup.time_step),
                  fmt::format("the stable limit for this rock and diameter is {:.3g} s", limit));
  }
  r.setup.gravity = s.real("motion.gravity");
  r.setup.axis = axis_of(s.text("loading.direction"));
  const std::string& planes = s.text("planes." + r.test);
  r.setup.planes = planes == "elastic" ? PlaneKind::elastic : planes == "rigid" ? PlaneKind::rigid : PlaneKind::plate;
  if (r.shape.unit() && r.setup.axis != 2) {
    throw s.error("loading.direction", "the single unit has no faces across that axis", "load it along z");
  }
  if (s.text("measure.section") == "elements" && r.setup.axis != 2) {
    throw s.error("measure.section", "the share of an end element is known for loading along z only",
                  "write \"centres\" or \"outline\"");
  }
  r.setup.plane_stiffness = s.real("planes.stiffness");
  if (r.test == "compression") r.setup.pressure = s.real("loading.confining_pressure");
  r.loading.kind = r.test == "tension" ? TestKind::tension : TestKind::compression;
  r.loading.motion = s.real("loading.factor") * s.real("loading." + r.test + "_motion");
  r.loading.both = s.text("loading.moving") == "both";
  r.loading.settle = static_cast<int>(s.integer("loading.settle"));
  r.loading.burst = r.test == "tension" ? 1 : 8;
  r.loading.after =
      static_cast<int>(s.integer(r.test == "tension" ? "loading.after_tension" : "loading.after_compression"));
  const double strength = r.test == "tension" ? r.rock.tensile_strength : r.rock.compressive_strength;
  // Along the rows a block first loses the rows, or all between them, and carries on with the rest: in tension to six
  // times the strain of the others, in compression as columns of elements that never fail.
  r.loading.largest_strain = s.real("loading.largest_strain");
  if (r.loading.largest_strain == 0)
    r.loading.largest_strain = (r.test == "tension" ? 8 : 4) * strength / r.rock.young_modulus;
  r.loading.most_steps = s.integer("loading.most_steps");
  r.rate_bias = s.real("measure.rate_bias");
  r.strains = s.reals("elastic.strains");
  if (r.strains.empty() || !std::is_sorted(r.strains.begin(), r.strains.end())) {
    throw s.error("elastic.strains", "the strains do not rise", "list at least one, the smallest first");
  }
  r.method = s.text("elastic.method") == "rest" ? ElasticMethod::rest : ElasticMethod::steps;
  const std::string& section = s.text("measure.section");
  r.section = section == "centres" ? Section::centres : section == "outline" ? Section::outline : Section::elements;
  r.gauge = s.text("measure.gauge") == "planes" ? Gauge::planes : Gauge::end_layers;
  r.setup.viscosity = s.real("motion.viscosity_factor") * viscosity(r.micro, static_cast<long>(element_count(r.shape)));
  return r;
}

double section_area(const Block& block, int axis, Section section) {
  if (section == Section::centres) return cross_section(block, axis);
  const double d = block.diameter;
  if (section == Section::elements) {
    return static_cast<double>(block.face(axis, true).size()) * std::sqrt(3.0) / 2 * d * d;
  }
  double area = 1;
  for (int i = 0; i < 3; ++i) {
    if (i != axis) area *= block.extent()[static_cast<std::size_t>(i)] + d;
  }
  return area;
}

}  // namespace dem::lattice
