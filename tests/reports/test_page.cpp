// The whole report from made-up records: files, page and PDF.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "engine/core/base64.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/output/pdf.h"
#include "reports/output/report.h"
#include "reports/page/citations.h"
#include "tests/reports/synthetic.h"
#include "tests/support/scratch.h"

namespace {

const std::filesystem::path assets = std::filesystem::path(DEM_SOURCE_DIR) / "assets";

render::Canvas& canvas() {
  static render::Canvas one;
  return one;
}

struct Ran {
  int status = 0;
  std::string output;
};

Ran run(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  Ran ran;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    ran.output.append(buffer.data(), n);
  ran.status = ::pclose(pipe);
  return ran;
}

reports::ReportOptions options_for(const std::filesystem::path& folder) {
  reports::ReportOptions options;
  options.folder = folder;
  options.assets = assets;
  options.engine_version = "0.1.0";
  options.again.command = "./dem-report synthetic.toml --scale draft";
  options.dpi = 100;  // pixels are looked at elsewhere
  return options;
}

/// One report with everything in it, made once; kept in DEM_KEEP_REPORT when that is set.
struct Whole {
  test::Scratch scratch;
  std::filesystem::path folder;
  reports::ReportOutcome outcome;

  Whole() {
    const char* kept = std::getenv("DEM_KEEP_REPORT");
    folder = kept ? std::filesystem::path(kept) : scratch / "out";
    const synthetic::Study study(scratch.path());
    outcome = reports::make_report(study.result(), options_for(folder), canvas, {{"threads", 2.0}});
  }
};

const Whole& whole() {
  static const Whole made;
  return made;
}

std::string file(const std::string& name) { return dem::read_file(whole().folder / name); }

}  // namespace

TEST_CASE("every figure is drawn and every file named in the summary is there") {
  CHECK(whole().outcome.checks_held);
  const auto summary = nlohmann::json::parse(file("summary.json"));
  std::set<std::string> drawn;
  for (const auto& figure : summary.at("figures")) {
    CAPTURE(figure.at("id").get<std::string>());
    CHECK_FALSE(figure.at("files").empty());
    drawn.insert(figure.at("id").get<std::string>());
    for (const auto& name : figure.at("files")) {
      CAPTURE(name.get<std::string>());
      const std::string bytes = file(name.get<std::string>());
      if (name.get<std::string>().ends_with(".csv")) {  // a head and at least one row
        CHECK(std::ranges::count(bytes, '\n') >= 2);
        CHECK(bytes.find(',') < bytes.find('\n'));
      } else {
        CHECK(bytes.size() > 1000);
      }
    }
  }
  CHECK(drawn == std::set<std::string>{"specimen", "grain_cluster", "progressive_failure", "crack_stages",
                                       "stress_strain", "crack_maps", "crack_counts", "group_shares",
                                       "energy_compression", "energy_tension"});
  CHECK(file("report.html").find("could not be drawn") == std::string::npos);
  CHECK(nlohmann::json::parse(file("run.json")).at("threads") == 2);
}

TEST_CASE("summary.json is as its schema says") {
  const auto check = [](const std::filesystem::path& summary) {
    return run("/usr/bin/python3 -m jsonschema -i '" + summary.string() + "' '" +
               (assets / "summary.schema.json").string() + "'");
  };
  const Ran good = check(whole().folder / "summary.json");
  CAPTURE(good.output);
  CHECK(good.status == 0);
  const test::Scratch scratch;
  auto broken = nlohmann::json::parse(file("summary.json"));
  broken["cases"][0]["results"]["young_modulus"] = "stiff";
  dem::write_file(scratch / "summary.json", broken.dump());
  CHECK(check(scratch / "summary.json").status != 0);
}

TEST_CASE("the page is valid HTML") {
  // tidy is older than loading="lazy".
  const Ran tidy = run("tidy -quiet -errors -utf8 --show-info no '" + (whole().folder / "report.html").string() +
                       "' 2>&1 | grep -v '<img> proprietary attribute \"loading\"$'");
  CHECK(tidy.output == "");
}

TEST_CASE("the page loads nothing from outside and needs no script") {
  const std::string html = file("report.html");
  CHECK(html.find("<script") == std::string::npos);
  CHECK(html.find("<link") == std::string::npos);
  CHECK(html.find("@import") == std::string::npos);
  for (std::size_t at = html.find(" src=\""); at != std::string::npos; at = html.find(" src=\"", at + 1)) {
    CHECK(html.compare(at, 11, " src=\"data:") == 0);
  }
  for (std::size_t at = html.find("url("); at != std::string::npos; at = html.find("url(", at + 1)) {
    CHECK(html.compare(at, 9, "url(data:") == 0);
  }
  CHECK(html.find("<meta charset=\"utf-8\">") < 200);
  CHECK(html.find("<html lang=\"en\">") != std::string::npos);
}

TEST_CASE("links lead somewhere, downloads are inside the page, and no two links or pictures are told alike") {
  const std::string html = file("report.html");
  std::size_t inner = 0;
  std::set<std::string> names, pictures;
  for (std::size_t at = html.find("<a "); at != std::string::npos; at = html.find("<a ", at + 1)) {
    const std::size_t from = html.find(" href=\"", at) + 7;
    REQUIRE(from < html.find('>', at));
    const std::string target = html.substr(from, html.find('"', from) - from);
    CAPTURE(target.substr(0, 80));
    if (target.starts_with('#')) {
      ++inner;
      CHECK(html.find("id=\"" + target.substr(1) + "\"") != std::string::npos);
    } else if (target.starts_with("data:")) {
      const std::size_t text = html.find('>', at) + 1;
      const std::string name = html.substr(text, html.find("</a>", text) - text);
      CHECK(html.compare(at, 13, "<a download=\"") == 0);
      CHECK(names.insert(name).second);
    } else {
      CHECK(target.starts_with("https://doi.org/"));
    }
  }
  for (std::size_t at = html.find("<img "); at != std::string::npos; at = html.find("<img ", at + 1)) {
    const std::size_t alt = html.find(" alt=\"", at) + 6;
    REQUIRE(alt < html.find('>', at));
    const std::string text = html.substr(alt, html.find('"', alt) - alt);
    CAPTURE(text);
    CHECK(text.starts_with("Figure "));
    CHECK(text.size() > 20);
    CHECK(pictures.insert(text).second);
  }
  CHECK(inner > 15);
  CHECK(names.size() > 30);
  CHECK(pictures.size() > 30);
}

TEST_CASE("a download holds the bytes of its file") {
  const std::string html = file("report.html");
  std::size_t tables = 0;
  for (const auto& entry : std::filesystem::directory_iterator(whole().folder / "data")) {
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    const std::string link = "<a download=\"" + name + "\" href=\"data:text/csv;base64,";
    const std::size_t at = html.find(link);
    REQUIRE(at != std::string::npos);
    const std::size_t from = at + link.size();
    CHECK(html.substr(from, html.find('"', from) - from) == dem::base64(dem::read_file(entry.path())));
    ++tables;
  }
  CHECK(tables > 5);
}

TEST_CASE("what to cite stands there as BibTeX too, that can be saved") {
  const std::string html = file("report.html");
  for (const char* text : {"@article{zhao2021,", "author = {Zhao, X. and Elsworth, D. and", "@misc{demreport,",
                           "note = {Version 0.1.0}", "pages = {1329--1364}", ".bib\" href=\"data:"}) {
    CAPTURE(text);
    CHECK(html.find(text) != std::string::npos);
  }
  for (const auto& paper : std::filesystem::directory_iterator(assets / "papers")) {
    for (const auto& one : nlohmann::json::parse(dem::read_file(paper.path() / "citations.json"))) {
      const reports::Citation cited = reports::citation(one);
      CAPTURE(cited.key);
      CHECK(reports::reference(cited).ends_with("."));
      const std::string entry = reports::bibtex(cited);
      CHECK(std::ranges::count(entry, '{') == std::ranges::count(entry, '}'));
      CHECK(entry.find(" & ") == std::string::npos);
    }
  }
}

TEST_CASE("the page names figures, sources, verdicts and residuals") {
  const std::string html = file("report.html");
  for (const char* text :
       {"Mirrors Zhao et al. 2021, Fig.\u00a014", "Mirrors Zhao et al. 2021, Fig.\u00a015a",
        "Tensile strength, AR\u00a01", "<span>not judged</span>", "Energy ledger", "Packing pressure",
        "10.1016/j.ijrmms.2021.104971", "--scale draft", "[scales.draft]", "A made-up study"}) {
    CAPTURE(text);
    CHECK(html.find(text) != std::string::npos);
  }
}

TEST_CASE("the PDF has text, embedded fonts, tags and a sane number of pages") {
  const std::string pdf = (whole().folder / "report.pdf").string();
  const Ran text = run("pdftotext '" + pdf + "' -");
  for (const char* words :
       {"Published numbers beside ours", "Figure 1.", "Uniaxial compressive strength", "Energy ledger", "What to cite",
        "· scale draft · dem-report 0.1.0", "Page 1 of ", "Counts and diagnostics of each case"}) {
    CAPTURE(words);
    CHECK(text.output.find(words) != std::string::npos);
  }
  const Ran fonts = run("pdffonts '" + pdf + "' | tail -n +3 | awk '{print $(NF-4)}' | sort -u");
  CHECK(fonts.output == "yes\n");
  const Ran info = run("pdfinfo '" + pdf + "'");
  CHECK(std::regex_search(info.output, std::regex("Tagged: +yes")));
  CHECK(std::regex_search(info.output, std::regex("Page size: .*A4")));
  std::smatch pages;
  REQUIRE(std::regex_search(info.output, pages, std::regex("Pages: +([0-9]+)")));
  CHECK(std::stoi(pages[1]) >= 10);
  CHECK(std::stoi(pages[1]) <= 30);
  CHECK(text.output.find(whole().folder.string()) == std::string::npos);
}

TEST_CASE("the page of another rock speaks of that rock") {
  const test::Scratch scratch;
  const dem::Scenario scenario = synthetic::scenario(scratch.path(), "my_rock",
                                                     "figures = [\"specimen\", \"progressive_failure\", "
                                                     "\"confinement_envelopes\"]\n")
                                     .with("rock", std::string("my rock"))
                                     .with("title", std::string("A rock of my own"));
  const synthetic::Options small{.diameter = 4e-3, .height = 8e-3, .samples = 40};
  const std::vector<dem::Record> records = {synthetic::compression(1, small), synthetic::direct_tension(1, small)};
  auto options = options_for(scratch / "out");
  options.pdf = false;
  const auto outcome = reports::make_report(synthetic::study_of(scenario, records), options, canvas, {});
  CHECK(outcome.verdicts_text.empty());
  std::string html = dem::read_file(scratch / "out/report.html");
  html.resize(html.find("id=\"scenario\""));  // the text of the scenario itself
  for (const char* absent : {"Mirrors", "Published.", "Lac du Bonnet", "too few pressures", "no fit", "the granite",
                             "Specimens of one mineral", "End of the unloading loops", "Rows with a dash"}) {
    const std::size_t at = html.find(absent);
    CAPTURE(std::string(at == std::string::npos ? "" : html.substr(at > 60 ? at - 60 : 0, 160)));
    CHECK(html.find(absent) == std::string::npos);
  }
  CHECK(html.find("Overlapping ellipsoids") != std::string::npos);
  CHECK(html.find("id=\"progressive_failure\"") != std::string::npos);
  CHECK(html.find("id=\"confinement_envelopes\"") == std::string::npos);  // one pressure makes no envelope
  const std::size_t row = html.find("compression_<wbr>ar_<wbr>1</th>");
  REQUIRE(row != std::string::npos);
  CHECK(html.substr(row, 200).find("AR\u00a01") != std::string::npos);  // its parameters
}

TEST_CASE("a failed case is shown in its figures' place and the rest of the report is made") {
  const test::Scratch scratch;
  synthetic::Study study(scratch.path(), {.diameter = 4e-3, .height = 8e-3, .samples = 40});
  study.fail("compression_ar_2", "the specimen cannot be packed: no rest after 1 000 rounds");
  study.record("compression_ar_3").checks[0].held = false;
  auto options = options_for(scratch / "out");
  options.pdf = false;
  const auto outcome = reports::make_report(study.result(), options, canvas, {});
  CHECK_FALSE(outcome.checks_held);
  CHECK_FALSE(std::filesystem::exists(scratch / "out/report.pdf"));
  const std::string html = dem::read_file(scratch / "out/report.html");
  const std::size_t plate = html.find("id=\"crack_maps\"");
  REQUIRE(plate != std::string::npos);
  CHECK(html.find("no rest after 1 000 rounds", plate) < html.find("id=\"crack_counts\""));
  CHECK(html.find("<span>broken</span>") != std::string::npos);
  CHECK(html.find("not computed") != std::string::npos);
  CHECK(std::filesystem::exists(scratch / "out/figures/crack_maps_discs_ar_3.png"));
}

TEST_CASE("records without their tables give notes, not crashes; --only draws one figure") {
  const test::Scratch scratch;
  synthetic::Study study(scratch.path(), {.diameter = 3e-3, .height = 6e-3, .samples = 10});
  for (const char* id : {"compression_ar_1", "compression_ar_2", "compression_ar_3"}) study.record(id).tables.clear();
  auto options = options_for(scratch / "out");
  options.pdf = false;
  CHECK_NOTHROW(reports::make_report(study.result(), options, canvas, {}));
  CHECK(dem::read_file(scratch / "out/report.html").find("could not be drawn") != std::string::npos);

  options.folder = scratch / "one";
  options.only = "energy_tension";
  reports::make_report(study.result(), options, canvas, {});
  const auto summary = nlohmann::json::parse(dem::read_file(scratch / "one/summary.json"));
  REQUIRE(summary.at("figures").size() == 1);
  CHECK(summary["figures"][0].at("id") == "energy_tension");
  options.only = "no_such_figure";
  CHECK_THROWS_WITH_AS(reports::make_report(study.result(), options, canvas, {}), doctest::Contains("crack_maps"),
                       dem::InputError);
}

TEST_CASE("a scenario of one's own shows the figures of its model that have something to draw") {
  const test::Scratch scratch;
  const dem::Scenario own = synthetic::scenario(scratch.path(), "tunnel_wall");
  const dem::Record record = synthetic::compression(1, {.diameter = 3e-3, .height = 6e-3, .samples = 10});
  auto options = options_for(scratch / "out");
  options.pdf = false;
  reports::make_report(synthetic::study_of(own, {record}), options, canvas, {});
  const auto summary = nlohmann::json::parse(dem::read_file(scratch / "out/summary.json"));
  std::set<std::string> ids;
  for (const auto& figure : summary.at("figures")) ids.insert(figure.at("id").get<std::string>());
  CHECK(ids.contains("specimen"));
  CHECK(ids.contains("energy_compression"));
  CHECK_FALSE(ids.contains("energy_tension"));  // no test in tension
  CHECK_FALSE(ids.contains("confinement_after_peak"));
  CHECK_FALSE(ids.contains("genesis_steps"));
  const std::string html = dem::read_file(scratch / "out/report.html");
  CHECK(html.find("could not be drawn") == std::string::npos);
  CHECK(html.find("Figure 1.") != std::string::npos);
}

TEST_CASE("an error in WeasyPrint's log fails the run and leaves no PDF") {
  const test::Scratch scratch;
  const std::string html =
      "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>x</title></head><body>"
      "<img alt=\"gone\" src=\"gone.png\"></body></html>";
  CHECK_THROWS_WITH_AS(reports::print_pdf(html, assets / "page" / "print.css", scratch / "x.pdf"),
                       doctest::Contains("ERROR"), dem::EnvironmentError);
  CHECK_FALSE(std::filesystem::exists(scratch / "x.pdf"));
}

TEST_CASE("the PDF's bytes do not hang on the folder that the report is in") {
  const test::Scratch scratch;
  const std::string html =
      "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>x</title></head><body>"
      "<img alt=\"a drop\" src=\"figures/drop.png\"></body></html>";
  std::filesystem::path picture;
  for (const auto& file : std::filesystem::directory_iterator(whole().folder / "figures")) {
    if (file.path().extension() == ".png") picture = file.path();
  }
  REQUIRE(!picture.empty());
  std::vector<std::string> bytes;
  for (const std::string folder : {"one", "another/below"}) {
    std::filesystem::create_directories(scratch / folder / "figures");
    std::filesystem::copy(picture, scratch / folder / "figures/drop.png");
    reports::print_pdf(html, assets / "page" / "print.css", scratch / folder / "x.pdf");
    bytes.push_back(dem::read_file(scratch / folder / "x.pdf"));
  }
  CHECK(bytes[0].size() > 2000);
  CHECK(bytes[0] == bytes[1]);
}

TEST_CASE("the list of figures names every one of them") {
  const std::string text = reports::list_figures();
  for (const reports::Figure& figure : reports::figures()) CHECK(text.find(figure.id) != std::string::npos);
}
