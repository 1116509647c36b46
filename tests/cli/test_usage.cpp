// The program as used, with wrong input: exit codes, what is said, and that nothing is written.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>

#include "engine/core/files.h"
#include "tests/cli/program.h"
#include "tests/support/scratch.h"

namespace {

const std::string scenario = DEM_SOURCE_DIR "/scenarios/ldb_aspect_ratio.toml";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("help, version, figures and keys go to stdout and exit with 0") {
  const test::Scratch folder;
  for (const auto& [option, said] :
       std::vector<std::pair<std::string, std::string>>{{"--help", "Usage:\n  dem-report [options] SCENARIO..."},
                                                        {"--version", "dem-report 0."},
                                                        {"--list-figures", "crack_maps"},
                                                        {"--explain-keys", "Keys of model = \"grain_texture\""}}) {
    CAPTURE(option);
    const test::Outcome outcome = test::run_program(folder.path(), {option});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(has(outcome.out, said));
  }
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("the reference of the scenario keys is what the program says of them") {
  const test::Scratch folder;
  const std::string page = test::run_program(folder.path(), {"keys", "--markdown"}).out;
  CHECK(has(page, "\n```text\n" + test::run_program(folder.path(), {"--explain-keys"}).out + "```\n"));
  const std::filesystem::path kept = DEM_SOURCE_DIR "/docs/use/keys.md";
  if (std::filesystem::exists(kept) && dem::read_file(kept) == page) return;
  FAIL_CHECK(kept.string() << " is not what the program says; to refresh it: " DEM_PROGRAM " keys --markdown > "
                           << kept.string());
}

TEST_CASE("the reference of the results is what the program says of them") {
  const test::Scratch folder;
  const std::string page = test::run_program(folder.path(), {"results", "--markdown"}).out;
  CHECK(has(page, "| `compressive_strength` |"));
  CHECK(has(test::run_program(folder.path(), {"results", "lattice"}).out,
            "breaking_displacement: Breaking displacement"));
  const std::filesystem::path kept = DEM_SOURCE_DIR "/docs/use/results.md";
  if (std::filesystem::exists(kept) && dem::read_file(kept) == page) return;
  FAIL_CHECK(kept.string() << " is not what the program says; to refresh it: " DEM_PROGRAM " results --markdown > "
                           << kept.string());
}

TEST_CASE("verbs do what the flags of the same meaning do") {
  const test::Scratch folder;
  const auto out = [&](const std::vector<std::string>& words) { return test::run_program(folder.path(), words).out; };
  CHECK(out({"figures"}) == out({"--list-figures"}));
  CHECK(out({"keys"}) == out({"--explain-keys"}));
  CHECK(out({"version"}) == out({"--version"}));
  CHECK(out({"help"}) == out({"--help"}));
  CHECK(out({"help", "run"}) == out({"run", "--help"}));
  const std::string one = out({"keys", "grain_texture"});
  CHECK(has(one, "Keys of every scenario"));
  CHECK(has(one, "Keys of model = \"grain_texture\""));
  CHECK(one.size() < out({"keys"}).size());
}

TEST_CASE("assets that are not there: exit code 3 before anything is written, and where they were looked for") {
  const test::Scratch folder;
  ::setenv("DEM_REPORT_ASSETS", (folder.path() / "nowhere").c_str(), 1);
  const test::Outcome outcome = test::run_program(folder.path(), {scenario, "--scale", "smoke", "--format", "html"});
  ::unsetenv("DEM_REPORT_ASSETS");
  CHECK(outcome.code == 3);
  CHECK(has(outcome.err, "DEM_REPORT_ASSETS names " + (folder.path() / "nowhere").string()));
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("wrong usage and wrong input exit with 2, say what would be right, and write nothing") {
  const test::Scratch folder;
  std::ofstream(folder / "typo.toml") << "model = \"grain_texture\"\nseeds = 2\n[scales.draft]\n";
  std::filesystem::create_directory(folder / "folder");
  struct Bad {
    std::vector<std::string> arguments;
    std::string said;
  };
  const std::vector<Bad> all = {
      {{}, "no scenario is given; write dem-report SCENARIO.toml"},
      {{"--treads", "2", scenario}, "did you mean '--threads'?"},
      {{"nowhere.toml"}, "nowhere.toml: there is no such file; the scenarios there are: typo.toml"},
      {{"run", "nowhere.toml"}, "nowhere.toml: there is no such file; the scenarios there are: typo.toml"},
      {{"nowhere"}, "nowhere: there is no such scenario file, and no such verb"},
      {{"typo"}, "did you mean the file 'typo.toml'?"},
      {{"help", "figure"}, "figure: unknown verb; did you mean 'figures'?"},
      {{"folder"}, "folder: this is a folder, not a scenario"},
      {{"typo.toml"}, "typo.toml:2:1: seeds: unknown key; did you mean 'seed'?"},
      {{scenario, "--scale", "high"}, "this scenario has no scale 'high'; it has: smoke, draft, paper"},
      {{scenario, "--set", "sed=2"}, "--set: sed: unknown key; did you mean 'seed'?"},
      {{scenario, "--set", "seed=x"}, "'x' is not a TOML value"},
      {{scenario, "--seed", "-1"}, "is not a whole number"},
      {{scenario, "--case", "compresion_ar_1"}, "did you mean 'compression_ar_1'?"},
      {{scenario, "--only", "crack_map"}, "crack_maps"},
      {{scenario, "--set", "figures=[\"crack_map\"]"}, "crack_maps"},
      {{scenario, "--format", "docx"}, "unknown format 'docx'"},
      {{scenario, "typo.toml"}, "typo.toml:2:1: seeds: unknown key"},
      {{scenario, scenario}, "another scenario of the same name"},
      {{scenario, "--set", "sweep.aspect_ratio=[]"}, "the list is empty"},
  };
  const auto files = [&] {
    return std::distance(std::filesystem::recursive_directory_iterator(folder.path()),
                         std::filesystem::recursive_directory_iterator());
  };
  const auto before = files();
  for (const Bad& bad : all) {
    CAPTURE(bad.said);
    const test::Outcome outcome = test::run_program(folder.path(), bad.arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.starts_with("dem-report: "));
    CHECK(has(outcome.err, bad.said));
    CHECK(files() == before);
  }
}
