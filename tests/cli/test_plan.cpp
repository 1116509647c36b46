// plan, run-case and collect as a shell loop, GNU parallel or a cluster uses them.
#include <doctest/doctest.h>

#include <csignal>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <thread>

#include "engine/core/files.h"
#include "tests/cli/program.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

const std::string scenario = DEM_SOURCE_DIR "/scenarios/quartzite_strength.toml";
const std::string study = "quartzite_strength.smoke";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// `text` as one word of a shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

Texts lines_of(const std::string& text) {
  Texts lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Every file below `folder` that must be the same anywhere: not what varies from run to run.
std::map<std::string, std::string> stable_files(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().filename() == "run.json") continue;
    std::string bytes = dem::read_file(entry.path());
    if (entry.path().filename() == "ro-crate-metadata.json") {  // the standard demands a date
      bytes = std::regex_replace(bytes, std::regex("\"(datePublished|endTime)\": \"[^\"]*\""), "");
    }
    files.emplace(fs::relative(entry.path(), folder).string(), std::move(bytes));
  }
  return files;
}

test::Outcome plan(const fs::path& folder, const Texts& more = {}) {
  Texts arguments = {"plan", scenario, "--scale", "smoke"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::run_program(folder, arguments);
}

test::Outcome run_case(const fs::path& folder, const Texts& lines) {
  Texts arguments = {"run-case", "out"};
  arguments.insert(arguments.end(), lines.begin(), lines.end());
  return test::run_program(folder, arguments);
}

test::Outcome collect(const fs::path& folder) {
  return test::run_program(folder, {"collect", "out", "--format", "html", "--only", "quartzite_strengths"});
}

/// The study run by the program itself, and its exit code.
struct Local {
  std::map<std::string, std::string> files;
  int code = 0;
};
const Local& local() {
  static const Local made = [] {
    const test::Scratch folder;
    const test::Outcome outcome = test::run_program(
        folder.path(), {scenario, "--scale", "smoke", "--format", "html", "--only", "quartzite_strengths"});
    INFO(outcome.err);
    REQUIRE(outcome.code <= 1);
    return Local{stable_files(folder.path() / "out" / study), outcome.code};
  }();
  return made;
}

}  // namespace

TEST_CASE("the lines of a plan, run from the last to the first and twice, make the report of a local run") {
  const test::Scratch folder;
  const test::Outcome made = plan(folder.path());
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(made.out == "1\n2\n3\n4\n5\n6\n");
  CHECK(has(made.err, "out/manifest.jsonl: 6 of 6 cases to run"));
  REQUIRE(lines_of(dem::read_file(folder / "out/manifest.jsonl")).size() == 6);
  for (const char* line : {"6", "5", "4", "3", "2", "1"}) {
    const test::Outcome once = run_case(folder.path(), {line});
    CHECK(once.code == 0);
    CHECK(has(once.err, "starting, no record yet"));
  }
  const test::Outcome again = run_case(folder.path(), {"2", "5"});
  CHECK(again.code == 0);
  CHECK(has(again.err, "kept"));
  CHECK_FALSE(has(again.err, "simulated"));
  const test::Outcome report = collect(folder.path());
  CAPTURE(report.err);
  CHECK(report.code == local().code);
  CHECK(has(report.out, "out/" + study + "/only.quartzite_strengths/report.html\n"));
  CHECK(stable_files(folder.path() / "out" / study) == local().files);

  const test::Outcome nothing = plan(folder.path());  // all are kept
  CHECK(nothing.code == 0);
  CHECK(nothing.out.empty());
  CHECK(has(nothing.err, "0 of 6 cases to run"));
  CHECK(dem::read_file(folder / "out/manifest.jsonl").empty());
  CHECK(has(run_case(folder.path(), {"1"}).err, "it is empty"));
  CHECK(collect(folder.path()).code == local().code);
}

TEST_CASE("a plan holds only the cases that are not kept") {
  const test::Scratch folder;
  REQUIRE(plan(folder.path()).code == 0);
  REQUIRE(run_case(folder.path(), {"1", "3"}).code == 0);
  const test::Outcome rest = plan(folder.path());
  CHECK(rest.out == "1\n2\n3\n4\n");
  CHECK(has(rest.err, "4 of 6 cases"));
  CHECK_FALSE(has(dem::read_file(folder / "out/manifest.jsonl"), "\"tension_n_2\""));
  CHECK(has(dem::read_file(folder / "out/manifest.jsonl"), "\"seconds_from\":\"this study\""));
  CHECK(lines_of(plan(folder.path(), {"--case", "tension_n_4"}).out).size() == 1);
}

TEST_CASE("every line twice at once: all end well, and the bytes are those of a local run") {
  const test::Scratch folder;
  REQUIRE(plan(folder.path()).code == 0);
  {
    std::vector<std::jthread> others;
    for (const Texts& order : {Texts{"1", "2", "3", "4", "5", "6"}, Texts{"6", "5", "4", "3", "2", "1"},
                               Texts{"1", "2", "3", "4", "5", "6"}}) {
      others.emplace_back([&folder, order] { CHECK(run_case(folder.path(), order).code == 0); });
    }
  }
  CHECK(collect(folder.path()).code == local().code);
  CHECK(stable_files(folder.path() / "out" / study) == local().files);
}

TEST_CASE("names with blanks, quotes and $() pass through unharmed") {
  const test::Scratch folder;
  const fs::path odd = folder / "it's a \"folder\" $(touch HARM) `touch HARM`; &";
  fs::create_directory(odd);
  // The name of a scenario names a folder: letters, digits, blanks and few signs.
  std::string text = dem::read_file(scenario);
  std::ofstream(odd / "my (odd) study.toml") << text;
  const std::string title = "title=\"it's $(touch HARM) `touch HARM` \\\"x\\\"\"";
  const test::Outcome made = test::run_program(
      odd, {"plan", "my (odd) study.toml", "--scale", "smoke", "-o", "o $(touch HARM) 'x'", "--set", title});
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  const fs::path out = odd / "o $(touch HARM) 'x'";
  const test::Outcome shell = test::run_shell(
      odd, "cd / && for i in 1 2 3 4 5 6; do \"$PROGRAM\" run-case " + quoted(out.string()) + " $i || exit 1; done");
  CAPTURE(shell.err);
  CHECK(shell.code == 0);
  const test::Outcome report =
      test::run_program("/", {"collect", out.string(), "--format", "html", "--only", "quartzite_strengths"});
  CAPTURE(report.err);
  CHECK(report.code == local().code);
  CHECK(has(report.out, (out / "my (odd) study.smoke/only.quartzite_strengths/report.html").string()));
  CHECK(has(dem::read_file(out / "my (odd) study.smoke/only.quartzite_strengths/report.html"), "$(touch HARM)"));
  for (const auto& entry : fs::recursive_directory_iterator(folder.path())) CHECK(entry.path().filename() != "HARM");
  CHECK_FALSE(fs::exists("/HARM"));
}

TEST_CASE("bad lines, missing plans and scenarios that changed since: exit code 2, and nothing is run") {
  const test::Scratch folder;
  CHECK(has(run_case(folder.path(), {"1"}).err, "there is no manifest; make it with dem-report plan"));
  CHECK(has(collect(folder.path()).err, "there is no plan; make it with dem-report plan"));
  std::ofstream(folder / "mine.toml") << dem::read_file(scenario);
  REQUIRE(test::run_program(folder.path(), {"plan", "mine.toml", "--scale", "smoke"}).code == 0);
  for (const char* line : {"0", "7", "-1", "x", "1.5", "99999999999999999999"}) {
    const test::Outcome bad = run_case(folder.path(), {"--", line});
    CAPTURE(line);
    CHECK(bad.code == 2);
    CHECK(has(bad.err, "the manifest has no such line; its lines are 1 to 6"));
  }
  CHECK(has(run_case(folder.path(), {}).err, "no line of the manifest is named"));
  CHECK(has(run_case(folder.path(), {"--pack", "0"}).err, "there are no packs beside the manifest"));

  std::string text = dem::read_file(scenario);
  text.replace(text.find("factor = 6.0"), 12, "factor = 7.0");
  std::ofstream(folder / "mine.toml") << text;
  const test::Outcome stale = run_case(folder.path(), {"1"});
  CAPTURE(stale.err);
  CHECK(stale.code == 2);
  CHECK(has(stale.err, "case tension_n_2 is not what was planned: the scenario or the program has changed; "));
  CHECK_FALSE(fs::exists(folder / "out/mine.smoke"));
  fs::remove(folder / "mine.toml");
  CHECK(run_case(folder.path(), {"1"}).code == 2);
  std::ofstream(folder / "out/manifest.jsonl") << "nonsense\n";
  CHECK(has(run_case(folder.path(), {"1"}).err, "out/manifest.jsonl:1: this is no line of a manifest"));
}

TEST_CASE("--executor: options that do not go together, and a machine without Slurm, before anything is written") {
  const test::Scratch folder;
  struct Bad {
    Texts arguments;
    std::string said;
  };
  const std::vector<Bad> all = {
      {{"--detach"}, "--detach: belongs to a cluster; add --executor slurm, or leave it out"},
      {{"--partition", "long"}, "--partition: belongs to a cluster"},
      {{"--cases-per-job", "2"}, "--cases-per-job: belongs to a cluster"},
      {{"--executor", "slrum"}, "did you mean 'slurm'?"},
      {{"--executor", "slurm", "--force"}, "--force: does not go with --executor slurm"},
      {{"--executor", "slurm", "--report-only"}, "--report-only: does not go with --executor slurm"},
      {{"--executor", "slurm", "--time-limit", "4h"}, "--time-limit: '4h' is no time limit; write minutes (90)"},
      {{"--executor", "slurm", "--sbatch", "--comment='x"}, "--sbatch: the quote ' is not closed"},
  };
  for (const Bad& bad : all) {
    Texts arguments = {scenario, "--scale", "smoke", "--format", "html"};
    arguments.insert(arguments.end(), bad.arguments.begin(), bad.arguments.end());
    const test::Outcome outcome = test::run_program(folder.path(), arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, bad.said));
  }
  const test::Outcome none = test::run_shell(folder.path(), "PATH=/nowhere; exec \"$PROGRAM\" '" + scenario +
                                                                "' --scale smoke --format html --executor slurm");
  CAPTURE(none.err);
  CHECK(none.code == 3);
  CHECK(has(none.err, "there is no Slurm here (scontrol is not found)"));
  CHECK(fs::is_empty(folder.path()));
}
