// Packing and seeds of a specimen, each kept by content: cases that differ in anything else share them.
#include <fmt/format.h>

#include <stdexcept>

#include "engine/core/hash.h"
#include "engine/store/store.h"
#include "engine/texture/genesis/specimen.h"

namespace dem::texture {
namespace {

// Raised whenever pack() or seed_grains() give other specimens for the same settings.
constexpr std::string_view genesis_version = "genesis 2";

std::string content_of(const PackingSettings& s) {
  return fmt::format(
      "{}\npacking\ndiameter = {}\nheight = {}\nradius_min = {}\nradius_ratio = {}\nmodulus = {}\n"
      "pressure = {}\nporosity = {}\nseed = {}\n",
      genesis_version, s.vessel.diameter, s.vessel.height, s.radius_min, s.radius_ratio, s.modulus, s.pressure,
      s.porosity, s.seed);
}

std::string content_of(const Cylinder& vessel, const std::vector<MineralGrains>& minerals, double seed_scale,
                       std::uint64_t seed) {
  std::string text = fmt::format("{}\ngrain seeds\ndiameter = {}\nheight = {}\nseed_scale = {}\nseed = {}\n",
                                 genesis_version, vessel.diameter, vessel.height, seed_scale, seed);
  for (const MineralGrains& m : minerals)
    text += fmt::format("mineral = {} {} {}\n", m.share, m.diameter_min, m.diameter_max);
  return text;
}

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) values.insert(values.end(), v.begin(), v.end());
  return values;
}

std::vector<Vec3> vectors(std::span<const double> values) {
  std::vector<Vec3> result(values.size() / 3);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return result;
}

std::vector<Table> tables_of(const Packing& packing) {
  Table particles{"particles", {}, {}};
  particles.add("position", "m", flat(packing.position), 3);
  particles.add("radius", "m", packing.radius);
  std::vector<std::int32_t> pairs;
  pairs.reserve(2 * packing.contacts.size());
  for (const auto& pair : packing.contacts) pairs.insert(pairs.end(), pair.begin(), pair.end());
  Table contacts{"contacts", {}, {}};
  contacts.add("pair", "", std::move(pairs), 2);
  Table state{"state", {}, {}};
  state.add("pressure", "Pa", std::vector<double>{packing.pressure});
  state.add("coordination", "1", std::vector<double>{packing.coordination});
  state.add("porosity", "1", std::vector<double>{packing.porosity});
  state.add("radius_scale", "1", std::vector<double>{packing.radius_scale});
  state.add("floaters_removed", "", std::vector<std::int32_t>{packing.floaters_removed});
  return {std::move(particles), std::move(contacts), std::move(state)};
}

void read_from(const TableFile& file, Packing& packing) {
  const Table& particles = file.table("particles");
  packing.position = vectors(particles.real("position"));
  const auto radius = particles.real("radius");
  packing.radius.assign(radius.begin(), radius.end());
  const auto pairs = file.table("contacts").integer("pair");
  packing.contacts.resize(pairs.size() / 2);
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) packing.contacts[k] = {pairs[2 * k], pairs[2 * k + 1]};
  const Table& state = file.table("state");
  packing.pressure = state.real("pressure")[0];
  packing.coordination = state.real("coordination")[0];
  packing.porosity = state.real("porosity")[0];
  packing.radius_scale = state.real("radius_scale")[0];
  packing.floaters_removed = state.integer("floaters_removed")[0];
}

std::vector<Table> tables_of(const GrainSeeds& seeds) {
  Table table{"seeds", {{"mineral", "index in the scenario's list of minerals"}}, {}};
  table.add("position", "m", flat(seeds.position), 3);
  table.add("radius", "m", seeds.radius);
  table.add("mineral", "", seeds.mineral);
  return {std::move(table)};
}

void read_from(const TableFile& file, GrainSeeds& seeds) {
  const Table& table = file.table("seeds");
  seeds.position = vectors(table.real("position"));
  const auto radius = table.real("radius");
  seeds.radius.assign(radius.begin(), radius.end());
  const auto mineral = table.integer("mineral");
  seeds.mineral.assign(mineral.begin(), mineral.end());
}

/// False when the file is missing, damaged or of other content: it is then made again, and a note says why.
template <class Part>
bool load(const std::filesystem::path& path, const std::string& content, Part& part, const RunContext& context) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return false;
  std::string why;
  try {
    const TableFile file = read_tables(path);
    if (file.attribute("content") == content) {
      read_from(file, part);
      return true;
    }
    why = path.string() + " belongs to another specimen";
  } catch (const EnvironmentError& failure) {
    why = failure.what();
  } catch (const std::out_of_range& missing) {
    why = path.string() + " is not whole: " + missing.what();
  }
  context.note("the specimen is made again: " + why);
  part = {};
  return false;
}

std::string file_of(const std::string& content) { return sha256(content).substr(0, 16) + ".h5"; }

template <class Make>
auto kept(const RunContext& context, const std::string& content, Make make) {
  using Part = decltype(make());
  if (context.specimens.empty()) return make();
  const std::filesystem::path path = context.specimens / file_of(content);
  const auto turn = context.turns ? context.turns->take(path) : std::unique_lock<std::mutex>();
  Part part;
  if (load(path, content, part, context)) return part;
  part = make();
  write_tables(path, {{"content", content}}, tables_of(part));
  return part;
}

}  // namespace

Genesis genesis(const PackingSettings& settings, const std::vector<MineralGrains>& minerals, double seed_scale,
                RunContext& context) {
  const Cylinder& vessel = settings.vessel;
  return {kept(context, content_of(settings), [&] { return pack(settings, context); }),
          kept(context, content_of(vessel, minerals, seed_scale, settings.seed),
               [&] { return seed_grains(vessel, minerals, seed_scale, settings.seed, context); })};
}

std::vector<std::string> genesis_files(const PackingSettings& settings, const std::vector<MineralGrains>& minerals,
                                       double seed_scale) {
  return {file_of(content_of(settings)), file_of(content_of(settings.vessel, minerals, seed_scale, settings.seed))};
}

}  // namespace dem::texture
