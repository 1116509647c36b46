#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "engine/scenario/suggest.h"
#include "engine/scenario/units.h"
#include "tests/unit/scenario_keys.h"

using test::changed;
using test::good;
using test::read;

TEST_CASE("values come in SI units, defaults included") {
  const dem::Scenario scenario = read(good);
  CHECK(scenario.name() == "study");
  CHECK(scenario.scale() == "paper");
  CHECK(scenario.model() == "rock");
  CHECK(scenario.seed() == 1);
  CHECK(scenario.real("specimen.diameter") == 0.025);
  CHECK(scenario.real("specimen.height") == 0.05);
  CHECK(scenario.text("specimen.shape") == "cylinder");
  CHECK(scenario.integer("specimen.layers") == 3);
  CHECK(scenario.real("specimen.layers") == 3.0);
  CHECK_FALSE(scenario.boolean("specimen.periodic"));
  REQUIRE(scenario.count("mineral") == 2);
  CHECK(scenario.real("mineral[0].share") == 0.6);
  CHECK(scenario.real("mineral[0].cohesion") == 1e8);
  CHECK(scenario.real("mineral[1].cohesion") == 3e8);
  CHECK(scenario.reals("sweep.aspect_ratio") == std::vector<double>{1, 2.5});
  CHECK(scenario.reals("sweep.dip").at(0) == doctest::Approx(std::numbers::pi / 2).epsilon(1e-15));
  CHECK(scenario.texts("sweep.tests") == std::vector<std::string>{"compression"});
  CHECK(scenario.given("specimen.diameter"));
  CHECK_FALSE(scenario.given("specimen.height"));
}

TEST_CASE("a scale overrides the file, --set overrides both") {
  CHECK(read(good, {}, "draft").real("specimen.diameter") == 0.0125);
  CHECK(read(good, {"specimen.diameter=\"5 mm\""}, "draft").real("specimen.diameter") == 0.005);
  CHECK(read(good, {"mineral[1].share=\"50 %\""}).real("mineral[1].share") == 0.5);
  CHECK(read(good, {"sweep.aspect_ratio=[3]"}).reals("sweep.aspect_ratio") == std::vector<double>{3});
  CHECK(read(good, {"seed=7", "seed = 8"}).seed() == 8);
}

TEST_CASE("a list of tables in a scale replaces the list as a whole") {
  const std::string text = good + "[[scales.paper.mineral]]\nname = \"glass\"\nshare = \"100 %\"\n";
  const dem::Scenario scenario = read(text);
  REQUIRE(scenario.count("mineral") == 1);
  CHECK(scenario.text("mineral[0].name") == "glass");
  CHECK(scenario.real("mineral[0].cohesion") == 1e8);
  CHECK_THROWS_AS((void)scenario.text("mineral[1].name"), std::logic_error);
}

TEST_CASE("a key that takes its value from another one follows that one") {
  const std::string text = good + "[[extra]]\nheight = \"30 mm\"\n[[extra]]\nshape = \"prism\"\n";
  const dem::Scenario usual = read(text), other = read(text, {"specimen.height=\"70 mm\""});
  CHECK(usual.real("extra[0].height") == 0.03);
  CHECK(usual.text("extra[0].shape") == "cylinder");
  CHECK(usual.real("extra[1].height") == 0.05);
  CHECK(usual.text("extra[1].shape") == "prism");
  CHECK(other.real("extra[1].height") == 0.07);
  CHECK(usual.given("extra[0].height"));
  CHECK_FALSE(usual.given("extra[1].height"));
  CHECK(usual.real("extra[0].length") == 0.01);  // that of its own shape, which follows another key too
  CHECK(usual.real("extra[1].length") == 0.02);
  CHECK(dem::explain(test::keys_of("rock")).find("default that of specimen.height") != std::string::npos);
}

TEST_CASE("the same quantity in any of its units is the same double") {
  CHECK(dem::read_quantity("0.35 mm", "mm") == 0.00035);
  CHECK(dem::read_quantity("350 um", "mm") == 0.00035);
  CHECK(dem::read_quantity("0.35mm", "m") == 0.00035);
  CHECK(dem::read_quantity("3.5e-4 m", "mm") == 0.00035);
  CHECK(dem::read_quantity("58 GPa", "MPa") == 5.8e10);
  CHECK(dem::read_quantity("17 %", "%") == 0.17);
  CHECK(dem::read_quantity("2.63 g/cm^3", "kg/m^3") == 2630.0);
  CHECK(dem::read_quantity("2 min", "s") == 120.0);
  CHECK(dem::read_quantity("-180 deg", "deg") == -std::numbers::pi);
  CHECK(dem::read_quantity(" 1e3 N/m ", "kN/m") == 1000.0);
  CHECK(dem::read_quantity("1e-3 Pa s", "Pa s") == 0.001);
  CHECK(dem::read_quantity("9.81 m/s^2", "m/s^2") == 9.81);
}

TEST_CASE("units as people write them") {
  struct Line {
    const char *text, *unit;
    double si;
  };
  for (const Line& line :
       {Line{"350 \u00b5m", "mm", 0.00035},  // the micro sign
        Line{"350 \u03bcm", "mm", 0.00035},  // the Greek letter
        Line{"350000 nm", "mm", 0.00035}, Line{"3 \u03bcs", "s", 3e-6}, Line{"58000 N/mm2", "GPa", 5.8e10},
        Line{"58000 N/mm²", "GPa", 5.8e10}, Line{"58000 N/mm^2", "GPa", 5.8e10}, Line{"58 kN/mm²", "GPa", 5.8e10},
        Line{"10 MN/m2", "MPa", 1e7}, Line{"2.63 g/cm3", "kg/m^3", 2630}, Line{"2.63 g/cm³", "kg/m^3", 2630},
        Line{"2.63 t/m³", "kg/m^3", 2630}, Line{"26.47796 kN/m3", "kg/m^3", 2700.0005},
        Line{"26.47796 kN/m³", "kg/m^3", 2700.0005}, Line{"1000 psi", "MPa", 6894757.293168361},
        Line{"1 ksi", "MPa", 6894757.293168361}, Line{"100 bar", "MPa", 1e7}, Line{"9.81 m/s²", "m/s^2", 9.81}}) {
    CAPTURE(line.text);
    CHECK(dem::read_quantity(line.text, line.unit) == doctest::Approx(line.si).epsilon(1e-6));
  }
  CHECK(dem::units_like("MPa") == "MPa, Pa, kPa, GPa, psi, ksi, bar");
  CHECK(dem::units_like("kg/m^3") == "kg/m^3, g/cm^3, kN/m^3");
}

TEST_CASE("quantities that are none are refused") {
  for (const char* text :
       {"", "mm", "1.2.3 mm", "1e mm", "--1 mm", "1 mm mm", "nan mm", "inf mm", "1,5 mm", "1e999 mm"}) {
    CAPTURE(text);
    CHECK_THROWS_AS((void)dem::read_quantity(text, "mm"), dem::InputError);
  }
}

TEST_CASE("SI values are shown in the declared unit") {
  CHECK(dem::in_unit(2.92e8, "MPa") == "292 MPa");
  CHECK(dem::in_unit(0.00035, "mm") == "0.35 mm");
  CHECK(dem::in_unit(0.17, "%") == "17 %");
  CHECK(dem::in_unit(1.66, "") == "1.66");
  for (int degrees = 1; degrees <= 90; ++degrees)
    CHECK(dem::in_unit(dem::to_si(degrees, "deg"), "deg") == std::to_string(degrees) + " deg");
}

TEST_CASE("canonical text: sorted, of the keys asked for, the same for the same values however written") {
  const std::vector<std::string> keys = {"mineral[].cohesion", "mineral[].name",  "mineral[].share",
                                         "specimen.diameter",  "specimen.height", "specimen.layers",
                                         "specimen.periodic",  "specimen.ratio",  "specimen.shape"};
  const std::string text = read(good).canonical(keys);
  CHECK(text ==
        "mineral[0].cohesion = 1e+08\nmineral[0].name = \"quartz\"\nmineral[0].share = 0.6\n"
        "mineral[1].cohesion = 3e+08\nmineral[1].name = \"mica\"\nmineral[1].share = 0.4\n"
        "specimen.diameter = 0.025\nspecimen.height = 0.05\nspecimen.layers = 3\nspecimen.periodic = false\n"
        "specimen.ratio = 1.66\nspecimen.shape = \"cylinder\"\n");
  const std::string same = changed(changed(good, "\"25 mm\"", "\"0.025 m\"\nlayers = 3"), "0.3 GPa", "300 MPa");
  CHECK(read(same).canonical(keys) == text);
  CHECK(read(good).canonical(std::vector<std::string>{"sweep.aspect_ratio"}) == "sweep.aspect_ratio = [1, 2.5]\n");
  CHECK(read(good).canonical().find("seed = ") != std::string::npos);
}

TEST_CASE("with() replaces one value in a copy; defects of ours are logic errors") {
  const dem::Scenario scenario = read(good);
  CHECK(scenario.with("specimen.ratio", 2.0).real("specimen.ratio") == 2.0);
  CHECK(scenario.real("specimen.ratio") == 1.66);
  CHECK_THROWS_AS((void)scenario.with("specimen.ratio", std::string("x")), std::logic_error);
  CHECK_THROWS_AS((void)scenario.with("specimen.unknown", 1.0), std::logic_error);
  CHECK_THROWS_AS((void)scenario.text("specimen.ratio"), std::logic_error);
  CHECK_THROWS_AS((void)scenario.real("specimen.unknown"), std::logic_error);
}

TEST_CASE("a model's own check names the line of the value, of the table for a list") {
  const dem::Scenario scenario = read(good);
  CHECK(scenario.error("mineral[1].share", "wrong", "right").where().line == 12);
  CHECK(scenario.error("mineral", "wrong", "right").where().line == 8);
  CHECK(scenario.error("sweep", "wrong", "right").where().line == 16);
  CHECK(std::string(scenario.error("specimen.height", "a", "b").what())
            .ends_with("study.toml:4:1: specimen.height: a; b"));
}

TEST_CASE("the text of --explain-keys has every key with unit, range, default and help") {
  const std::string text = dem::explain(test::keys_of("rock"));
  CHECK(text.find("[specimen]\n  diameter: quantity in mm, m, cm, um, km, nm, 1 to 500 mm, required\n"
                  "      of the cylinder\n") != std::string::npos);
  CHECK(text.find("[[mineral]]\n") != std::string::npos);
  CHECK(text.find("shape: text, one of cylinder, prism, default \"cylinder\"") != std::string::npos);
  CHECK(text.find("layers: whole number, 1 to 9, default 3") != std::string::npos);
  for (const dem::Key& key : dem::common_keys())
    CHECK(dem::explain(dem::common_keys()).find(key.help) != std::string::npos);
}

TEST_CASE("edit distance counts a swap of neighbours as one") {
  CHECK(dem::edit_distance("", "abc") == 3);
  CHECK(dem::edit_distance("daimeter", "diameter") == 1);
  CHECK(dem::edit_distance("kitten", "sitting") == 3);
  const std::vector<std::string> words = {"share", "name"};
  CHECK(dem::closest("shar", words) == "share");
  CHECK(dem::closest("cohesion", words).empty());
}
