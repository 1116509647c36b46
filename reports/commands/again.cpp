#include "reports/commands/again.h"

#include "engine/core/files.h"
#include "reports/commands/study_options.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

bool same_bytes(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (!fs::is_regular_file(a, error) || !fs::is_regular_file(b, error)) return false;
  if (fs::file_size(a, error) != fs::file_size(b, error)) return false;
  return dem::read_file(a) == dem::read_file(b);
}

/// The place of a file as seen from the folder at hand.
struct Place {
  fs::path path;
  bool shipped = false;
};

struct Program {
  std::string name;
  fs::path scenarios;  ///< those that come with it
};

Program program_at(Home home) {
  if (home == Home::clone) return {"./dem-report", "scenarios"};
  return {"dem-report", "/usr/share/dem-report/scenarios"};
}

/// `below`: the folder of `shipped` where files of this kind lie.
Place place_of(const fs::path& file, const fs::path& shipped, const Program& program, const fs::path& below) {
  const fs::path known = below / file.filename();
  if (same_bytes(file, shipped / known)) return {program.scenarios / known, true};
  return {file.filename(), false};
}

std::string quoted(const fs::path& path) {
  std::string text = "\"";
  for (const char c : path.string()) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

std::string key_of(const std::string& override) {
  std::string key = override.substr(0, override.find('='));
  std::erase_if(key, [](char c) { return c == ' ' || c == '\t'; });
  return key;
}

}  // namespace

fs::path shipped_scenarios(const fs::path& assets) {
  std::error_code error;
  const fs::path whole = fs::canonical(assets, error);
  return (error ? assets : whole).parent_path() / "scenarios";
}

reports::Again how_again(const RunRequest& request, const dem::Scenario& scenario, const fs::path& shipped, Home home) {
  const Program program = program_at(home);
  const fs::path map = scenario.declares("grains.file") ? fs::path(scenario.text("grains.file")) : fs::path();
  Place study = place_of(scenario.file(), shipped, program, {});
  // A map is named from the folder of its scenario, and nobody but root may put one beside the installed ones.
  if (home == Home::installed && !map.empty()) study = {study.path.filename(), false};
  reports::Again again;
  again.scenario = {study.path.string(), study.shipped};
  again.command = program.name + " " + shell_quoted(study.path.string());
  if (request.scale != "draft") again.command += " --scale " + request.scale;
  bool another_rock = !study.shipped, another_map = false;
  for (const std::string& override : request.overrides) {
    const std::string key = key_of(override);
    another_rock = another_rock || key == "include";
    another_map = another_map || key == "grains.file";
    if (key == "include" || key == "grains.file") continue;
    again.command +=
        key == "seed" ? " --seed " + override.substr(override.find('=') + 1) : " --set " + shell_quoted(override);
  }
  if (!scenario.included().empty()) {
    Place rock = place_of(scenario.included(), shipped, program, "rocks");
    if (rock.path == study.path) rock.path = "rock_" + rock.path.string();  // both are saved in one folder
    again.rock = {rock.path.string(), rock.shipped};
    if (another_rock) again.command += " --set " + shell_quoted("include=" + quoted(rock.path));
  }
  if (!map.empty()) {
    again.needs = (study.path.parent_path() / map.filename()).string();
    if (another_map || map != map.filename())
      again.command += " --set " + shell_quoted("grains.file=" + quoted(map.filename()));
  }
  if (!request.figure.empty()) again.command += " --only " + shell_quoted(request.figure);
  if (!request.only_case.empty()) again.command += " --case " + shell_quoted(request.only_case);
  return again;
}

}  // namespace cli
