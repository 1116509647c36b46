#include "engine/lattice/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dem::lattice {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

std::vector<Key> declare() {
  using enum KeyType;
  const auto number = [](const char* path, const char* unit, double low, double high, const char* standard,
                         const char* help) { return Key{path, real, unit, low, high, {}, standard, help}; };
  const auto whole = [](const char* path, double low, double high, const char* standard, const char* help) {
    return Key{path, integer, "", low, high, {}, standard, help};
  };
  const auto word = [](const char* path, std::vector<std::string> choices, const char* standard, const char* help) {
    return Key{path, text, "", -inf, inf, std::move(choices), standard, help};
  };
  const std::vector<std::string> tests{"elastic", "tension", "compression"};
  const std::vector<std::string> planes{"elastic", "rigid", "plate"};
  const std::vector<std::string> directions_{"x", "y", "z"};
  return {
      number("rock.young_modulus", "GPa", 1e-6, 1e6, "", "E of the rock (Table 1)"),
      number("rock.poisson_ratio", "", -1, 0.5, "", "nu of the rock, 0 to 0.2 (Eq. 4)"),
      number("rock.tensile_strength", "MPa", -1e6, 1e6, "", "Tu of the rock (Table 1)"),
      number("rock.compressive_strength", "MPa", -1e6, 1e6, "", "Cu of the rock, positive (Table 1)"),
      number("rock.internal_friction", "", -10, 100, "", "mu_i, coefficient of internal friction (Table 1)"),
      number("rock.density", "kg/m^3", 1, 30000, "", "of the whole packing (Eq. 27)"),
      number("correction.tensile_deficit", "%", 0, 90, "\"0 %\"",
             "tested Tu below theory: Xb is raised to make up for it (section 6)"),
      number("correction.compressive_deficit", "%", 0, 90, "\"0 %\"",
             "tested Cu below theory: Fs0 is raised to make up for it (section 6)"),
      number("block.element_diameter", "mm", 1e-6, 1e6, "\"1 mm\"", "d"),
      whole("block.elements_y", 2, 400, "12", "elements along y of the block; the sweep sets it"),
      whole("block.rows", 0, 1001, "0", "rows of a layer, odd; 0: as published for elements_y"),
      whole("block.layers", 0, 1001, "0", "layers along z, odd; 0: as published for elements_y"),
      number("motion.time_step", "s", 1e-15, 1, "\"1e-8 s\"", "dt"),
      number("motion.viscosity_factor", "", 0, 100, "1.0", "on the viscosity of Eq. 28"),
      number("motion.gravity", "m/s^2", 0, 1e7, "\"0 m/s^2\"", "g, against z"),
      word("loading.direction", directions_, "\"z\"", "axis of loading; z is the normal of the layers"),
      word("loading.planes", planes, "\"elastic\"",
           "end elements on springs Kn to the plane, held in it, or one rigid plate on those springs"),
      number("planes.stiffness", "", 0.1, 5, "1.0", "of the springs between planes and end elements, over Kn"),
      word("loading.moving", {"both", "one"}, "\"both\"", "planes that move"),
      whole("loading.settle", 1, 1000000, "100", "time steps in a loading step"),
      number("loading.factor", "", 1e-3, 1e3, "1.0", "on the motions below"),
      number("loading.elastic_motion", "m", 1e-15, 1, "\"1.7e-10 m\"", "of a plane in a loading step, elastic tests"),
      number("loading.tension_motion", "m", 1e-15, 1, "\"1.7e-10 m\"", "of a plane in a loading step, tension"),
      number("loading.compression_motion", "m", 1e-15, 1, "\"1.7e-9 m\"", "of a plane in a loading step, compression"),
      whole("loading.after_tension", 0, 10000000, "10000", "time steps followed after failure in tension"),
      whole("loading.after_compression", 0, 10000000, "60000", "time steps followed after failure in compression"),
      Key{"elastic.strains",
          reals,
          "",
          1e-9,
          0.01,
          {},
          "[1e-6, 1e-5, 1e-4, 1e-3]",
          "compressive strains at which E and nu are taken, rising"},
      word("elastic.method", {"rest", "steps"}, "\"rest\"",
           "come to rest at each strain, or the paper's loading steps"),
      word("measure.section", {"centres", "outline", "elements"}, "\"centres\"",
           "area of stress: box of element centres, outline of the spheres, or end elements times their share"),
      word("measure.gauge", {"end_layers", "planes"}, "\"end_layers\"",
           "strain from the end layers or from the planes"),
      Key{"tests", texts, "", -inf, inf, tests, "", "tests to run on each block"},
      Key{"sweep.elements_y", integers, "", 2, 400, {}, "[12]", "blocks, by elements along y"},
      word("extra[].test", tests, "", "a case beside the sweep"),
      whole("extra[].elements_y", 2, 400, "12", "its block"),
      word("extra[].planes", planes, "\"elastic\"", "its planes"),
      word("extra[].moving", {"both", "one"}, "\"both\"", "its moving planes"),
      word("extra[].direction", directions_, "\"z\"", "its direction of loading"),
      number("extra[].stiffness", "", 0.1, 5, "1.0", "the stiffness of its planes, beside planes.stiffness"),
      number("extra[].factor", "", 1e-3, 1e3, "1.0", "on its motion in a loading step, beside loading.factor"),
      word("extra[].method", {"rest", "steps"}, "\"rest\"", "its elastic method"),
  };
}

int axis_of(const std::string& direction) { return direction == "x" ? 0 : direction == "y" ? 1 : 2; }

// Rock values are checked where their formulas are; here the message gets its place in the file.
void check_rock(const Scenario& s) {
  const double nu = s.real("rock.poisson_ratio");
  if (!(nu >= 0 && nu <= 0.2)) {
    throw s.error("rock.poisson_ratio", fmt::format("Poisson's ratio is {}", nu),
                  "it must lie in 0 ... 0.2: above, the shear stiffness of a bond Ks would be negative (Eq. 4), below, "
                  "larger than Kn");
  }
  for (const char* key : {"rock.tensile_strength", "rock.compressive_strength"}) {
    if (!(s.real(key) > 0)) {
      throw s.error(key, fmt::format("the strength is {:g} MPa", 1e-6 * s.real(key)),
                    "write a positive strength, in compression too");
    }
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
  return block_shape(ny, rows, layers);
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
  const std::string& planes = s.text("loading.planes");
  r.setup.planes = planes == "elastic" ? PlaneKind::elastic : planes == "rigid" ? PlaneKind::rigid : PlaneKind::plate;
  if (r.shape.unit() && r.setup.axis != 2) {
    throw s.error("loading.direction", "the single unit has no faces across that axis", "load it along z");
  }
  if (s.text("measure.section") == "elements" && r.setup.axis != 2) {
    throw s.error("measure.section", "the share of an end element is known for loading along z only",
                  "write \"centres\" or \"outline\"");
  }
  r.setup.plane_stiffness = s.real("planes.stiffness");
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
  r.loading.largest_strain = (r.test == "tension" ? 8 : 4) * strength / r.rock.young_modulus;
  r.strains = s.reals("elastic.strains");
  if (r.strains.empty() || !std::is_sorted(r.strains.begin(), r.strains.end())) {
    throw s.error("elastic.strains", "the strains do not rise", "list at least one, the smallest first");
  }
  r.method = s.text("elastic.method") == "rest" ? ElasticMethod::rest : ElasticMethod::steps;
  const std::string& section = s.text("measure.section");
  r.section = section == "centres" ? Section::centres : section == "outline" ? Section::outline : Section::elements;
  r.gauge = s.text("measure.gauge") == "planes" ? Gauge::planes : Gauge::end_layers;
  const Block block = make_block(r.shape, r.micro.diameter);
  r.setup.viscosity = s.real("motion.viscosity_factor") * viscosity(r.micro, static_cast<long>(block.site.size()));
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
