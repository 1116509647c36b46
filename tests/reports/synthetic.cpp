#include "tests/reports/synthetic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/core/cell_grid.h"
#include "engine/core/files.h"
#include "engine/core/random.h"
#include "engine/texture/keys.h"
#include "engine/texture/quantities.h"

namespace synthetic {

namespace quantity = dem::texture::quantity;
namespace {

using Vec = std::array<double, 3>;

constexpr std::array<const char*, 4> minerals{"plagioclase", "alkali feldspar", "quartz", "biotite"};
constexpr std::array<double, 4> shares{0.17, 0.48, 0.29, 0.06};
constexpr double radius_mean = 0.45e-3;

struct Body {
  std::vector<Vec> position;
  std::vector<double> radius;
  std::vector<std::int32_t> grain, mineral;
  std::vector<Vec> seed;
  std::vector<double> seed_radius;
  std::vector<std::int32_t> seed_mineral;
  std::vector<std::array<std::int32_t, 2>> pairs;
};

double distance(const Vec& a, const Vec& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

// Jittered close packing in the cylinder.
void place_particles(Body& body, const Options& o, dem::RandomStream& random) {
  const double step = 1.95 * radius_mean;
  const double layer = step * std::sqrt(2.0 / 3.0);
  for (int k = 0; (k + 0.5) * layer < o.height; ++k) {
    for (int j = -40; j <= 40; ++j) {
      for (int i = -40; i <= 40; ++i) {
        const double x = (i + 0.5 * (j & 1) + 0.25 * (k & 1)) * step + random.uniform(-0.1, 0.1) * step;
        const double y = (j * 0.866 + 0.29 * (k & 1)) * step + random.uniform(-0.1, 0.1) * step;
        const double z = (k + 0.5) * layer;
        const double radius = random.uniform(0.35e-3, 0.55e-3);
        if (std::hypot(x, y) + 0.8 * radius_mean > 0.5 * o.diameter) continue;
        body.position.push_back({x, y, z});
        body.radius.push_back(radius);
      }
    }
  }
}

void place_seeds(Body& body, const Options& o, dem::RandomStream& random) {
  const double volume = std::numbers::pi / 4 * o.diameter * o.diameter * o.height;
  const auto number = static_cast<std::size_t>(std::max(8.0, volume / 1.6e-8));
  for (std::size_t i = 0; i < number; ++i) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double r = 0.5 * o.diameter * std::sqrt(random.uniform());
    body.seed.push_back({r * std::cos(angle), r * std::sin(angle), random.uniform(0, o.height)});
    body.seed_radius.push_back(random.uniform(1.0e-3, 2.2e-3));
    double draw = random.uniform();
    std::int32_t mineral = 0;
    while (mineral < 3 && draw > shares[static_cast<std::size_t>(mineral)])
      draw -= shares[static_cast<std::size_t>(mineral++)];
    body.seed_mineral.push_back(mineral);
  }
}

void assign_grains(Body& body, double aspect_ratio) {
  const double lambda = std::cbrt(aspect_ratio);
  for (const Vec& p : body.position) {
    double best = 1e300;
    std::int32_t chosen = 0;
    for (std::size_t s = 0; s < body.seed.size(); ++s) {
      const Vec& q = body.seed[s];
      const double measure =
          std::hypot((p[0] - q[0]) / (lambda * lambda), (p[1] - q[1]) * lambda, (p[2] - q[2]) * lambda) /
          body.seed_radius[s];
      if (measure < best) best = measure, chosen = static_cast<std::int32_t>(s);
    }
    body.grain.push_back(chosen);
    body.mineral.push_back(body.seed_mineral[static_cast<std::size_t>(chosen)]);
  }
}

void find_contacts(Body& body) {
  const dem::CellGrid grid(body.position.size(), 1.2e-3, [&](std::size_t i) { return body.position[i]; });
  for (std::size_t i = 0; i < body.position.size(); ++i) {
    grid.around(body.position[i], [&](std::int32_t j) {
      const auto other = static_cast<std::size_t>(j);
      if (other <= i) return;
      if (distance(body.position[i], body.position[other]) < 1.08 * (body.radius[i] + body.radius[other])) {
        body.pairs.push_back({static_cast<std::int32_t>(i), j});
      }
    });
  }
}

Body body_of(double aspect_ratio, const Options& options) {
  dem::RandomStream random(7, dem::Purpose::test_data);
  Body body;
  place_particles(body, options, random);
  place_seeds(body, options, random);
  assign_grains(body, aspect_ratio);
  find_contacts(body);
  return body;
}

std::vector<double> flat(const std::vector<Vec>& points) {
  std::vector<double> values;
  for (const Vec& p : points) values.insert(values.end(), p.begin(), p.end());
  return values;
}

dem::Table particles_table(const Body& body, const Options& o, double aspect_ratio) {
  dem::Table table{.name = "particles",
                   .attributes = {{"minerals", "plagioclase,alkali feldspar,quartz,biotite"},
                                  {"diameter", fmt::format("{}", o.diameter)},
                                  {"height", fmt::format("{}", o.height)},
                                  {"aspect_ratio", fmt::format("{}", aspect_ratio)}},
                   .columns = {}};
  table.add("position", "m", flat(body.position), 3);
  table.add("radius", "m", body.radius);
  table.add("grain", "", body.grain);
  table.add("mineral", "", body.mineral);
  table.add("growth_round", "", std::vector<std::int32_t>(body.radius.size(), 0));
  return table;
}

dem::Table grains_table(const Body& body, double aspect_ratio) {
  const double lambda = std::cbrt(aspect_ratio);
  std::vector<std::int32_t> number(body.seed.size(), 0);
  for (const std::int32_t g : body.grain) ++number[static_cast<std::size_t>(g)];
  std::vector<double> axis, semi_long, semi_short;
  for (const double r : body.seed_radius) {
    axis.insert(axis.end(), {1.0, 0.0, 0.0});
    semi_long.push_back(lambda * lambda * r);
    semi_short.push_back(r / lambda);
  }
  dem::Table table{.name = "grains", .attributes = {}, .columns = {}};
  table.add("centre", "m", flat(body.seed), 3);
  table.add("radius", "m", body.seed_radius);
  table.add("mineral", "", body.seed_mineral);
  table.add("axis", "1", axis, 3);
  table.add("particles", "", number);
  table.add("semi_long", "m", semi_long);
  table.add("semi_short", "m", semi_short);
  table.add("own_axis", "1", axis, 3);
  table.add("own_long", "m", semi_long);
  table.add("own_short", "m", semi_short);
  return table;
}

bool inter(const Body& body, const std::array<std::int32_t, 2>& pair) {
  return body.grain[static_cast<std::size_t>(pair[0])] != body.grain[static_cast<std::size_t>(pair[1])];
}

dem::Table contacts_table(const Body& body) {
  std::vector<std::int32_t> pairs, place;
  for (const auto& pair : body.pairs) {
    pairs.insert(pairs.end(), pair.begin(), pair.end());
    place.push_back(inter(body, pair) ? 1 : 0);
  }
  dem::Table table{.name = "contacts", .attributes = {}, .columns = {}};
  table.add("pair", "", pairs, 2);
  table.add("kind", "", place);
  table.add("place", "", place);
  return table;
}

struct CrackList {
  std::vector<double> strain, position, normal, area;
  std::vector<std::int32_t> mode, place, mineral_a, mineral_b, contact;
};

// Contacts break in the order of a score: boundaries first, then those near an inclined plane.
CrackList cracks_of(const Body& body, const Options& o, double aspect_ratio, double peak_strain) {
  dem::RandomStream random(11, dem::Purpose::test_data);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t c = 0; c < body.pairs.size(); ++c) {
    const Vec& p = body.position[static_cast<std::size_t>(body.pairs[c][0])];
    const double off_plane = std::abs(p[2] - 0.5 * o.height - 1.4 * p[0]) / o.height;
    const bool boundary = inter(body, body.pairs[c]);
    const double score = (boundary ? 0.36 : 0.75) + 0.35 * off_plane + random.uniform(0, 0.9) - 0.02 * aspect_ratio;
    if (score < 1.12) order.emplace_back(score, c);
  }
  std::ranges::sort(order);
  CrackList list;
  for (const auto& [score, c] : order) {
    const auto i = static_cast<std::size_t>(body.pairs[c][0]);
    const auto j = static_cast<std::size_t>(body.pairs[c][1]);
    const bool boundary = inter(body, body.pairs[c]);
    const double gap = distance(body.position[i], body.position[j]);
    list.strain.push_back(peak_strain * std::min(1.18, 0.33 + 0.9 * std::sqrt(std::max(0.0, score - 0.36))));
    for (std::size_t d = 0; d < 3; ++d) {
      list.position.push_back(0.5 * (body.position[i][d] + body.position[j][d]));
      list.normal.push_back((body.position[j][d] - body.position[i][d]) / gap);
    }
    const double r = std::min(body.radius[i], body.radius[j]);
    list.area.push_back(std::numbers::pi * r * r / (boundary ? 1 : 3));
    list.mode.push_back(random.uniform() < (boundary ? 0.05 : 0.25) && score > 0.9 ? 1 : 0);
    list.place.push_back(boundary ? 1 : 0);
    list.mineral_a.push_back(body.mineral[i]);
    list.mineral_b.push_back(body.mineral[j]);
    list.contact.push_back(static_cast<std::int32_t>(c));
  }
  return list;
}

dem::Table cracks_table(const CrackList& list) {
  dem::Table table{.name = "cracks", .attributes = {}, .columns = {}};
  table.add("time", "s", list.strain);
  table.add("strain", "1", list.strain);
  table.add("mode", "", list.mode);
  table.add("place", "", list.place);
  table.add("position", "m", list.position, 3);
  table.add("normal", "1", list.normal, 3);
  table.add("area", "m2", list.area);
  table.add("mineral_a", "", list.mineral_a);
  table.add("mineral_b", "", list.mineral_b);
  table.add("contact", "", list.contact);
  return table;
}

struct Curve {
  double modulus = 0, peak = 0, peak_strain = 0, end_strain = 0, poisson = 0.17;
};

double stress_at(const Curve& c, double strain) {
  const double t = strain / c.peak_strain;
  if (t > 1) return c.peak * std::max(0.0, 1 - 6 * (t - 1) * (t - 1) - 0.6 * (t - 1));
  const double ductility = c.modulus * c.peak_strain / c.peak - 1;  // how far the peak lies behind the straight line
  return c.modulus * strain * (1 - ductility / (1 + ductility) * std::pow(t, 1 / std::max(0.05, ductility)));
}

std::size_t cracks_until(const CrackList& list, double strain) {
  return static_cast<std::size_t>(std::ranges::upper_bound(list.strain, strain) - list.strain.begin());
}

dem::Table history_table(const Curve& c, const CrackList& list, const Options& o) {
  const auto rows = static_cast<std::size_t>(o.samples);
  std::map<std::string, std::vector<double>> col;
  const double volume = std::numbers::pi / 4 * o.diameter * o.diameter * o.height;
  double work = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double strain = c.end_strain * static_cast<double>(i) / static_cast<double>(rows - 1);
    const double stress = stress_at(c, strain);
    const double t = strain / c.peak_strain;
    const double lateral = -c.poisson * strain * (1 + 1.6 * std::pow(t, 4));
    if (i > 0) work += 0.5 * (stress + col["axial_stress"].back()) * (strain - col["axial_strain"].back()) * volume;
    col["time"].push_back(0.01 * static_cast<double>(i));
    col["step"].push_back(100.0 * static_cast<double>(i));
    col["platen_strain"].push_back(1.03 * strain);
    col["axial_strain"].push_back(strain);
    col["lateral_strain"].push_back(lateral);
    col["volumetric_strain"].push_back(strain + 2 * lateral);
    col["axial_stress"].push_back(stress);
    std::array<double, 4> n{};
    for (std::size_t k = 0; k < cracks_until(list, strain); ++k)
      ++n[static_cast<std::size_t>(2 * list.place[k] + list.mode[k])];
    col["cracks_intra_tension"].push_back(n[0]);
    col["cracks_intra_shear"].push_back(n[1]);
    col["cracks_inter_tension"].push_back(n[2]);
    col["cracks_inter_shear"].push_back(n[3]);
    const double elastic = std::min(work, stress * stress / (2 * c.modulus) * volume);
    const double rest = work - elastic;
    col["work"].push_back(work);
    col["elastic"].push_back(elastic);
    col["kinetic"].push_back(1e-4 * work);
    col["damping"].push_back(0.35 * rest);
    col["friction"].push_back(0.30 * rest);
    col["bond_tension"].push_back(0.22 * rest);
    col["bond_shear"].push_back(0.13 * rest - 2e-4 * work);
    col["residual"].push_back(1e-4 * work * (1.2 + std::sin(0.3 * static_cast<double>(i))));
    col["axial_stiffness"].push_back(i == 0 ? std::nan("") : stress / strain);
  }
  dem::Table table{.name = "history", .attributes = {}, .columns = {}};
  constexpr std::array<std::pair<const char*, const char*>, 20> order{{{"time", "s"},
                                                                       {"step", ""},
                                                                       {"platen_strain", "1"},
                                                                       {"axial_strain", "1"},
                                                                       {"lateral_strain", "1"},
                                                                       {"volumetric_strain", "1"},
                                                                       {"axial_stress", "Pa"},
                                                                       {"cracks_intra_tension", ""},
                                                                       {"cracks_intra_shear", ""},
                                                                       {"cracks_inter_tension", ""},
                                                                       {"cracks_inter_shear", ""},
                                                                       {"work", "J"},
                                                                       {"elastic", "J"},
                                                                       {"kinetic", "J"},
                                                                       {"damping", "J"},
                                                                       {"friction", "J"},
                                                                       {"bond_tension", "J"},
                                                                       {"bond_shear", "J"},
                                                                       {"residual", "J"},
                                                                       {"axial_stiffness", "Pa"}}};
  for (const auto& [name, unit] : order) table.add(name, unit, col[name]);
  return table;
}

void add_snapshots(dem::Record& record, const Curve& c, const CrackList& list) {
  const std::array<std::pair<const char*, double>, 7> moments{{{"crack_initiation", 0.34},
                                                               {"stable_growth", 0.6},
                                                               {"damage", 0.8},
                                                               {"unstable_growth", 0.92},
                                                               {"peak", 1.0},
                                                               {"post_peak", 1.06},
                                                               {"end", c.end_strain / c.peak_strain}}};
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const double strain = moments[k].second * c.peak_strain;
    dem::Table table{.name = fmt::format("snapshots/{:04}", k),
                     .attributes = {{"moment", moments[k].first},
                                    {"strain", fmt::format("{}", strain)},
                                    {"stress", fmt::format("{}", stress_at(c, strain))},
                                    {"cracks", fmt::format("{}", cracks_until(list, strain))}},
                     .columns = {}};
    table.add("displacement", "m", std::vector<double>(record.table("particles").rows() * 3, 0.0), 3);
    record.tables.push_back(table);
  }
}

void add_shares(dem::Record& record, const Body& body) {
  const auto joined = [](std::string name) {
    std::ranges::replace(name, ' ', '_');
    return name;
  };
  double between = 0;
  std::map<std::string, double> groups;
  for (const auto& pair : body.pairs) {
    auto a = body.mineral[static_cast<std::size_t>(pair[0])];
    auto b = body.mineral[static_cast<std::size_t>(pair[1])];
    if (a > b) std::swap(a, b);
    const std::string first = joined(minerals[static_cast<std::size_t>(a)]);
    if (inter(body, pair)) between += 1;
    ++groups[inter(body, pair) ? "inter_" + first + "_" + joined(minerals[static_cast<std::size_t>(b)])
                               : "intra_" + first];
  }
  const auto all = static_cast<double>(body.pairs.size());
  record.put(quantity::inter_grain_share, between / all);
  record.put(quantity::coordination, 2 * all / static_cast<double>(body.radius.size()));
  record.put(quantity::porosity, 0.33);
  for (std::size_t m = 0; m < minerals.size(); ++m) {
    const auto n = std::ranges::count(body.mineral, static_cast<std::int32_t>(m));
    record.put(quantity::mineral_share, joined(minerals[m]),
               static_cast<double>(n) / static_cast<double>(body.mineral.size()));
  }
  for (const auto& [name, n] : groups) record.put(quantity::contact_share, name, n / all);
}

dem::Record start(const std::string& test, double aspect_ratio, const Body& body, const Options& options) {
  dem::Record record;
  record.model = "grain_texture";
  record.scenario = "ldb_aspect_ratio";
  record.case_id = fmt::format("{}_ar_{:g}", test, aspect_ratio);
  record.physics_version = "test";
  record.seed = 1;
  record.quantities = dem::texture::quantities();
  record.parameters = {{"test", test},          {"aspect_ratio", aspect_ratio}, {"dip", 0.0},
                       {"seed_scale", 0.669},   {"growth", "deepest_contact"},  {"between", "minerals"},
                       {"pressure_ratio", 0.01}};
  record.tables = {particles_table(body, options, aspect_ratio), grains_table(body, aspect_ratio),
                   contacts_table(body)};
  return record;
}

void finish(dem::Record& record, const Body& body, const CrackList& list) {
  std::array<double, 4> n{};
  for (std::size_t k = 0; k < list.mode.size(); ++k) ++n[static_cast<std::size_t>(2 * list.place[k] + list.mode[k])];
  for (std::size_t k = 0; k < 4; ++k) record.put(quantity::cracks[k], n[k]);
  add_shares(record, body);
  record.put(quantity::energy_residual, 2.2e-4);
  record.put(quantity::steps, 19900);
  record.put(quantity::particles, static_cast<double>(body.radius.size()));
  record.put(quantity::contacts, static_cast<double>(body.pairs.size()));
  record.put(quantity::grains, static_cast<double>(body.seed.size()));
  record.checks = {
      {"energy_residual", 2.2e-4, 1e-2, true, "The largest residual of the energy ledger over the work done."},
      {"equilibrium", 0.006, 0.02, true, "The forces on the two platens differ by no more than this share."}};
}

}  // namespace

dem::Record compression(double aspect_ratio, const Options& options) {
  const Body body = body_of(aspect_ratio, options);
  const Curve c{.modulus = 70e9,
                .peak = 1e6 * options.ucs_MPa * (1.02 - 0.02 * aspect_ratio),
                .peak_strain = 3.6e-3,
                .end_strain = 4.1e-3};
  const CrackList list = cracks_of(body, options, aspect_ratio, c.peak_strain);
  dem::Record record = start("compression", aspect_ratio, body, options);
  record.tables.push_back(cracks_table(list));
  record.tables.push_back(history_table(c, list, options));
  add_snapshots(record, c, list);
  record.put(quantity::young_modulus, 70.3);
  record.put(quantity::poisson_ratio, 0.166);
  record.put(quantity::compressive_strength, 1e-6 * c.peak);
  record.put(quantity::peak_strain, c.peak_strain);
  record.put(quantity::initiation_by_stiffness, 72.5);
  record.put(quantity::stress_at_strain, 69.7 - aspect_ratio);
  record.put(quantity::initiation_by_cracks, 81.0);
  record.put(quantity::crack_damage, 1e-6 * stress_at(c, 0.8 * c.peak_strain));
  record.put(quantity::crack_damage_strain, 0.8 * c.peak_strain);
  finish(record, body, list);
  return record;
}

dem::Record direct_tension(double aspect_ratio, const Options& options) {
  const Body body = body_of(aspect_ratio, options);
  const Curve c{.modulus = 55e9,
                .peak = 1e6 * options.ts_MPa * (1.03 - 0.03 * aspect_ratio),
                .peak_strain = 1.9e-4,
                .end_strain = 2.2e-4,
                .poisson = 0.12};
  CrackList list = cracks_of(body, options, aspect_ratio, c.peak_strain);
  dem::Record record = start("direct_tension", aspect_ratio, body, options);
  record.tables.push_back(cracks_table(list));
  record.tables.push_back(history_table(c, list, options));
  record.put(quantity::young_modulus, 52.1);
  record.put(quantity::tensile_strength, 1e-6 * c.peak);
  record.put(quantity::peak_strain, c.peak_strain);
  finish(record, body, list);
  return record;
}

dem::Scenario scenario(const std::filesystem::path& folder, const std::string& name, const std::string& more,
                       const std::string& scale) {
  const std::filesystem::path file = folder / (name + ".toml");
  dem::write_file(file,
                  "model = \"grain_texture\"\ntitle = \"Grains of aspect ratio 1, 2 and 3 in Lac du Bonnet granite\"\n"
                  "description = \"A made-up study for tests of the report.\"\nseed = 1\n"
                  "include = \"" DEM_SOURCE_DIR
                  "/scenarios/rocks/lac_du_bonnet.toml\"\n"
                  "tests = [\"compression\", \"direct_tension\"]\n" +
                      more +
                      "\n[specimen]\ndiameter = \"20 mm\"\nheight = \"40 mm\"\n[scales.draft]\n[scales.paper]\n");
  return dem::Scenario::read(file.string(), scale, {}, [](std::string_view) { return dem::texture::keys(); });
}

namespace {

// As the shipped scenario of this name.
const std::string figures =
    "[\"specimen\", \"grain_cluster\", \"progressive_failure\", \"crack_stages\", \"stress_strain\", \"crack_maps\", "
    "\"crack_counts\", \"group_shares\", \"energy_compression\", \"energy_tension\"]";

}  // namespace

Study::Study(const std::filesystem::path& folder, const Options& options)
    : scenario_(scenario(folder, "ldb_aspect_ratio", "published = [\"aspect_ratio\"]\nfigures = " + figures)) {
  for (const double aspect_ratio : {1.0, 2.0, 3.0}) records_.push_back(compression(aspect_ratio, options));
  for (const double aspect_ratio : {1.0, 2.0, 3.0}) records_.push_back(direct_tension(aspect_ratio, options));
}

reports::StudyResult study_of(const dem::Scenario& scenario, const std::vector<dem::Record>& records) {
  reports::StudyResult study{.scenario = &scenario,
                             .cases = {},
                             .quantities = dem::texture::quantities(),
                             .parameters = dem::texture::parameters()};
  for (const dem::Record& record : records) study.cases.push_back({record.case_id, record.parameters, &record, ""});
  return study;
}

reports::StudyResult Study::result() const {
  reports::StudyResult study = study_of(scenario_, records_);
  for (const auto& [id, error] : failures_) {
    reports::CaseResult& failed = *std::ranges::find(study.cases, id, &reports::CaseResult::id);
    failed.record = nullptr;
    failed.error = error;
  }
  return study;
}

dem::Record& Study::record(const std::string& id) { return *std::ranges::find(records_, id, &dem::Record::case_id); }

void Study::fail(const std::string& id, const std::string& error) { failures_.emplace_back(id, error); }

}  // namespace synthetic
