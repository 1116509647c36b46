// Many studies on one page, the files that CI reads, and numbers night by night.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "engine/core/append.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/overview/for_ci.h"
#include "reports/overview/history.h"
#include "reports/overview/index.h"
#include "tests/reports/made_report.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using overview::StudyRow;

const fs::path assets = DEM_SOURCE_DIR "/assets";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Four studies: one is well, one has a broken check, one changed, one could not run.
void write_studies(const fs::path& output) {
  test::MadeReport{}.write(output, "alpha");
  dem::write_file(output / "alpha.smoke/run.json",
                  R"({"case_seconds": {"compression_ar_1": 2.5}, "report_seconds": 1})");
  test::MadeReport broken;
  broken.check_holds = false;
  broken.verdict = "missed";
  broken.write(output, "beta");
  test::MadeReport{}.write(output, "gamma");
  dem::write_file(output / "gamma.smoke/comparison.json",
                  R"({"format": 1, "same": false, "studies": [{"study": "gamma.smoke", "state": "changed",
                      "sentence": "changed: 1 of 2 results", "causes": [{"cause": "seed: 1 -> 2", "cases": []}],
                      "counts": {}, "changed": [{"id": "results/a|b", "state": "beyond_tolerance", "old": "1 <MPa>",
                      "new": "2 & 3", "difference": "+100 %"}], "same": ["results/c"]}]})");
  dem::write_file(output / "delta.smoke/run.json", "{\"error\": \"no memory <left> & \\u001b[31mred\"}");
}

int run(const std::string& command) { return WEXITSTATUS(std::system(command.c_str())); }

}  // namespace

TEST_CASE("the index: what failed first, filters without scripts, errors shown, both files whole") {
  const test::Scratch folder;
  write_studies(folder.path());
  const std::vector<StudyRow> rows = overview::read_rows(folder.path(), true);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].folder == "delta.smoke");  // could not run
  CHECK(rows[1].folder == "beta.smoke");
  CHECK(rows[2].folder == "gamma.smoke");
  CHECK(rows[3].folder == "alpha.smoke");
  CHECK(rows[3].verdict() == "2 of 2 checks held; 1 of 1 published numbers met");
  CHECK(rows[3].seconds == 3.5);
  CHECK(rows[1].verdict() == "0 of 2 checks held; 0 of 1 published numbers met, 1 missed");
  StudyRow none = rows[3];  // at another scale than the published one
  none.published = {{"a", "", "not judged"}, {"b", "", "not computed"}};
  CHECK(none.verdict() == "2 of 2 checks held; none of 2 published numbers judged at this scale, 1 not computed");
  overview::write_index(folder.path(), rows, nullptr, assets);
  const std::string page = dem::read_file(folder / "index.html");
  CHECK_FALSE(has(page, "<script"));
  CHECK(has(page, "4 studies, 2 failed, 1 changed"));
  CHECK(has(page, "no memory &lt;left&gt; &amp;"));
  CHECK(has(page, "href=\"alpha.smoke/report.html\""));
  CHECK(has(page, "data:image/png;base64,"));
  const std::string json = dem::read_file(folder / "index.json");
  CHECK(has(json, "\"state\": \"failed\""));
  dem::write_file(folder / "index.json", json);
  CHECK(run("/usr/bin/python3 -W ignore -m jsonschema -i '" + (folder / "index.json").string() + "' '" +
            (assets / "index.schema.json").string() + "'") == 0);
}

TEST_CASE("a study whose files are damaged stops no other") {
  const test::Scratch folder;
  write_studies(folder.path());
  dem::write_file(folder / "alpha.smoke/summary.json", "{\"format\": 2, \"scen");
  const std::vector<StudyRow> rows = overview::read_rows(folder.path(), true);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].folder == "alpha.smoke");
  CHECK(has(rows[0].error, "cut short or damaged"));
}

TEST_CASE("JUnit: the form that Jenkins reads, and what another parser makes of it") {
  const test::Scratch folder;
  write_studies(folder / "out");
  const std::vector<StudyRow> rows = overview::read_rows(folder / "out", false);
  for (const bool strict : {false, true}) {
    const std::string file = folder / "junit.xml";
    dem::write_file(file, overview::junit(rows, strict));
    CHECK(run("xmllint --noout --schema '" DEM_SOURCE_DIR "/tests/reports/junit.xsd' '" + file + "' 2>/dev/null") == 0);
    dem::write_file(folder / "read.py", R"(
import sys
from junitparser import JUnitXml, Error, Failure, Skipped
xml = JUnitXml.fromfile(sys.argv[1])
found = {}
for suite in xml:
    kinds = [type(r).__name__ for case in suite for r in case.result]
    assert suite.tests == len(list(suite)), (suite.name, suite.tests)
    assert suite.failures == kinds.count("Failure") and suite.errors == kinds.count("Error"), suite.name
    found[suite.name] = (suite.tests, suite.failures, suite.errors)
    for case in suite:
        if case.name == "compression_ar_1" and suite.name == "alpha.smoke":
            assert case.time == 2.5, case.time
        if case.classname == "gamma.smoke.reference" and case.result:
            assert case.name == "results/a|b" and "1 <MPa> -> 2 & 3" in case.result[0].message
print(found)
strict = int(sys.argv[2])
assert found == {"delta.smoke": (1, 0, 1), "beta.smoke": (6, 2 + strict, 0), "gamma.smoke": (8, 1, 0), "alpha.smoke": (6, 0, 0)}, found
)");
    CHECK(run("/usr/bin/python3 '" + (folder / "read.py").string() + "' '" + file + "' " + (strict ? "1" : "0")) == 0);
  }
}

TEST_CASE("Markdown: short, whatever was run, with nothing that would break its table") {
  const test::Scratch folder;
  write_studies(folder.path());
  std::vector<StudyRow> rows = overview::read_rows(folder.path(), false);
  const std::string text = overview::markdown(rows);
  CHECK(has(text, "## 4 studies: 2 failed, 1 changed, 1 well\n"));
  CHECK(has(text, "- results/a\\|b: 1 \\<MPa> -> 2 & 3; +100 %"));
  CHECK(has(text, "- why: seed: 1 -> 2"));
  for (int i = 0; i < 40; ++i) {
    StudyRow row = rows[2];
    for (int k = 0; k < 200; ++k)
      row.changes.push_back({"results/" + std::string(80, 'x'), "beyond_tolerance", true, std::string(200, 'y')});
    rows.push_back(row);
  }
  const std::string all = overview::markdown(rows);
  CHECK(all.size() < 60'000);
  CHECK(has(all, "parts more are on the page index.html"));
}

TEST_CASE("annotations of GitHub") {
  CHECK(overview::github_annotation("a,b.toml", 3, 7, "50 %\nis wrong") ==
        "::error file=a%2Cb.toml,line=3,col=7::50 %25%0Ais wrong");
  CHECK(overview::github_annotation("", 0, 0, "no scenario") == "::error::no scenario");
}

TEST_CASE("history: whole lines, half ones left out and taken away") {
  const test::Scratch folder;
  write_studies(folder / "out");
  const fs::path file = folder / "history.jsonl";
  const std::vector<StudyRow> rows = {overview::read_row(folder / "out/alpha.smoke", false)};
  overview::append_history(file, rows, "abc", "2026-01-01");
  const std::string line = dem::read_file(file);
  dem::write_file(file, line + line.substr(0, line.size() / 2));  // killed while it wrote
  CHECK(overview::read_history(file).nights.size() == 1);
  overview::append_history(file, rows, "def", "2026-01-02");
  const overview::History history = overview::read_history(file);
  REQUIRE(history.nights.size() == 2);
  CHECK(history.damaged == 0);
  CHECK(history.nights[1].label == "def");
  const auto series = overview::series_of(history, "alpha.smoke");
  CHECK(std::ranges::find(series, "results/compression_ar_1/compressive_strength", &overview::Series::id) !=
        series.end());
  CHECK(std::ranges::find(series, "seconds/compression_ar_1", &overview::Series::id) != series.end());
  dem::write_file(file, "no json\n" + line);
  CHECK(overview::read_history(file).damaged == 1);
  CHECK_THROWS_AS(overview::read_history(folder / "none.jsonl"), dem::InputError);
}

TEST_CASE("processes that append at once lose nothing, also when one is killed") {
  const test::Scratch folder;
  const fs::path file = folder / "history.jsonl";
  constexpr int processes = 4, lines = 50;
  std::vector<pid_t> children;
  for (int p = 0; p < processes; ++p) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      for (int i = 0; i < lines; ++i)
        dem::append_line(file, std::to_string(p) + " " + std::to_string(i) + std::string(3000, '.'));
      _exit(0);
    }
    children.push_back(child);
  }
  const pid_t killed = fork();
  REQUIRE(killed >= 0);
  if (killed == 0) {
    while (true) dem::append_line(file, "9 " + std::string(3000, '.'));
  }
  usleep(20000);
  kill(killed, SIGKILL);
  waitpid(killed, nullptr, 0);
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  const std::string text = dem::read_file(file);
  std::vector<int> next(processes, 0);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    REQUIRE(end != std::string::npos);
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    REQUIRE(line.size() > 3000);
    const int who = line[0] - '0';
    if (who == 9) continue;
    CHECK(line.starts_with(std::to_string(who) + " " + std::to_string(next[static_cast<std::size_t>(who)]++) + "."));
  }
  for (const int count : next) CHECK(count == lines);
}

TEST_CASE("steps: none in quiet series, found where they are") {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::exponential_distribution<double> exponential;
  const auto laplace = [&] { return (random() & 1 ? 1 : -1) * exponential(random); };
  const auto outliers = [&] { return normal(random) * (random() % 20 == 0 ? 8 : 1); };
  const auto quiet = [&](const auto& noise) {
    int alarms = 0;
    for (int series = 0; series < 300; ++series) {
      std::vector<double> values(60);
      for (double& value : values) value = 100 + noise();
      alarms += overview::steps(values).empty() ? 0 : 1;
    }
    return alarms;
  };
  CHECK(quiet([&] { return normal(random); }) <= 3);
  CHECK(quiet(laplace) <= 3);
  CHECK(quiet(outliers) <= 3);
  int found = 0;
  for (int series = 0; series < 100; ++series) {
    std::vector<double> values(60);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 100 + normal(random) + (i >= 40 ? 4 : 0);
    const auto steps = overview::steps(values);
    if (steps.size() == 1 && steps[0].at >= 39 && steps[0].at <= 41) ++found;
  }
  CHECK(found >= 95);
}

TEST_CASE("steps of numbers without noise: the very night") {
  std::vector<double> values(60, 163.4);
  CHECK(overview::steps(values).empty());
  values.back() = std::nextafter(163.4, 200.0);
  const auto last = overview::steps(values);
  REQUIRE(last.size() == 1);
  CHECK(last[0].at == 59);
  std::fill(values.begin() + 20, values.begin() + 40, 170.0);
  CHECK(overview::steps(values).size() == 3);
  CHECK(overview::steps({1, 2}).size() <= 1);
  CHECK(overview::steps({}).empty());
}
