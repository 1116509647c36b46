// dem-report plan: what is to be run, a line a case.
#include "reports/commands/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/text.h"
#include "engine/study/progress.h"
#include "reports/commands/study_options.h"
#include "reports/commands/verbs.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t largest_plan = std::uint64_t{16} << 20;

RunRequest request_of(const Arguments& arguments) {
  RunRequest request;
  request.scenarios = arguments.words("SCENARIO");
  request.output = output_folder(arguments.text("output"));
  request.scale = arguments.text("scale");
  request.overrides = overrides(arguments);
  request.only_case = arguments.text("case");
  return request;
}

int perform(const Arguments& arguments) {
  const RunRequest request = request_of(arguments);
  const Planned plan = planned(request);
  const cluster::Manifest manifest = cluster::plan(plan.studies, plan.sources, request.output, request.only_case);
  const std::string lines = cluster::to_text(manifest);
  const fs::path file = request.output / "manifest.jsonl";
  dem::write_file(request.output / "plan.json", plan_text(request));
  dem::write_file(file, lines);

  for (std::size_t i = 1; i <= manifest.size(); ++i) std::cout << i << "\n";
  if (arguments.has("quiet")) return 0;
  std::size_t cases = 0;
  for (const dem::Study& study : plan.studies) cases += request.only_case.empty() ? study.cases.size() : 1;
  double seconds = 0;
  for (const cluster::Line& line : manifest) seconds += line.seconds;
  const bool guessed =
      std::ranges::any_of(manifest, [](const cluster::Line& l) { return l.seconds_from == "its scale"; });
  std::cerr << fmt::format("{}: {} of {} cases to run, about {} one after the other{}\n", dem::printable(file.string()),
                           manifest.size(), cases, dem::duration_text(seconds),
                           guessed ? " (a guess by scale: nothing like it was run here yet)" : "");
  return 0;
}

}  // namespace

Planned planned(const RunRequest& request) {
  Planned plan{checked_studies(request), {}};
  for (const std::string& scenario : request.scenarios) {
    plan.sources.push_back({fs::current_path().string(), scenario, request.scale, request.overrides});
  }
  return plan;
}

std::string plan_text(const RunRequest& request) {
  const Json json = {{"folder", fs::current_path().string()},
                     {"scenarios", request.scenarios},
                     {"scale", request.scale},
                     {"set", request.overrides},
                     {"case", request.only_case}};
  try {
    return json.dump(2) + "\n";
  } catch (const nlohmann::json::exception&) {
    throw dem::InputError("a name of the plan is not UTF-8, and a plan cannot carry it",
                          "give the file or folder another name");
  }
}

RunRequest read_plan(const fs::path& output) {
  const fs::path file = output / "plan.json";
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw dem::InputError(dem::Location{file.string(), 0, 0}, {}, "there is no plan",
                          "make it with dem-report plan SCENARIO... -o FOLDER");
  }
  RunRequest request;
  std::string folder;
  try {
    const Json json = Json::parse(dem::read_input(file, largest_plan));
    json.at("folder").get_to(folder);
    json.at("scenarios").get_to(request.scenarios);
    json.at("scale").get_to(request.scale);
    json.at("set").get_to(request.overrides);
    json.at("case").get_to(request.only_case);
  } catch (const nlohmann::json::exception&) {
    throw dem::InputError(dem::Location{file.string(), 0, 0}, {}, "this is no plan",
                          "make it again with dem-report plan");
  }
  request.output = output;
  // Scenarios are named as seen from where they were planned, and so stand in the report.
  if (!fs::equivalent(folder, fs::current_path(), error) || error) {
    request.output = fs::absolute(output);
    fs::current_path(folder, error);
    if (error) {
      throw dem::InputError(dem::Location{file.string(), 0, 0}, "folder",
                            "the folder that it was planned in, " + folder + ", cannot be entered from here",
                            "collect where that folder is seen, or plan again");
    }
  }
  return request;
}

Command verbs::plan() {
  return {.name = "plan",
          .summary = "list the cases that are to be run, for a cluster or a loop of the shell",
          .details =
              "Writes DIR/manifest.jsonl, a line a case that has no current record, with its estimated time and "
              "memory, and prints the numbers of the lines. run-case runs a line, collect writes the reports.",
          .positionals = {scenario_positional()},
          .options = {output_option(), scale_option(), seed_option(), set_option(), case_option(), quiet_option()},
          .examples = {{"dem-report plan scenarios/ldb_dip_angle.toml -o out | parallel dem-report run-case out",
                        "every case, as many at a time as there are cores (GNU parallel)"},
                       {"dem-report collect out", "and the report"}},
          .exit_codes = usual_exit_codes(),
          .perform = perform};
}

}  // namespace cli
