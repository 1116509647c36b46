// dem-report calibrate as it is used: a mineral so small that a test of it takes a tenth of a second.
#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/core/files.h"
#include "tests/cli/program.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Texts = std::vector<std::string>;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A mineral alone, with these values of its parameters and with `more` at the end of its entry.
std::string scenario(const std::string& modulus, const std::string& tensile, const std::string& cohesion,
                     const std::string& more, const std::string& top = "") {
  return R"(model = "grain_texture"
title = "A mineral"
rock = "stone"
tests = ["compression", "direct_tension"]
figures = ["mineral_properties"]
)" + top +
         R"(
[specimen]
diameter = "6.25 mm"
height = "12.5 mm"
[packing]
minimum_radius = "0.35 mm"
modulus = "55 GPa"
[texture]
only_mineral = "stone"
[compression]
rate = 4e-7
[direct_tension]
rate = 2e-8
[measure]
rate_bias = 1.0
[scales.smoke]
[[mineral]]
name = "stone"
share = "100 %"
diameter_min = "2 mm"
diameter_max = "3 mm"
density = "2600 kg/m^3"
stiffness_ratio = 1.6
friction = 0.6
bond_stiffness_ratio = 1.6
friction_angle = "50 deg"
modulus = ")" +
         modulus + "\"\nbond_modulus = \"" + modulus + "\"\ntensile_strength = \"" + tensile + "\"\ncohesion = \"" +
         cohesion + "\"\n" + more;
}

/// What the laboratory says: `lines` below [mineral.measured].
std::string at_start(const std::string& lines, const std::string& calibrate = "budget = 40\nseeds = 3") {
  return scenario("50 GPa", "45 MPa", "180 MPa", "[mineral.measured]\n" + lines, "[calibrate]\n" + calibrate + "\n");
}

test::Outcome calibrate(const fs::path& folder, const std::string& text, const Texts& more = {}) {
  dem::write_file(folder / "stone.toml", text);
  Texts arguments = {"calibrate", "stone.toml", "--scale", "smoke", "--format", "html", "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::run_program(folder, arguments);
}

Json result(const fs::path& folder, const std::string& output = "out") {
  return Json::parse(dem::read_file(folder / output / "stone.smoke/calibration/calibration.json"));
}

/// Means of other seeds of hidden parameters, as a laboratory would state them, made once.
const std::string& hidden_data() {
  static const std::string lines = [] {
    const test::Scratch scratch;
    dem::write_file(scratch / "stone.toml", scenario("62 GPa", "36 MPa", "230 MPa", "", "seed = 101\nrepeats = 5"));
    const test::Outcome made =
        test::run_program(scratch.path(), {"stone.toml", "--scale", "smoke", "--format", "html", "--quiet"});
    INFO(made.err);
    const Json summary = Json::parse(dem::read_file(scratch / "out/stone.smoke/summary.json"));
    const auto mean = [&](const char* test, const char* result) {
      double sum = 0;
      int count = 0;
      for (const Json& one : summary.at("cases")) {
        if (one.at("parameters").at("test") != test) continue;
        sum += one.at("results").at(result).get<double>();
        ++count;
      }
      return std::to_string(sum / count);
    };
    return "young_modulus = \"" + mean("compression", "young_modulus") + " GPa +- 1 %\"\nucs = \"" +
           mean("compression", "compressive_strength") + " MPa +- 3 %\"\ntensile_strength = \"" +
           mean("direct_tension", "tensile_strength") + " MPa +- 4 %\"\n";
  }();
  return lines;
}

}  // namespace

TEST_CASE("a hidden mineral is found within the stated intervals, and its rock gives what was measured") {
  const test::Scratch scratch;
  const test::Outcome outcome = calibrate(scratch.path(), at_start(hidden_data()));
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const Json subject = result(scratch.path()).at("subjects").at(0);
  CHECK(subject.at("tests").get<int>() <= 40);
  const std::vector<std::pair<std::string, double>> truth = {
      {"stone.modulus", 62.0 / 50}, {"stone.tensile_strength", 36.0 / 45}, {"stone.cohesion", 230.0 / 180}};
  REQUIRE(subject.at("parameters").size() == truth.size());
  for (const auto& [name, factor] : truth) {
    CAPTURE(name);
    const auto& all = subject.at("parameters");
    const auto at = std::ranges::find_if(all, [&](const Json& one) { return one.at("name") == name; });
    REQUIRE(at != all.end());
    CHECK(at->at("interval").at(0).get<double>() < factor);
    CHECK(at->at("interval").at(1).get<double>() > factor);
    CHECK(at->at("factor").get<double>() == doctest::Approx(factor).epsilon(0.12));
  }
  CHECK(std::system(("/usr/bin/python3 -W ignore -m jsonschema -i '" +
                     (scratch / "out/stone.smoke/calibration/calibration.json").string() +
                     "' '" DEM_SOURCE_DIR "/assets/calibration.schema.json'")
                        .c_str()) == 0);
  // What the data cannot tell is kept, and the page says what would.
  CHECK(subject.at("kept").size() >= 2);
  const std::string page = dem::read_file(scratch / "out/stone.smoke/calibration/calibration.html");
  CHECK(has(page, "kept at"));
  CHECK(has(page, "To determine it, measure"));
  // Nobody else has this scenario: the page holds it.
  CHECK(has(page, "with stone.toml saved there"));
  CHECK(has(page, "Save stone.toml"));

  // The rock can be included, and is what was run.
  const std::string rock = dem::read_file(scratch / "out/stone.smoke/rocks/stone.calibrated.toml");
  CHECK(has(rock, "[mineral.measured]"));
  std::string study = scenario("1 GPa", "1 MPa", "1 MPa", "");
  study = "include = \"out/stone.smoke/rocks/stone.calibrated.toml\"\n" + study.substr(0, study.find("[[mineral]]"));
  dem::write_file(scratch / "study.toml", study);
  const test::Outcome report =
      test::run_program(scratch.path(), {"study.toml", "--scale", "smoke", "--format", "html", "--quiet"});
  INFO(report.err);
  CHECK(report.code == 0);
  const std::string html = dem::read_file(scratch / "out/study.smoke/report.html");
  CHECK(has(html, "Measured in the laboratory"));
}

TEST_CASE("where the laboratory split discs, discs are split") {
  const test::Scratch scratch;
  // Measured as discs of 36 MPa give it, seeds 101 to 105: 21 to 26 MPa. A fall of the load at 8.5 MPa, with ten cracks of
  // one of them, is no splitting.
  std::string text = at_start("brazilian_strength = \"22.5 MPa +- 3.5\"\n", "budget = 12\nseeds = 2");
  text.replace(text.find("[measure]"), 0, "[brazilian]\ndiameter = \"10 mm\"\nthickness = \"5 mm\"\n");
  const test::Outcome outcome = calibrate(scratch.path(), text);
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const Json subject = result(scratch.path()).at("subjects").at(0);
  CHECK(subject.at("targets").at(0).at("computed").get<double>() == doctest::Approx(22.5).epsilon(0.15));
  REQUIRE(subject.at("parameters").size() == 1);
  const Json parameter = subject.at("parameters").at(0);
  CHECK(parameter.at("name") == "stone.tensile_strength");
  CHECK(parameter.at("interval").at(0).get<double>() < 36.0 / 45);
  CHECK(parameter.at("interval").at(1).get<double>() > 36.0 / 45);
}

TEST_CASE("any number of threads, and a search that was stopped, give the same bytes") {
  const test::Scratch scratch;
  const std::string text = at_start(hidden_data());
  const test::Outcome one = calibrate(scratch.path(), text, {"--threads", "1", "-o", "one"});
  REQUIRE(one.code == 0);
  dem::write_file(scratch / "stone.toml", text);
  const test::Outcome stopped = test::run_program(
      scratch.path(),
      {"calibrate", "stone.toml", "--scale", "smoke", "--format", "html", "--threads", "2", "-o", "two"},
      [&](int process) {
        test::wait_until([&] { return fs::exists(scratch / "two/stone.smoke/cases"); }, 60);
        ::kill(process, SIGTERM);
      });
  CHECK(stopped.code == 143);
  CHECK(has(stopped.err, "give the same command to go on"));
  CHECK_FALSE(fs::exists(scratch / "two/stone.smoke/calibration/calibration.json"));
  const test::Outcome two = calibrate(scratch.path(), text, {"--threads", "2", "-o", "two"});
  REQUIRE(two.code == 0);
  for (const char* file :
       {"calibration/calibration.json", "calibration/calibration.html", "rocks/stone.calibrated.toml"}) {
    CAPTURE(file);
    CHECK(dem::read_file(scratch / "one/stone.smoke" / file) == dem::read_file(scratch / "two/stone.smoke" / file));
  }
}

TEST_CASE("progress names the stage, the trial and how far it is from what was measured") {
  const test::Scratch scratch;
  dem::write_file(scratch / "stone.toml", at_start("young_modulus = \"70 GPa +- 12\"\n"));
  const test::Outcome outcome =
      test::run_program(scratch.path(), {"calibrate", "stone.toml", "--scale", "smoke", "--format", "html"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(has(outcome.err, "stone, elastic, trial 1: E "));
  CHECK(has(outcome.err, "stone, fresh seeds, trial 1: E "));
  CHECK(has(outcome.out, "calibrated rock: out/stone.smoke/rocks/stone.calibrated.toml"));
  CHECK(has(outcome.out, "within its uncertainty"));
  CHECK(has(outcome.out, "of them were run now, in "));
}

TEST_CASE("bad input ends with what to do, before anything is written") {
  const test::Scratch scratch;
  const auto refused = [&](const std::string& text, const std::string& part) {
    CAPTURE(text);
    const test::Outcome outcome = calibrate(scratch.path(), text);
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, part));
    CHECK_FALSE(fs::exists(scratch / "out"));
  };
  refused(at_start(""), "nothing is measured");
  refused(at_start("ucs = \"100 MPa +- 5\"\ntensile_strength = \"40 MPa +- 2\"\n"), "more than a quarter");
  refused(at_start("ucs = \"100 MPa +- 5\"\ncrack_damage = \"150 MPa +- 5\"\n"), "is not below");
  refused(at_start("ucs = \"300 MPa +- 5\"\npeaks = [\"200 MPa +- 5 at 20 MPa\"]\n"),
          "rises with the confining pressure");
  refused(at_start("hoek_brown_m = \"20 +- 3\"\n"), "measure ucs too");
  refused(at_start("ucs = \"200\"\n"), "no unit");
  refused(at_start("ucs = \"200 mm +- 3\"\n"), "units of length");
  refused(at_start("young_modulus = \"70 GPa +- 1\"\n",
                   "parameters = [\"stone.modulus\", \"stone.stiffness_ratio\", \"stone.cohesion\"]"),
          "3 parameters cannot follow from 1 measured value, E");
  refused(at_start("young_modulus = \"70 GPa +- 1\"\n", "parameters = [\"stone.cohesion\"]"), "does not determine");
  refused(at_start("ucs = \"200 MPa +- 5\"\n", "parameters = [\"stone.cohession\"]"), "there is no parameter");
  refused(at_start("ucs = \"200 MPa +- 5\"\n", "parameters = [\"quarz.cohesion\"]"), "there is no mineral");
  refused(at_start("ucs = \"200 MPa +- 5\"\n", "ranges = [\"stone.cohesion 2-3\"]"), "does not hold the start");
  refused(at_start("ucs = \"200 MPa +- 5\"\n") + "[measured]\nyoung_modulus = \"70 GPa +- 1\"\n",
          "the rock has one mineral, whose own measured values");
  const test::Outcome lattice = test::run_program(
      scratch.path(), {"calibrate", DEM_SOURCE_DIR "/scenarios/quartzite_elastic.toml", "--scale", "smoke"});
  CHECK(lattice.code == 2);
  CHECK(has(lattice.err, "cannot be calibrated"));
}

TEST_CASE("a range that excludes the answer, and a test that gives nothing, end with what to do") {
  const test::Scratch scratch;
  const test::Outcome narrow = calibrate(scratch.path(), at_start("young_modulus = \"140 GPa +- 1\"\n",
                                                                  "ranges = [\"stone.modulus 0.8-1.2\"]\nseeds = 3"));
  INFO(narrow.err);
  CHECK(narrow.code == 1);
  CHECK(has(narrow.err, "stone.modulus came to the upper end of its range"));
  CHECK(has(narrow.err, "widen it in calibrate.ranges"));

  const test::Outcome nothing =
      calibrate(scratch.path(), at_start("ucs = \"200 MPa +- 5\"\n"), {"--set", "compression.most_steps=500"});
  INFO(nothing.err);
  CHECK(nothing.code == 1);
  CHECK(has(nothing.err, "gave no result to go on from"));
  CHECK(has(nothing.err, "Start from other values"));
}

TEST_CASE("a rock moves its minerals together, then its boundaries, and tells when its budget is used up") {
  const test::Scratch scratch;
  const test::Outcome outcome = test::run_program(
      scratch.path(), {"calibrate", DEM_SOURCE_DIR "/scenarios/my_rock.toml", "--scale", "smoke", "--format", "html",
                       "--set", "specimen.diameter=\"6.25 mm\"", "--set", "specimen.height=\"12.5 mm\"", "--set",
                       "calibrate.budget=10", "--set", "calibrate.seeds=3"});
  INFO(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(has(outcome.err, "The budget of 20 tests is used up: raise calibrate.budget"));
  CHECK(has(outcome.out + outcome.err, "the rock, boundaries, trial 1"));
  const Json found =
      Json::parse(dem::read_file(scratch / "out/my_rock.smoke/calibration/calibration.json")).at("values");
  // One factor for all minerals: 50 and 58 GPa, 180 and 290 MPa at the start. The factor of the boundaries was 0.25.
  const auto value = [&](const char* key) { return found.at(key).get<double>(); };
  CHECK(value("mineral[1].modulus") / value("mineral[0].modulus") == doctest::Approx(58.0 / 50).epsilon(2e-3));
  CHECK(value("mineral[1].cohesion") / value("mineral[0].cohesion") == doctest::Approx(290.0 / 180).epsilon(2e-3));
  CHECK(value("mineral[0].modulus") == value("mineral[0].bond_modulus"));
  CHECK(value("interaction.tensile_strength") != doctest::Approx(0.25));
}

TEST_CASE("specimens are not tested under pressure once the peak there is known well enough") {
  const test::Scratch scratch;
  const test::Outcome outcome =
      calibrate(scratch.path(), at_start("young_modulus = \"70 GPa +- 0.4 %\"\nucs = \"200 MPa +- 15 %\"\n"
                                         "peaks = [\"340 MPa +- 25 % at 20 MPa\"]\n"));
  INFO(outcome.err);
  const Json subject = result(scratch.path()).at("subjects").at(0);
  CHECK(subject.at("tests").get<int>() <= 40);
  std::map<std::string, int> specimens;
  for (const Json& target : subject.at("targets"))
    specimens[target.at("key").get<std::string>()] = target.at("specimens").get<int>();
  CHECK(specimens.at("peaks") >= 3);
  CHECK(specimens.at("ucs") == specimens.at("young_modulus"));
  CHECK(specimens.at("young_modulus") > specimens.at("peaks") + 4);
  CHECK(has(dem::read_file(scratch / "out/stone.smoke/calibration/calibration.html"),
            "by means over " + std::to_string(specimens.at("peaks")) + " to " + std::to_string(specimens.at("ucs")) +
                " specimens"));
}
