#include "engine/sheet/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "engine/model/case.h"
#include "engine/scenario/suggest.h"

namespace dem::sheet {
namespace {

constexpr int most_rows = 4000;

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
       .high = most_rows,
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
       .high = 20000,
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
       .high = 20000,
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
       .help = "attribute of the grain map, like MINERAL, AGE.CYCLE (a column), CONC_A (of unodes)"},
      {.path = "rule[].value",
       .type = KeyType::text,
       .affects = Affects::specimen,
       .help = "grains (or particles nearest to unodes) with this value follow the rule; numbers in any form"},
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
      {.path = "strength.scaling",
       .type = KeyType::text,
       .choices = {"spring", "toughness"},
       .standard = "\"spring\"",
       .affects = Affects::specimen,
       .help =
           "thresholds as they are for every particle size, or times the root of sheet.columns over strength.columns"},
      {.path = "strength.columns",
       .type = KeyType::integer,
       .low = 10,
       .high = 2000,
       .standard = "400",
       .affects = Affects::specimen,
       .help = "toughness: the particles in a row at which thresholds are those of disorder.strength"},
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
      repeats_key(),
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
  if (s.text("strength.scaling") == "toughness") {
    r.disorder.strength *= toughness_factor(r.columns, static_cast<int>(s.integer("strength.columns")));
  } else if (s.given("strength.columns")) {
    throw s.error("strength.columns", "it changes nothing with strength.scaling = \"spring\"",
                  "leave it out, or write strength.scaling = \"toughness\"");
  }
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
  if (std::adjacent_find(r.snapshots.begin(), r.snapshots.end(), std::greater_equal<>()) != r.snapshots.end()) {
    throw s.error("loading.snapshots", "the strains do not rise", "list them in rising order, each once");
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
  const double end = r.loading.steps * r.loading.step;
  if (!r.snapshots.empty() && r.snapshots.back() > end * (1 + 1e-9)) {
    throw s.error("loading.snapshots",
                  fmt::format("the loading ends at a strain of {:g} ({} steps of {:g}), before the snapshot at {:g}",
                              end, r.loading.steps, r.loading.step, r.snapshots.back()),
                  "lower the strain or raise loading.steps; the end is always kept");
  }
  return r;
}

RuleError::RuleError(std::size_t which, std::string name, const std::string& what, std::string right)
    : InputError({}, fmt::format("rule[{}].{}", which, name), what, std::move(right)),
      rule(which),
      key(std::move(name)),
      wrong(what) {}

namespace {

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

// Numbers are the same however they are written: Elle writes 1.00000000e+00.
bool follows(const std::string& value, const std::string& wanted) {
  if (value == wanted) return true;
  const auto a = number_of(value), b = number_of(wanted);
  return a && b && *a == *b;
}

// "QUARTZ, GARNET"; of many numbers their range.
std::string listed(const std::set<std::string>& values) {
  if (values.size() <= 12) return fmt::format("{}", fmt::join(values, ", "));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::string& value : values) {
    const auto number = number_of(value);
    if (!number) return fmt::format("{}, ... ({} values)", *values.begin(), values.size());
    low = std::min(low, *number), high = std::max(high, *number);
  }
  return fmt::format("{} numbers from {} to {}", values.size(), low, high);
}

std::string nearest(const std::string& wanted, const std::set<std::string>& values) {
  const auto capitals = [](std::string text) {
    for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return text;
  };
  for (const std::string& value : values) {
    if (capitals(value) == capitals(wanted)) return value;
  }
  return closest(wanted, std::vector<std::string>(values.begin(), values.end()));
}

[[noreturn]] void no_such(std::size_t rule, const char* key, const std::string& wanted, const std::string& wrong,
                          const std::set<std::string>& known, const std::string& has) {
  const std::string near = number_of(wanted) ? "" : nearest(wanted, known);
  throw RuleError(rule, key, wrong, (near.empty() ? "" : "did you mean '" + near + "'? ") + has + listed(known));
}

// Multiplies the properties of those of `ids` that follow a rule; of flynns or of unodes.
bool apply_rules(const ElleMap& map, const std::vector<Settings::Rule>& rules, bool unodes, const std::vector<int>& ids,
                 std::vector<GrainProperties>& result) {
  bool any = false;
  for (std::size_t r = 0; r < rules.size(); ++r) {
    const Settings::Rule& rule = rules[r];
    const ElleColumn column = map.find(rule.attribute);
    const std::string source = map.source.empty() ? "the grown map" : map.source;
    if (!column) {
      const auto names = map.attribute_names();
      const std::set<std::string> known(names.begin(), names.end());
      const std::string wrong = fmt::format("{} has no attribute '{}'", source, rule.attribute);
      if (known.empty())
        throw RuleError(r, "attribute", wrong,
                        "it has none at all: set grains.expanding for grains that are marked, or leave the rule out");
      no_such(r, "attribute", rule.attribute, wrong, known, "its attributes are ");
    }
    if (column.section->of_unodes != unodes) continue;
    any = true;
    const std::map<int, std::string> values(column.section->values.begin(), column.section->values.end());
    std::set<std::string> known;
    bool followed = false;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto own = values.find(ids[i]);
      const std::string value = column.part(own == values.end() ? column.section->standard : own->second);
      if (!value.empty()) known.insert(value);
      if (!follows(value, rule.value)) continue;
      followed = true;
      result[i].stiffness *= rule.properties.stiffness;
      result[i].strength *= rule.properties.strength;
      result[i].growth *= rule.properties.growth;
    }
    if (followed) continue;
    const char* const what = unodes ? "unode" : "grain";
    no_such(r, "value", rule.value, fmt::format("no {} of {} has {} '{}'", what, source, rule.attribute, rule.value),
            known, "its values are ");
  }
  return any;
}

}  // namespace

std::vector<GrainProperties> properties_of(const ElleMap& map, const std::vector<Settings::Rule>& rules) {
  std::vector<GrainProperties> result(map.flynns.size());
  std::vector<int> ids;
  for (const ElleFlynn& flynn : map.flynns) ids.push_back(flynn.id);
  (void)apply_rules(map, rules, false, ids, result);
  return result;
}

std::vector<GrainProperties> unode_properties_of(const ElleMap& map, const std::vector<Settings::Rule>& rules) {
  std::vector<GrainProperties> result(map.unodes.size());
  std::vector<int> ids;
  for (const ElleNode& unode : map.unodes) ids.push_back(unode.id);
  if (!apply_rules(map, rules, true, ids, result)) result.clear();
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

namespace {

// Rows of particles that make the sheet as high as the cell.
int rows_of(const ElleMap& map, const Settings& settings) {
  const double width = map.high[0] - map.low[0], height = map.high[1] - map.low[1];
  const double rows = height / width * settings.columns * 2 / std::numbers::sqrt3;
  const auto refuse = [&](const std::string& wrong, const char* right) {
    throw InputError({map.source, map.box_line, 0}, "CellBoundingBox",
                     fmt::format("the cell is {:g} wide and {:g} high: {}", width, height, wrong), right);
  };
  if (settings.rows > 0) {
    if (settings.rows > 2 * rows + 2)
      refuse(fmt::format("{} rows of particles would lay it {:.3g} times over each other", settings.rows,
                         settings.rows / rows),
             "leave sheet.rows at 0 for a sheet as high as the cell");
    return settings.rows;
  }
  if (rows > most_rows)
    refuse(fmt::format("{:.3g} rows of particles, and {} are the most", rows, most_rows),
           "lower sheet.columns, or take a map of a lower cell");
  if (rows < 1.5) refuse(fmt::format("{:.2g} rows of particles, no sheet", rows), "raise sheet.columns");
  return std::max(2, static_cast<int>(std::lround(rows)));
}

}  // namespace

Specimen make_specimen(const Settings& settings) {
  Specimen made;
  int rows = settings.rows;
  if (settings.source == "file") {
    made.map = read_elle(settings.file);
    rows = rows_of(made.map, settings);
  }
  made.sheet = make_sheet(settings.columns, rows, settings.wall_weight);
  if (settings.source != "file") made.map = grown_map(settings, made.sheet);
  made.grains = properties_of(made.map, settings.rules);
  const std::vector<GrainProperties> unodes = unode_properties_of(made.map, settings.rules);
  made.cover = cover(made.map, made.sheet);
  std::vector<GrainProperties> particles;
  if (!unodes.empty()) {
    for (const auto u : nearest_unodes(made.map, made.sheet)) particles.push_back(unodes[static_cast<std::size_t>(u)]);
  } else if (!made.map.unodes.empty()) {
    made.map.notes.push_back(fmt::format("No rule is about the {} unodes of {}: they are left out.",
                                         made.map.unodes.size(), made.map.source));
  }
  apply_disorder(made.sheet, made.cover, made.grains, settings.disorder, settings.seed, particles);
  made.grows.reserve(made.cover.flynn.size());
  for (std::size_t i = 0; i < made.cover.flynn.size(); ++i) {
    const double grain = made.grains[static_cast<std::size_t>(made.cover.flynn[i])].growth;
    made.grows.push_back((particles.empty() ? grain : grain * particles[i].growth) - 1);
  }
  return made;
}

}  // namespace dem::sheet
