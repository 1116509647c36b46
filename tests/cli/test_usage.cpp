// The program as used, with wrong input: exit codes, what is said, and that nothing is written.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "engine/core/files.h"
#include "tests/cli/program.h"
#include "tests/support/scratch.h"

namespace {

const std::string scenario = DEM_SOURCE_DIR "/scenarios/ldb_aspect_ratio.toml";
const std::string minerals = DEM_SOURCE_DIR "/scenarios/ldb_minerals.toml";
const std::string elle = DEM_SOURCE_DIR "/scenarios/elle_polycrystal.toml";

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
  std::filesystem::copy_file(scenario, folder / "caf\xe9.toml");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  const std::string rock = "include = \"" DEM_SOURCE_DIR "/scenarios/rocks/my_rock.toml\"\n";
  const std::string specimen = "[specimen]\ndiameter = \"9 mm\"\nheight = \"18 mm\"\n[scales.draft]\n";
  std::ofstream(folder / "sweep.toml") << rock << "tests = [\"genesis\"]\nsweep.mineral = [\"gold\"]\n"
                                       << "model = \"grain_texture\"\n"
                                       << specimen;
  std::ofstream(folder / "figures.toml") << rock << "figures = [\"x\"]\ntests = [\"genesis\"]\n"
                                         << "model = \"grain_texture\"\n"
                                         << specimen;
  struct Bad {
    std::vector<std::string> arguments;
    std::string said;
  };
  const std::vector<Bad> all = {
      {{}, "no scenario is given; write dem-report SCENARIO.toml"},
      {{"--treads", "2", scenario}, "did you mean '--threads'?"},
      {{"nowhere.toml"}, "nowhere.toml: there is no such file; the scenarios there are: "},
      {{"run", "nowhere.toml"}, "nowhere.toml: there is no such file; the scenarios there are: "},
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
      // Several scenarios: which of them refuses.
      {{minerals, scenario, "--scale", "smoke", "--set", "sweep.mineral=[\"quartz\"]", "--set",
        "extra[0].growth=\"most_contacts\""},
       minerals + ": --set: extra[0].growth: no such entry"},
      {{scenario, minerals, "--scale", "smoke", "--only", "dip_clusters2"}, scenario + ": --only: there is no figure"},
      {{"figures.toml"}, "figures.toml:2:1: figures: there is no figure 'x'"},
      // Names that become folders and files.
      {{minerals, "--scale", "smoke", "--set", "sweep.mineral=[\"../../../../../X\"]"},
       "--set: sweep.mineral[0]: the name \"../../../../../X\" has '.'"},
      {{minerals, "--scale", "smoke", "--set", "mineral[2].name=\"../../../../../X\""}, "mineral[2].name: the name"},
      {{minerals, "--scale", "smoke", "--set", "mineral[2].name=\"a\\u0000b\""}, "the control character \\x00"},
      {{minerals, "--scale", "smoke", "--set", "mineral[2].name=\"" + std::string(300, 'x') + "\""},
       "has 300 characters; write at most 40"},
      {{minerals, "--scale", "smoke", "--set", "mineral[2].name=\"Biotite\""},
       "'biotite' and 'Biotite' give the same name of folders, biotite"},
      {{scenario, "--set", "title=\"\\u001b[31m\""}, "title: \"\\x1b[31m\" has the control character \\x1b"},
      {{scenario, "--set", "title=\"" + std::string(20000, 'x') + "\""}, "has 20000 characters; write at most 200"},
      {{"a\x1b[31m.toml"}, "a\\x1b[31m.toml: there is no such file"},
      {{"caf\xe9.toml"}, "caf\\xe9.toml: the name of the file is not UTF-8"},
      // Files that are none.
      {{"/dev/zero"}, "/dev/zero: the file is no plain file"},
      {{"pipe"}, "pipe: the file is no plain file"},
      {{scenario, "--set", "include=\"/dev/zero\""}, "--set: include: /dev/zero is no plain file"},
      {{elle, "--scale", "smoke", "--set", "grains.source=\"file\"", "--set", "grains.file=\"/dev/zero\""},
       "grains.file: the file is no plain file"},
      // What comes from a sweep has the line of the sweep.
      {{"sweep.toml"}, "sweep.toml:3:7: sweep.mineral: there is no mineral 'gold'"},
      {{scenario, "--set", "seed=9007199254740990", "--set", "repeats=10"}, "--set: repeats: the last of 10 seeds"},
      {{scenario, "--set", "seed=9007199254740993"}, "--set: seed: 9007199254740993 is out of range"},
      {{scenario, "--set", "specimen.diameter=\"4 mm\""}, "4 mm is too narrow for its particles"},
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

TEST_CASE("a mineral by any name that may be written has its cases below the output folder") {
  const test::Scratch folder;
  const std::string id = "direct_tension_k_quarz_ue4__1_";
  const test::Outcome outcome = test::run_program(
      folder.path(), {minerals, "--scale", "smoke", "--format", "html", "--case", id, "-o", "deep/../out", "--set",
                      "mineral[2].name=\"K-Quarz ä (1)\"", "--set", "sweep.mineral=[\"K-Quarz ä (1)\"]"});
  CAPTURE(outcome.err);
  CHECK(outcome.code <= 1);
  CHECK(has(outcome.err, id + " ("));
  CHECK(std::filesystem::exists(folder / "out/ldb_minerals.smoke/cases" / id / "results.h5"));
  CHECK(std::filesystem::exists(folder / "out/ldb_minerals.smoke" / ("case." + id) / "summary.json"));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()) == 1);
}
