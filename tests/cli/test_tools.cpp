// The program as used, with tools that fail: WeasyPrint, the GL driver, fonts, pipes that nobody reads, limits.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "engine/core/files.h"
#include "tests/cli/program.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

const std::string scenario = DEM_SOURCE_DIR "/scenarios/ldb_texture.toml";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A variable of the environment, for as long as this lives.
class Variable {
 public:
  Variable(const std::string& name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name.c_str())) before_ = before;
    ::setenv(name.c_str(), value.c_str(), 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { before_ ? ::setenv(name_.c_str(), before_->c_str(), 1) : ::unsetenv(name_.c_str()); }

 private:
  std::string name_;
  std::optional<std::string> before_;
};

/// The record of one case of the scenario, simulated once for all tests of this file.
class Simulated : public test::Scratch {
 public:
  Simulated() {
    const test::Outcome outcome = test::run_program(path(), {scenario, "--scale", "smoke", "--case", "genesis_ar_1",
                                                             "--only", "input_parameters", "--format", "html"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
  }
};

/// A folder with that record.
class Recorded : public test::Scratch {
 public:
  Recorded() {
    static const Simulated simulated;
    fs::copy(simulated / "out", *this / "out", fs::copy_options::recursive);
  }
};

/// A report of one record: the page is made and printed, and the exit code is 1, for the other cases have none.
test::Outcome report(const fs::path& folder, const Texts& more = {}, const test::WhileRunning& meanwhile = {}) {
  Texts words = {scenario, "--scale", "smoke", "--report-only", "--only", "input_parameters"};
  words.insert(words.end(), more.begin(), more.end());
  return test::run_program(folder, words, meanwhile);
}

fs::path study(const fs::path& folder) { return folder / "out" / "ldb_texture.smoke"; }
fs::path output(const fs::path& folder) { return study(folder) / "only.input_parameters"; }

/// A weasyprint that does what `script` says, "$pdf" being the file that it should write; first in PATH.
class FakeWeasyprint {
 public:
  explicit FakeWeasyprint(const std::string& script)
      : path_("PATH", folder_.path().string() + ":" + std::getenv("PATH")) {
    const fs::path program = folder_ / "weasyprint";
    std::ofstream(program) << "#!/bin/sh\nfor pdf; do :; done\n" << script << "\n";
    fs::permissions(program, fs::perms::owner_all);
  }

 private:
  test::Scratch folder_;
  Variable path_;
};

/// Files that are being written, or were left so.
int unfinished(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (has(entry.path().filename().string(), ".part")) ++count;
  }
  return count;
}

/// The number that a script has left in a file, once it is there.
int number_in(const fs::path& file) {
  int number = 0;
  test::wait_until([&] { return bool(std::ifstream(file) >> number); }, 60);
  return number;
}

bool ends(int process) {
  return test::wait_until(
      [&] {
        std::ifstream file("/proc/" + std::to_string(process) + "/stat");
        std::string line;
        return !std::getline(file, line) || has(line, ") Z");
      },
      2);
}

const std::string hangs = "sleep 600 & echo $! >pid.new; echo $$ >own; mv pid.new pid; wait";

}  // namespace

TEST_CASE("a PDF that is not whole, or a WeasyPrint that fails: exit code 3, its own words, and no PDF") {
  struct Broken {
    std::string script;
    Texts said;
  };
  const std::vector<Broken> all = {
      {"exit 0", {"left no whole PDF: it is empty", "it said nothing"}},
      {"echo nothing to print >&2", {"it is empty", "it said last: nothing to print"}},
      {"echo hello >\"$pdf\"", {"it does not begin like a PDF"}},
      {"printf '%%PDF-1.7\\n1 0 obj <</Type /Page>>' >\"$pdf\"", {"it ends too early"}},
      {"printf '%%PDF-1.7\\n<</Type /Pages /Count 0>>\\nstartxref\\n9\\n%%%%EOF\\n' >\"$pdf\"", {"it has no page"}},
      {"rm \"$pdf\"", {"cannot read"}},
      {"printf 'out of \\033[31mpaper\\a' >&2; exit 4", {"ended with status 4; it said last: out of  [31mpaper"}},
      {"echo 'ERROR: no ink' >&2", {"could not print the report: ERROR: no ink"}},
      {"kill -SEGV $$", {"weasyprint was ended by signal 11 (Segmentation fault)"}},
      {"kill -KILL $$", {"signal 9 (Killed), as a machine does that is out of memory"}},
      {"echo 'UserWarning: No fonts configured in FontConfig.' >&2; kill -SEGV $$", {"found no font"}},
  };
  const Recorded folder;
  for (const Broken& broken : all) {
    CAPTURE(broken.script);
    const FakeWeasyprint fake(broken.script);
    const test::Outcome outcome = report(folder.path());
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    for (const std::string& said : broken.said) CHECK(has(outcome.err, said));
    CHECK(outcome.err.find_first_of("\033\a") == std::string::npos);
    CHECK_FALSE(fs::exists(output(folder.path()) / "report.pdf"));
    CHECK(unfinished(folder.path()) == 0);
  }
}

TEST_CASE("a WeasyPrint that hangs is ended with all that it started: after its time, and with the program") {
  const FakeWeasyprint fake(hangs);
  SUBCASE("after its time") {
    const Recorded folder;
    const test::Outcome outcome = report(folder.path(), {"--pdf-timeout", "1"});
    CHECK(outcome.code == 3);
    CHECK(has(outcome.err, "still printing after 1 s and was ended: allow more with --pdf-timeout"));
    CHECK(ends(number_in(output(folder.path()) / "pid")));
    CHECK(unfinished(folder.path()) == 0);
  }
  SUBCASE("when a signal asks the program to stop, or WeasyPrint alone") {
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
      for (const bool alone : {false, true}) {
        if (alone && signal == SIGINT) continue;  // shells ignore it for what runs behind
        CAPTURE(signal);
        CAPTURE(alone);
        const Recorded folder;
        std::chrono::steady_clock::time_point sent;
        const test::Outcome outcome = report(folder.path(), {}, [&](int process) {
          number_in(output(folder.path()) / "pid");
          sent = std::chrono::steady_clock::now();
          ::kill(alone ? number_in(output(folder.path()) / "own") : process, signal);
        });
        CAPTURE(outcome.err);
        CHECK(std::chrono::steady_clock::now() - sent < std::chrono::seconds(2));
        CHECK(outcome.code == 128 + signal);
        CHECK(has(outcome.err, "give the same command to go on"));
        CHECK(ends(number_in(output(folder.path()) / "pid")));
        CHECK(unfinished(folder.path()) == 0);
      }
    }
  }
  SUBCASE("when the program is killed; what it left is gone after the next run") {
    const Recorded folder;
    const test::Outcome outcome = report(folder.path(), {}, [&](int process) {
      number_in(output(folder.path()) / "pid");
      ::kill(process, SIGKILL);
    });
    CHECK(outcome.code == 128 + SIGKILL);
    CHECK(ends(number_in(output(folder.path()) / "pid")));
    CHECK(unfinished(folder.path()) == 3);  // PDF, page and log
    CHECK(report(folder.path(), {"--format", "html"}).code == 1);
    CHECK(unfinished(folder.path()) == 0);
  }
}

TEST_CASE("drawing ends with 128 and the signal, whichever process gets it") {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    for (const bool alone : {false, true}) {
      CAPTURE(signal);
      CAPTURE(alone);
      const Recorded folder;
      std::chrono::steady_clock::time_point sent;
      const test::Outcome outcome = test::run_program(
          folder.path(), {scenario, "--scale", "smoke", "--report-only", "--format", "html", "--threads", "2"},
          [&](int process) {
            test::wait_until([&] { return fs::exists(study(folder.path()) / "data"); }, 60);
            std::vector<int> workers;
            test::wait_until([&] { return !(workers = test::children_of(process)).empty(); }, 60);
            sent = std::chrono::steady_clock::now();
            if (!workers.empty()) ::kill(alone ? workers.back() : process, signal);
          });
      CAPTURE(outcome.err);
      CHECK(std::chrono::steady_clock::now() - sent < std::chrono::seconds(2));
      CHECK(outcome.code == 128 + signal);
      CHECK(has(outcome.err, "give the same command to go on"));
      CHECK(unfinished(folder.path()) == 0);
    }
  }
}

TEST_CASE("what the machine lacks is named before anything is simulated: exit code 3") {
  struct Lack {
    std::string name, value, said;
  };
  const std::vector<Lack> all = {
      {"GALLIUM_DRIVER", "nonsense", "GALLIUM_DRIVER is 'nonsense', and OSMesa"},
      {"MESA_GL_VERSION_OVERRIDE", "3.2", "perhaps the reason: MESA_GL_VERSION_OVERRIDE=3.2"},
      {"SOURCE_DATE_EPOCH", "garbage", "SOURCE_DATE_EPOCH is 'garbage'"},
      {"SOURCE_DATE_EPOCH", "-1", "a whole number of seconds since 1970"},
      {"SOURCE_DATE_EPOCH", "", "SOURCE_DATE_EPOCH is ''"},
      {"PATH", "/nowhere", "--format html"},
  };
  for (const Lack& lack : all) {
    CAPTURE(lack.name);
    const test::Scratch folder;
    const Variable variable(lack.name, lack.value);
    const test::Outcome outcome = test::run_program(folder.path(), {scenario, "--scale", "smoke"});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(has(outcome.err, lack.said));
    CHECK_FALSE(has(outcome.err, "not installed"));
    CHECK(fs::is_empty(folder.path()));
  }
}

TEST_CASE("fonts that fontconfig does not know are named, and an empty environment is enough") {
  const Recorded folder;
  std::ofstream(folder / "empty.conf") << "<?xml version=\"1.0\"?><!DOCTYPE fontconfig SYSTEM \"fonts.dtd\">"
                                          "<fontconfig></fontconfig>";
  {
    const Variable fonts("FONTCONFIG_FILE", folder / "empty.conf");
    const test::Outcome outcome = report(folder.path());
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(has(outcome.err, "weasyprint found no font"));
    const test::Scratch fresh;  // before anything is simulated
    CHECK(test::run_program(fresh.path(), {scenario, "--scale", "smoke"}).code == 3);
    CHECK(fs::is_empty(fresh.path()));
  }
  const test::Outcome outcome = test::run_shell(
      folder.path(), "exec env -i \"$PROGRAM\" " + scenario + " --scale smoke --report-only --only input_parameters");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(fs::exists(output(folder.path()) / "report.pdf"));
}

TEST_CASE("a pipe that nobody reads changes nothing, a limit on the size of files is a full disk") {
  const Recorded folder;
  const std::string command = "\"$PROGRAM\" " + scenario +
                              " --scale smoke --report-only --only input_parameters "
                              "--format html";
  test::run_shell(folder.path(), "{ " + command + "; echo $? >code; } 2>&1 | true");
  CHECK(dem::read_file(folder / "code") == "1\n");
  CHECK(fs::exists(output(folder.path()) / "report.html"));
  const Recorded other;
  const test::Outcome full = test::run_shell(other.path(), "ulimit -f 8; " + command);
  CAPTURE(full.err);
  CHECK(full.code == 3);
  CHECK(has(full.err, "files may not grow larger here (ulimit -f)"));
  CHECK(unfinished(other.path()) == 0);
}
