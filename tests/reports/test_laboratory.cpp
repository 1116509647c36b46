// What the user's laboratory measured, beside ours.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/texture/quantities.h"
#include "reports/figures/table.h"
#include "reports/output/summary.h"
#include "reports/published/laboratory.h"
#include "tests/reports/synthetic.h"
#include "tests/support/scratch.h"

namespace {

namespace quantity = dem::texture::quantity;
using reports::Verdict;

/// Three seeds of a compression test, and one of a tension test.
struct Fixture {
  test::Scratch scratch;
  dem::Scenario scenario;
  std::vector<dem::Record> records;

  explicit Fixture(const std::string& measured)
      : scenario(synthetic::scenario(scratch.path(), "mine", "[measured]\n" + measured)) {
    for (const double ucs : {205.0, 210.0, 212.0}) {
      dem::Record record;
      const auto seed = static_cast<double>(records.size() + 1);
      record.case_id = fmt::format("compression_seed_{:g}", seed);
      record.parameters = {
          {"test", "compression"}, {"aspect_ratio", 1.0}, {"mineral", ""}, {"confining_pressure", 0.0}, {"seed", seed}};
      record.quantities = dem::texture::quantities();
      record.put(quantity::compressive_strength, ucs);
      record.put(quantity::young_modulus, 70.0);
      record.put(quantity::initiation_by_cracks, 80.0);
      records.push_back(record);
    }
  }

  [[nodiscard]] reports::StudyResult study() const {
    reports::StudyResult result = synthetic::study_of(scenario, records);
    result.measurables = dem::texture::measurables();
    return result;
  }
  [[nodiscard]] std::vector<reports::LaboratoryRow> rows() const { return reports::beside_laboratory(study()); }
};

}  // namespace

TEST_CASE("ours is within the laboratory's uncertainty, outside or undecided by its interval") {
  // 209 with an interval of 200 to 218.
  CHECK(Fixture("ucs = \"210 MPa +- 20\"\n").rows().front().verdict == Verdict::met);
  CHECK(Fixture("ucs = \"210 MPa +- 2\"\n").rows().front().verdict == Verdict::undecided);
  CHECK(Fixture("ucs = \"250-260 MPa\"\n").rows().front().verdict == Verdict::missed);
  CHECK(Fixture("ucs = \"210 MPa\"\n").rows().front().verdict == Verdict::not_judged);
  CHECK(Fixture("tensile_strength = \"9.3 MPa +- 1\"\n").rows().front().verdict == Verdict::not_computed);
  CHECK(Fixture("brazilian_strength = \"9.3 MPa +- 1\"\n").rows().front().verdict == Verdict::not_computed);
  const auto row = Fixture("ucs = \"0.21 GPa +- 20 MPa\"\n").rows().front();
  CHECK(row.ours->value == doctest::Approx(209));
  CHECK(row.seeds == 3);
  CHECK(row.number.value == doctest::Approx(210));
  CHECK(reports::laboratory_text(row.number) == "210 ± 20 MPa");
  CHECK(reports::laboratory_text(Fixture("ucs = \"200-228 MPa\"\n").rows().front().number) == "200 to 228 MPa");
}

TEST_CASE("which reading crack initiation is compared with is a choice") {
  const std::string measured = "crack_initiation = \"80 MPa +- 5\"\n";
  CHECK(Fixture(measured).rows().front().verdict == Verdict::met);
  CHECK(Fixture(measured + "crack_initiation_by = \"axial_stiffness\"\n").rows().front().verdict ==
        Verdict::not_computed);
}

TEST_CASE("peaks at pressures are a row each, and minerals have their own") {
  const Fixture fixture("peaks = [\"320 MPa +- 10 at 20 MPa\", \"400-440 MPa at 40 MPa\"]\n");
  const auto rows = fixture.rows();
  REQUIRE(rows.size() == 2);
  CHECK(rows[1].number.pressure == doctest::Approx(40));
  CHECK(reports::laboratory_name(rows[1].number) == "Peak stress at σ₃ 40 MPa");
}

TEST_CASE("nothing is said of a rock that nothing was measured of, and summary.json keeps its form") {
  const Fixture none("");
  CHECK(none.rows().empty());
  CHECK(reports::laboratory_tally(none.rows()).empty());
  CHECK(reports::summary_json(none.study(), {}, {}, "0.1.0").find("laboratory") == std::string::npos);
  const Fixture some("ucs = \"210 MPa +- 20\"\nyoung_modulus = \"60 GPa +- 1\"\n");
  CHECK(reports::laboratory_tally(some.rows()) ==
        "Of 2 values measured in the laboratory ours are within the uncertainty of 1 and outside that of 1.");
  const auto json = nlohmann::json::parse(reports::summary_json(some.study(), {}, {}, "0.1.0"));
  CHECK(json.at("laboratory").size() == 2);
  CHECK(json.at("laboratory").at(0).at("verdict") == "outside");
}

TEST_CASE("the chart of laboratory and model holds what both have, over the measured value") {
  const Fixture fixture("ucs = \"220 MPa +- 11\"\nyoung_modulus = \"70 GPa\"\ntensile_strength = \"9 MPa +- 1\"\n");
  reports::StudyResult study = fixture.study();
  study.laboratory = reports::laboratory_numbers(study);
  const reports::FigureContent content = reports::texture::laboratory_comparison(study);
  CHECK(content.finding == "Over the measured values: E 100 %; UCS 95.0 %.");  // 209 of 220; no tension test
  REQUIRE(content.panels.size() == 1);
  const auto& chart = std::get<render::Chart>(content.panels.front().content);
  CHECK(chart.series[0].y_error[1] == doctest::Approx(5));  // 11 of 220
  CHECK(chart.series[1].y_error[1] ==
        doctest::Approx(4.07).epsilon(0.01));  // t(0.975, 2) s / sqrt(3), of 205, 210, 212
  study.laboratory.clear();
  CHECK(reports::texture::laboratory_comparison(study).finding.empty());
}
