// Many studies, references and what a CI reads, with the program as used.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "engine/core/files.h"
#include "tests/cli/program.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

const std::string scenario = DEM_SOURCE_DIR "/scenarios/quartzite_elastic.toml";  // a tenth of a second
const std::string study = "quartzite_elastic.smoke";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

test::Outcome run(const fs::path& folder, const Texts& more = {}) {
  Texts arguments = {scenario, "--scale", "smoke", "--format", "html"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::run_program(folder, arguments);
}

test::Outcome program(const fs::path& folder, const Texts& arguments) { return test::run_program(folder, arguments); }

/// A folder with a report that was accepted, made once.
class Accepted {
 public:
  Accepted() {
    const test::Outcome first = run(made().path(), {"--reference", "references"});
    INFO(first.err);
    REQUIRE(first.code == 0);
    first_ = first.out;
    REQUIRE(program(made().path(), {"accept", "quartzite_elastic", "--reason", "first"}).code == 0);
  }
  [[nodiscard]] const std::string& first() const { return first_; }
  /// A copy of it.
  static void copy(const fs::path& to) {
    static const Accepted once;
    fs::copy(made().path(), to, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    if (!has(once.first(), "; new, without a reference; out/"))
      FAIL("a study without a reference is told as new: " << once.first());
  }

 private:
  static const test::Scratch& made() {
    static const test::Scratch folder;
    return folder;
  }
  std::string first_;
};

std::string file(const fs::path& path) { return dem::read_file(path); }

}  // namespace

TEST_CASE("run again against the reference: nothing changed; the same bytes of the comparison") {
  const test::Scratch folder;
  Accepted::copy(folder.path());
  const test::Outcome again = run(folder.path(), {"--reference", "references"});
  INFO(again.err);
  CHECK(again.code == 0);
  CHECK(has(again.out, "nothing changed since the reference; out/" + study + "/report.html\n"));
  CHECK(has(file(folder / "out" / study / "report.html"), "<section id=\"since-reference\" class=\"since good\">"));
  const std::string page = file(folder / "out" / study / "comparison.html");
  CHECK(run(folder.path(), {"--reference", "references", "--report-only"}).code == 0);
  CHECK(file(folder / "out" / study / "comparison.html") == page);

  CHECK(program(folder.path(), {"compare", "references", "out", "-o", "one.html"}).code == 0);
  CHECK(program(folder.path(), {"compare", "references/" + study, "out/" + study, "-o", "two.html"}).code == 0);
  CHECK(file(folder / "one.html") == file(folder / "two.html"));
  // Without --reference nothing is left that an index would take for this run's.
  CHECK(run(folder.path()).code == 0);
  CHECK_FALSE(fs::exists(folder / "out" / study / "comparison.json"));
}

TEST_CASE("a key changed: 1, the key is named, the rest of the report is there; accepted item by item") {
  const test::Scratch folder;
  Accepted::copy(folder.path());
  const test::Outcome changed =
      run(folder.path(), {"--reference", "references", "--set", "rock.young_modulus=\"90.9 GPa\""});
  CHECK(changed.code == 1);
  CHECK(has(changed.out, "changed: "));
  CHECK(has(changed.err, "since the reference"));
  const std::string page = file(folder / "out" / study / "report.html");
  CHECK(has(page, "rock.young_modulus: 90\u00a0GPa -&gt; 90.9\u00a0GPa"));
  CHECK(page.find("since-reference") < page.find("id=\"findings\""));
  const test::Outcome compared = program(folder.path(), {"compare", "references", "out"});
  CHECK(compared.code == 1);
  CHECK(has(compared.out, "why: rock.young_modulus: 90 GPa -> 90.9 GPa"));
  CHECK(fs::exists(folder / "comparison.html"));
  CHECK(std::system(("/usr/bin/python3 -W ignore -m jsonschema -i '" + (folder / "comparison.json").string() +
                     "' '" DEM_SOURCE_DIR "/assets/comparison.schema.json'")
                        .c_str()) == 0);
  CHECK(program(folder.path(), {"accept", study, "--item", "results/*", "--reason", "stiffer"}).code == 0);
  const test::Outcome partly = program(folder.path(), {"compare", "references", "out"});
  CHECK(partly.code == 1);
  CHECK_FALSE(has(partly.out, " results"));
  CHECK(program(folder.path(), {"accept", "--all", "--reason", "stiffer"}).code == 0);
  CHECK(program(folder.path(), {"compare", "references", "out"}).code == 0);
  const std::string log = file(folder / "references/accepted.jsonl");
  CHECK(std::ranges::count(log, '\n') == 3);
}

TEST_CASE("several studies: one that cannot run is told, the others are made; index, JUnit, Markdown and history") {
  const test::Scratch folder;
  Accepted::copy(folder.path());
  fs::copy(scenario, folder / "other.toml");
  dem::write_file(folder / "out/other.smoke/figures", "a file in the way");
  const test::Outcome outcome =
      program(folder.path(), {"other.toml", scenario, "--scale", "smoke", "--format", "html", "--junit", "ci/junit.xml",
                              "--markdown", "ci/summary.md", "--history", "history.jsonl", "--label", "abc123"});
  CHECK(outcome.code == 3);
  CHECK(has(outcome.err, "[1/2] other.smoke: "));
  CHECK(has(outcome.err, "[2/2] quartzite_elastic.smoke: "));
  CHECK(has(outcome.err, "all: about "));
  CHECK(has(outcome.out, "quartzite_elastic smoke: "));
  const std::string page = file(folder / "out/index.html");
  CHECK(has(page, "2 studies, 1 failed"));
  CHECK(has(page, "out/other.smoke/figures"));
  CHECK(has(file(folder / "out/index.json"), "\"error\": "));
  CHECK(has(file(folder / "ci/junit.xml"), "<testsuites name=\"dem-report\""));
  CHECK(has(file(folder / "ci/summary.md"), "| other.smoke | **failed** |"));
  CHECK(std::ranges::count(file(folder / "history.jsonl"), '\n') == 2);
  CHECK(has(file(folder / "history.jsonl"), "\"label\":\"abc123\""));
  const std::string before = file(folder / "out/index.json");
  CHECK(program(folder.path(), {"index", "out"}).code == 0);
  CHECK(has(file(folder / "out/index.json"), "\"error\": "));
  CHECK(program(folder.path(), {"index", "out", "--history", "history.jsonl"}).code == 0);
  CHECK(file(folder / "out/index.json") == before);
}

TEST_CASE("colours on a terminal that wants them, for what is not well, and nowhere else") {
  const test::Scratch folder;
  Accepted::copy(folder.path());
  // A terminal for stdout alone: one that rules the process would stop the tests when they run in the background.
  dem::write_file(folder / "terminal.py",
                  "import os, subprocess, sys\n"
                  "master, slave = os.openpty()\n"
                  "nothing = subprocess.DEVNULL\n"
                  "program = subprocess.Popen(sys.argv[1:], stdin=nothing, stdout=slave, stderr=nothing)\n"
                  "os.close(slave)\n"
                  "try:\n"
                  "    while part := os.read(master, 65536):\n"
                  "        sys.stdout.buffer.write(part)\n"
                  "except OSError:\n"
                  "    pass\n"
                  "sys.exit(program.wait())\n");
  const auto on_terminal = [&](const std::string& environment) {
    const std::string words = " --scale smoke --format html --report-only --reference references";
    return test::run_shell(folder.path(), "unset NO_COLOR; " + environment +
                                              " /usr/bin/python3 terminal.py \"$PROGRAM\" '" + scenario + "'" + words);
  };
  const test::Outcome well = on_terminal("TERM=xterm");
  CHECK(well.code == 0);
  CHECK(has(well.out, "quartzite_elastic smoke: "));
  CHECK_FALSE(has(well.out, "\033[31m"));
  dem::write_file(folder / "references" / study / "reference.json", "{");  // cannot be read: not well
  const test::Outcome red = on_terminal("TERM=xterm");
  CHECK(red.code == 1);
  CHECK(has(red.out, "\033[31mquartzite_elastic smoke: "));
  for (const char* environment : {"NO_COLOR=1 TERM=xterm", "TERM=dumb"}) {
    const test::Outcome plain = on_terminal(environment);
    CHECK(plain.code == 1);
    CHECK(has(plain.out, "quartzite_elastic smoke: "));
    CHECK_FALSE(has(plain.out, "\033[31m"));
  }
}

TEST_CASE("a dry run says what would be simulated, and writes nothing") {
  const test::Scratch folder;
  const test::Outcome fresh = run(folder.path(), {"--dry-run"});
  CHECK(fresh.code == 0);
  CHECK(has(fresh.out, study + ": 4 of 4 cases to simulate, about "));
  CHECK(has(fresh.out, ": to simulate, no record yet; about "));
  CHECK(has(fresh.out, "nothing was written"));
  CHECK(fs::is_empty(folder.path()));
  Accepted::copy(folder.path());
  CHECK(has(run(folder.path(), {"--dry-run"}).out, study + ": 0 of 4 cases to simulate"));
  CHECK(has(run(folder.path(), {"--dry-run", "--set", "rock.young_modulus=\"91 GPa\""}).out,
            "to simulate, rock.young_modulus: 90 GPa -> 91 GPa; about"));
}

TEST_CASE("progress as JSON: an object a line") {
  const test::Scratch folder;
  const test::Outcome outcome = run(folder.path(), {"--progress", "json"});
  CHECK(outcome.code == 0);
  dem::write_file(folder / "lines", outcome.err);
  dem::write_file(folder / "read.py",
                  "import json, sys\n"
                  "events = [json.loads(line)['event'] for line in open(sys.argv[1])]\n"
                  "assert events.count('begin') == 4 and events.count('end') == 4 and 'count' in events, events\n");
  CHECK(std::system(("/usr/bin/python3 '" + (folder / "read.py").string() + "' '" + (folder / "lines").string() + "'")
                        .c_str()) == 0);
}

TEST_CASE("on GitHub an error of a scenario is an annotation at its place") {
  const test::Scratch folder;
  dem::write_file(folder / "bad.toml", "model = \"lattice\"\ntests = [\"elastic\"]\nsede = 3\n");
  const std::string command = "\"$PROGRAM\" bad.toml --scale smoke";
  const test::Outcome here = test::run_shell(folder.path(), "unset GITHUB_ACTIONS\n" + command);
  CHECK(here.code == 2);
  CHECK(here.out.empty());
  const test::Outcome there = test::run_shell(folder.path(), "GITHUB_ACTIONS=true " + command);
  CHECK(there.code == 2);
  CHECK(there.out.starts_with("::error file=bad.toml,line="));
}

TEST_CASE("what does not go together, and folders that are not there: 2, and why") {
  const test::Scratch folder;
  dem::write_file(folder / "wrong/tolerances.toml", "[[tolerance]]\nitem = \"*\"\nrelative = 0.1\n");
  const std::vector<std::pair<Texts, std::string>> wrong = {
      {{"compare", "a"}, "no old is given"},
      {{"compare", "a", "b"}, "OLD: there is no folder a"},
      {{"compare", ".", "."}, "no report and no reference lies in ."},
      {{"accept", "x", "--reason", "y"}, "x: no report of that name lies in out"},
      {{"accept", "x"}, "--reason: no reason is given"},
      {{"accept", "--reason", "y"}, "no study is named"},
      {{"accept", "x", "--all", "--reason", "y"}, "no report of that name lies in out"},
      {{"index", "nowhere"}, "DIR: there is no folder nowhere"},
      {{"index", "."}, "no study lies in ."},
      {{scenario, "--reference", "r", "--only", "quartzite_unit"}, "--reference: does not go with --only or --case"},
      {{scenario, "--reference", "wrong"}, "tolerances.toml:1:1: reason: it is missing"},
      {{scenario, "--label", "x"}, "--label: it names a line of a history"},
      {{scenario, "--progress", "xml"}, "unknown progress 'xml'"}};
  for (const auto& [arguments, why] : wrong) {
    CAPTURE(why);
    const test::Outcome outcome = program(folder.path(), arguments);
    CHECK(outcome.code == 2);
    CHECK_MESSAGE(has(outcome.err, why), outcome.err);
    CHECK_FALSE(fs::exists(folder / "out"));
  }
}

TEST_CASE("killed while it accepts, writes the index or the history: nothing half-written, nothing lost") {
  const test::Scratch folder;
  Accepted::copy(folder.path());
  CHECK(run(folder.path(), {"--set", "rock.young_modulus=\"91 GPa\"", "--history", "history.jsonl"}).code == 0);
  const std::string old_reference = file(folder / "references" / study / "reference.json");
  const std::string night = file(folder / "history.jsonl");
  std::mt19937 random(5);
  const auto killed = [&](const Texts& arguments) {
    const auto pause = std::chrono::microseconds(random() % 60000);
    test::run_program(folder.path(), arguments, [&](int process) {
      std::this_thread::sleep_for(pause);
      ::kill(process, SIGKILL);
    });
  };
  for (int round = 0; round < 6; ++round) {
    killed({"accept", "--all", "--reason", "killed"});
    const int code = program(folder.path(), {"compare", "references", "out", "--quiet"}).code;
    const bool is_old = file(folder / "references" / study / "reference.json") == old_reference;
    CHECK(code == (is_old ? 1 : 0));
    killed({"index", "out"});
    if (fs::exists(folder / "out/index.html")) CHECK(has(file(folder / "out/index.html"), "</html>"));
  }
  CHECK(program(folder.path(), {"accept", "--all", "--reason", "to the end"}).code == 0);
  CHECK(program(folder.path(), {"index", "out"}).code == 0);
  CHECK(program(folder.path(), {"compare", "references", "out", "--quiet"}).code == 0);
  CHECK(file(folder / "history.jsonl") == night);
  const test::Outcome left =
      test::run_shell(folder.path(), "find references out -maxdepth 2 -name '.*.part*' -o -name accepting.json");
  CHECK(left.out == "");
}
