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
#include "reports/page/page_parts.h"
#include "reports/published/papers.h"
#include "reports/published/published.h"
#include "reports/published/standing.h"
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
  std::string scale = "draft";  ///< of the published numbers; the study's as well

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
    dem::write_file(scratch / "papers/p/paper.json",
                    R"({"model": "grain_texture", "paper": "P", "scale": ")" + scale + "\"}");
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

TEST_CASE("a value is judged by its interval where it has one") {
  const reports::Band band{90, 110};
  const double none = std::nan("");
  struct Row {
    double ours, low, high;
    Verdict verdict;
  };
  for (const Row& row : {Row{100, 95, 105, Verdict::met},           // inside
                         Row{92, 90, 94, Verdict::met},             // inside, up to the end
                         Row{100, -52, 110.5, Verdict::undecided},  // anything could be
                         Row{92, 88, 96, Verdict::undecided},       // across one end
                         Row{85, 80, 90, Verdict::undecided},       // the end itself is in the band
                         Row{85, 80, 89, Verdict::missed},          // outside
                         Row{200, 150, 250, Verdict::missed}, Row{100, none, none, Verdict::met},
                         Row{110, none, none, Verdict::met}, Row{110.5, none, none, Verdict::missed}}) {
    CAPTURE(row.ours);
    CAPTURE(row.low);
    CHECK(reports::judge_value(row.ours, dem::analysis::Estimate{row.ours, row.low, row.high}, band) == row.verdict);
  }
  CHECK(reports::judge_value(100, std::nullopt, band) == Verdict::met);
}

TEST_CASE("a trend or a difference is judged by the side of zero that its interval lies on") {
  const double none = std::nan("");
  struct Row {
    double ours, low, high;
    int sign;
    bool by_chance;
    Verdict verdict;
  };
  for (const Row& row :
       {Row{2, 1, 3, 1, true, Verdict::met}, Row{2, 1, 3, -1, true, Verdict::missed},
        Row{-2, -3, -1, -1, true, Verdict::met}, Row{-2, -3, -1, 1, true, Verdict::missed},
        Row{2, -1, 5, 1, true, Verdict::undecided}, Row{2, -1, 5, -1, true, Verdict::undecided},
        Row{0, 0, 0, 1, true, Verdict::missed}, Row{2, 0, 4, 1, true, Verdict::undecided},
        Row{2, none, none, 1, true, Verdict::undecided},  // two points, or one seed
        Row{2, none, none, 1, false, Verdict::met},       // nothing is left to chance
        Row{2, none, none, -1, false, Verdict::missed}, Row{0, none, none, 1, false, Verdict::missed}}) {
    CAPTURE(row.ours);
    CAPTURE(row.sign);
    CHECK(reports::judge_sign({row.ours, row.low, row.high}, row.sign, row.by_chance) == row.verdict);
  }
}

TEST_CASE("only published numbers count as met or missed") {
  using reports::Role;
  reports::Tally counts;
  for (const Verdict verdict :
       {Verdict::met, Verdict::missed, Verdict::undecided, Verdict::not_judged, Verdict::not_computed}) {
    for (const Role role :
         {Role::number, Role::fitted, Role::theory, Role::stated, Role::derived, Role::follows, Role::sensitivity}) {
      counts.add(role, verdict, true);
    }
  }
  CHECK(counts.met == 1);
  CHECK(counts.missed == 1);
  CHECK(counts.undecided == 1);
  CHECK(counts.not_judged == 1);
  CHECK(counts.not_computed == 1);
  CHECK(counts.numbers() == 5);
  CHECK(counts.fitted == 5);
  CHECK(counts.theory == 5);
  CHECK(counts.stated == 5);
  CHECK(counts.derived == 5);
  CHECK(counts.follows == 5);
  CHECK(
      reports::tally_text(counts, "paper") ==
      "Of 5 published numbers and trends, 1 is met, 1 missed, 1 undecided, 1 not judged (published at paper scale) "
      "and 1 not "
      "computed. Counted separately: 5 published in words (the limits are ours; 1 met, 1 missed, 1 undecided, 1 not "
      "computed), 5 derived from "
      "published numbers (1 not computed), 5 that follow from others (1 not computed), 5 to which a choice was fitted "
      "(1 not computed) and 5 that check a formula (1 not computed).");
  CHECK(reports::tally_text({.met = 0, .missed = 0, .undecided = 0, .not_judged = 3}, "paper") ==
        "None of the 3 published numbers is judged: they belong to the scale “paper”.");
  CHECK(reports::tally_text({.met = 0, .missed = 2}, "paper") == "Of 2 published numbers, none is met and 2 missed.");
  CHECK(reports::tally_text({.met = 2}, "paper") == "Of 2 published numbers, 2 are met.");
  CHECK(reports::tally_text({.met = 1}, "paper") == "Of one published number, 1 is met.");
  CHECK(reports::tally_text({.met = 2, .stated = 3, .stated_met = 3}, "paper") ==
        "Of 2 published numbers, 2 are met. Counted separately: 3 published in words, all met (the limits are ours).");
}

constexpr const char* falls =
    R"("kind": "trend", "published": "falls", "over": {"aspect_ratio": [1, 2, 3]}, "of": {"test": "compression", "of": "compressive_strength"})";

void without_seeds(std::vector<dem::Record>& records) {
  for (dem::Record& record : records) std::erase_if(record.parameters, [](const auto& p) { return p.first == "seed"; });
}

TEST_CASE_FIXTURE(Fixture, "a trend that its interval does not tell from scatter is undecided") {
  without_seeds(records);
  const Comparison scattered = one(falls);  // 206, 190, 195
  CHECK(scattered.verdict == Verdict::undecided);
  CHECK(std::get<std::string>(*scattered.computed) == "no clear trend");
  CHECK(scattered.detail.find("not at every step") != std::string::npos);
  CHECK(scattered.estimate->low < 0);
  CHECK(scattered.estimate->high > 0);
  CHECK(*scattered.p_value > 0.05);
  records[1].results[0].second = 200;
  records[2].results[0].second = 194.01;
  CHECK(one(falls).verdict == Verdict::met);
  CHECK(std::get<std::string>(*one(falls).computed) == "falls");
  records[0].results[0].second = 188;
  records[2].results[0].second = 212.01;
  CHECK(one(falls).verdict == Verdict::missed);
  for (int i : {1, 2}) records[i].results[0].second = 188;
  CHECK(std::get<std::string>(*one(falls).computed) == "stays level");
  CHECK(one(falls).verdict == Verdict::missed);
}

TEST_CASE_FIXTURE(Fixture, "two points alone have no interval") {
  records.pop_back();
  const Comparison row = one(falls);
  CHECK(row.verdict == Verdict::undecided);
  CHECK(std::get<std::string>(*row.computed) == "one seed cannot show a trend");
  CHECK(row.detail.find("slope") != std::string::npos);
  without_seeds(records);
  CHECK(one(falls).verdict == Verdict::met);  // nothing is left to chance
}

TEST_CASE_FIXTURE(Fixture, "the slopes of several seeds decide a trend, under three nothing does") {
  const auto repeated = [&](int seeds, double shift, double tilt, const std::string& more = "") {
    records.clear();
    for (int ar = 1; ar <= 3; ++ar) {
      for (int seed = 1; seed <= seeds; ++seed)
        records.push_back(made(ar, seed, 200.0 - 5 * ar + (seed - 2.5) * (shift + tilt * ar)));
    }
    return one(falls + more);
  };
  CHECK(repeated(4, 0, 0.5).verdict == Verdict::met);
  CHECK(repeated(4, 20, 0.5).verdict == Verdict::met);  // stronger packings: each falls for itself
  CHECK(repeated(4, 0, 20).verdict == Verdict::undecided);
  CHECK(repeated(2, 0, 0).verdict == Verdict::undecided);
  CHECK(std::get<std::string>(*repeated(2, 0, 0).computed) == "2 seeds cannot show a trend");
  CHECK(repeated(1, 0, 0).verdict == Verdict::undecided);
  CHECK(*repeated(4, 0, 0.5).p_value < 0.05);
  CHECK(repeated(4, 0, 0.5).estimate->value == doctest::Approx(-5));
  CHECK(repeated(4, 0, 0.5, R"(, "resolution": 0.04)").verdict == Verdict::met);  // 10 of 190
  const Comparison small = repeated(4, 0, 0.5, R"(, "resolution": 0.08)");
  CHECK(small.verdict == Verdict::undecided);
  CHECK(std::get<std::string>(*small.computed) == "no clear trend");
  records.erase(records.begin() + 11);  // a seed without its last step has no slope of all
  CHECK(one(falls).detail.find("3 seeds") != std::string::npos);
}

TEST_CASE_FIXTURE(Fixture, "terms: extremes, distances, families and what is read off tables") {
  for (dem::Record& record : records)
    record.put(quantity::mineral_share, "quartz", record.number("aspect_ratio") == 2 ? 0.4 : 0.3);
  records[2].put(quantity::mineral_share, "biotite", 0.25);
  const std::string a = R"({"test": "compression", "aspect_ratio": 1, "of": "compressive_strength"})";
  const std::string b = R"({"test": "compression", "aspect_ratio": 2, "of": "compressive_strength"})";
  const auto of = [&](const std::string& term) {
    return std::get<double>(*one(value("1", R"({"relative": 1})", "\"of\": " + term)).computed);
  };
  CHECK(of(R"({"largest": [)" + a + "," + b + "]}") == 206);
  CHECK(of(R"({"least": [)" + a + "," + b + "]}") == 190);
  CHECK(of(R"({"distance": [)" + b + "," + a + "]}") == doctest::Approx(16));
  const auto furthest = [&](int one, int other) {
    return of(fmt::format(R"({{"furthest": "mineral_share.*", "apart": [{{"test": "compression", "aspect_ratio": {}}},
                          {{"test": "compression", "aspect_ratio": {}}}]}})",
                          one, other));
  };
  CHECK(furthest(1, 2) == doctest::Approx(10));
  CHECK(furthest(1, 3) == doctest::Approx(25));  // what one of them has not is none
  CHECK(furthest(3, 1) == doctest::Approx(25));
  const Comparison row = one(
      value("1", R"({"relative": 1})",
            R"("of": {"test": "compression", "aspect_ratio": 1, "derived": "cracks", "which": {"place": "inter"}})"));
  CHECK(row.verdict == Verdict::not_computed);
  CHECK(row.detail.find("compression_ar_1") != std::string::npos);  // it keeps no table of cracks
  CHECK_THROWS_WITH_AS(
      (void)one(value(
          "1", R"({"relative": 1})",
          R"("of": {"test": "compression", "aspect_ratio": 1, "derived": "cracks", "which": {"where": "inter"}})")),
      doctest::Contains("cracks have no 'where'"), dem::EnvironmentError);
}

TEST_CASE_FIXTURE(Fixture, "the mean of three seeds has an interval, that of two is judged alone") {
  const auto seeds = [&](std::initializer_list<double> strengths) {
    records.clear();
    for (const double ucs : strengths) records.push_back(made(1, static_cast<double>(records.size() + 1), ucs));
    return one(value("200", R"({"relative": 0.1})"));
  };
  CHECK(seeds({199, 200, 201}).verdict == Verdict::met);
  CHECK(seeds({170, 200, 230}).verdict == Verdict::undecided);
  CHECK(seeds({170, 230}).verdict == Verdict::met);
  CHECK_FALSE(seeds({170, 230}).estimate->has_interval());
  CHECK(seeds({170, 230}).detail.find("mean of 2 seeds") != std::string::npos);
}

TEST_CASE_FIXTURE(Fixture, "at another scale nothing is judged, and what grows with the specimen not even compared") {
  for (dem::Record& record : records) record.put(quantity::cracks_inter_tension, 100);
  const std::string particles = R"("of": {"test": "compression", "aspect_ratio": 1, "of": "cracks.inter_tension"})";
  const std::string share =
      R"("of": {"quotient": [{"test": "compression", "aspect_ratio": 1, "of": "cracks.inter_tension"}, {"test": "compression", "aspect_ratio": 2, "of": "cracks.inter_tension"}]})";
  CHECK(one(value("5000", R"({"relative": 0.1})", particles)).verdict == Verdict::missed);
  scale = "paper";
  const Comparison strength = one(value("250", R"({"relative": 0.1})"));
  CHECK(strength.verdict == Verdict::not_judged);
  CHECK(strength.outcome == Verdict::missed);
  CHECK(*strength.deviation == doctest::Approx(-0.176));
  const Comparison count = one(value("5000", R"({"relative": 0.1})", particles));
  CHECK(count.verdict == Verdict::not_judged);
  CHECK_FALSE(count.deviation.has_value());
  CHECK(count.detail == "grows with the specimen: not compared at this scale");
  const Comparison loading = one(value("250", R"({"relative": 0.1}, "of_loading": true)"));
  CHECK_FALSE(loading.deviation.has_value());
  CHECK(loading.detail == "follows the loading: not compared at this scale");
  CHECK(one(value("250", R"({"relative": 0.1}, "of_loading": true, "scale": "draft")")).deviation.has_value());
  CHECK(one(value("1", R"({"relative": 0.1})", share)).deviation.has_value());
  CHECK(one(falls).verdict == Verdict::not_judged);
  CHECK(one(value("250", R"({"relative": 0.1}, "scale": "any")")).verdict == Verdict::missed);
  CHECK(one(value("250", R"({"relative": 0.1}, "scale": "draft")")).verdict == Verdict::missed);
  CHECK(compared(R"({"id": "x", "topics": [], "source": "S", "quantity": "Q", )" +
                     value("250", R"({"relative": 0.1}, "scale": "high")") + "}",
                 study())
            .empty());
}

TEST_CASE_FIXTURE(Fixture, "the effect of a parameter is a relative change without its sign, of several the sum") {
  const auto raised = [&](const std::string& name, double seed, double ucs) {
    records.push_back(made(1, seed, ucs));
    records.back().case_id += "_" + name;
    records.back().parameters.emplace_back("raised", name);
  };
  raised("cohesion", 1, 206 * 1.1);
  raised("friction", 1, 206 * 0.95);
  const std::string ucs = R"({"test": "compression", "aspect_ratio": 1, "of": "compressive_strength"})";
  const auto effect = [&](const std::string& names) {
    return one(value("[0.5, 1]", R"({"absolute": 0})", R"("of": {"effect": )" + names + R"(, "on": )" + ucs + "}"));
  };
  CHECK(std::get<double>(*effect(R"(["cohesion"])").computed) == doctest::Approx(0.1));
  CHECK(std::get<double>(*effect(R"(["friction"])").computed) == doctest::Approx(0.05));
  CHECK(std::get<double>(*effect(R"(["cohesion", "friction"])").computed) == doctest::Approx(0.15));
  const std::string entry = R"({"id": "x", "topics": [], "source": "S", "quantity": "Q", )" +
                            value("1", R"({"absolute": 0})", R"("of": {"effect": ["modulus"], "on": )" + ucs + "}") +
                            "}";
  CHECK(compared(entry, study()).empty());  // nobody raised it
}

TEST_CASE_FIXTURE(Fixture, "other readings stand under their number and do not count") {
  const std::string entry = R"({"id": "x", "topics": [], "source": "S", "quantity": "Q", )" +
                            value("206", R"({"relative": 0.01})") +
                            R"(, "readings": [
        {"id": "x_2", "reading": "AR 2", "of": {"test": "compression", "aspect_ratio": 2, "of": "compressive_strength"}},
        {"id": "x_9", "reading": "AR 9", "of": {"test": "compression", "aspect_ratio": 9, "of": "compressive_strength"}}]},
      {"id": "y", "topics": [], "source": "S", "quantity": "Q", "follows": ["x"], )" +
                            value("300", R"({"relative": 0.01})") +
                            R"(}, {"id": "z", "topics": [], "source": "S", "quantity": "Q", "fitted": "a choice", )" +
                            value("300", R"({"relative": 0.01})") +
                            R"(}, {"id": "t", "topics": [], "source": "S", "quantity": "Q", "theory": "Eq. 1", )" +
                            value("206", R"({"relative": 0.01})") + "}";
  const auto rows = compared(entry, study());
  REQUIRE(rows.size() == 5);
  CHECK(rows[1].id == "x_2");
  CHECK(rows[1].role == reports::Role::sensitivity);
  CHECK(rows[1].of == std::vector<std::string>{"x"});
  CHECK(rows[1].verdict == Verdict::missed);
  CHECK(std::get<double>(rows[1].published) == 206);
  CHECK(rows[2].role == reports::Role::follows);
  const auto counts = reports::Comparisons{"P", "draft", rows}.tally();
  CHECK(counts.met == 1);
  CHECK(counts.missed == 0);
  CHECK(counts.numbers() == 1);
  CHECK(counts.fitted == 1);
  CHECK(counts.theory == 1);
}

TEST_CASE("what stands before ours follows from the numbers that the statement stands on") {
  using reports::Agreement;
  const auto row = [](const char* id, Verdict outcome, const char* scale = "draft") {
    Comparison one;
    one.id = id;
    one.kind = "value";
    one.scale = scale;
    one.outcome = outcome;
    one.verdict = one.scale == "paper" && outcome != Verdict::not_computed ? Verdict::not_judged : outcome;
    if (outcome != Verdict::not_computed) one.computed = 1.0;
    one.deviation = 0.0;
    return one;
  };
  const auto standing = [&](std::vector<Comparison> rows, std::optional<Agreement> own = std::nullopt) {
    reports::DrawnFigure figure;
    figure.statement = "As published.";
    figure.agreement = own;
    for (const Comparison& one : rows) figure.rows.push_back(one.id);
    reports::set_standing(figure, {"P", "draft", std::move(rows)}, "draft");
    return figure.standing;
  };
  CHECK(standing({row("a", Verdict::met)}) == "Agrees.");
  CHECK(standing({row("a", Verdict::met), row("b", Verdict::met)}) == "Agrees.");
  CHECK(standing({row("a", Verdict::missed)}) == "Disagrees.");
  CHECK(standing({row("a", Verdict::met), row("b", Verdict::missed), row("c", Verdict::undecided)}) ==
        "Disagrees (1 of 3 missed, 1 undecided).");
  CHECK(standing({row("a", Verdict::undecided), row("b", Verdict::undecided)}) == "Undecided (both undecided).");
  CHECK(standing({row("a", Verdict::met), row("b", Verdict::not_computed)}) == "Undecided (1 of 2 not computed).");
  CHECK(standing({row("a", Verdict::met, "paper")}) == "Not judged at draft scale.");
  CHECK(standing({row("a", Verdict::missed, "paper"), row("b", Verdict::not_computed, "paper")}) ==
        "Not judged at draft scale (1 of 2 not computed).");
  CHECK(standing({row("a", Verdict::missed, "paper"), row("b", Verdict::met)}) == "Agrees (1 of 2 not judged).");
  CHECK(standing({row("a", Verdict::missed, "paper")}, Agreement::agrees) == "Not judged at draft scale.");
  CHECK(standing({row("a", Verdict::not_computed, "paper")}) == "Not compared at draft scale.");
  CHECK(standing({row("a", Verdict::met, "any")}) == "Agrees.");
  CHECK(standing({}, Agreement::disagrees) == "Disagrees.");
  CHECK(standing({}) == "");
  CHECK(standing({row("a", Verdict::met)}, Agreement::disagrees) == "Agrees.");
  CHECK(standing({row("a", Verdict::not_computed, "paper")}, Agreement::agrees) == "Agrees.");
  reports::DrawnFigure smaller;
  smaller.statement = "As published.";
  smaller.agreement = Agreement::disagrees;
  reports::set_standing(smaller, {"P", "paper", {}}, "draft");
  CHECK(smaller.standing == "Disagrees at draft scale.");
  Comparison other = row("a", Verdict::missed);
  other.role = reports::Role::sensitivity;
  CHECK(standing({other}) == "");
}

TEST_CASE_FIXTURE(Fixture, "what a paper says in words or what follows from its numbers is no published number") {
  const std::string near = value("200", R"({"relative": 0.1})");
  const Comparison stated = one(near + R"(, "stated": "mainly")");
  CHECK(stated.role == reports::Role::stated);
  CHECK(stated.stated == "mainly");
  CHECK(stated.verdict == Verdict::met);
  const Comparison derived = one(near + R"(, "derived": "400 / 2")");
  CHECK(derived.role == reports::Role::derived);
  // A limit that was set when ours was known: the words stand there, and the row counts as fitted.
  const Comparison fitted = one(near + R"(, "stated": "mainly", "fitted": "why")");
  CHECK(fitted.role == reports::Role::fitted);
  CHECK(fitted.stated == "mainly");
  const auto counts = reports::Comparisons{"P", "draft", {stated, derived}}.tally();
  CHECK(counts.numbers() == 0);
  CHECK(counts.stated == 1);
  CHECK(counts.derived == 1);
  // Figures draw neither as published.
  const auto entry = [&](const char* id, const char* more) {
    return R"({"id": ")" + std::string(id) + R"(", "topics": [], "source": "S", "quantity": "Q", )" + near + more + "}";
  };
  dem::write_file(scratch / "papers/p/published.json", R"({"numbers": [)" + entry("a", "") + "," +
                                                           entry("b", R"(, "stated": "mainly")") + "," +
                                                           entry("c", R"(, "derived": "400 / 2")") + "]}");
  const auto drawn = reports::published_numbers(study(), scratch / "papers");
  REQUIRE(drawn.size() == 1);
  CHECK(drawn[0].id == "a");
}

TEST_CASE_FIXTURE(Fixture, "an entry that says what it cannot mean is refused by name") {
  const auto refuses = [&](const std::string& rest, const char* what) {
    CAPTURE(rest);
    CHECK_THROWS_WITH_AS(one(rest), doctest::Contains(what), dem::EnvironmentError);
  };
  const std::string good = value("200", R"({"relative": 0.1})");
  CHECK(one(good).verdict == Verdict::met);
  refuses(good + R"(, "tolerence": 1)", "tolerence");
  refuses(good + R"(, "follows": ["nothing"])", "nothing");
  refuses(good + R"(, "follows": ["x"])", "follow");
  refuses(good + R"(, "fitted": "a", "theory": "b")", "one of");
  refuses(good + R"(, "fitted": "")", "says why");
  refuses(good + R"(, "stated": "")", "the paper’s words");
  refuses(good + R"(, "stated": "mainly", "theory": "b")", "one of");
  refuses(good + R"(, "stated": "mainly", "derived": "b")", "not derived");
  refuses(good + R"(, "stated": "mainly", "follows": ["a"], "fitted": "b")", "one of");
  refuses(good + R"(, "scale": "huge")", "huge");
  refuses(good + R"(, "readings": [{"id": "x", "reading": "r", "of": {}}])", "twice");
  refuses(value("0", R"({"relative": 0.1})"), "relative to nothing");
  refuses(value("200", R"({"relative": -0.1})"), "negative");
  refuses(value("200", R"({"factor": 0.1})"), "tolerance");
  refuses(R"("kind": "guess", "of": {})", "guess");
  refuses(R"("kind": "trend", "published": "wobbles", "over": {"aspect_ratio": [1, 2]}, "of": {})", "rises or falls");
}

TEST_CASE_FIXTURE(Fixture, "steps of a trend may have a fraction") {
  records = {made(1, 1, 10), made(1.5, 1, 15), made(4, 1, 40)};
  without_seeds(records);
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

TEST_CASE_FIXTURE(Fixture, "greater is greater, by the interval of the differences where there are seeds") {
  const std::string a = R"({"test": "compression", "aspect_ratio": 1, "of": "compressive_strength"})";
  const std::string b = R"({"test": "compression", "aspect_ratio": 2, "of": "compressive_strength"})";
  const std::string up = R"("kind": "greater", "of": )" + a + R"(, "than": )" + b,
                    down = R"("kind": "greater", "of": )" + b + R"(, "than": )" + a;
  CHECK(one(up).verdict == Verdict::undecided);
  CHECK(one(up).detail.find("206 against 190; one seed: no interval") != std::string::npos);
  for (const double seed : {2.0, 3.0}) {
    records.push_back(made(1, seed, 205 + seed));
    records.push_back(made(2, seed, 190 - seed));
  }
  CHECK(one(up).verdict == Verdict::met);
  CHECK(one(down).verdict == Verdict::missed);
  records.back() = made(2, 3, 300);
  CHECK(one(up).verdict == Verdict::undecided);
  for (dem::Record& record : records) std::erase_if(record.parameters, [](const auto& p) { return p.first == "seed"; });
  CHECK(one(up).verdict == Verdict::met);
}

TEST_CASE_FIXTURE(Fixture,
                  "two that are less apart than the resolution are undecided; a reading has its own second term") {
  without_seeds(records);
  const std::string a = R"({"test": "compression", "aspect_ratio": 1, "of": "compressive_strength"})";  // 206
  const std::string b = R"({"test": "compression", "aspect_ratio": 2, "of": "compressive_strength"})";  // 190
  const std::string up = R"("kind": "greater", "of": )" + a + R"(, "than": )" + b;
  CHECK(one(up + R"(, "resolution": 0.07)").verdict == Verdict::met);
  const Comparison close = one(up + R"(, "resolution": 0.08)");
  CHECK(close.verdict == Verdict::undecided);
  CHECK(close.detail.find("7.8 % apart") != std::string::npos);
  const auto rows =
      compared(R"({"id": "a", "topics": ["aspect_ratio"], "source": "s", "quantity": "q", )" + up +
                   R"(, "readings": [{"id": "turned", "reading": "turned", "of": )" + b + R"(, "than": )" + a + "}]}",
               study());
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].verdict == Verdict::met);
  CHECK(rows[1].outcome == Verdict::missed);
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
    CHECK(row.role != reports::Role::sensitivity);  // shown where the scenario has their cases
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
          R"(}, {"id": "t", "topics": [], "source": "S", "quantity": "Q", "kind": "trend", "published": "rises", )"
          R"("over": {"dip": [0, 90]}, "of": {"test": "compression", "of": "compressive_strength"}}], )"
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
        "The largest deviation from the six published parameters is 2.000 % (mass of an element).");
  for (const char* id :
       {"unit_tensile_strength", "mean_tensile_strength", "unit_compressive_strength", "mean_compressive_strength"}) {
    CAPTURE(id);
    CHECK(study.published_value(id) < 0);
  }
}

TEST_CASE("what was run tells the loading steps with the factor of the scale") {
  const auto told = [](const char* scale) {
    const dem::Scenario scenario = dem::Scenario::read(DEM_SOURCE_DIR "/scenarios/quartzite_strength.toml", scale, {},
                                                       [](std::string_view) { return dem::lattice::keys(); });
    dem::Record record;
    record.parameters = {{"test", "tension"}, {"factor", 1.0}};
    record.quantities = dem::lattice::quantities();
    const reports::StudyResult study{.scenario = &scenario,
                                     .cases = {{"tension", record.parameters, &record, ""}},
                                     .quantities = dem::lattice::quantities(),
                                     .parameters = dem::lattice::parameters()};
    auto rows = reports::cases_data(study);
    return rows.list_value().front().get("parameters")->string_value();
  };
  CHECK(told("draft") == "loading steps × 5");
  CHECK(told("paper") == "loading steps × 1");
}
