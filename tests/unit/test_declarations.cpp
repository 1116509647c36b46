// What the models declare: keys that say what they affect, results and parameters with their words, and everything that
// speaks of them: scenarios, figures, published numbers.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "engine/core/files.h"
#include "engine/model/model.h"
#include "engine/study/study.h"
#include "reports/figure.h"
#include "reports/page/page_cases.h"
#include "reports/published/papers.h"
#include "reports/published/terms.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path source = DEM_SOURCE_DIR;

std::vector<fs::path> scenarios() {
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(source / "scenarios")) {
    if (file.path().extension() == ".toml") files.push_back(file.path());
  }
  std::ranges::sort(files);
  return files;
}

dem::Study study_at(const fs::path& file, const std::string& scale) {
  return dem::read_study(file.string(), scale, {}, dem::models());
}

reports::StudyResult without_records(const dem::Study& study) {
  reports::StudyResult result{.scenario = &study.scenario,
                              .cases = {},
                              .quantities = study.model->quantities(),
                              .parameters = study.model->parameters()};
  for (const dem::CaseSpec& spec : study.cases) result.cases.push_back({spec.id, spec.parameters, nullptr, ""});
  return result;
}

Json numbers_of(const reports::Paper& paper) {
  const fs::path file = paper.folder / "published.json";
  return fs::exists(file) ? Json::parse(dem::read_file(file)).at("numbers") : Json::array();
}

// Every term of a number, with the places of the parameter that it goes over.
template <class Use>
void each_term(const Json& entry, const Use& use) {
  std::vector<dem::Parameters> places = {{}};
  if (entry.contains("over")) {
    const auto axis = entry.at("over").items().begin();
    places.clear();
    for (const Json& step : axis.value()) places.push_back({{axis.key(), step.get<double>()}});
  }
  for (const char* name : {"of", "than"}) {
    if (entry.contains(name)) use(entry.at(name), places);
  }
}

}  // namespace

TEST_CASE("every key says what it affects") {
  const auto check = [](std::span<const dem::Key> keys) {
    for (const dem::Key& key : keys) {
      CAPTURE(key.path);
      CHECK(key.affects != dem::Affects::undeclared);
      CHECK((key.when.empty() || key.affects == dem::Affects::specimen || key.affects == dem::Affects::test));
    }
  };
  check(dem::common_keys());
  for (const dem::Model& model : dem::models()) check(model.keys());
}

TEST_CASE("the content of a case follows the keys that affect it, and no others") {
  for (const char* name : {"my_rock", "quartzite_energy", "elle_polycrystal"}) {
    CAPTURE(name);
    const std::string file = (source / "scenarios" / (std::string(name) + ".toml")).string();
    const dem::Study study = dem::read_study(file, "smoke", {}, dem::models());
    const dem::CaseSpec& spec = study.cases.front();
    for (const dem::Key& key : study.model->keys()) {
      if (key.path.find('[') != std::string::npos || key.type == dem::KeyType::text) continue;
      CAPTURE(key.path);
      const bool in_content = spec.content.find("\n" + key.path + " = ") != std::string::npos;
      const bool affects = key.affects == dem::Affects::specimen || key.affects == dem::Affects::test;
      if (!affects || key.when.empty()) CHECK(in_content == affects);
      if (!key.when.empty() && in_content) {
        const std::size_t kind = spec.content.find("kind = ");
        const std::string kinds = spec.content.substr(kind, spec.content.find('\n', kind) - kind);
        CHECK(std::ranges::any_of(key.when, [&](const std::string& w) { return kinds.find(w) != std::string::npos; }));
      }
    }
    CHECK(spec.content.find("title") == std::string::npos);
    CHECK(spec.content.find("seed = ") != std::string::npos);
  }
}

TEST_CASE("every result and parameter has its words, and ids are unlike") {
  for (const dem::Model& model : dem::models()) {
    CAPTURE(model.name);
    std::set<std::string_view> ids;
    for (const dem::Quantity& quantity : model.quantities()) {
      CAPTURE(quantity.id);
      CHECK(ids.insert(quantity.id).second);
      CHECK_FALSE(quantity.name.empty());
      CHECK(quantity.meaning.ends_with("."));
      CHECK((quantity.shown.empty() ? quantity.factor == 1 : quantity.factor != 1));
      CHECK(quantity.digits >= 1);
    }
    for (const dem::Parameter& parameter : model.parameters()) {
      CAPTURE(parameter.id);
      CHECK(ids.insert(parameter.id).second);
      CHECK_FALSE(parameter.name.empty());
      CHECK(parameter.key.empty() != parameter.usual.empty());
      const auto has_key = [&](const dem::Key& key) { return key.path == parameter.key; };
      if (!parameter.key.empty()) {
        CHECK((std::ranges::any_of(model.keys(), has_key) || std::ranges::any_of(dem::common_keys(), has_key)));
      }
    }
  }
}

TEST_CASE("findings begin with results that a model declares") {
  for (const std::string_view id : reports::telling_results()) {
    CAPTURE(id);
    CHECK(std::ranges::any_of(dem::models(), [&](const dem::Model& model) {
      return std::ranges::any_of(model.quantities(), [&](const dem::Quantity& one) { return one.covers(id); });
    }));
  }
}

TEST_CASE("a record refuses what its model does not declare") {
  static constexpr std::array declared{dem::Quantity{.id = "strength", .name = "Strength"},
                                       dem::Quantity{.id = "share.*", .name = "Share"}};
  dem::Record record;
  record.quantities = declared;
  record.put(declared[0], 1);
  record.put(declared[1], "quartz", 0.5);
  CHECK(record.value(declared[0]) == 1);
  CHECK(*record.find_result("share.quartz") == 0.5);
  CHECK(record.value_or_nan(declared[1], "quartz") == 0.5);
  CHECK(std::isnan(record.value_or_nan(declared[1], "biotite")));
  CHECK_THROWS_AS(record.put(declared[0], 2), std::logic_error);  // twice
  CHECK_THROWS_AS(record.put(declared[1], 2), std::logic_error);  // a family without its member
  CHECK_THROWS_AS(record.put(dem::Quantity{.id = "strenght", .name = "Strength"}, 1), std::logic_error);
  CHECK_THROWS_AS((void)record.value(dem::Quantity{.id = "modulus", .name = "Modulus"}), std::out_of_range);
  CHECK_THROWS_AS((void)dem::find_quantity(declared, "strenght"), std::out_of_range);
}

TEST_CASE("every case of every shipped scenario has parameters that its model declares") {
  for (const fs::path& file : scenarios()) {
    CAPTURE(file.filename().string());
    const dem::Study study = study_at(file, "smoke");
    for (const dem::CaseSpec& spec : study.cases) {
      CAPTURE(spec.id);
      REQUIRE_FALSE(spec.parameters.empty());
      CHECK(spec.parameters.front().first == "test");
      for (const auto& [id, value] : spec.parameters) {
        if (id != "test") CHECK_NOTHROW((void)dem::find_parameter(study.model->parameters(), id));
      }
    }
  }
}

TEST_CASE("every figure is shown by a shipped scenario, and every scenario names figures and topics that exist") {
  std::set<std::string> shown;
  for (const fs::path& file : scenarios()) {
    CAPTURE(file.filename().string());
    const dem::Study study = study_at(file, "smoke");
    for (const std::string& id : study.scenario.texts("figures")) {
      CAPTURE(id);
      shown.insert(id);
      const auto figures = reports::figures();
      const auto at = std::ranges::find(figures, id, &reports::Figure::id);
      REQUIRE(at != figures.end());
      CHECK(at->model == study.model->name);
    }
    CHECK_NOTHROW(reports::check_topics(study.scenario, source / "assets/papers"));
  }
  for (const reports::Figure& figure : reports::figures()) {
    CAPTURE(figure.id);
    CHECK(shown.contains(std::string(figure.id)));
  }
}

TEST_CASE("every published term asks for a result that its test gives, of a case that a shipped scenario has") {
  std::vector<dem::Study> studies;
  for (const fs::path& file : scenarios()) studies.push_back(study_at(file, "paper"));
  for (const dem::Model& model : dem::models()) {
    for (const reports::Paper& paper : reports::papers_of(std::string(model.name), source / "assets/papers")) {
      for (const Json& entry : numbers_of(paper)) {
        CAPTURE(entry.at("id").get<std::string>());
        for (const Json& reading : entry.value("readings", Json::array())) {
          CAPTURE(reading.at("id").get<std::string>());
          for (const char* member : {"of", "than"}) {
            if (!reading.contains(member)) continue;
            for (const auto& [id, test] : reports::results_of(reading.at(member))) {
              CHECK(dem::find_quantity(model.quantities(), id).given_by(test));
            }
          }
          CHECK(std::ranges::any_of(studies, [&](const dem::Study& study) {
            if (study.model->name != model.name) return false;
            const auto result = without_records(study);
            return reports::Terms(result).has_cases(reading.at("of"));
          }));
        }
        each_term(entry, [&](const Json& term, const std::vector<dem::Parameters>& places) {
          for (const auto& [id, test] : reports::results_of(term)) {
            CAPTURE(id);
            REQUIRE_NOTHROW((void)dem::find_quantity(model.quantities(), id));
            CHECK(dem::find_quantity(model.quantities(), id).given_by(test));
          }
          for (const std::string topic : entry.at("topics")) {
            CAPTURE(topic);
            for (const dem::Study& study : studies) {
              const auto& topics = study.scenario.texts("published");
              if (study.model->name != model.name || std::ranges::find(topics, topic) == topics.end()) continue;
              const auto result = without_records(study);
              const reports::Terms terms(result);
              CHECK(std::ranges::any_of(places, [&](const auto& at) { return terms.has_cases(term, at); }));
            }
          }
        });
      }
    }
  }
}

TEST_CASE("statements that cannot be checked stand on the page of their paper, with the reason") {
  for (const auto& [paper, page] : {std::pair{"liu_2017", "liu-2017.md"},
                                    {"zhao_2021", "zhao-2021.md"},
                                    {"model_description", "spring-sheet.md"}}) {
    CAPTURE(paper);
    const Json file = Json::parse(dem::read_file(source / "assets/papers" / paper / "published.json"));
    const std::string text = dem::read_file(source / "docs/papers" / page);
    REQUIRE(file.contains("unchecked"));
    for (const Json& one : file.at("unchecked")) {
      const auto part = [&](const char* name) { return one.at(name).get<std::string>(); };
      CAPTURE(part("statement"));
      CHECK(text.find("| " + part("source") + " | " + part("statement") + " | " + part("why") + " |\n") !=
            std::string::npos);
    }
  }
}

TEST_CASE("what stands under “Published” has its place in a source, and the numbers that it stands on are there") {
  for (const reports::Figure& figure : reports::figures()) {
    CAPTURE(figure.id);
    std::set<std::string> ids;
    for (const reports::Paper& paper : reports::papers_of(std::string(figure.model), source / "assets/papers")) {
      for (const Json& entry : numbers_of(paper)) ids.insert(entry.at("id").get<std::string>());
    }
    for (const fs::path& file : scenarios()) {
      const dem::Study study = study_at(file, "smoke");
      if (study.model->name != figure.model) continue;
      const reports::FigureContent content = figure.make(without_records(study));
      if (!content.statement.empty() && !content.expected) CHECK_FALSE(figure.source.empty());
      for (const std::string& id : content.rows) {
        CAPTURE(id);
        CHECK(ids.contains(id));
      }
    }
  }
}
