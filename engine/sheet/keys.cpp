#include "engine/sheet/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem::sheet {
namespace {

std::vector<Key> declare() {
  return {
      {.path = "sheet.columns",
       .type = KeyType::integer,
       .low = 10,
       .high = 2000,
       .standard = "50",
       .affects = Affects::specimen,
       .help = "particles in a row; the box is 1 wide, a particle's radius 0.5/columns"},
      {.path = "sheet.rows",
       .type = KeyType::integer,
       .low = 0,
       .high = 4000,
       .standard = "0",
       .affects = Affects::specimen,
       .help = "rows of particles; 0: as many as make the box nearest to square"},
      {.path = "sheet.wall_weight",
       .low = 0.1,
       .high = 1,
       .standard = "1.0",
       .affects = Affects::specimen,
       .help = "factor on k of springs along walls; 0.5 makes the sheet a cut of an infinite one"},
      {.path = "grains.source",
       .type = KeyType::text,
       .choices = {"voronoi", "layers", "file"},
       .standard = "\"voronoi\"",
       .affects = Affects::specimen,
       .help = "grow seeded grains, lay bands, or read an Elle file"},
      {.path = "grains.file",
       .type = KeyType::text,
       .form = Form::path,
       .standard = "\"\"",
       .affects = Affects::specimen,
       .help = "Elle file for source \"file\", relative to the scenario's folder"},
      {.path = "grains.count",
       .type = KeyType::integer,
       .low = 4,
       .high = 100000,
       .standard = "30",
       .affects = Affects::specimen,
       .help = "number of grown grains"},
      {.path = "grains.lloyd",
       .type = KeyType::integer,
       .low = 0,
       .high = 100,
       .standard = "2",
       .affects = Affects::specimen,
       .help = "steps that even out the grown grains"},
      {.path = "grains.periodic",
       .type = KeyType::boolean,
       .standard = "true",
       .affects = Affects::specimen,
       .help = "grown grains go on over the box's edge, as in Elle"},
      {.path = "grains.layer_low",
       .low = 0,
       .high = 1,
       .standard = "0.45",
       .affects = Affects::specimen,
       .help = "lower edge of the layer, share of the height"},
      {.path = "grains.layer_high",
       .low = 0,
       .high = 1,
       .standard = "0.55",
       .affects = Affects::specimen,
       .help = "upper edge of the layer, share of the height"},
      {.path = "grains.layer_grains",
       .type = KeyType::integer,
       .low = 1,
       .high = 100000,
       .standard = "1",
       .affects = Affects::specimen,
       .help = "grains that the layer is grown of, cut at its edges"},
      {.path = "grains.expanding",
       .type = KeyType::integer,
       .low = 0,
       .high = 10000,
       .standard = "0",
       .affects = Affects::specimen,
       .help = "grown grains inside the box that are marked EXPAND 1, drawn at random"},
      {.path = "grains.expanding_mineral",
       .type = KeyType::text,
       .standard = "\"GARNET\"",
       .affects = Affects::specimen,
       .help = "MINERAL of those grains; all others are MATRIX"},
      {.path = "rule[].attribute",
       .type = KeyType::text,
       .affects = Affects::specimen,
       .help = "attribute of the grain map, like MINERAL"},
      {.path = "rule[].value",
       .type = KeyType::text,
       .affects = Affects::specimen,
       .help = "grains with this value follow the rule"},
      {.path = "rule[].stiffness",
       .low = 1e-6,
       .high = 1e6,
       .standard = "1.0",
       .affects = Affects::specimen,
       .help = "factor on the elastic constant of those grains"},
      {.path = "rule[].strength",
       .low = 1e-6,
       .high = 1e6,
       .standard = "1.0",
       .affects = Affects::specimen,
       .help = "factor on the breaking thresholds inside them"},
      {.path = "rule[].growth",
       .low = 0,
       .high = 0.1,
       .standard = "0.0",
       .affects = Affects::specimen,
       .help = "of their radii in a step of growth, as a share (0.002)"},
      {.path = "disorder.stiffness",
       .low = 1e-6,
       .high = 1e6,
       .standard = "1.0",
       .affects = Affects::specimen,
       .help = "mean elastic constant k; 1 stands for 10 GPa"},
      {.path = "disorder.stiffness_sd",
       .low = 0,
       .high = 0.6,
       .standard = "0.25",
       .affects = Affects::specimen,
       .help = "standard deviation of k over grains (Gauss), share of the mean"},
      {.path = "disorder.strength",
       .low = 1e-9,
       .high = 1e3,
       .standard = "0.006",
       .affects = Affects::specimen,
       .help = "mean breaking stress k (d - l)/l inside grains"},
      {.path = "disorder.spread",
       .low = 0,
       .high = 0.999,
       .standard = "0.6",
       .affects = Affects::specimen,
       .help = "thresholds are uniform in strength (1 - spread ... 1 + spread)"},
      {.path = "disorder.boundary",
       .low = 1e-6,
       .high = 1,
       .standard = "0.5",
       .affects = Affects::specimen,
       .help = "factor on thresholds of springs between grains"},
      {.path = "loading.kind",
       .type = KeyType::text,
       .choices = {"pure_shear", "extension", "compression", "growth"},
       .affects = Affects::test,
       .help = "shorten along y and keep the area; lengthen or shorten along x; grow marked grains"},
      {.path = "loading.step",
       .low = 1e-9,
       .high = 0.05,
       .standard = "0.001",
       .affects = Affects::test,
       .help = "strain of a load step"},
      {.path = "loading.steps",
       .type = KeyType::integer,
       .low = 1,
       .high = 100000,
       .standard = "10",
       .affects = Affects::test,
       .help = "load steps at most"},
      {.path = "loading.most_breaks",
       .type = KeyType::integer,
       .low = 0,
       .high = 1e9,
       .standard = "0",
       .affects = Affects::test,
       .help = "ends the run after so many broken springs; 0: no limit"},
      {.path = "loading.stop_share",
       .low = 0,
       .high = 1,
       .standard = "0.0",
       .affects = Affects::test,
       .help =
           "ends the run at the break by which the differential stress falls below this share of its peak; 0: never"},
      {.path = "loading.substeps",
       .type = KeyType::integer,
       .low = 1,
       .high = 1000,
       .standard = "4",
       .affects = Affects::test,

       .help = "parts of a load step once springs are broken, for the work done"},
      {.path = "loading.work_tolerance",
       .low = 0,
       .high = 1,
       .standard = "3e-6",
       .affects = Affects::test,
       .when = {"converged"},
       .help = "converged: a part whose energies disagree by more than this share of all work is halved; 0: never"},
      {.path = "loading.snapshots",
       .type = KeyType::reals,
       .low = 0,
       .high = 10,
       .standard = "[]",
       .affects = Affects::test,
       .help = "strains at which fields are kept; the end is always kept"},
      {.path = "solvers",
       .type = KeyType::texts,
       .choices = {"converged", "historical"},
       .standard = "[\"converged\"]",
       .affects = Affects::cases,
       .help = "a case for each"},
      {.path = "solver.tolerance",
       .low = 1e-13,
       .high = 1e-2,
       .standard = "1e-8",
       .affects = Affects::test,
       .when = {"converged"},
       .help = "converged: largest unbalanced over largest spring force"},
      {.path = "historical.relaxation",
       .low = 0.01,
       .high = 1.99,
       .standard = "0.9",
       .affects = Affects::test,
       .when = {"historical"},
       .help = "historical: share of (sum F)/(sum k) that a particle moves"},
      {.path = "historical.stop",
       .low = 1e-15,
       .high = 1,
       .standard = "1.4e-7",
       .affects = Affects::test,
       .when = {"historical"},
       .help = "historical: largest move that counts as equilibrium, box widths"},
      {.path = "sweep.spread",
       .type = KeyType::reals,
       .low = 0,
       .high = 0.999,
       .standard = "[]",
       .affects = Affects::cases,
       .help = "a case for each spread of the thresholds; empty: disorder.spread"},
  };
}

}  // namespace

std::span<const Key> keys() {
  static const std::vector<Key> declared = declare();
  return declared;
}

Settings read_settings(const Scenario& s) {
  Settings r;
  r.seed = s.seed();
  r.columns = static_cast<int>(s.integer("sheet.columns"));
  r.rows = static_cast<int>(s.integer("sheet.rows"));
  if (r.rows == 1) throw s.error("sheet.rows", "one row is no sheet", "write 2 or more, or 0 for a square box");
  r.wall_weight = s.real("sheet.wall_weight");
  r.source = s.text("grains.source");
  const std::string& file = s.text("grains.file");
  if (r.source == "file") {
    if (file.empty()) throw s.error("grains.file", "no Elle file is named", "source \"file\" reads one: give its path");
    r.file = file_beside(s.file(), file);
  } else if (!file.empty()) {
    throw s.error("grains.file", "an Elle file is named, but the source is \"" + r.source + "\"",
                  "write grains.source = \"file\" to read it");
  }
  r.voronoi.grains = static_cast<int>(s.integer("grains.count"));
  r.voronoi.lloyd = static_cast<int>(s.integer("grains.lloyd"));
  r.voronoi.periodic = s.boolean("grains.periodic");
  r.voronoi.seed = r.seed;
  r.layer_low = s.real("grains.layer_low");
  r.layer_high = s.real("grains.layer_high");
  if (r.source == "layers" && !(r.layer_low > 0 && r.layer_low < r.layer_high && r.layer_high < 1)) {
    throw s.error("grains.layer_high", fmt::format("the layer goes from {:g} to {:g}", r.layer_low, r.layer_high),
                  "its edges rise and lie inside 0 ... 1");
  }
  r.layer_grains = static_cast<int>(s.integer("grains.layer_grains"));
  if (r.layer_grains > 1 && r.source != "layers") {
    throw s.error("grains.layer_grains", "there is no layer with source \"" + r.source + "\"",
                  "write grains.source = \"layers\", or grains.count for grown grains");
  }
  r.expanding = static_cast<int>(s.integer("grains.expanding"));
  r.expanding_mineral = s.text("grains.expanding_mineral");
  for (std::size_t i = 0; i < s.count("rule"); ++i) {
    const auto key = [i](const char* name) { return fmt::format("rule[{}].{}", i, name); };
    r.rules.push_back({s.text(key("attribute")),
                       s.text(key("value")),
                       {s.real(key("stiffness")), s.real(key("strength")), 1 + s.real(key("growth"))}});
  }
  r.disorder.stiffness = s.real("disorder.stiffness");
  r.disorder.stiffness_sd = s.real("disorder.stiffness_sd");
  r.disorder.strength = s.real("disorder.strength");
  r.disorder.strength_spread = s.real("disorder.spread");
  r.disorder.boundary = s.real("disorder.boundary");
  const std::string& kind = s.text("loading.kind");
  r.loading.kind = kind == "pure_shear"    ? LoadingKind::pure_shear
                   : kind == "extension"   ? LoadingKind::extension
                   : kind == "compression" ? LoadingKind::compression
                                           : LoadingKind::growth;
  r.loading.step = s.real("loading.step");
  r.loading.steps = static_cast<int>(s.integer("loading.steps"));
  if (s.integer("loading.most_breaks") > 0) r.loading.most_breaks = static_cast<int>(s.integer("loading.most_breaks"));
  r.loading.stop_share = s.real("loading.stop_share");
  r.loading.substeps = static_cast<int>(s.integer("loading.substeps"));
  r.snapshots = s.reals("loading.snapshots");
  if (!std::is_sorted(r.snapshots.begin(), r.snapshots.end())) {
    throw s.error("loading.snapshots", "the strains do not rise", "list them in rising order");
  }
  if (s.texts("solvers").empty()) throw s.error("solvers", "no solver is named", "write [\"converged\"]");
  r.solver = s.texts("solvers").front();
  if (r.solver == "converged") r.loading.work_tolerance = s.real("loading.work_tolerance");
  r.converged.tolerance = s.real("solver.tolerance");
  r.historical.relaxation = s.real("historical.relaxation");
  r.historical.stop = s.real("historical.stop");
  if (r.loading.kind == LoadingKind::growth) {
    const bool grows =
        std::any_of(r.rules.begin(), r.rules.end(), [](const auto& rule) { return rule.properties.growth > 1; });
    r.loading.step = 0;
    for (const auto& rule : r.rules) r.loading.step = std::max(r.loading.step, rule.properties.growth - 1);
    if (!grows) {
      throw s.error("loading.kind", "no grain grows", "give a [[rule]] with growth for the grains that should");
    }
  }
  return r;
}

std::vector<GrainProperties> properties_of(const ElleMap& map, const std::vector<Settings::Rule>& rules) {
  std::vector<GrainProperties> result(map.flynns.size());
  for (std::size_t f = 0; f < result.size(); ++f) {
    for (const auto& rule : rules) {
      if (map.attribute(rule.attribute, f) != rule.value) continue;
      result[f].stiffness *= rule.properties.stiffness;
      result[f].strength *= rule.properties.strength;
      result[f].growth *= rule.properties.growth;
    }
  }
  return result;
}

namespace {

ElleMap grown_map(const Settings& settings, const Sheet& sheet) {
  const double height = 2 * sheet.radius0 + sheet.y.back() - sheet.y.front();
  if (settings.source == "layers") {
    VoronoiSettings layer = settings.voronoi;
    layer.grains = settings.layer_grains;
    return layered_map(height, settings.layer_low * height, settings.layer_high * height, layer);
  }
  VoronoiSettings voronoi = settings.voronoi;
  voronoi.height = height;
  ElleMap map = voronoi_map(voronoi);
  if (settings.expanding > 0) mark_expanding(map, settings.expanding, settings.expanding_mineral, settings.seed);
  return map;
}

}  // namespace

Specimen make_specimen(const Settings& settings) {
  Specimen made;
  int rows = settings.rows;
  if (settings.source == "file") {
    made.map = read_elle(settings.file);
    const double aspect = (made.map.high[1] - made.map.low[1]) / (made.map.high[0] - made.map.low[0]);
    if (rows == 0)
      rows = std::max(2, static_cast<int>(std::lround(aspect * settings.columns * 2 / std::numbers::sqrt3)));
  }
  made.sheet = make_sheet(settings.columns, rows, settings.wall_weight);
  if (settings.source != "file") made.map = grown_map(settings, made.sheet);
  made.cover = cover(made.map, made.sheet);
  made.grains = properties_of(made.map, settings.rules);
  apply_disorder(made.sheet, made.cover, made.grains, settings.disorder, settings.seed);
  made.grows.reserve(made.cover.flynn.size());
  for (const auto f : made.cover.flynn) made.grows.push_back(made.grains[static_cast<std::size_t>(f)].growth - 1);
  return made;
}

}  // namespace dem::sheet
