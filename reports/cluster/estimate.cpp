#include "reports/cluster/estimate.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/core/errors.h"
#include "engine/core/files.h"

namespace cluster {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Before anything is known. Times of the shipped scenarios: docs/notes/speed.md.
double seconds_at(const std::string& scale) {
  if (scale == "smoke") return 5;
  if (scale == "draft") return 60;
  if (scale == "paper") return 600;
  return 3600;
}

// engine/study counts with the same for a case of a study that has several.
constexpr std::uint64_t usual_memory = std::uint64_t{2} << 30;
constexpr std::uint64_t memory_at_high_scale = std::uint64_t{4} << 30;
constexpr std::uint64_t least_memory = std::uint64_t{512} << 20;

Json read_json(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return Json::object();
  try {
    Json json = Json::parse(dem::read_file(path), nullptr, false);
    if (json.is_object()) return json;
  } catch (const dem::EnvironmentError&) {
  }
  return Json::object();
}

double number(const Json& object, const std::string& name) {
  const auto at = object.find(name);
  return at != object.end() && at->is_number() ? at->get<double>() : 0;
}

}  // namespace

std::optional<CaseRun> earlier_run(const fs::path& case_folder) {
  const Json json = read_json(case_folder / "run.json");
  CaseRun run;
  run.seconds = number(json, "seconds");
  if (!(run.seconds > 0)) return {};
  run.threads = static_cast<int>(std::clamp(number(json, "threads"), 1.0, 1024.0));
  run.memory = static_cast<std::uint64_t>(std::clamp(number(json, "memory_bytes"), 0.0, 1e15));
  return run;
}

std::vector<Estimate> estimates(const dem::Study& study, const fs::path& output) {
  const Json report = read_json(dem::inside(output, study.folder()) / "run.json");
  const Json in_report = report.value("case_seconds", Json::object());
  const std::string& scale = study.scenario.scale();
  const std::uint64_t usual = scale == "high" ? memory_at_high_scale : usual_memory;

  std::vector<Estimate> all;
  double known_seconds = 0;
  int known = 0;
  for (const dem::CaseSpec& spec : study.cases) {
    Estimate estimate{0, usual, "this case"};
    if (const auto run = earlier_run(dem::case_folder(output, study, spec.id))) {
      estimate.seconds = run->seconds;
      // A quarter over what was seen; never more than the usual for what another case may have taken beside.
      if (run->memory > 0 && scale != "high") estimate.memory = std::clamp(run->memory / 4 * 5, least_memory, usual);
    } else if (in_report.is_object()) {
      estimate.seconds = number(in_report, spec.id);
    }
    if (estimate.seconds > 0) {
      known_seconds += estimate.seconds;
      ++known;
    }
    all.push_back(std::move(estimate));
  }
  for (Estimate& estimate : all) {
    if (estimate.seconds > 0) continue;
    estimate.seconds = known > 0 ? known_seconds / known : seconds_at(scale);
    estimate.from = known > 0 ? "this study" : "its scale";
  }
  return all;
}

}  // namespace cluster
