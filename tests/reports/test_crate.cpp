// ro-crate-metadata.json: the rules of RO-Crate 1.1 and of Process Run Crate 0.5 that such a file has to keep, written down from
// their texts, and what this program promises besides.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "reports/output/crate.h"
#include "reports/output/report.h"
#include "tests/reports/synthetic.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path assets = fs::path(DEM_SOURCE_DIR) / "assets";

render::Canvas& canvas() {
  static render::Canvas one;
  return one;
}

/// A report without its PDF, of one figure.
void make(const synthetic::Study& study, const fs::path& folder, const std::string& date) {
  reports::ReportOptions options;
  options.folder = folder;
  options.assets = assets;
  options.engine_version = "0.1.0";
  options.pdf = false;
  options.dpi = 72;
  options.only = "stress_strain";
  options.again.command = "./dem-report mine.toml --scale draft";
  options.date = [date] { return date; };
  reports::make_report(study.result(), options, canvas, {{"threads", 2.0}});
}

std::string text(const fs::path& folder) { return dem::read_file(folder / "ro-crate-metadata.json"); }

using Entities = std::map<std::string, Json>;

Entities entities(const Json& crate) {
  Entities all;
  for (const Json& one : crate.at("@graph")) CHECK(all.emplace(one.at("@id").get<std::string>(), one).second);
  return all;
}

std::vector<std::string> ids(const Json& links) {
  std::vector<std::string> all;
  for (const Json& one : links.is_array() ? links : Json::array({links}))
    all.push_back(one.at("@id").get<std::string>());
  return all;
}

/// "%20" -> " "
std::string decoded(const std::string& uri) {
  std::string all;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%') {
      all += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      all += uri[i];
    }
  }
  return all;
}

const synthetic::Options small{.diameter = 3e-3, .height = 6e-3, .samples = 5};
const std::string first_date = "2026-01-31T12:00:00+00:00", second_date = "2026-02-01T12:00:00+00:00";

/// Every link leads to an entity of the file; `of` an entity.
void check_links(const Json& of, const Entities& all) {
  if (of.is_object() && of.size() == 1 && of.contains("@id")) {
    CHECK((all.contains(of.at("@id")) || of.at("@id") == "https://w3id.org/ro/crate/1.1"));
  } else if (of.is_structured()) {
    for (const Json& part : of) check_links(part, all);
  }
}

void check_rules(const fs::path& folder) {
  const Json crate = Json::parse(text(folder));
  // JSON-LD, flattened and compacted: two keys, entities beside each other.
  CHECK(crate.size() == 2);
  CHECK(crate.at("@context").at(0) == "https://w3id.org/ro/crate/1.1/context");
  CHECK(crate["@context"].at(1).contains("sha256"));  // no term of that context
  const Entities all = entities(crate);
  for (const auto& [id, one] : all) {
    CAPTURE(id);
    CHECK(one.contains("@type"));
    check_links(one, all);
  }
  // The descriptor, and the root that it is about.
  const Json& descriptor = all.at("ro-crate-metadata.json");
  CHECK(descriptor.at("@type") == "CreativeWork");
  CHECK(ids(descriptor.at("conformsTo")) == std::vector<std::string>{"https://w3id.org/ro/crate/1.1"});
  CHECK(ids(descriptor.at("about")) == std::vector<std::string>{"./"});
  const Json& root = all.at("./");
  CHECK(root.at("@type") == "Dataset");
  for (const char* key : {"name", "description", "license"}) CHECK_FALSE(root.at(key).get<std::string>().empty());
  CHECK(std::regex_match(root.at("datePublished").get<std::string>(),
                         std::regex(R"(\d{4}-\d{2}-\d{2}T\d{2}:\d{2}:\d{2}\+00:00)")));
  // Data entities: relative URIs of files that are there, all of them parts of the root.
  const auto parts = ids(root.at("hasPart"));
  std::set<std::string> files;
  for (const auto& [id, one] : all) {
    if (one.at("@type") == "File") files.insert(id);
  }
  CHECK(std::set<std::string>(parts.begin(), parts.end()) == files);
  CHECK(parts.size() == files.size());
  for (const std::string& id : files) {
    CAPTURE(id);
    CHECK(std::regex_match(id, std::regex("[A-Za-z0-9._~%-]+(/[A-Za-z0-9._~%-]+)*")));
    const fs::path file = folder / decoded(id);
    REQUIRE(fs::exists(file));
    CHECK(all.at(id).contains("encodingFormat"));
    if (all.at(id).contains("sha256")) CHECK(all.at(id).at("sha256") == dem::sha256(dem::read_file(file)));
    if (all.at(id).contains("contentSize")) CHECK(all.at(id).at("contentSize") == std::to_string(fs::file_size(file)));
    CHECK((all.at(id).contains("sha256") || id == "run.json" || id.ends_with(".h5")));
  }
  // The profile.
  const auto profiles = ids(root.at("conformsTo"));
  REQUIRE(profiles == std::vector<std::string>{"https://w3id.org/ro/wfrun/process/0.5"});
  CHECK(all.at(profiles[0]).at("@type") == "CreativeWork");
  CHECK(all.at(profiles[0]).at("version") == "0.5");
  REQUIRE(ids(root.at("mentions")) == std::vector<std::string>{"#run"});
  const Json& run = all.at("#run");
  CHECK(run.at("@type") == "CreateAction");
  for (const char* key : {"name", "description"}) CHECK_FALSE(run.at(key).get<std::string>().empty());
  CHECK(run.at("endTime") == root.at("datePublished"));
  const Json& program = all.at(ids(run.at("instrument")).at(0));
  CHECK(program.at("@type") == "SoftwareApplication");
  CHECK(program.at("softwareVersion") == "0.1.0");
  CHECK_FALSE(program.contains("version"));  // one of the two
  for (const char* key : {"object", "result"}) {
    CHECK_FALSE(run.at(key).empty());
    for (const std::string& id : ids(run.at(key))) {
      CHECK((all.at(id).at("@type") == "File" || all.at(id).at("@type") == "PropertyValue"));
    }
  }
  const std::string status = run.at("actionStatus");
  CHECK((status == "http://schema.org/CompletedActionStatus" || status == "http://schema.org/FailedActionStatus"));
  CHECK(run.contains("error") == (status == "http://schema.org/FailedActionStatus"));
}

}  // namespace

TEST_CASE("a report folder is a crate: every file with its hash, the inputs beside it, and the run that made it") {
  const test::Scratch scratch;
  const synthetic::Study study(scratch.path(), small);
  const fs::path folder = scratch / "out";
  make(study, folder, first_date);
  check_rules(folder);
  const Entities all = entities(Json::parse(text(folder)));
  const fs::path scenario = study.result().scenario->file(), rock = study.result().scenario->included();
  CHECK(dem::read_file(folder / "inputs" / scenario.filename()) == dem::read_file(scenario));
  if (!rock.empty()) CHECK(dem::read_file(folder / "inputs/rocks" / rock.filename()) == dem::read_file(rock));
  CHECK(all.contains("inputs/" + scenario.filename().string()));
  for (const char* id : {"report.html", "summary.json", "run.json", "#seed", "#scale", "#physics-version"})
    CHECK(all.contains(id));
  const Json summary = Json::parse(dem::read_file(folder / "summary.json"));
  CHECK(all.at("#scenario-sha256").at("value") == summary.at("provenance").at("scenario_sha256"));
  for (const Json& figure : summary.at("figures")) {
    for (const Json& file : figure.at("files")) CHECK(all.contains(file));
  }
  // No path of this machine, and the date is the only thing that tells two runs apart.
  CHECK(text(folder).find(scratch.path().string()) == std::string::npos);
  make(study, scratch / "other", second_date);
  CHECK(std::regex_replace(text(scratch / "other"), std::regex("2026-02-01"), "2026-01-31") == text(folder));
}

TEST_CASE("the date stays while nothing else changes, and a file of before does not outlive what it describes") {
  const test::Scratch scratch;
  const synthetic::Study study(scratch.path(), small);
  const fs::path folder = scratch / "out";
  make(study, folder, first_date);
  const std::string first = text(folder);
  make(study, folder, second_date);
  CHECK(text(folder) == first);
  dem::write_file(folder / "ro-crate-metadata.json", first.substr(0, first.size() / 2));
  make(study, folder, second_date);
  CHECK(text(folder).find(second_date) != std::string::npos);
  CHECK(reports::take_crate(folder) == std::regex_replace(first, std::regex("2026-01-31"), "2026-02-01"));
  CHECK_FALSE(fs::exists(folder / "ro-crate-metadata.json"));
  CHECK(reports::take_crate(folder).empty());
}

TEST_CASE("a case that failed makes the run a failed one; names of files are URIs") {
  const test::Scratch scratch;
  synthetic::Study study(scratch.path(), small);
  study.fail("direct_tension_ar_3", "the solution blew up");
  const fs::path folder = scratch / "out";
  make(study, folder, first_date);
  check_rules(folder);
  const Json run = entities(Json::parse(text(folder))).at("#run");
  CHECK(run.at("actionStatus") == "http://schema.org/FailedActionStatus");
  CHECK(run.at("error") == "direct_tension_ar_3: the solution blew up");

  const dem::Scenario named = synthetic::scenario(scratch.path(), "two words ä");
  reports::StudyResult result = study.result();
  result.scenario = &named;
  reports::ReportOptions options;
  options.folder = scratch / "named";
  options.engine_version = "0.1.0";
  dem::make_folder(options.folder);
  reports::write_crate(result, {}, options, "", first_date);
  const Entities all = entities(Json::parse(text(options.folder)));
  CHECK(all.contains("inputs/two%20words%20%C3%A4.toml"));
  CHECK(fs::exists(options.folder / "inputs/two words ä.toml"));
}
