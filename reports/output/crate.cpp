#include "reports/output/crate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "reports/provenance.h"

namespace reports {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* file_name = "ro-crate-metadata.json";
constexpr const char* crate_version = "https://w3id.org/ro/crate/1.1";
constexpr const char* profile = "https://w3id.org/ro/wfrun/process/0.5";

Json link(const std::string& id) { return {{"@id", id}}; }

/// A path as the relative URI that RO-Crate wants.
std::string uri(const fs::path& path) {
  std::string all;
  for (const unsigned char c : path.generic_string()) {
    const bool plain = (c < 0x80 && std::isalnum(c) != 0) ||
                       std::string_view("-._~/").find(static_cast<char>(c)) != std::string_view::npos;
    all += plain ? std::string(1, static_cast<char>(c)) : fmt::format("%{:02X}", c);
  }
  return all;
}

std::string media_type(const fs::path& path) {
  constexpr std::array<std::pair<std::string_view, const char*>, 9> known = {{{".html", "text/html"},
                                                                              {".pdf", "application/pdf"},
                                                                              {".json", "application/json"},
                                                                              {".png", "image/png"},
                                                                              {".svg", "image/svg+xml"},
                                                                              {".csv", "text/csv"},
                                                                              {".toml", "application/toml"},
                                                                              {".h5", "application/x-hdf5"},
                                                                              {".elle", "text/plain"}}};
  const std::string extension = path.extension().string();
  const auto at =
      std::ranges::find(known, std::string_view(extension), &std::pair<std::string_view, const char*>::first);
  return at == known.end() ? "application/octet-stream" : at->second;
}

/// The graph as it grows: entities, and the files that lie in the crate.
class Crate {
 public:
  explicit Crate(fs::path folder) : folder_(std::move(folder)) {}

  /// A file that is there; its hash when it is the same for every run. What is not there is left out.
  void file(const fs::path& path, const std::string& name, Json& list, bool stable = true) {
    std::error_code error;
    if (!fs::is_regular_file(folder_ / path, error) || !known_.insert(path).second) return;
    Json entity = {{"@id", uri(path)}, {"@type", "File"}, {"name", name}, {"encodingFormat", media_type(path)}};
    if (stable) {
      entity["contentSize"] = std::to_string(fs::file_size(folder_ / path));
      // Records may be large, and carry what they depend on inside.
      if (path.extension() != ".h5") entity["sha256"] = dem::sha256(dem::read_file(folder_ / path));
    }
    files_.push_back(std::move(entity));
    list.push_back(link(uri(path)));
  }

  /// A value that the run was given.
  void value(const std::string& id, const std::string& name, Json value, Json& list) {
    values_.push_back({{"@id", "#" + id}, {"@type", "PropertyValue"}, {"name", name}, {"value", std::move(value)}});
    list.push_back(link("#" + id));
  }

  [[nodiscard]] const Json& files() const { return files_; }
  [[nodiscard]] const Json& values() const { return values_; }

 private:
  fs::path folder_;
  std::set<fs::path> known_;
  Json files_ = Json::array(), values_ = Json::array();
};

/// Scenario, rock and map below `inputs`, so that the scenario finds the two where they lie beside it by habit.
Json inputs(const StudyResult& study, const ReportOptions& options, Crate& crate) {
  const dem::Scenario& scenario = *study.scenario;
  const fs::path map = scenario.declares("grains.file") ? fs::path(scenario.text("grains.file")) : fs::path();
  struct Input {
    fs::path from, to;
    const char* name;
  };
  const fs::path below = "inputs";
  std::vector<Input> all = {{scenario.file(), below / fs::path(scenario.file()).filename(), "Scenario"}};
  if (!scenario.included().empty())
    all.push_back({scenario.included(), below / "rocks" / fs::path(scenario.included()).filename(), "Rock"});
  if (!map.empty())
    all.push_back({fs::path(scenario.file()).parent_path() / map, below / map.filename(), "Map of the grains"});
  Json list = Json::array();
  for (const Input& one : all) {
    std::error_code error;
    if (!fs::is_regular_file(one.from, error)) continue;
    dem::write_file(options.folder / one.to, dem::read_file(one.from));
    crate.file(one.to, one.name, list);
  }
  return list;
}

Json results(const StudyResult& study, const std::vector<DrawnFigure>& figures, Crate& crate) {
  Json list = Json::array();
  crate.file("report.html", "Report", list);
  crate.file("report.pdf", "Report, printed", list);
  crate.file("summary.json", "Results, verdicts and checks", list);
  crate.file("comparison.html", "What changed since the reference", list);
  crate.file("comparison.json", "What changed since the reference, for programs", list);
  for (const DrawnFigure& figure : figures) {
    for (const std::string& file : figure.files) crate.file(file, std::string(figure.figure->title), list);
  }
  for (const CaseResult& one : study.cases) {
    crate.file(fs::path("cases") / one.id / "results.h5", "Record of the case " + one.id, list);
  }
  crate.file("run.json", "What varies from run to run", list, false);
  return list;
}

/// "case_1: it blew up; case_2: ..."; "": every case has its record.
std::string failures(const StudyResult& study) {
  std::string all;
  for (const CaseResult& one : study.cases) {
    if (!one.record) all += (all.empty() ? "" : "; ") + one.id + ": " + one.error;
  }
  return all;
}

/// All but the two dates, which are empty.
Json crate_json(const StudyResult& study, const std::vector<DrawnFigure>& figures, const ReportOptions& options) {
  const dem::Scenario& scenario = *study.scenario;
  const Provenance origin = provenance_of(study, options.engine_version);
  Crate crate(options.folder);
  Json given = inputs(study, options, crate);
  crate.value("scale", "scale", scenario.scale(), given);
  crate.value("seed", "seed", std::to_string(origin.seed), given);
  crate.value("scenario-sha256", "SHA-256 of all values of the scenario but names of files", origin.scenario_sha256,
              given);
  if (!origin.physics_version.empty()) crate.value("physics-version", "physics version", origin.physics_version, given);
  const Json made = results(study, figures, crate);
  Json parts = Json::array();
  for (const Json& file : crate.files()) parts.push_back(link(file.at("@id")));

  const std::string title = scenario.text("title").empty() ? scenario.name() : scenario.text("title");
  const std::string error = failures(study);
  Json run = {{"@id", "#run"},
              {"@type", "CreateAction"},
              {"name", "Run of dem-report"},
              {"description", options.again.command},
              {"instrument", link("#dem-report")},
              {"object", given},
              {"result", made},
              {"endTime", ""},
              {"actionStatus",
               error.empty() ? "http://schema.org/CompletedActionStatus" : "http://schema.org/FailedActionStatus"}};
  if (!error.empty()) run["error"] = error;

  Json graph = Json::array();
  graph.push_back(
      {{"@id", file_name}, {"@type", "CreativeWork"}, {"conformsTo", link(crate_version)}, {"about", link("./")}});
  graph.push_back({{"@id", "./"},
                   {"@type", "Dataset"},
                   {"name", fmt::format("{} ({}, scale {})", title, scenario.name(), scenario.scale())},
                   {"description", scenario.text("description").empty() ? "Report of a discrete element study"
                                                                        : scenario.text("description")},
                   {"datePublished", ""},
                   {"license", "Not stated: it is for those to say who made the run."},
                   {"conformsTo", Json::array({link(profile)})},
                   {"hasPart", parts},
                   {"mentions", Json::array({link("#run")})}});
  graph.push_back({{"@id", profile}, {"@type", "CreativeWork"}, {"name", "Process Run Crate"}, {"version", "0.5"}});
  graph.push_back({{"@id", "#dem-report"},
                   {"@type", "SoftwareApplication"},
                   {"name", "dem-report"},
                   {"description", "Discrete element studies of brittle rock"},
                   {"softwareVersion", origin.engine_version}});
  graph.push_back(std::move(run));
  for (const Json& entity : crate.values()) graph.push_back(entity);
  for (const Json& entity : crate.files()) graph.push_back(entity);
  return {{"@context", Json::array({std::string(crate_version) + "/context",
                                    Json{{"sha256", "https://w3id.org/ro/terms/workflow-run#sha256"}}})},
          {"@graph", graph}};
}

void set_dates(Json& crate, const std::string& date) {
  for (Json& entity : crate.at("@graph")) {
    for (const char* key : {"datePublished", "endTime"}) {
      if (entity.contains(key)) entity[key] = date;
    }
  }
}

/// The date of an earlier crate that differs from `crate` in nothing else; "": there is none.
std::string date_of_same(const std::string& earlier, const Json& crate) {
  try {
    Json other = Json::parse(earlier);
    const std::string date = other.at("@graph").at(1).at("datePublished").get<std::string>();
    set_dates(other, "");
    return other == crate ? date : "";
  } catch (const Json::exception&) {
    return {};
  }
}

}  // namespace

std::string take_crate(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(folder / file_name, error)) return {};
  std::string text = dem::read_file(folder / file_name);
  fs::remove(folder / file_name, error);
  return text;
}

void write_crate(const StudyResult& study, const std::vector<DrawnFigure>& figures, const ReportOptions& options,
                 const std::string& earlier, const std::string& date) {
  Json crate = crate_json(study, figures, options);
  const std::string kept = date_of_same(earlier, crate);
  set_dates(crate, kept.empty() ? date : kept);
  dem::write_file(options.folder / file_name, crate.dump(2) + "\n");
}

}  // namespace reports
