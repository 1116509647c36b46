#include "reports/commands/study_options.h"

#include <algorithm>
#include <set>
#include <thread>

#include "engine/core/errors.h"

namespace cli {
namespace {

dem::Study read_one(const std::string& file, const std::string& scale, std::span<const std::string> overrides,
                    bool of_several) {
  try {
    return dem::read_study(file, scale, overrides, dem::models());
  } catch (const dem::InputError& error) {
    if (!of_several || error.where().file != "--set") throw;
    // The same --set may serve the other scenarios.
    dem::Location where = error.where();
    where.file = file + ": --set";
    throw dem::InputError(where, error.key(), error.wrong(), error.right());
  }
}

}  // namespace

Positional scenario_positional() {
  return {.name = "SCENARIO",
          .help = "scenario files",
          .ending = ".toml",
          .most = Positional::any_number,
          .kind = OptionKind::file};
}

Option output_option() {
  return {.name = "output",
          .letter = 'o',
          .value = "DIR",
          .help = "folder for everything that is written",
          .kind = OptionKind::folder,
          .standard = "out"};
}

Option scale_option() {
  return {.name = "scale",
          .value = "SCALE",
          .help = "size of the study",
          .kind = OptionKind::text,
          .standard = "draft",
          .choices = {"smoke", "draft", "paper", "high"}};
}

Option threads_option() {
  return {.name = "threads",
          .value = "N",
          .help = "threads to simulate with, all of the machine when not given; results do not depend on it",
          .kind = OptionKind::number,
          .low = 1,
          .high = 1024};
}

Option seed_option() {
  return {.name = "seed",
          .value = "N",
          .help = "seed of the random numbers, in the place of the scenario's",
          .kind = OptionKind::number,
          .low = 0,
          .high = std::uint64_t{1} << 53};
}

Option case_option() {
  return {.name = "case",
          .value = "ID",
          .help = "run only this case; its report goes into the folder case.ID",
          .kind = OptionKind::text};
}

Option set_option() {
  return {.name = "set",
          .value = "KEY=VALUE",
          .help = "override a scenario key, in TOML: --set 'specimen.diameter=\"10 mm\"'",
          .kind = OptionKind::text,
          .repeatable = true};
}

Option quiet_option() { return {.name = "quiet", .help = "no progress, only errors"}; }

Option reference_option() {
  return {.name = "reference",
          .value = "DIR",
          .help = "folder of the references that were accepted",
          .kind = OptionKind::folder};
}

int threads(const Arguments& arguments) {
  if (arguments.has("threads")) return static_cast<int>(arguments.number("threads"));
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

std::vector<std::string> overrides(const Arguments& arguments) {
  std::vector<std::string> all = arguments.texts("set");
  if (arguments.has("seed")) all.push_back("seed=" + std::to_string(arguments.number("seed")));
  return all;
}

std::vector<dem::Study> read_studies(std::span<const std::string> files, const std::string& scale,
                                     std::span<const std::string> overrides) {
  std::vector<dem::Study> studies;
  std::set<std::string> folders;
  for (const std::string& file : files) {
    dem::Study study = read_one(file, scale, overrides, files.size() > 1);
    if (!folders.insert(study.folder()).second) {
      throw dem::InputError(dem::Location{file, 0, 0}, {}, "another scenario of the same name is given",
                            "run them one by one, with different --output folders");
    }
    studies.push_back(std::move(study));
  }
  return studies;
}

std::filesystem::path output_folder(const std::filesystem::path& given) {
  const bool up = std::ranges::find(given, std::filesystem::path("..")) != given.end();
  if (!up || given.lexically_normal() == given) return given;
  std::error_code error;
  const std::filesystem::path straight = std::filesystem::weakly_canonical(given, error);
  return error ? given : straight;
}

std::string shell_quoted(const std::string& text) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/=+,:%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

}  // namespace cli
