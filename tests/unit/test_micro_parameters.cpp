// Parameters that are moved as one, and the specimens of a sensitivity study.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "engine/core/errors.h"
#include "engine/texture/keys.h"
#include "engine/texture/micro_parameters.h"
#include "engine/texture/model.h"
#include "tests/support/near.h"

using namespace dem::texture;

namespace {

dem::Scenario granite(const std::vector<std::string>& set) {
  return dem::Scenario::read(DEM_SOURCE_DIR "/scenarios/ldb_uniaxial.toml", "draft", set,
                             [](std::string_view) { return keys(); });
}

std::vector<dem::CaseSpec> cases(const std::vector<std::string>& set) { return model().cases(granite(set)); }

std::string refusal(const std::vector<std::string>& set) {
  try {
    (void)cases(set);
  } catch (const dem::InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a parameter has the keys that move together, of all minerals, of one, or of the boundaries") {
  const dem::Scenario scenario = granite({});
  const MicroParameter moduli = micro_parameter(scenario, "sweep.raised", "modulus");
  CHECK(moduli.keys.size() == 8);  // of contacts and of bonds, of four minerals
  CHECK_FALSE(moduli.is_of_boundaries());
  const MicroParameter quartz = micro_parameter(scenario, "sweep.raised", "quartz.cohesion");
  CHECK(quartz.keys == std::vector<std::string>{"mineral[2].cohesion"});
  CHECK(quartz.kind == "cohesion");
  CHECK(quartz.start.front() == test::near(292e6));
  const MicroParameter boundaries = micro_parameter(scenario, "sweep.raised", "interaction.stiffness_ratio");
  CHECK(boundaries.is_of_boundaries());
  CHECK(boundaries.start == std::vector<double>{2.0});
  const dem::Scenario raised = multiplied(scenario, moduli, 1.5, "sweep.raised");
  CHECK(raised.real("mineral[3].bond_modulus") == test::near(60e9));
  CHECK(raised.real("mineral[3].cohesion") == scenario.real("mineral[3].cohesion"));
}

TEST_CASE("each parameter is raised alone, beside the specimen as it is, in every test and seed") {
  const auto all = cases({R"(sweep.raised=["cohesion", "interaction.cohesion"])", "repeats=2",
                          R"(tests=["compression", "direct_tension"])"});
  REQUIRE(all.size() == 12);
  std::vector<std::string> ids;
  for (const dem::CaseSpec& spec : all) ids.push_back(spec.id);
  CHECK(std::ranges::find(ids, "compression_ar_1") != ids.end());
  CHECK(std::ranges::find(ids, "direct_tension_ar_1_interaction_cohesion_raised_seed_2") != ids.end());
  const auto at = [&](const char* id) -> const dem::CaseSpec& {
    return *std::ranges::find(all, std::string(id), &dem::CaseSpec::id);
  };
  const dem::CaseSpec &base = at("compression_ar_1"), &minerals = at("compression_ar_1_cohesion_raised"),
                      &boundaries = at("compression_ar_1_interaction_cohesion_raised");
  CHECK(minerals.scenario.real("mineral[0].cohesion") / base.scenario.real("mineral[0].cohesion") == test::near(1.2));
  CHECK(minerals.scenario.real("interaction.cohesion") == base.scenario.real("interaction.cohesion"));
  CHECK(boundaries.scenario.real("interaction.cohesion") / base.scenario.real("interaction.cohesion") ==
        test::near(1.2));
  // The specimen as it is keeps its record, and so does one whose value was written by hand.
  CHECK(base.content == cases({})[0].content);
  CHECK(boundaries.content ==
        cases({fmt::format("interaction.cohesion={}", 1.2 * base.scenario.real("interaction.cohesion"))})[0].content);
  CHECK(minerals.content == cases({R"(sensitivity.parameter="cohesion")"})[0].content);
  CHECK(cases({R"(sweep.raised=["cohesion"])", "sensitivity.factor=1.5"})[1].content != minerals.content);
}

TEST_CASE("what cannot be raised is told with the key, and with what can be") {
  CHECK(refusal({R"(sweep.raised=["cohesoin"])"}).find("did you mean 'cohesion'") != std::string::npos);
  CHECK(refusal({R"(sweep.raised=["interaction.cohesoin"])"}).find("there is no coefficient") != std::string::npos);
  CHECK(refusal({R"(sweep.raised=["olivine.cohesion"])"}).find("there is no mineral 'olivine'") != std::string::npos);
  CHECK(refusal({R"(sweep.raised=["cohesion", "cohesion"])"}).find("are the same") != std::string::npos);
  for (const char* name : {"interaction.cohesion", "biotite.cohesion"}) {
    const std::string told = refusal({R"(sweep.mineral=["quartz"])", fmt::format("sweep.raised=[\"{}\"]", name)});
    CHECK(told.find("does nothing: quartz stands alone") != std::string::npos);
  }
  const std::string steep = refusal({R"(sweep.raised=["friction_angle"])", "sensitivity.factor=1.6"});
  CHECK(steep.find("cannot be 1.6 times as large") != std::string::npos);
  CHECK(steep.find("give at most 1.4") != std::string::npos);
}
