// Verdicts: our numbers beside published ones.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/lattice/keys.h"
#include "engine/lattice/quantities.h"
#include "engine/texture/quantities.h"
#include "reports/figures/table.h"
#include "reports/published/papers.h"
#include "reports/published/published.h"
#include "tests/reports/synthetic.h"
#include "tests/support/scratch.h"

namespace {

namespace quantity = dem::texture::quantity;

using reports::Comparison;
using reports::Verdict;

/// A study of three cases with one result each.
struct Fixture {
  test::Scratch scratch;
  dem::Scenario scenario = synthetic::scenario(scratch.path());
  std::vector<dem::Record> records;

  Fixture() {
    for (const double ucs : {206.0, 190.0, 195.0}) {
      records.push_back(made(static_cast<double>(records.size() + 1), 1, ucs));
    }
  }

  static dem::Record made(double aspect_ratio, double seed, double ucs) {
    dem::Record record;
    record.case_id = fmt::format("compression_ar_{:g}_seed_{:g}", aspect_ratio, seed);
    record.parameters = {{"test", "compression"}, {"aspect_ratio", aspect_ratio}, {"seed", seed}};
    record.quantities = dem::texture::quantities();
    record.put(quantity::compressive_strength, ucs);
    record.put(quantity::inter_grain_share, 0.5);
    return record;
  }

  [[nodiscard]] reports::StudyResult study() const { return synthetic::study_of(scenario, records); }

  [[nodiscard]] std::vector<Comparison> compared(const std::string& numbers, const reports::StudyResult& study) const {
    dem::write_file(scratch / "papers/p/published.json", R"({"numbers": [)" + numbers + "]}");
    dem::write_file(scratch / "papers/p/paper.json", R"({"model": "grain_texture", "paper": "P", "scale": "paper"})");
    return reports::compare(study, scratch / "papers").rows;
  }
  [[nodiscard]] Comparison one(const std::string& rest) const { return one(rest, study()); }
  [[nodiscard]] Comparison one(const std::string& rest, const reports::StudyResult& study) const {
    const auto rows =
        compared(R"({"id": "x", "topics": ["aspect_ratio"], "source": "S", "quantity": "Q", )" + rest + "}", study);
    REQUIRE(rows.size() == 1);
    return rows[0];
  }
};

constexpr const char* ucs_1 = R"("of": {"test": "compression", "aspect_ratio": 1, "of": "compressive_strength"})";

std::string value(const std::string& published, const std::string& tolerance, const std::string& of = ucs_1) {
  return R"("kind": "value", "published": )" + published + R"(, "tolerance": )" + tolerance + ", " + of;
}

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a value is met within a relative tolerance and missed beyond it") {
  const Comparison near = one(value("200", R"({"relative": 0.1})"));
  CHECK(near.verdict == Verdict::met);
  CHECK(near.relative);
  CHECK(*near.deviation == doctest::Approx(0.03));
  CHECK(*near.tolerance == 0.1);
  CHECK(std::get<double>(*near.computed) == 206);
  CHECK(one(value("206", R"({"relative": 0})")).verdict == Verdict::met);
  CHECK(one(value("250", R"({"relative": 0.1})")).verdict == Verdict::missed);
  CHECK(*one(value("250", R"({"relative": 0.1})")).deviation < 0);
}

TEST_CASE_FIXTURE(Fixture, "an absolute tolerance is in the unit of the number") {
  CHECK(one(value("204", R"({"absolute": 2})")).verdict == Verdict::met);
  CHECK(one(value("203.9", R"({"absolute": 2})")).verdict == Verdict::missed);
}

TEST_CASE_FIXTURE(Fixture, "a range is left only beyond its ends") {
  CHECK(*one(value("[200, 210]", R"({"relative": 0.01})")).deviation == 0);
  const Comparison above = one(value("[100, 200]", R"({"absolute": 5})"));
  CHECK(*above.deviation == doctest::Approx(6));
  CHECK(above.verdict == Verdict::missed);
}

TEST_CASE_FIXTURE(Fixture, "terms: quotients, sums, means, differences, constants, factors, in the shown unit") {
  const std::string a = R"({"test": "compression", "aspect_ratio": 1, "of": "compressive_strength"})";
  const std::string b = R"({"test": "compression", "aspect_ratio": 2, "of": "compressive_strength"})";
  const auto of = [&](const std::string& term) {
    return std::get<double>(*one(value("1", R"({"relative": 1})", "\"of\": " + term)).computed);
  };
  CHECK(of(R"({"quotient": [)" + a + "," + b + "]}") == doctest::Approx(206.0 / 190.0));
  CHECK(of(R"({"sum": [)" + a + "," + b + "]}") == doctest::Approx(396));
  CHECK(of(R"({"difference": [)" + a + "," + b + "]}") == doctest::Approx(16));
  CHECK(of(R"({"mean": [)" + a + "," + b + "]}") == doctest::Approx(198));
  CHECK(of(R"({"times": 0.5, "test": "compression", "aspect_ratio": 1, "of": "inter_grain_share"})") ==
        doctest::Approx(25));  // half of what is shown: 50 %
  CHECK(of(R"({"difference": [)" + a + R"(, {"constant": 6}]})") == doctest::Approx(200));
}

TEST_CASE_FIXTURE(Fixture, "a trend is judged by the sign of its slope") {
  const std::string falls =
      R"("kind": "trend", "published": "falls", "over": {"aspect_ratio": [1, 2, 3]}, "of": {"test": "compression", "of": "compressive_strength"})";
  const Comparison row = one(falls);
  CHECK(row.verdict == Verdict::met);
  CHECK(std::get<std::string>(*row.computed) == "falls");
  CHECK(row.detail.find("not at every step") != std::string::npos);
  records[2].results[0].second = 230;
  CHECK(one(falls).verdict == Verdict::missed);
  records[1].results[0].second = records[2].results[0].second = 206;
  CHECK(std::get<std::string>(*one(falls).computed) == "stays level");
  CHECK(one(falls).verdict == Verdict::missed);
}

TEST_CASE_FIXTURE(Fixture, "a trend over several seeds must stand out of their scatter") {
  const std::string falls =
      R"("kind": "trend", "published": "falls", "over": {"aspect_ratio": [1, 2, 3]}, "of": {"test": "compression", "of": "compressive_strength"})";
  const auto repeated = [&](double scatter) {
    records.clear();
    for (int ar = 1; ar <= 3; ++ar) {
      for (int seed = 1; seed <= 4; ++seed) {
        records.push_back(made(ar, seed, 200.0 - 5 * ar + scatter * (seed - 2.5)));
      }
    }
    return one(falls);
  };
  const Comparison clear = repeated(0.5), hidden = repeated(20);
  CHECK(clear.by_interval);
  CHECK(clear.verdict == Verdict::met);
  CHECK(hidden.by_interval);
  CHECK(hidden.verdict == Verdict::missed);
  CHECK(std::get<std::string>(*hidden.computed) == "lost in scatter");
}

TEST_CASE_FIXTURE(Fixture, "steps of a trend may have a fraction") {
  records = {made(1, 1, 10), made(1.5, 1, 15), made(4, 1, 40)};
  const Comparison row = one(
      R"("kind": "trend", "published": "rises", "over": {"aspect_ratio": [1, 1.5, 4]}, "of": {"test": "compression", "of": "compressive_strength"})");
  CHECK(row.verdict == Verdict::met);
  CHECK(row.detail.find("slope 10 ") != std::string::npos);
}

TEST_CASE_FIXTURE(Fixture, "numbers of one rock are not set beside another") {
  const std::string entry = R"({"id": "x", "topics": ["aspect_ratio"], "source": "S", "quantity": "Q", )" +
                            value("200", R"({"relative": 0.1})") + "}";
  CHECK(compared(entry, study()).size() == 1);
  dem::write_file(scratch / "papers/p/paper.json", R"({"model": "grain_texture", "paper": "P", "rock": "granite"})");
  CHECK_FALSE(reports::of_a_paper(scenario.with("rock", std::string("my rock")), scratch / "papers"));
  CHECK(reports::of_a_paper(scenario.with("rock", std::string("granite")), scratch / "papers"));
  auto other = study();
  other.of_a_paper = false;
  CHECK(compared(entry, other).empty());
}

TEST_CASE_FIXTURE(Fixture, "greater is greater") {
  const std::string a = R"({"test": "compression", "aspect_ratio": 1, "of": "compressive_strength"})";
  const std::string b = R"({"test": "compression", "aspect_ratio": 2, "of": "compressive_strength"})";
  CHECK(one(R"("kind": "greater", "of": )" + a + R"(, "than": )" + b).verdict == Verdict::met);
  CHECK(one(R"("kind": "greater", "of": )" + b + R"(, "than": )" + a).verdict == Verdict::missed);
}

TEST_CASE_FIXTURE(Fixture, "what is missing is not computed, and says why") {
  const std::string wanted = value("200", R"({"relative": 0.1})");
  auto failed = study();
  failed.cases[0].record = nullptr;
  failed.cases[0].error = "the specimen cannot be packed";
  CHECK(one(wanted, failed).verdict == Verdict::not_computed);
  CHECK(one(wanted, failed).detail == "case compression_ar_1_seed_1 failed");
  failed.cases[0].error.clear();
  CHECK(one(wanted, failed).detail == "case compression_ar_1_seed_1 was not run");
  records[0].results.clear();
  CHECK(one(wanted).verdict == Verdict::not_computed);
  CHECK(one(wanted).detail.find("Compressive strength") != std::string::npos);
  CHECK_FALSE(one(wanted).computed.has_value());
}

TEST_CASE_FIXTURE(Fixture, "numbers of other scenarios and optional ones without a case are left out") {
  const std::string entry =
      R"({"id": "x", "topics": ["other"], "source": "S", "quantity": "Q", )" + value("1", R"({"relative": 1})") + "}";
  CHECK(compared(entry, study()).size() == 1);  // a scenario without topics: by its cases
  scenario = scenario.with("published", std::vector<std::string>{"aspect_ratio"});
  CHECK(compared(entry, study()).empty());
  const std::string optional =
      R"({"id": "x", "optional": true, "topics": ["aspect_ratio"], "source": "S", "quantity": "Q", "kind": "value",
    "published": 1, "tolerance": {"relative": 1}, "of": {"test": "compression", "aspect_ratio": 9, "of": "compressive_strength"}})";
  CHECK(compared(optional, study()).empty());
}

TEST_CASE_FIXTURE(Fixture, "a broken file of published numbers is named") {
  CHECK_THROWS_WITH_AS(compared("{", study()), doctest::Contains("papers/p/published.json"), dem::EnvironmentError);
  CHECK_THROWS_WITH_AS(one(R"("kind": "guess")"), doctest::Contains("published"), dem::EnvironmentError);
}

TEST_CASE("the published numbers of the grain texture model can be read and have unlike ids") {
  const test::Scratch scratch;
  const dem::Scenario scenario = synthetic::scenario(scratch.path(), "study", "published = [\"aspect_ratio\"]");
  const reports::StudyResult empty = synthetic::study_of(scenario, {});
  const auto found = reports::compare(empty, std::filesystem::path(DEM_SOURCE_DIR) / "assets/papers");
  CHECK(found.rows.size() >= 25);
  CHECK(found.scale == "paper");
  std::vector<std::string> ids;
  for (const Comparison& row : found.rows) {
    CAPTURE(row.id);
    CHECK(row.verdict == Verdict::not_computed);
    CHECK_FALSE(row.source.empty());
    ids.push_back(row.id);
  }
  std::ranges::sort(ids);
  CHECK(std::ranges::adjacent_find(ids) == ids.end());
}

TEST_CASE_FIXTURE(Fixture, "figures are given every value and range of the paper, compared or quoted") {
  dem::write_file(
      scratch / "papers/p/published.json",
      R"({"numbers": [)"
      R"({"id": "a", "topics": ["another"], "source": "S", "quantity": "Q", "unit": "MPa", )" +
          value("206.8", R"({"relative": 0.1})") +
          R"(}, {"id": "t", "topics": [], "source": "S", "quantity": "Q", "kind": "trend", "published": "rises"}], )"
          R"("quoted": [{"id": "b", "source": "T", "quantity": "R", "published": [2, 3]}]})");
  dem::write_file(scratch / "papers/p/paper.json", R"({"model": "grain_texture", "paper": "P"})");
  dem::write_file(scratch / "papers/q/published.json", R"({"numbers": [{"broken": 1}]})");
  dem::write_file(scratch / "papers/q/paper.json", R"({"model": "sheet", "paper": "P"})");
  auto known = study();
  known.published = reports::published_numbers(known, scratch / "papers");
  REQUIRE(known.published.size() == 2);
  CHECK(known.published_value("a") == 206.8);
  CHECK(known.published[0].unit == "MPa");
  CHECK(known.published[1].source == "T");
  CHECK(known.published[1].low == 2);
  CHECK(known.published[1].high == 3);
  CHECK(std::isnan(known.published_value("t")));
  CHECK(std::isnan(study().published_value("a")));
}

TEST_CASE("the lattice's figures take what the paper states from its file") {
  const dem::Scenario scenario = dem::Scenario::read(DEM_SOURCE_DIR "/scenarios/quartzite_strength.toml", "smoke", {},
                                                     [](std::string_view) { return dem::lattice::keys(); });
  namespace block = dem::lattice::quantity;
  dem::Record record;
  record.parameters = {{"test", "compression"}, {"elements_y", 4.0}};
  record.quantities = dem::lattice::quantities();
  record.put(block::normal_stiffness, 46.794e6);
  record.put(block::shear_stiffness, 8.068e6);
  record.put(block::breaking_displacement, 1.704e-7);
  record.put(block::initial_shear_resistance, 18.452);
  record.put(block::contact_friction, 0.3964);
  record.put(block::element_mass, 1.02 * 1.874e-6);
  record.put(block::opening_stress_theory, 95.9);
  record.tables.push_back({.name = "particles", .attributes = {}, .columns = {}});
  reports::StudyResult study{.scenario = &scenario,
                             .cases = {{"compression_n_4", record.parameters, &record, ""}},
                             .quantities = dem::lattice::quantities(),
                             .parameters = dem::lattice::parameters()};
  CHECK(reports::lattice::parameters(study).finding.empty());
  study.published = reports::published_numbers(study, DEM_SOURCE_DIR "/assets/papers");
  CHECK(reports::lattice::parameters(study).finding ==
        "The largest deviation from the six published parameters is 2.000 %.");
  for (const char* id :
       {"unit_tensile_strength", "mean_tensile_strength", "unit_compressive_strength", "mean_compressive_strength"}) {
    CAPTURE(id);
    CHECK(study.published_value(id) < 0);
  }
}
