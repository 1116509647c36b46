// Scenario files of all models, up to their cases. A line "#set MODEL PATH=VALUE" is given as --set gives it
// where the file names that model.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "engine/model/model.h"
#include "engine/study/study.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/scratch.h"

namespace {

/// Settings of every declared key that has no list before it: its choices, its default, the ends of its range and beyond.
std::vector<std::string> settings() {
  std::vector<std::string> lines;
  for (const dem::Model& model : dem::models()) {
    for (const dem::Key& key : model.keys()) {
      if (key.path.find("[]") != std::string::npos) continue;
      const bool list =
          key.type == dem::KeyType::integers || key.type == dem::KeyType::reals || key.type == dem::KeyType::texts;
      const auto set = [&](const std::string& value) {
        lines.push_back("#set " + std::string(model.name) + " " + key.path + (list ? "=[" + value + "]" : "=" + value) +
                        "\n");
      };
      if (!key.standard.empty()) lines.push_back(fmt::format("#set {} {}={}\n", model.name, key.path, key.standard));
      for (const std::string& choice : key.choices) set('"' + choice + '"');
      if (key.type == dem::KeyType::boolean) set("true"), set("false");
      if (key.type == dem::KeyType::text || key.type == dem::KeyType::texts || key.type == dem::KeyType::boolean)
        continue;
      for (const double end : {key.low, key.high}) {
        if (!std::isfinite(end)) continue;
        for (const double factor : {1.0, 1.0, 1.0, 1.5}) {
          set(key.unit.empty() ? fmt::format("{}", factor * end) : fmt::format("\"{} {}\"", factor * end, key.unit));
        }
      }
    }
  }
  return lines;
}

/// The settings that an input holds.
std::vector<std::string> set_by(const std::string& input) {
  std::vector<std::string> found;
  std::istringstream in(input);
  for (std::string line; std::getline(in, line);) {
    const std::size_t path = line.find(' ', 5);
    if (!line.starts_with("#set ") || path == std::string::npos) continue;
    if (input.find('"' + line.substr(5, path - 5) + '"') != std::string::npos) found.push_back(line.substr(path + 1));
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  const test::Scratch scratch;
  const std::filesystem::path file = scratch / "scenario.toml";
  dem_fuzz::Harness harness{"scenario",
                            dem_fuzz::corpus("scenario"),
                            {"\"",
                             "\"\"\"",
                             "'",
                             "[",
                             "]",
                             "[[",
                             "]]",
                             "{",
                             "}",
                             "=",
                             ".",
                             ",",
                             "#",
                             "\n",
                             " GPa",
                             " mm",
                             " %",
                             " psi",
                             "seed = ",
                             "repeats = ",
                             "[sweep]\n",
                             "[[extra]]\n",
                             "[[mineral]]\n",
                             "[[rule]]\n",
                             "[scales.smoke]\n",
                             "include = ",
                             "tests = ",
                             "true",
                             "\"kN/m3\"",
                             "1979-05-27",
                             "\xCE\xBCm",
                             "\\u0000",
                             "../",
                             "snapshots = "},
                            settings(),
                            [&](const std::string& input) {
                              std::ofstream(file, std::ios::binary | std::ios::trunc) << input;
                              (void)dem::read_study(file.string(), "smoke", set_by(input), dem::models());
                            }};
  return dem_fuzz::run(argc, argv, harness);
}
