#include "reports/page/choices.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <variant>

#include "engine/model/quantities.h"
#include "reports/text.h"

namespace reports {
namespace {

using Json = nlohmann::json;

/// A text with the values of the scenario's keys in the place of their names in braces.
std::string filled(const dem::Scenario& scenario, std::string text) {
  for (std::size_t at = 0; (at = text.find('{', at)) != std::string::npos;) {
    const std::size_t end = text.find('}', at);
    const double value = scenario.real(text.substr(at + 1, end - at - 1));
    text.replace(at, end - at + 1, needs_powers(value) ? number(value, 3) : shortest(value));
  }
  return text;
}

/// Whether a case is under confining pressure.
bool is_confined(const StudyResult& study) {
  return std::ranges::any_of(study.cases, [](const CaseResult& one) {
    const auto* pressure = dem::find_value(one.parameters, "confining_pressure");
    return pressure && std::holds_alternative<double>(*pressure) && std::get<double>(*pressure) > 0;
  });
}

/// Whether the cases of the study differ in a parameter.
bool is_varied(const StudyResult& study, const std::string& parameter) {
  const auto* first = study.cases.empty() ? nullptr : dem::find_value(study.cases.front().parameters, parameter);
  return first && std::ranges::any_of(study.cases, [&](const CaseResult& one) {
           const auto* value = dem::find_value(one.parameters, parameter);
           return value && *value != *first;
         });
}

/// Whether a case has a specimen of one mineral alone, joined by flat joints throughout, or one with grains.
bool has_specimen(const StudyResult& study, bool of_one_mineral) {
  return std::ranges::any_of(study.cases, [&](const CaseResult& one) {
    const auto* mineral = dem::find_value(one.parameters, "mineral");
    const auto* name = mineral ? std::get_if<std::string>(mineral) : nullptr;
    return (name && !name->empty()) == of_one_mineral;
  });
}

}  // namespace

nlohmann::json about(const StudyResult& study, const nlohmann::json& entries) {
  Json kept = Json::array();
  for (Json one : entries) {
    if (one.contains("rock") && !study.of_a_paper) continue;
    one.erase("rock");
    const Json wanted = one.value("test", Json());  // one test, or several
    const auto tests = wanted.is_array() ? wanted : wanted.is_null() ? Json::array() : Json::array({wanted});
    const auto is_run = [&](const Json& test) {
      return std::ranges::any_of(study.cases, [&](const auto& c) { return c.test() == test.get<std::string>(); });
    };
    if (!tests.empty() && std::ranges::none_of(tests, is_run)) continue;
    one.erase("test");
    if (one.value("confined", false) && !is_confined(study)) continue;
    one.erase("confined");
    const std::string specimen = one.value("specimen", "");
    if (!specimen.empty() && !has_specimen(study, specimen == "one mineral")) continue;
    one.erase("specimen");
    const auto is_so = [&](const auto& key) {
      const Json& wanted_value = key.value();
      return wanted_value.is_number() ? study.scenario->real(key.key()) == wanted_value.template get<double>()
                                      : study.scenario->text(key.key()) == wanted_value.template get<std::string>();
    };
    const Json when = one.value("when", Json::object()), unless = one.value("unless", Json::object());
    if (!std::ranges::all_of(when.items(), is_so)) continue;
    if (std::ranges::any_of(unless.items(), is_so)) continue;
    const std::string varied = one.value("varied", "");
    if (!varied.empty() && !is_varied(study, varied)) continue;
    one.erase("when");
    one.erase("unless");
    one.erase("varied");
    const std::string more = one.value("of_the_rock", "");
    one.erase("of_the_rock");
    if (one.contains("text")) {
      one["text"] = filled(*study.scenario, one["text"].get<std::string>()) +
                    (study.of_a_paper && !more.empty() ? " " + more : "");
    }
    kept.push_back(std::move(one));
  }
  return kept;
}

}  // namespace reports
