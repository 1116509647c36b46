// The program as used, on the shipped scenario at its smallest scale.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include "engine/core/files.h"
#include "tests/cli/program.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

const std::string scenario = DEM_SOURCE_DIR "/scenarios/ldb_aspect_ratio.toml";
const std::string id = "direct_tension_ar_1";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// One case of the smoke scale, one figure, no PDF: the least that is a whole run.
test::Outcome run(const fs::path& folder, const Texts& more = {}, const test::WhileRunning& meanwhile = {}) {
  Texts arguments = {scenario,
                     "--scale",
                     "smoke",
                     "--case",
                     id,
                     "--only",
                     "stress_strain",
                     "--format",
                     "html",
                     "--set",
                     "direct_tension.rate=1e-7"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::run_program(folder, arguments, meanwhile);
}

fs::path study_folder(const fs::path& folder) { return folder / "out" / "ldb_aspect_ratio.smoke"; }
fs::path output(const fs::path& folder) { return study_folder(folder) / ("case." + id + ".only.stress_strain"); }
fs::path record(const fs::path& folder) { return study_folder(folder) / "cases" / id / "results.h5"; }

/// The exit code that the checks of a study call for: 1 when one of them does not hold.
int due_code_of(const fs::path& study) {
  return has(dem::read_file(study / "summary.json"), "\"held\": false") ? 1 : 0;
}
int due_code(const fs::path& folder) { return due_code_of(output(folder)); }

/// The record of an uncut run with one thread, made once for all tests of this file.
const std::string& uncut_record() {
  static const std::string bytes = [] {
    const test::Scratch folder;
    const test::Outcome outcome = run(folder.path(), {"--threads", "1"});
    INFO(outcome.err);
    REQUIRE(outcome.code == due_code(folder.path()));
    return dem::read_file(record(folder.path()));
  }();
  return bytes;
}

/// Files in `folder` that are not being written.
int whole_files(const fs::path& folder) {
  int count = 0;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (!at->path().filename().string().starts_with(".")) ++count;
  }
  return count;
}

/// Sends a signal while the case is being loaded: its packing and its grains are there, its record is not.
test::WhileRunning signalled(const fs::path& folder, int signal) {
  return [=](int process) {
    for (int i = 0; i < 12000 && whole_files(folder / "out" / "specimens") < 2; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ::kill(process, signal);
  };
}

}  // namespace

TEST_CASE("a run leaves what it promises, a second one keeps it, and both give the same bytes") {
  const test::Scratch folder;
  const test::Outcome first = run(folder.path(), {"--threads", "2"});
  CAPTURE(first.err);
  REQUIRE(first.code == due_code(folder.path()));
  CHECK(has(first.err, id + " ("));
  CHECK(has(first.err, "starting, no record yet"));
  const fs::path out = output(folder.path());
  for (const char* name :
       {"report.html", "summary.json", "run.json", "ro-crate-metadata.json", "inputs", "figures", "data"}) {
    CAPTURE(name);
    CHECK(fs::exists(out / name));
  }
  CHECK_FALSE(fs::exists(out / "report.pdf"));
  CHECK_FALSE(fs::exists(record(folder.path()).parent_path() / "checkpoint"));
  CHECK(has(first.out, "out/ldb_aspect_ratio.smoke/case." + id + ".only.stress_strain/report.html\n"));
  CHECK_FALSE(fs::exists(study_folder(folder.path()) / "report.html"));  // that of the whole study stays
  CHECK(dem::read_file(record(folder.path())) == uncut_record());        // however many threads
  const std::string page = dem::read_file(out / "report.html");
  const std::string summary = dem::read_file(out / "summary.json");

  const test::Outcome second = run(folder.path(), {"--threads", "1"});
  CHECK(second.code == due_code(folder.path()));
  CHECK(has(second.err, id + ": kept"));
  CHECK_FALSE(has(second.err, "starting"));
  CHECK(dem::read_file(out / "report.html") == page);
  CHECK(dem::read_file(out / "summary.json") == summary);

  const test::Outcome redrawn = run(folder.path(), {"--report-only", "--quiet"});
  CHECK(redrawn.code == due_code(folder.path()));
  CHECK(redrawn.out.empty());
  CHECK(redrawn.err.empty() == (redrawn.code == 0));
  CHECK_FALSE(has(redrawn.err, "kept"));
  CHECK(dem::read_file(out / "summary.json") == summary);

  const test::Outcome other = run(folder.path(), {"--seed", "2", "--threads", "1"});
  CHECK(other.code == due_code(folder.path()));
  CHECK(has(other.err, "starting, seed: 1 -> 2"));
}

TEST_CASE("a run that is stopped by a signal says so, and goes on to the same bytes") {
  for (const int signal : {SIGINT, SIGTERM}) {
    CAPTURE(signal);
    const test::Scratch folder;
    const test::Outcome cut = run(folder.path(), {"--threads", "1"}, signalled(folder.path(), signal));
    CAPTURE(cut.err);
    REQUIRE(cut.code == 128 + signal);
    CHECK(has(cut.err, "give the same command to go on"));
    CHECK(fs::exists(record(folder.path()).parent_path() / "checkpoint"));
    CHECK_FALSE(fs::exists(record(folder.path())));
    CHECK_FALSE(fs::exists(output(folder.path()) / "report.html"));

    const test::Outcome resumed = run(folder.path(), {"--threads", "1"});
    CHECK(resumed.code == due_code(folder.path()));
    CHECK(has(resumed.err, "goes on from its checkpoint"));
    CHECK(dem::read_file(record(folder.path())) == uncut_record());
    CHECK_FALSE(fs::exists(record(folder.path()).parent_path() / "checkpoint"));
  }
}

TEST_CASE("cases side by side: the same summary for any number of threads, and a signal keeps the state of all") {
  const auto run_two = [](const fs::path& folder, const std::string& threads,
                          const test::WhileRunning& meanwhile = {}) {
    return test::run_program(
        folder,
        {DEM_SOURCE_DIR "/scenarios/ldb_dip_angle.toml", "--scale", "smoke", "--set", "tests=[\"direct_tension\"]",
         "--set", "sweep.dip=[\"0 deg\", \"90 deg\"]", "--set", "direct_tension.rate=1e-7", "--only", "stress_strain",
         "--format", "html", "--threads", threads},
        meanwhile);
  };
  const fs::path study = fs::path("out/ldb_dip_angle.smoke"), report = study / "only.stress_strain";
  std::string summary, page;
  for (const char* threads : {"1", "2", "3"}) {
    CAPTURE(threads);
    const test::Scratch folder;
    const test::Outcome outcome = run_two(folder.path(), threads);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == due_code_of(folder.path() / report));
    CHECK(has(outcome.err, "direct_tension_ar_2_dip_0 (1/2): starting"));
    CHECK(has(outcome.err, "direct_tension_ar_2_dip_90 (2/2): starting"));
    CHECK(whole_files(folder.path() / "out" / "specimens") == 2);
    if (summary.empty()) {
      summary = dem::read_file(folder.path() / report / "summary.json");
      page = dem::read_file(folder.path() / report / "report.html");
    }
    CHECK(dem::read_file(folder.path() / report / "summary.json") == summary);
    CHECK(dem::read_file(folder.path() / report / "report.html") == page);
  }

  const test::Scratch folder;
  const test::Outcome cut = run_two(folder.path(), "2", signalled(folder.path(), SIGTERM));
  CAPTURE(cut.err);
  REQUIRE(cut.code == 128 + SIGTERM);
  const fs::path cases = folder.path() / study / "cases";
  for (const char* one : {"direct_tension_ar_2_dip_0", "direct_tension_ar_2_dip_90"}) {
    CAPTURE(one);
    CHECK(fs::exists(cases / one / "checkpoint"));
    CHECK_FALSE(fs::exists(cases / one / "results.h5"));
  }
  const test::Outcome resumed = run_two(folder.path(), "2");
  CHECK(resumed.code == due_code_of(folder.path() / report));
  CHECK(has(resumed.err, "direct_tension_ar_2_dip_0 (1/2): starting, no record yet; goes on from its checkpoint"));
  CHECK(has(resumed.err, "direct_tension_ar_2_dip_90 (2/2): starting, no record yet; goes on from its checkpoint"));
  CHECK(dem::read_file(folder.path() / report / "summary.json") == summary);
}

TEST_CASE("a run that is killed leaves nothing half-written, and the next one the same bytes") {
  const test::Scratch folder;
  const test::Outcome killed = run(folder.path(), {"--threads", "1"}, signalled(folder.path(), SIGKILL));
  REQUIRE(killed.code == 128 + SIGKILL);
  CHECK_FALSE(fs::exists(record(folder.path())));
  const fs::path left = record(folder.path()).parent_path() / ".results.h5.abcdef.part";
  dem::write_file(left, "half a record of nobody that is known");
  const test::Outcome again = run(folder.path(), {"--threads", "1"});
  CHECK(again.code == due_code(folder.path()));
  CHECK(dem::read_file(record(folder.path())) == uncut_record());
  CHECK(fs::exists(left));
  // The record, run.json and what was left.
  CHECK(std::distance(fs::directory_iterator(record(folder.path()).parent_path()), {}) == 3);
}

TEST_CASE("stopped while the specimen is packed: nothing is promised that is not there") {
  const test::Scratch folder;
  const test::Outcome cut = run(folder.path(), {"--threads", "1"}, [&](int process) {
    test::wait_until([&] { return fs::exists(record(folder.path()).parent_path()); }, 60);
    ::kill(process, SIGTERM);
  });
  CAPTURE(cut.err);
  REQUIRE(cut.code == 128 + SIGTERM);
  REQUIRE_FALSE(fs::exists(record(folder.path()).parent_path() / "checkpoint"));
  CHECK(has(cut.err, "had no state to keep yet and begins anew: give the same command to go on"));
  CHECK_FALSE(has(cut.err, "state of those"));
}

TEST_CASE("a damaged specimen is made again, and a note says so") {
  const test::Scratch folder;
  const auto make = [&] {
    return test::run_program(
        folder.path(), {DEM_SOURCE_DIR "/scenarios/ldb_texture.toml", "--scale", "smoke", "--case", "genesis_ar_1",
                        "--only", "genesis_contacts", "--format", "html", "--force"});
  };
  const test::Outcome first = make();
  REQUIRE(first.code == 0);
  CHECK_FALSE(has(first.err, "made again"));
  std::map<fs::path, std::string> whole;
  for (const auto& entry : fs::directory_iterator(folder / "out/specimens")) {
    whole[entry.path()] = dem::read_file(entry.path());
  }
  REQUIRE(whole.size() == 2);
  for (const auto& [path, bytes] : whole) dem::write_file(path, bytes.substr(0, bytes.size() / 2));
  const test::Outcome again = make();
  CHECK(again.code == 0);
  CHECK(has(again.err, "genesis_ar_1: the specimen is made again: "));
  for (const auto& [path, bytes] : whole) CHECK(dem::read_file(path) == bytes);
}

TEST_CASE("--report-only without records is one line and exit code 2; with some of them a report is made") {
  const test::Scratch folder;
  const test::Outcome outcome = run(folder.path(), {"--report-only"});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(outcome.err == "dem-report: " + scenario +
                           ": --report-only: there is no record to draw from in out/ldb_aspect_ratio.smoke (" + id +
                           ": no record yet); run it once without --report-only\n");
  CHECK(fs::is_empty(folder.path()));

  const Texts texture = {DEM_SOURCE_DIR "/scenarios/ldb_texture.toml", "--scale", "smoke", "--format", "html"};
  const auto with = [&](const Texts& more) {
    Texts words = texture;
    words.insert(words.end(), more.begin(), more.end());
    return test::run_program(folder.path(), words);
  };
  REQUIRE(with({"--case", "genesis_ar_1", "--only", "genesis_contacts"}).code == 0);
  const test::Outcome some = with({"--report-only", "--only", "genesis_contacts"});
  CAPTURE(some.err);
  CHECK(some.code == 1);
  CHECK(has(some.err, "failed: There is no record to draw from (no record yet)"));
  CHECK(has(dem::read_file(folder / "out/ldb_texture.smoke/only.genesis_contacts/report.html"),
            "There is no record to draw from"));
}

TEST_CASE("the same scenario gives the same report from any folder, by any path, for any number of threads") {
  const test::Scratch folder;
  const fs::path home = folder.path() / "home", away = folder.path() / "far/away";
  fs::create_directories(home / "rocks");
  fs::create_directories(away);
  for (const char* file : {"ldb_texture.toml", "rocks/lac_du_bonnet.toml"})
    fs::copy(fs::path(DEM_SOURCE_DIR) / "scenarios" / file, home / file);
  const Texts common = {"--scale", "smoke", "--case", "genesis_ar_1", "--only", "genesis_contacts"};
  const auto made = [&](const fs::path& from, const Texts& words) {
    Texts all = words;
    all.insert(all.end(), common.begin(), common.end());
    const test::Outcome outcome = test::run_program(from, all);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const fs::path report = from / "out/ldb_texture.smoke/case.genesis_ar_1.only.genesis_contacts";
    Texts bytes;
    for (const char* name : {"report.html", "report.pdf", "summary.json"})
      bytes.push_back(dem::read_file(report / name));
    return bytes;
  };
  const Texts first = made(home, {"ldb_texture.toml", "--threads", "1"});
  CHECK(has(first[0], "./dem-report scenarios/ldb_texture.toml"));
  CHECK(has(first[0], "dem-report /usr/share/dem-report/scenarios/ldb_texture.toml"));
  const Texts second = made(away, {(home / "ldb_texture.toml").string(), "--threads", "2"});
  const Texts third = made(away, {"../../home/rocks/../ldb_texture.toml", "--threads", "1"});
  for (const Texts& other : {second, third}) {
    for (std::size_t i = 0; i < first.size(); ++i) CHECK((first[i] == other[i]));
  }
}

TEST_CASE("output that cannot be written: exit code 3, the path is named") {
  const test::Scratch folder;
  dem::write_file(folder / "out", "a file in the way");
  const test::Outcome outcome = run(folder.path());
  CHECK(outcome.code == 3);
  CHECK(has(outcome.err, "dem-report: cannot make the folder out"));
  CHECK(dem::read_file(folder / "out") == "a file in the way");
}

TEST_CASE("a specimen can be made and reported without being loaded") {
  const test::Scratch folder;
  const test::Outcome made =
      test::run_program(folder.path(), {DEM_SOURCE_DIR "/scenarios/ldb_texture.toml", "--scale", "smoke", "--case",
                                        "genesis_ar_1", "--only", "genesis_contacts", "--format", "html"});
  INFO(made.err);
  REQUIRE(made.code == 0);
  const fs::path output = folder.path() / "out/ldb_texture.smoke/case.genesis_ar_1.only.genesis_contacts";
  CHECK(has(dem::read_file(output / "summary.json"), "genesis_ar_1.packing_pressure"));
  CHECK(fs::exists(output / "figures" / "genesis_contacts_laws.png"));
  CHECK(has(dem::read_file(output / "report.html"), "Contacts by group and by law"));
}

TEST_CASE("published numbers stand beside the rock that they belong to only") {
  const test::Scratch folder;
  const Texts common = {"--scale", "smoke", "--case", "genesis_ar_1", "--only", "input_parameters", "--format", "html"};
  Texts paper = {DEM_SOURCE_DIR "/scenarios/ldb_texture.toml"}, own = paper;
  paper.insert(paper.end(), common.begin(), common.end());
  own.insert(own.end(), common.begin(), common.end());
  const test::Outcome granite = test::run_program(folder.path(), paper);
  INFO(granite.err);
  REQUIRE(granite.code == 0);
  const fs::path report = folder.path() / "out/ldb_texture.smoke/case.genesis_ar_1.only.input_parameters/report.html";
  CHECK(has(dem::read_file(report), "Targets of the calibration (Table\u00a02)"));
  // With the granite's reading of the text: the scenario's other readings are other specimens then.
  own.insert(own.end(), {"--set", "include=\"" DEM_SOURCE_DIR "/scenarios/rocks/my_rock.toml\"", "--set",
                         "texture.seed_scale=0.669", "--set", "texture.growth=\"deepest_contact\""});
  const test::Outcome mine = test::run_program(folder.path(), own);
  INFO(mine.err);
  REQUIRE(mine.code == 0);
  const std::string text = dem::read_file(report);
  CHECK_FALSE(has(text, "Targets of the calibration (Table\u00a02)"));
  CHECK(has(text, "feldspar"));
  CHECK_FALSE(has(text, "<strong>Published.</strong>"));
  CHECK_FALSE(has(text, "Published numbers beside ours"));
}
