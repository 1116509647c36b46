// The small parts of a report: words and numbers, CSV, sampling, scale bars, summary.json, links.
#include <doctest/doctest.h>

#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "engine/analysis/ending.h"
#include "engine/analysis/ledger.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/lattice/quantities.h"
#include "engine/texture/quantities.h"
#include "reports/figures/parts.h"
#include "reports/figures/sheet/parts.h"
#include "reports/output/csv.h"
#include "reports/output/drawing.h"
#include "reports/output/pdf.h"
#include "reports/output/summary.h"
#include "reports/page/listing.h"
#include "reports/page/page.h"
#include "reports/page/page_parts.h"
#include "reports/page/typeset.h"
#include "reports/template.h"
#include "reports/text.h"
#include "tests/reports/synthetic.h"
#include "tests/support/scratch.h"

TEST_CASE("numbers as a reader sees them") {
  CHECK(reports::number(206.84, 4) == "206.8");
  CHECK(reports::number(0.18312) == "0.183");
  CHECK(reports::number(0) == "0");
  CHECK(reports::number(-28.2) == "\u221228.2");
  CHECK(reports::number(3.2e-5, 2) == "3.2 × 10⁻⁵");
  CHECK(reports::number(std::nan("")) == "not a number");
  CHECK(reports::count(36528) == "36\u202f528");
  CHECK(reports::count(2590) == "2590");
  CHECK(reports::shortest(206.8) == "206.8");
  CHECK(reports::percent(0.1234) == "12.3 %");
  CHECK(reports::with_sign(reports::fixed(1.5, 1)) == "+1.5");
  CHECK(reports::with_sign(reports::fixed(-1.5, 1)) == "\u22121.5");
  CHECK(reports::listed({"a", "b", "c"}) == "a, b and c");
}

TEST_CASE("a template shares parts with others; one that is missing or broken is named") {
  const test::Scratch scratch;
  std::filesystem::create_directories(scratch / "parts");
  const auto write = [&](const char* name, const char* text) {
    dem::write_file(scratch / name, text);
    return scratch / name;
  };
  const auto page = write("page.html", "<main>\n{{> hello}}\n{{#inner}}{{> hello}}{{/inner}}\n</main>");
  reports::PageData data, inner;
  data.set("name", "a & b");
  inner.set("name", "c");
  data.set("inner", inner);
  CHECK_THROWS_WITH_AS((void)reports::fill_template(page, data), doctest::Contains("hello.html"),
                       dem::EnvironmentError);
  write("parts/hello.html", "Hello {{name}}.\n");
  CHECK(reports::fill_template(page, data) == "<main>\nHello a &amp; b.\nHello c.\n</main>");
  write("parts/hello.html", "Hello {{#name}}.");
  CHECK_THROWS_WITH_AS((void)reports::fill_template(page, data),
                       doctest::Contains("the page template hello.html is broken"), dem::EnvironmentError);
}

TEST_CASE("a page is set in type: indices, no-break spaces, degrees, apostrophes") {
  const std::vector<std::pair<std::string, std::string>> texts = {
      {"σci 99.40 MPa at 0.171 % strain", "σ<sub>ci</sub> 99.40~MPa at 0.171~% strain"},
      {"E_c + E_b, R_max/R_min, σ_t,b (MPa), α_μ",
       "E<sub>c</sub> + E<sub>b</sub>, R<sub>max</sub>/R<sub>min</sub>, "
       "σ<sub>t,b</sub> (MPa), α<sub>μ</sub>"},
      {"K_{n} and the K_n of it", "K<sub>n</sub> and the K<sub>n</sub> of it"},
      {"key measure.rate_bias of ldb_texture, a_b.toml, x_y_z",
       "key measure.rate_bias of ldb_texture, a_b.toml, x_y_z"},
      {"Section 4.1, Fig. 14c and Eqs. 7 and 8", "Section~4.1, Fig.~14c and Eqs.~7 and 8"},
      {"AR 1 to 3, σ₃ 10 MPa, dip 45°", "AR~1 to 3, σ<sub>3</sub>~10~MPa, dip~45°"},
      {"log₁₀ E of Tᵤ", "log<sub>10</sub> E of T<sub>u</sub>"},
      {"15.8 ± 0.6, p = 0.03, (1.7 ± 0.4) × 10⁻⁵ N/m", "15.8~±~0.6, p~=~0.03, (1.7~±~0.4)~×~10⁻⁵~N/|m"},
      {"6.25 mm × 12.5 mm, ± 5 °, 3 points", "6.25~mm~×~12.5~mm, ±~5°, 3 points"},
      {"the grains&apos; ratio, the paper's own 'word'", "the grains’ ratio, the paper’s own 'word’"},
      {"of 5 mm", "of 5~mm"},
      {"(p ≤ 0.001), (“Table 4”", "(p ≤~0.001), (“Table~4”"},
      {"5 more", "5 more"},
      {"UCS/TS, S(S + 1)/2, a/W, docs/use/keys.md, x/y.toml, and/",
       "UCS/|TS, S(S + 1)/|2, a/|W, docs/use/keys.md, x/y.toml, and/"},
      {"", ""}};
  for (const auto& [plain, set] : texts) {
    CAPTURE(plain);
    std::string text = reports::typeset_text(plain);
    for (std::size_t at = text.find("\u00a0"); at != std::string::npos; at = text.find("\u00a0"))
      text.replace(at, 2, "~");
    for (std::size_t at = text.find("\u2060"); at != std::string::npos; at = text.find("\u2060"))
      text.replace(at, 3, "|");
    CHECK(text == set);
  }
  CHECK(
      reports::typeset("<p title=\"σci 5 %\">σc</p><pre>E_c's</pre><span class=\"id\">a_b</span><style>a_b</style>") ==
      "<p title=\"σci 5 %\">σ<sub>c</sub></p><pre>E_c's</pre><span class=\"id\">a_<wbr>b</span><style>a_b</style>");
}

TEST_CASE("CSV quotes what needs it and keeps every point") {
  CHECK(reports::csv(reports::TextTable{{"a", "b"}, {{"x, y", "say \"z\""}}}) ==
        "a,b\r\n\"x, y\",\"say \"\"z\"\"\"\r\n");
  render::Chart chart;
  chart.x.title = "Strain (%)";
  chart.left.title = "Stress (MPa)";
  chart.series.resize(1);
  chart.series[0].label = "AR 1";
  for (int i = 0; i < 20000; ++i) {
    chart.series[0].x.push_back(i);
    chart.series[0].y.push_back(0.5 * i);
  }
  const auto tables = reports::csv_tables(chart);
  REQUIRE(tables.size() == 1);
  CHECK(tables[0].suffix.empty());
  const std::string text = tables[0].text();
  CHECK(text.starts_with("series,Strain (%),Stress (MPa)\r\nAR 1,0,0\r\nAR 1,1,0.5\r\n"));
  CHECK(std::ranges::count(text, '\n') == 20001);
}

TEST_CASE("a chart has a CSV for each of its tables, one row of heads, and columns for what is published") {
  render::Chart chart;
  chart.x.title = "Aspect ratio";
  chart.left.title = "Strength σ_{c} (MPa)";
  chart.right.title = "Ratio";
  chart.bars.emplace();
  chart.bars->categories = {"AR 1", "AR 2"};
  chart.bars->labels = {"UCS", "UCS, published"};
  chart.bars->values = {{163, std::nan("")}, {-1.5e-7, 150}};
  const auto series = [](const std::string& label, std::vector<double> x, std::vector<double> y) {
    render::Series made;
    made.label = label;
    made.x = std::move(x);
    made.y = std::move(y);
    made.side = render::Side::right;
    return made;
  };
  chart.series = {series("ratio", {1, 2}, {20, 21}), series("ratio, published", {1}, {19})};
  chart.series[0].y_error = {1, 2};
  render::Mark mark;
  mark.kind = render::Mark::Kind::horizontal;
  mark.y = 71.1;
  mark.label = "published";
  chart.marks = {mark};
  render::Chart inner;
  inner.series = {series("s", {1}, {2})};
  render::Inset inset;
  inset.chart = {inner};
  chart.insets = {inset};
  const auto tables = reports::csv_tables(chart);
  REQUIRE(tables.size() == 4);
  CHECK(tables[0].text() == "Aspect ratio,UCS (MPa),\"UCS, published (MPa)\"\r\nAR 1,163,-1.5e-07\r\nAR 2,,150\r\n");
  CHECK(tables[1].suffix == "curves");
  CHECK(tables[1].text() ==
        "series,Aspect ratio,Ratio,Published: Ratio,± of Ratio\r\n"
        "ratio,1,20,,1\r\nratio,2,21,,2\r\n\"ratio, published\",1,,19,\r\n");
  CHECK(tables[2].suffix == "marks");
  CHECK(tables[2].text() == "mark,Aspect ratio,Strength σ_c (MPa),Ratio\r\npublished,,71.1,\r\n");
  CHECK(tables[3].suffix == "inset");
}

TEST_CASE("a table of texts is numbers in its CSV, with units in the heads") {
  const auto written = [](const reports::TextTable& table) { return reports::csv(table); };
  CHECK(written({{"", "K_{n}", "m (95 % interval)", "TS (MPa)"},
                 {{"a", "46.794 × 10⁶ N/m", "29.0 (−51.8 to 110)", "12.1 ± 0.5"},
                  {"b", "8\u202f067\u202f902 N/m", "–", "13"}}}) ==
        "quantity,K_n (N/m),m,\"m, low\",\"m, high\",TS (MPa),\"TS, standard deviation (MPa)\"\r\n"
        "a,46.794e6,29.0,-51.8,110,12.1,0.5\r\nb,8067902,,,,13,\r\n");
  CHECK(written({{"Cracks, tension / shear", "At the end"}, {{"within quartz", "6 / 0"}, {"", "1110 / 135"}}}) ==
        "\"Cracks, tension / shear\",\"At the end, tension\",\"At the end, shear\"\r\n"
        "within quartz,6,0\r\nwithin quartz,1110,135\r\n");
  CHECK(
      written(
          {{"Parameter", "Value", "Value"},
           {{"dip", "45°", "x"}, {"radius", "0.35 mm", "y"}, {"ratios", "1, 2, 3", "z"}, {"range", "9–13 mm", ""}}}) ==
      "Parameter,\"Value, from\",\"Value, to\",\"Value, unit\",\"Value, in words\",Value\r\n"
      "dip,45,,°,,x\r\nradius,0.35,,mm,,y\r\nratios,,,,\"1, 2, 3\",z\r\nrange,9,13,mm,,\r\n");
}

TEST_CASE("a fitted value is told with its interval, and as undecided where that holds zero") {
  const double none = std::nan("");
  CHECK(reports::told({25.6, 19, 31}, 3, "MPa") == "25.6 MPa (95 % interval 19.0 to 31.0)");
  CHECK(reports::told({62.5, -18.7, 76.6}, 3, "°") == "62.5° (95 % interval \u221218.7 to 76.6: contains zero)");
  CHECK(reports::told({16, none, none}, 3) == "16.0 (no interval from so few points)");
}

TEST_CASE("curves end before the frame") {
  const auto chart_of = [](std::initializer_list<std::vector<double>> curves) {
    render::Chart chart;
    for (const std::vector<double>& x : curves) chart.series.emplace_back().x = x;
    return chart;
  };
  render::Chart chart = chart_of({{0, 2}, {0, 1}});
  reports::leave_room(chart);
  CHECK(*chart.x.low == 0);
  CHECK(*chart.x.high == doctest::Approx(2.1));
  chart = chart_of({{0, -2, 2}});
  reports::leave_room(chart);
  CHECK(*chart.x.low == doctest::Approx(-2.2));
  CHECK(*chart.x.high == doctest::Approx(2.2));
}

TEST_CASE("the end of loading is found in the history of a test that was followed further") {
  dem::Record record;
  dem::Table history{"history", {}, {}};
  history.add("axial_strain", "1", std::vector<double>{0, 1e-3, 2e-3, 1.5e-3, 2e-3});  // the gauge springs back
  history.add("axial_stress", "Pa", std::vector<double>{0, 5e7, 1e8, 8e7, 1e7});
  record.tables.push_back(history);
  CHECK_FALSE(dem::analysis::has_end_of_loading(record));
  CHECK(dem::analysis::end_of_loading(record) == 4);
  CHECK_FALSE(dem::analysis::is_followed(record));
  record.tables.push_back({"snapshots/0000", {{"moment", "peak"}, {"strain", "0.002"}, {"stress", "1e+08"}}, {}});
  record.tables.push_back({"snapshots/0001", {{"moment", "end"}, {"strain", "0.0015"}, {"stress", "8e+07"}}, {}});
  CHECK(dem::analysis::has_end_of_loading(record));
  CHECK(dem::analysis::end_of_loading(record) == 3);
  CHECK(dem::analysis::is_followed(record));
}

TEST_CASE("a sampled curve keeps its ends, its peak and its lowest point") {
  render::Chart chart;
  chart.series.resize(1);
  render::Series& curve = chart.series[0];
  for (int i = 0; i < 50000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(std::sin(i * 1e-3));
  }
  curve.y[31234] = 7;
  curve.y[41234] = -7;
  const auto few = reports::sampled(chart, 10000);
  CHECK(few.all == 50000);
  CHECK(few.drawn <= 10000);
  CHECK(few.drawn > 4000);
  const render::Series& thin = few.chart.series[0];
  CHECK(thin.x.front() == 0);
  CHECK(thin.x.back() == 49999);
  CHECK(std::ranges::max(thin.y) == 7);
  CHECK(std::ranges::min(thin.y) == -7);
  CHECK(std::ranges::is_sorted(thin.x));
  CHECK(reports::sampled(chart, 50000).chart.series[0].x.size() == 50000);
}

TEST_CASE("scale bars are round and not too long") {
  for (const double width : {1.2e-3, 6.25e-3, 12.5e-3, 25e-3, 3.0}) {
    CAPTURE(width);
    const auto bar = reports::scale_bar({.metres_per_pixel = width / 500, .width = 500});
    CHECK(bar.percent > 10);
    CHECK(bar.percent <= 40.001);
  }
  CHECK(reports::scale_bar({.metres_per_pixel = 25e-3 / 500, .width = 500}).text == "10 mm");
  CHECK(reports::scale_bar({.metres_per_pixel = 0, .width = 500}).percent == 0);
}

TEST_CASE("the sheet's runs of several seeds: the first is shown, all are judged") {
  using namespace reports::sheet;
  std::vector<dem::Record> records;
  for (const auto& [solver, seed, share] :
       {std::tuple{"converged", 1, 0.60}, {"converged", 2, 0.66}, {"converged", 3, 0.63}, {"historical", 1, 0.9}}) {
    dem::Record record;
    record.model = "sheet";
    record.quantities = dem::sheet::quantities();
    record.seed = static_cast<std::uint64_t>(seed);
    record.parameters = {
        {"test", "pure_shear"}, {"spread", 0.6}, {"solver", solver}, {"seed", static_cast<double>(seed)}};
    record.put(quantity::along_compression_share, share);
    records.push_back(std::move(record));
  }
  const auto study_of = [&](std::size_t count) {
    reports::StudyResult study;
    for (std::size_t i = 0; i < count; ++i) study.cases.push_back({"case", records[i].parameters, &records[i], ""});
    return study;
  };
  const auto share = [](const dem::Record& one) { return 100 * one.value(quantity::along_compression_share); };
  const reports::StudyResult all = study_of(4);
  CHECK(records_of(all) == std::vector<const dem::Record*>{&records[0], &records[3]});
  CHECK(seeds_of(all, records[0]).size() == 3);
  CHECK(seeds_of(all, records[3]).size() == 1);
  CHECK(label_of(records[0], all) == "converged, seed 1");
  CHECK(over_seeds_said(all, records_of(all), share, "the share is") ==
        " Over 3 seeds the share is 63 % (95 % interval 56 to 70) (converged).");
  CHECK(label_of(records[0], study_of(1)) == "this run");
  CHECK(over_seeds_said(study_of(1), {&records[0]}, share, "the share is").empty());

  using reports::Agreement;
  const auto part = [](const dem::Record& one) { return one.value(quantity::along_compression_share); };
  CHECK(mainly(over_seeds(all, records[0], part), 0.33) == Agreement::agrees);
  CHECK(mainly({0.55, 0.4, 0.7}, 0.33) == Agreement::undecided);  // the interval reaches below a half
  CHECK(mainly({0.25, 0.2, 0.3}, 0.33) == Agreement::disagrees);
}

TEST_CASE("the ledger takes every energy of a history in its role") {
  const auto terms = dem::analysis::ledger_terms(synthetic::compression(1, {.samples = 3}).table("history"));
  REQUIRE(terms.size() == 8);
  CHECK(terms.front().role == dem::analysis::LedgerTerm::Role::work);
  CHECK(terms[1].label == "Elastic");
  CHECK(terms.back().role == dem::analysis::LedgerTerm::Role::residual);

  dem::Table sheet;  // energies in elastic constants, beside other numbers without a unit
  sheet.name = "history";
  for (const char* name : {"strain", "elastic", "released", "boundary_work", "growth_work"})
    sheet.add(name, "1", std::vector<double>{1.0});
  const auto of_sheet = dem::analysis::ledger_terms(sheet);
  REQUIRE(of_sheet.size() == 4);
  CHECK(dem::analysis::in_elastic_constants(sheet));
  CHECK(of_sheet[0].role == dem::analysis::LedgerTerm::Role::work);
  CHECK(of_sheet[1].label == "Work of growing grains");
  CHECK(of_sheet[3].role == dem::analysis::LedgerTerm::Role::share);
}

TEST_CASE("summary.json has the promised structure") {
  const test::Scratch scratch;
  synthetic::Study study(scratch.path(), {.diameter = 3e-3, .height = 6e-3, .samples = 5});
  study.fail("direct_tension_ar_3", "the solution blew up");
  study.record("compression_ar_1").put(dem::texture::quantity::residual_over_peak, std::nan(""));
  const auto result = study.result();
  const auto comparisons = reports::compare(result, std::filesystem::path(DEM_SOURCE_DIR) / "assets/papers");
  const std::string text = reports::summary_json(result, comparisons, {}, "0.1.0");
  const auto json = nlohmann::json::parse(text);
  CHECK(json.at("format") == 4);
  CHECK(json.at("provenance").at("engine_version") == "0.1.0");
  CHECK(json["provenance"].at("physics_version") == study.record("compression_ar_1").physics_version);
  CHECK(json["provenance"].at("seed") == study.result().scenario->seed());
  CHECK(json["provenance"].at("scenario_sha256").get<std::string>().size() == 64);
  CHECK(json.at("quantities").at("young_modulus").at("unit") == "GPa");
  CHECK(json["quantities"].at("contact_share.*").at("kind") == "result");
  CHECK_FALSE(json["quantities"].contains("gap_share"));
  CHECK(json.at("scenario") == "ldb_aspect_ratio");
  CHECK(json.at("scale") == "draft");
  REQUIRE(json.at("cases").size() == 6);
  const auto& first = json["cases"][0];
  CHECK(first.at("id") == "compression_ar_1");
  CHECK(first.at("parameters").at("aspect_ratio") == 1);
  CHECK(first.at("results").at("young_modulus") == 70.3);
  CHECK(first["results"].at("crack_initiation").at("strain_0_1_percent").is_number());
  CHECK(first["results"].at("cracks").at("inter_tension").is_number_integer());
  CHECK_FALSE(first["results"].contains("residual_over_peak"));
  CHECK(json["cases"][5].at("error") == "the solution blew up");
  CHECK(json.at("checks")[0].at("id") == "compression_ar_1.energy_residual");
  for (const char* key : {"value", "limit", "held"}) CHECK(json["checks"][0].contains(key));
  const auto counts = comparisons.tally();
  CHECK(json.at("verdicts").at("not_judged") == counts.not_judged);
  CHECK(json["verdicts"].at("met") == 0);
  REQUIRE_FALSE(json.at("comparisons").empty());
  for (const auto& row : json["comparisons"]) {
    for (const char* key :
         {"id", "source", "published", "computed", "deviation", "tolerance", "verdict", "role", "of", "scale"})
      CHECK(row.contains(key));
    CHECK(row.at("verdict") != "met");  // the published numbers belong to another scale
  }
  CHECK(text == reports::summary_json(study.result(), comparisons, {}, "0.1.0"));
}

TEST_CASE("run.json nests by dots") {
  const auto json =
      nlohmann::json::parse(reports::run_json({{"host", "here"}, {"wall_s.total", 1.5}, {"wall_s.report", 2.0}}));
  CHECK(json.at("host") == "here");
  CHECK(json.at("wall_s").at("total") == 1.5);
}

TEST_CASE("text cells that a spreadsheet would compute are made harmless, numbers stay numbers") {
  for (const auto& [cell, written] : std::vector<std::pair<std::string, std::string>>{
           {"=1+1", "'=1+1"},
           {"@SUM(A1)", "'@SUM(A1)"},
           {"+cmd|' /C calc'!A0", "'+cmd|' /C calc'!A0"},
           {"-2+3+cmd", "'-2+3+cmd"},
           {"=HYPERLINK(\"x\",\"y\")", "\"'=HYPERLINK(\"\"x\"\",\"\"y\"\")\""},
           {"-", "'-"},
           {"--1", "'--1"},
           {"-1.5e-07", "-1.5e-07"},
           {"+3", "+3"},
           {"+4.68 %", "+4.68 %"},
           {"\u22121.5", "\u22121.5"},
           {"quartz", "quartz"}}) {
    CHECK(reports::csv(reports::TextTable{{cell}, {}}) == written + "\r\n");
  }
}

TEST_CASE("seeds are whole in summary.json: as numbers while a double holds them, as text beyond") {
  const test::Scratch scratch;
  const dem::Scenario scenario = synthetic::scenario(scratch.path());
  for (const auto& [seed, written] :
       std::vector<std::pair<std::uint64_t, std::string>>{{1, "1"},
                                                          {std::uint64_t{1} << 53, "9007199254740992"},
                                                          {(std::uint64_t{1} << 53) + 1, "\"9007199254740993\""},
                                                          {18446744073709551615U, "\"18446744073709551615\""}}) {
    dem::Record record;
    record.seed = seed;
    record.parameters = {{"test", "compression"}, {"seed", static_cast<double>(seed)}};
    const reports::StudyResult study{.scenario = &scenario,
                                     .cases = {{"a", record.parameters, &record, ""}},
                                     .quantities = dem::texture::quantities(),
                                     .parameters = dem::texture::parameters()};
    CHECK(reports::summary_json(study, {"", "", {}}, {}, "0.1.0").find("\"seed\": " + written + "\n") !=
          std::string::npos);
  }
}

TEST_CASE("cases are told apart by what sets them apart") {
  const test::Scratch scratch;
  const dem::Scenario scenario = synthetic::scenario(scratch.path());
  dem::Record base, small;
  base.parameters = {{"test", "compression"}, {"aspect_ratio", 1.0}, {"seed_scale", 1.0}};
  small.parameters = {{"test", "compression"}, {"aspect_ratio", 1.0}, {"seed_scale", 0.675}};
  const reports::StudyResult study{
      .scenario = &scenario,
      .cases = {{"a", base.parameters, &base, ""}, {"b", small.parameters, &small, ""}, {"c_d", {}, nullptr, "failed"}},
      .quantities = dem::texture::quantities(),
      .parameters = dem::texture::parameters()};
  CHECK(reports::case_label(study, study.cases[0]) == "base case");  // all have AR 1
  CHECK(reports::case_label(study, study.cases[1]) == "grain diameters × 0.675");
  CHECK(reports::case_label(study, study.cases[2]) == "C d");
}

TEST_CASE("a choice that each test has its own of is told in all tests or in none") {
  const test::Scratch scratch;
  const dem::Scenario scenario = synthetic::scenario(scratch.path());
  using namespace dem::lattice::parameter;
  static constexpr std::array declared{elements_y, planes_tension, planes_compression};
  const auto study_of = [&](const std::string& in_compression) {
    reports::StudyResult study{.scenario = &scenario, .cases = {}, .quantities = {}, .parameters = declared};
    for (const double size : {2.0, 4.0})
      study.cases.push_back(
          {"a", {{"test", "tension"}, {"elements_y", size}, {"planes_tension", "rigid"}}, nullptr, ""});
    study.cases.push_back(
        {"c", {{"test", "compression"}, {"elements_y", 4.0}, {"planes_compression", in_compression}}, nullptr, ""});
    return study;
  };
  const reports::StudyResult other = study_of("elastic"), alike = study_of("rigid");
  CHECK(reports::case_label(other, other.cases[0]) == "n = 2, planes rigid");
  CHECK(reports::case_label(other, other.cases[2]) == "n = 4, planes elastic");
  CHECK(reports::case_label(alike, alike.cases[0]) == "n = 2");
  CHECK(reports::case_label(alike, alike.cases[2]) == "n = 4");
}

TEST_CASE("a case is told by what varies in its test, and by its seed where each seed has a column") {
  const test::Scratch scratch;
  const dem::Scenario scenario = synthetic::scenario(scratch.path());
  std::vector<dem::Record> records;
  for (const auto& [test, pressure, seed] :
       {std::tuple{"compression", 0.0, 1.0}, std::tuple{"compression", 10.0, 1.0},
        std::tuple{"direct_tension", 0.0, 1.0}, std::tuple{"direct_tension", 0.0, 2.0}}) {
    dem::Record& record = records.emplace_back();
    record.model = "grain_texture";
    record.case_id = std::string(test) + reports::shortest(pressure) + reports::shortest(seed);
    record.model = "sheet";
    record.quantities = dem::sheet::quantities();
    record.seed = static_cast<std::uint64_t>(seed);
    record.parameters = {{"test", test}, {"aspect_ratio", 1.0}, {"confining_pressure", pressure}, {"seed", seed}};
    record.results = {{"particles", 600 + seed}};
  }
  const reports::StudyResult study = synthetic::study_of(scenario, records);
  CHECK(reports::case_label(study, study.cases[1]) == "σ₃ 10 MPa");
  CHECK(reports::case_label(study, study.cases[2]) == "AR 1");
  CHECK(reports::case_label(study, study.cases[2], true) == "seed 1");
  CHECK(reports::case_label(study, study.cases[3], true) == "seed 2");
  const std::string rows =
      kainjow::mustache::mustache("{{#c}}{{test}}: {{{parameters}}}, {{{particles}}} particles. {{/c}}")
          .render(kainjow::mustache::data("c", reports::cases_data(study)));
  CHECK(rows ==
        "compression: σ₃ 0 MPa, seed 1, 601 particles. compression: σ₃ 10 MPa, seed 1, 601 particles. "
        "direct tension: AR 1, seeds 1 and 2, 601–602 particles. ");
}

TEST_CASE("a series that fills a row begins one after another such series") {
  const auto rows = [](const std::vector<std::pair<std::string, int>>& series, int per_row) {
    const reports::Figure figure{};
    reports::DrawnFigure drawn;
    drawn.figure = &figure;
    for (const auto& [caption, count] : series) {
      for (int k = 0; k < count; ++k) {
        reports::DrawnPanel panel;
        panel.letter = static_cast<char>('a' + static_cast<int>(drawn.panels.size()));
        panel.caption = caption;
        panel.label = "case";
        panel.per_row = per_row;
        drawn.panels.push_back(panel);
      }
    }
    return kainjow::mustache::mustache("{{#f}}{{#panel_rows}}{{#panels}}{{letter}}{{/panels}} {{/panel_rows}}{{/f}}")
        .render(kainjow::mustache::data("f", reports::figures_data({drawn}, {})));
  };
  CHECK(rows({{"whole", 7}, {"cut", 7}}, 4) == "abcd efg hijk lmn ");
  CHECK(rows({{"whole", 1}, {"cut", 7}}, 4) == "abcd efgh ");
  CHECK(rows({{"whole", 2}, {"cut", 2}}, 4) == "abcd ");
  CHECK(rows({{"whole", 5}, {"cut", 5}}, 5) == "abcde fghij ");
}

TEST_CASE("charts beside each other have one height, and so have their frames") {
  const auto panel = [](int labels) {
    render::Chart chart;
    for (int k = 0; k < labels; ++k)
      chart.series.push_back(
          {.label = "a series with a long name " + std::to_string(k), .x = {0, 1}, .y = {0, 1}, .colour = {}});
    chart.legend = render::Chart::Legend::below;
    return reports::Panel{.id = "p", .caption = "", .alt = "", .content = chart, .per_row = 2};
  };
  std::vector<reports::Panel> panels{panel(1), panel(7)};
  reports::lay_out(panels);
  const auto &few = std::get<render::Chart>(panels[0].content), &many = std::get<render::Chart>(panels[1].content);
  CHECK(few.height == many.height);
  CHECK(few.foot > 0);
  CHECK(many.foot == 0);
  CHECK(render::plot_height(few) == doctest::Approx(render::plot_height(many)).epsilon(0.01));
}

TEST_CASE("a listing that was broken into lines says the same, and none of its comments ends") {
  const auto longest = [](const std::string& text) {
    std::size_t most = 0;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = text.find('\n', begin);
      most = std::max(most, end - begin);
      begin = end + 1;
    }
    return most;
  };
  const std::string made =
      "# one two three four five six seven eight nine ten    \n"
      "title = \"one two three four five # six seven eight\"  # a comment that goes on and on and on\n"
      "list = [\"one, two\", 'three # four', \"five\",  # six seven eight nine ten eleven\n"
      "  { a = 1, b = 2 }, 3]\n"
      "text = \"\"\"\nas it is, with # and all, however long it may be: nothing is broken here\n\"\"\"\n";
  const std::string broken = reports::listing(made, 30);
  CHECK(toml::parse(broken) == toml::parse(made));
  CHECK(broken.find("# one two three four five six\n# seven eight nine ten\n") == 0);
  for (const auto& file :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(DEM_SOURCE_DIR) / "scenarios")) {
    if (file.path().extension() != ".toml") continue;
    CAPTURE(file.path().string());
    const std::string text = dem::read_file(file.path());
    for (const std::size_t width : {40U, 62U}) {
      const std::string shown = reports::listing(text, width);
      CHECK(toml::parse(shown) == toml::parse(text));
      CHECK(longest(shown) <= width + 20);  // words that nothing breaks
    }
  }
}

TEST_CASE("broken springs of a sheet with a layer are told apart by the grains of their particles") {
  // Four rows of three: matrix, layer, layer, matrix.
  const double r = 1.0 / 6, row = std::sqrt(3.0) * r;
  std::vector<double> place;
  std::vector<std::int32_t> grain;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 3; ++x) {
      place.insert(place.end(), {r + 2 * r * x + (y % 2 == 1 ? r : 0), r + row * y});
      grain.push_back(y == 0 ? 0 : y < 3 ? 1 : 2);
    }
  }
  dem::Record record;
  dem::Table particles{"particles", {{"columns", "3"}, {"rows", "4"}, {"radius", std::to_string(r)}}, {}};
  particles.add("position", "1", place, 2);
  particles.add("grain", "", grain);
  dem::Table grains{"grains", {}, {}};
  grains.add("growth", "1", std::vector<double>(3, 0.0));
  grains.add("stiffness", "1", std::vector<double>{0.01, 1, 0.012});
  dem::Table cracks{"cracks", {}, {}};
  std::vector<double> middle;
  for (const auto& [i, j] : {std::pair{3, 4}, {4, 6}, {7, 8}, {0, 3}, {7, 10}, {9, 10}})
    for (std::size_t k = 0; k < 2; ++k)
      middle.push_back(0.5 * (place[2 * static_cast<std::size_t>(i) + k] + place[2 * static_cast<std::size_t>(j) + k]));
  cracks.add("position", "1", middle, 2);
  cracks.add("place", "", std::vector<std::int32_t>{0, 0, 0, 1, 1, 0});
  cracks.add("strain", "1", std::vector<double>{1, 1, 2, 1, 2, 2});
  dem::Table history{"history", {}, {}};
  history.add("crossing_fractures", "1", std::vector<double>{0});
  record.tables = {particles, grains, cracks, history};
  using enum reports::sheet::CrackPlace;
  CHECK(reports::sheet::places_of(record) == std::vector{inside, inside, inside, edge, edge, matrix});
  CHECK(reports::sheet::crack_counts(record, 1) == std::array<int, 4>{2, 0, 1, 0});
  CHECK(reports::sheet::crack_counts(record, 2) == std::array<int, 4>{3, 0, 2, 1});
  CHECK(reports::sheet::between_by_chance(record) == doctest::Approx(10.0 / 23));
}
