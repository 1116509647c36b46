#include "reports/cluster/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "engine/core/text.h"
#include "reports/cluster/estimate.h"

namespace cluster {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t largest_manifest = std::uint64_t{256} << 20;

void check_text(const std::string& text) {
  if (dem::is_utf8(text)) return;
  throw dem::InputError("the name '" + dem::printable(text) + "' is not UTF-8, and a plan cannot carry it",
                        "give the file or folder another name");
}

Json json_of(const Line& line) {
  check_text(line.source.folder);
  check_text(line.source.scenario);
  for (const std::string& override : line.source.overrides) check_text(override);
  return {{"study", line.study},
          {"case", line.case_id},
          {"content", line.content},
          {"seconds", std::round(line.seconds * 1000) / 1000},
          {"seconds_from", line.seconds_from},
          {"memory_mib", line.memory >> 20},
          {"threads", line.threads},
          {"specimens", line.specimens},
          {"scenario", line.source.scenario},
          {"scale", line.source.scale},
          {"set", line.source.overrides},
          {"folder", line.source.folder}};
}

Line line_of(const Json& json) {
  Line line;
  json.at("study").get_to(line.study);
  json.at("case").get_to(line.case_id);
  json.at("content").get_to(line.content);
  json.at("seconds").get_to(line.seconds);
  json.at("seconds_from").get_to(line.seconds_from);
  line.memory = json.at("memory_mib").get<std::uint64_t>() << 20;
  json.at("threads").get_to(line.threads);
  json.at("specimens").get_to(line.specimens);
  json.at("scenario").get_to(line.source.scenario);
  json.at("scale").get_to(line.source.scale);
  json.at("set").get_to(line.source.overrides);
  json.at("folder").get_to(line.source.folder);
  return line;
}

}  // namespace

std::string Source::path() const {
  std::error_code error;
  const bool here = fs::equivalent(folder, fs::current_path(error), error) && !error;
  return here ? scenario : (fs::path(folder) / scenario).string();
}

Manifest plan(const std::vector<dem::Study>& studies, const std::vector<Source>& sources, const fs::path& output,
              const std::string& only_case) {
  Manifest manifest;
  std::map<std::string, int> users;  // of a specimen
  for (std::size_t i = 0; i < studies.size(); ++i) {
    const dem::Study& study = studies[i];
    const std::vector<Estimate> estimated = estimates(study, output);
    for (std::size_t k = 0; k < study.cases.size(); ++k) {
      const dem::CaseSpec& spec = study.cases[k];
      if ((!only_case.empty() && spec.id != only_case) || dem::is_kept(output, study, spec)) continue;
      Line line{.source = sources[i],
                .study = study.folder(),
                .case_id = spec.id,
                .content = dem::sha256(spec.content),
                .seconds = estimated[k].seconds,
                .seconds_from = estimated[k].from,
                .memory = estimated[k].memory,
                .threads = spec.threads,
                .specimens = {}};
      if (study.model->specimens) line.specimens = study.model->specimens(spec);
      for (const std::string& specimen : line.specimens) ++users[specimen];
      manifest.push_back(std::move(line));
    }
  }
  for (Line& line : manifest) {
    std::erase_if(line.specimens, [&](const std::string& specimen) { return users[specimen] < 2; });
  }
  return manifest;
}

std::string to_text(const Manifest& manifest) {
  std::string text;
  for (const Line& line : manifest) text += json_of(line).dump() + "\n";
  return text;
}

Manifest manifest_of(const std::string& text, const std::string& file) {
  Manifest manifest;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    try {
      manifest.push_back(line_of(Json::parse(text.substr(from, end - from))));
    } catch (const nlohmann::json::exception&) {
      throw dem::InputError(dem::Location{file, static_cast<int>(manifest.size()) + 1, 0}, {},
                            "this is no line of a manifest", "make it again with dem-report plan");
    }
    from = end + 1;
  }
  return manifest;
}

Manifest read_manifest(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw dem::InputError(dem::Location{file.string(), 0, 0}, {}, "there is no manifest",
                          "make it with dem-report plan SCENARIO... -o FOLDER");
  }
  return manifest_of(dem::read_input(file, largest_manifest), file.string());
}

dem::Study study_of(const Line& line) {
  const dem::Study study = dem::read_study(line.source.path(), line.source.scale, line.source.overrides, dem::models());
  const auto stale = [&](const std::string& what) {
    return dem::InputError(dem::Location{line.source.path(), 0, 0}, {},
                           "case " + line.case_id + " " + what + ": the scenario or the program has changed",
                           "make the plan again with dem-report plan");
  };
  const auto spec = std::ranges::find(study.cases, line.case_id, &dem::CaseSpec::id);
  if (study.folder() != line.study || spec == study.cases.end()) throw stale("is no longer there");
  if (dem::sha256(spec->content) != line.content) throw stale("is not what was planned");
  return dem::with_one_case(study, line.case_id);
}

}  // namespace cluster
