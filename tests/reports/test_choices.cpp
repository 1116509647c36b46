// Choices and citations are told only where they are about the study.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "engine/texture/quantities.h"
#include "reports/page/choices.h"
#include "reports/text.h"
#include "tests/reports/synthetic.h"
#include "tests/support/scratch.h"

namespace {

using Json = nlohmann::json;

/// The study of aspect ratios 1, 2, 3 in compression and tension, grains throughout, without pressure.
struct Made {
  test::Scratch scratch;
  synthetic::Study study{scratch.path()};
};

bool is_told(const Json& conditions) {
  const Made made;
  Json entry = conditions;
  entry["text"] = "A choice.";
  const Json kept = reports::about(made.study.result(), Json::array({entry}));
  for (const Json& one : kept) CHECK(one.size() == 1);  // the conditions are taken off
  return kept.size() == 1;
}

}  // namespace

TEST_CASE("an entry without conditions is told, and braces hold the scenario's value") {
  CHECK(is_told(Json::object()));
  const Made made;
  const Json kept = reports::about(made.study.result(), Json::array({{{"text", "{specimen.diameter} m wide"}}}));
  REQUIRE(kept.size() == 1);
  CHECK(kept[0]["text"] == "0.02 m wide");
}

TEST_CASE("a rate per step is told in s⁻¹ and m/s by the time steps of the cases that were loaded at it") {
  Made made;
  const double step = 4e-8;
  made.study.record("compression_ar_1").put(dem::texture::quantity::time_step, step);
  const std::string text = "{compression.rate} per step{compression.rate in time over specimen.height}.";
  reports::StudyResult study = made.study.result();
  const double rate = study.scenario->real("compression.rate"), height = study.scenario->real("specimen.height");
  const std::string told = reports::about(study, Json::array({{{"text", text}}}))[0]["text"];
  CAPTURE(told);
  CHECK(told.find(", or " + reports::number(rate / step, 2) + " s⁻¹; ") != std::string::npos);
  CHECK(told.find(" at " + reports::number(rate * height / step, 2) + " m/s ") != std::string::npos);
  for (auto& one : study.cases) one.record = nullptr;
  const std::string bare = reports::about(study, Json::array({{{"text", text}}}))[0]["text"];
  CHECK(bare.ends_with(" per step."));
}

TEST_CASE("a key's value tells an entry (when), or takes it away (unless), as text or as a number") {
  CHECK(is_told({{"when", {{"compression.jacket", "rigid"}}}}));
  CHECK_FALSE(is_told({{"when", {{"compression.jacket", "membrane"}}}}));
  CHECK_FALSE(is_told({{"unless", {{"compression.jacket", "rigid"}}}}));
  CHECK(is_told({{"unless", {{"compression.jacket", "membrane"}}}}));
  CHECK(is_told({{"when", {{"specimen.diameter", 0.02}}}}));
  CHECK_FALSE(is_told({{"when", {{"specimen.diameter", 0.03}}}}));
  CHECK_FALSE(is_told({{"unless", {{"specimen.diameter", 0.02}}}}));
}

TEST_CASE("all of `when` must be so, and one of `unless` is enough") {
  CHECK_FALSE(is_told({{"when", {{"compression.jacket", "rigid"}, {"specimen.diameter", 0.03}}}}));
  CHECK_FALSE(is_told({{"unless", {{"compression.jacket", "rigid"}, {"specimen.diameter", 0.03}}}}));
}

TEST_CASE("a varied parameter tells an entry only where cases differ in it") {
  CHECK(is_told({{"varied", "aspect_ratio"}}));
  CHECK_FALSE(is_told({{"varied", "seed"}}));
  CHECK_FALSE(is_told({{"varied", "no_such_parameter"}}));
}

TEST_CASE("an entry about a test, a pressure or a kind of specimen is told where the study has it") {
  CHECK(is_told({{"test", "compression"}}));
  CHECK(is_told({{"test", {"brazilian", "direct_tension"}}}));
  CHECK_FALSE(is_told({{"test", "brazilian"}}));
  CHECK_FALSE(is_told({{"confined", true}}));
  CHECK(is_told({{"specimen", "grains"}}));
  CHECK_FALSE(is_told({{"specimen", "one mineral"}}));
}

TEST_CASE("an entry about the paper's rock is not told of another one") {
  const Made made;
  reports::StudyResult study = made.study.result();
  const Json entries = Json::array(
      {{{"text", "A granite."}, {"rock", true}}, {{"text", "Any rock."}, {"of_the_rock", "And this granite."}}});
  study.of_a_paper = true;
  Json kept = reports::about(study, entries);
  REQUIRE(kept.size() == 2);
  CHECK(kept[1]["text"] == "Any rock. And this granite.");
  study.of_a_paper = false;
  kept = reports::about(study, entries);
  REQUIRE(kept.size() == 1);
  CHECK(kept[0]["text"] == "Any rock.");
}
