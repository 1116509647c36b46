// Comparison of reports: each kind of change is made, and its neighbour that is none.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/model/model.h"
#include "reports/comparison/folders.h"
#include "reports/comparison/pictures.h"
#include "reports/comparison/reference.h"
#include "tests/reports/made_report.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using comparison::State;
using test::Drawn;
using test::MadeReport;

const comparison::Options options{.models = dem::models(), .tolerances = {}, .threads = 2};

/// Both ways in which a study is compared.
struct Both {
  comparison::StudyComparison reports, reference;
};

Both compared(const MadeReport& was, const MadeReport& is, const std::string& tolerances = {}) {
  const test::Scratch folder;
  const fs::path before = was.write(folder / "old");
  const fs::path now = is.write(folder / "new");
  comparison::accept(before, folder / "references", {.reason = "first", .date = "2026-01-01"}, options);
  if (!tolerances.empty()) {
    dem::write_file(folder / "references/tolerances.toml", tolerances);
    dem::write_file(folder / "old/tolerances.toml", tolerances);
  }
  return {comparison::compare_folders(folder / "old", folder / "new", options).studies.at(0),
          comparison::compare_with_reference(now, folder / "references", {}, options)};
}

const comparison::Item& item(const comparison::StudyComparison& study, const std::string& id) {
  const auto at = std::ranges::find(study.items, id, &comparison::Item::id);
  REQUIRE_MESSAGE(at != study.items.end(), id);
  return *at;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The items that alarm, and no other, in both comparisons.
void check_alarms(const Both& both, std::vector<std::string> expected) {
  std::ranges::sort(expected);
  for (const comparison::StudyComparison* study : {&both.reports, &both.reference}) {
    CHECK(study->problem == "");
    std::vector<std::string> found;
    for (const comparison::Item& one : study->items) {
      if (one.alarms()) found.push_back(one.id);
    }
    std::ranges::sort(found);
    CHECK(found == expected);
    CHECK(study->well() == expected.empty());
  }
}

}  // namespace

TEST_CASE("the same twice: nothing changed, and the same bytes of page and JSON") {
  const Both both = compared({}, {});
  check_alarms(both, {});
  CHECK(both.reports.sentence() == "nothing changed");
  CHECK(both.reference.sentence() == "nothing changed");
  const auto page = [](const comparison::StudyComparison& study) {
    return comparison::comparison_page({{study}}, DEM_SOURCE_DIR "/assets");
  };
  const std::string once = page(both.reports);
  CHECK(once == page(compared({}, {}).reports));
  CHECK_FALSE(has(once, "<script"));
}

TEST_CASE("a key of the scenario: named, with the results that moved") {
  MadeReport now;
  now.cases[0].cohesion = 2.9492e8;
  now.cases[0].results["compressive_strength"] = 164.9;
  const Both both = compared({}, now);
  check_alarms(both, {"cases/compression_ar_1", "results/compression_ar_1/compressive_strength"});
  for (const auto* study : {&both.reports, &both.reference}) {
    REQUIRE(study->causes.size() == 1);
    CHECK(study->causes[0].text == "mineral[2].cohesion: 292 MPa -> 294.92 MPa");
    CHECK(study->causes[0].cases == std::vector<std::string>{"compression_ar_1"});
    const comparison::Item& result = item(*study, "results/compression_ar_1/compressive_strength");
    CHECK(result.was == "163.4 MPa");
    CHECK(result.is == "164.9 MPa");
    CHECK(result.difference == "+0.918 %");
  }
}

TEST_CASE("the last bit of one result is found, and told as such") {
  MadeReport now;
  now.cases[1].results["compressive_strength"] = std::nextafter(151.25, 1000.0);
  const Both both = compared({}, now);
  check_alarms(both, {"results/compression_ar_2/compressive_strength"});
  for (const auto* study : {&both.reports, &both.reference}) {
    CHECK(has(item(*study, "results/compression_ar_2/compressive_strength").difference, "1 unit in the last place"));
    REQUIRE(study->causes.size() == 1);
    CHECK(has(study->causes[0].text, "last bits alone: another compiler"));
  }
}

TEST_CASE("cracks: one in a hundred elsewhere is seen, edges that are smoothed otherwise are not") {
  MadeReport now;
  SUBCASE("one per cent") { now.drawn.others = 2; }
  SUBCASE("a single one of two hundred") { now.drawn.others = 1; }
  SUBCASE("the legend moved by six pixels") { now.drawn.legend_shift = 6; }
  check_alarms(compared({}, now), {"figures/crack_maps"});
}

TEST_CASE("smoothed edges: changed pixels, no alarm") {
  MadeReport now;
  SUBCASE("another way to smooth") { now.drawn.samples = 2; }
  SUBCASE("all edges moved by a third of a pixel") { now.drawn.offset = 0.3; }
  const Both both = compared({}, now);
  check_alarms(both, {});
  CHECK(item(both.reports, "figures/crack_maps").state == State::within_tolerance);
  CHECK(item(both.reports, "figures/crack_maps").pictures.size() == 3);
}

TEST_CASE("one pixel of an edge: changed, no alarm; a spot of another colour: an alarm") {
  const render::Image was = test::crack_map({});
  render::Image is = was;
  for (std::size_t at = is.at(100, 100), k = 0; k < 3; ++k) is.rgb[at + k] = is.rgb[is.at(101, 100) + k];
  is.rgb[is.at(100, 100)] = static_cast<std::uint8_t>(is.rgb[is.at(100, 100)] ^ 1);
  const comparison::PictureDifference edge = comparison::compare_pictures(was, is, 1);
  CHECK(edge.changed > 0);
  CHECK_FALSE(edge.seen);
  for (int row = 200; row < 204; ++row) {
    for (int column = 200; column < 204; ++column) is.rgb[is.at(column, row) + 1] = 255;
  }
  CHECK(comparison::compare_pictures(was, is, 1).seen);
}

TEST_CASE("a renamed figure is told as such") {
  MadeReport now;
  now.figure = "maps_of_cracks";
  const Both both = compared({}, now);
  check_alarms(both, {"figures/crack_maps", "figures/maps_of_cracks"});
  for (const auto* study : {&both.reports, &both.reference}) {
    CHECK(item(*study, "figures/crack_maps").difference == "the same picture is now named figures/maps_of_cracks");
    CHECK(item(*study, "figures/crack_maps").state == State::gone);
  }
}

TEST_CASE("cases that go and come") {
  MadeReport more;
  more.cases.push_back({.id = "compression_ar_3", .results = {{"compressive_strength", 140}}});
  const std::vector<std::string> items = {"cases/compression_ar_3", "results/compression_ar_3/compressive_strength",
                                          "checks/compression_ar_3.energy_residual"};
  const Both came = compared({}, more), gone = compared(more, {});
  check_alarms(came, items);
  check_alarms(gone, items);
  CHECK(item(came.reference, "cases/compression_ar_3").state == State::came);
  CHECK(item(gone.reference, "cases/compression_ar_3").state == State::gone);
}

TEST_CASE("a check that broke, a verdict that turned") {
  MadeReport broken;
  broken.check_holds = false;
  const Both checks = compared({}, broken);
  check_alarms(checks, {"checks/compression_ar_1.energy_residual", "checks/compression_ar_2.energy_residual"});
  CHECK(has(item(checks.reference, "checks/compression_ar_1.energy_residual").difference, "held → broken"));
  MadeReport missed;
  missed.verdict = "undecided";
  const Both verdicts = compared({}, missed);
  check_alarms(verdicts, {"published/ucs"});
  CHECK(item(verdicts.reference, "published/ucs").difference == "met → undecided");
}

TEST_CASE("curves: the distance as a share of the range, old and new over each other") {
  MadeReport now;
  now.peak = 166.668;
  const Both both = compared({}, now);
  check_alarms(both, {"data/curves.csv"});
  for (const auto* study : {&both.reports, &both.reference}) {
    const comparison::Item& curve = item(*study, "data/curves.csv");
    REQUIRE(curve.overlays.size() == 1);
    CHECK(curve.overlays[0].distance == doctest::Approx(0.02 / 1.02).epsilon(0.1));
  }
}

TEST_CASE("words of the page, apart from numbers") {
  MadeReport now;
  now.choice = "The residual is taken at the end of the test, at 1.6 times the peak strain.";
  check_alarms(compared({}, now), {});
  now.choice = "The residual is taken where the stress stops falling.";
  check_alarms(compared({}, now), {"text/choices"});
}

TEST_CASE("drawings: the version in their facts is no change, their text is") {
  MadeReport now;
  now.drawing = "<svg><metadata>0.2.0</metadata><text>a</text></svg>";
  check_alarms(compared({}, now), {});
  now.drawing = "<svg><metadata>0.1.0</metadata><text>b</text></svg>";
  check_alarms(compared({}, now), {"figures/drawing"});
}

TEST_CASE("another physics version: the scatter of seeds is what a result may move by") {
  MadeReport was;
  was.cases.clear();
  for (int seed = 1; seed <= 5; ++seed) {
    was.cases.push_back({.id = "compression_seed_" + std::to_string(seed),
                         .seed = seed,
                         .results = {{"compressive_strength", 160.0 + 2 * (seed % 3)}}});
  }
  MadeReport now = was;
  now.physics = "grain_texture 7";
  now.cases[0].results["compressive_strength"] += 3;
  now.cases[1].results["compressive_strength"] += 30;
  const Both both = compared(was, now);
  for (const auto* study : {&both.reports, &both.reference}) {
    CHECK(item(*study, "results/compression_seed_1/compressive_strength").state == State::within_scatter);
    CHECK(item(*study, "results/compression_seed_2/compressive_strength").state == State::beyond);
    REQUIRE(study->causes.size() == 1);
    CHECK(study->causes[0].text == "physics version: grain_texture 6 -> grain_texture 7");
    CHECK(study->causes[0].cases.empty());
  }
}

TEST_CASE("tolerances.toml: what it allows, with its reason; what is wrong with it") {
  MadeReport now;
  now.cases[0].results["compressive_strength"] = 163.5;
  const std::string allows =
      "[[tolerance]]\nitem = \"results/*/compressive_strength\"\nrelative = 0.001\nreason = \"rounding\"\n";
  const Both both = compared({}, now, allows);
  check_alarms(both, {});
  CHECK(has(item(both.reference, "results/compression_ar_1/compressive_strength").tolerance,
            "0.100 % (tolerances.toml: rounding)"));
  now.cases[0].results["compressive_strength"] = 164;
  check_alarms(compared({}, now, allows), {"results/compression_ar_1/compressive_strength"});
  for (const auto& [text, wrong] : std::vector<std::pair<std::string, std::string>>{
           {"[[tolerance]]\nitem = \"*\"\nrelative = 0.1\n", "tolerances.toml:1:1: reason: it is missing"},
           {"[[tolerance]]\nitem = \"*\"\nreason = \"x\"\n", "a tolerance is one number"},
           {"[[tolerance]]\nitems = \"*\"\n", "did you mean 'item'?"},
           {"[[tolerance]\n", "correct the TOML"}}) {
    CAPTURE(text);
    try {
      compared({}, {}, text);
      FAIL("nothing was thrown");
    } catch (const dem::InputError& error) {
      CHECK_MESSAGE(has(error.what(), wrong), error.what());
    }
  }
}

TEST_CASE("a reference of an older format, or one cut short, is named") {
  const test::Scratch folder;
  const fs::path study = MadeReport{}.write(folder / "out");
  comparison::accept(study, folder / "references", {.reason = "first", .date = "2026-01-01"}, options);
  const fs::path reference = folder / "references/rock.smoke/reference.json";
  const std::string whole = dem::read_file(reference);
  const auto problem = [&](const std::string& text) {
    dem::write_file(reference, text);
    return comparison::compare_with_reference(study, folder / "references", {}, options).problem;
  };
  CHECK(problem(whole) == "");
  std::string older = whole;
  older.replace(older.find("\"format\": 1"), 11, "\"format\": 0");
  CHECK(problem(older) == "its format is 0, and this program reads 1: look at the report, then accept it anew");
  CHECK(has(problem(whole.substr(0, whole.size() / 2)), "cut short or damaged"));
  CHECK(has(problem(""), "cut short or damaged"));
  CHECK(problem(whole) == "");
  for (const auto& entry : fs::directory_iterator(folder / "references/rock.smoke/pictures")) fs::remove(entry.path());
  CHECK(has(problem(whole), "it is not whole: pictures/"));
  MadeReport old;
  old.summary_format = 1;
  const fs::path made_before = old.write(folder / "before");
  CHECK(has(comparison::compare_folders(made_before, study, options).studies.at(0).problem,
            "the old one cannot be read: its summary.json is of format 1, older than 2"));
  // A whole acceptance needs nothing of what was damaged.
  comparison::accept(study, folder / "references", {.reason = "anew", .date = "2026-01-02"}, options);
  CHECK(comparison::compare_with_reference(study, folder / "references", {}, options).sentence() == "nothing changed");
}

TEST_CASE("items are accepted one by one, with what was and is in the log") {
  const test::Scratch folder;
  comparison::accept(MadeReport{}.write(folder / "out"), folder / "references", {.reason = "first", .date = "night 1"},
                     options);
  MadeReport now;
  now.cases[0].results["compressive_strength"] = 170;
  now.cases[1].results["compressive_strength"] = 150;
  now.drawn.others = 8;
  const fs::path study = now.write(folder / "out");
  const auto alarms = [&] {
    return comparison::compare_with_reference(study, folder / "references", {}, options).alarms();
  };
  CHECK(alarms() == 3);
  comparison::accept(study, folder / "references",
                     {.items = {"results/compression_ar_1/*"}, .reason = "a better platen", .date = "night 2"},
                     options);
  CHECK(alarms() == 2);
  comparison::accept(study, folder / "references", {.items = {"figures/*"}, .reason = "seen", .date = "night 3"},
                     options);
  CHECK(alarms() == 1);
  const std::string log = dem::read_file(folder / "references/accepted.jsonl");
  CHECK(std::ranges::count(log, '\n') == 3);
  CHECK(has(log, "\"what\":\"results/compression_ar_1/compressive_strength\""));
  CHECK(has(log, "\"old\":\"163.4 MPa\",\"new\":\"170.0 MPa\""));
  CHECK(has(log, "a better platen"));
  CHECK_FALSE(has(dem::read_file(folder / "references/rock.smoke/reference.json"), "night 2"));
  CHECK_THROWS_AS(
      comparison::accept(study, folder / "references", {.items = {"nothing/*"}, .reason = "x", .date = ""}, options),
      dem::InputError);
  // No picture that nobody names stays.
  CHECK(std::distance(fs::directory_iterator(folder / "references/rock.smoke/pictures"), fs::directory_iterator()) ==
        2);
}

TEST_CASE("the log of a study that changed everywhere stays short") {
  const test::Scratch folder;
  MadeReport made;
  for (int k = 0; k < 40; ++k) made.cases[0].results["inter_quartz_" + std::to_string(k)] = k;
  comparison::accept(made.write(folder / "out"), folder / "references", {.reason = "first", .date = "night 1"},
                     options);
  for (auto& [name, value] : made.cases[0].results) value *= 2;
  comparison::accept(made.write(folder / "out"), folder / "references", {.reason = "second", .date = "night 2"},
                     options);
  const std::string log = dem::read_file(folder / "references/accepted.jsonl");
  const std::string last = log.substr(log.find("night 2"));
  std::size_t items = 0;
  for (std::size_t at = last.find("\"what\""); at != std::string::npos; at = last.find("\"what\"", at + 1)) ++items;
  CHECK(items == 31);
  CHECK(has(last, "\"what\":\"others\",\"difference\":\""));
}

TEST_CASE("an acceptance that was killed after it took place gets its line in the log") {
  const test::Scratch folder;
  const fs::path study = MadeReport{}.write(folder / "out");
  const fs::path references = folder / "references";
  comparison::accept(study, references, {.reason = "first", .date = "night 1"}, options);
  const std::string log = dem::read_file(references / "accepted.jsonl");
  dem::write_file(references / "rock.smoke/accepting.json", log.substr(0, log.size() - 1));
  dem::write_file(references / "accepted.jsonl", "");
  comparison::accept(study, references, {.reason = "second", .date = "night 2"}, options);
  const std::string both = dem::read_file(references / "accepted.jsonl");
  CHECK(std::ranges::count(both, '\n') == 2);
  CHECK(both.starts_with(log));
  // One that did not take place leaves none.
  dem::write_file(references / "rock.smoke/accepting.json", "{\"reference\":\"0\"}");
  comparison::accept(study, references, {.reason = "third", .date = "night 3"}, options);
  CHECK(std::ranges::count(dem::read_file(references / "accepted.jsonl"), '\n') == 3);
  CHECK_FALSE(fs::exists(references / "rock.smoke/accepting.json"));
}
