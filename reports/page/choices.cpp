#include "reports/page/choices.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <variant>

#include "engine/model/quantities.h"
#include "reports/text.h"

namespace reports {
namespace {

using Json = nlohmann::json;

bool is_confined(const CaseResult& one) {
  const auto* pressure = dem::find_value(one.parameters, "confining_pressure");
  return pressure && std::holds_alternative<double>(*pressure) && std::get<double>(*pressure) > 0;
}

/// Whether a case is under confining pressure.
bool is_confined(const StudyResult& study) {
  return std::ranges::any_of(study.cases, [](const CaseResult& one) { return is_confined(one); });
}

/// ", or 1.4 s⁻¹; the loaded ends move at 0.07 m/s relative to each other" for a rate per step (“compression.rate”), by the time
/// steps of the cases that were loaded at it: at the scale that was run. "" without results.
std::string rate_in_time(const StudyResult& study, const std::string& rate, double length) {
  const std::string test = rate.substr(0, rate.find('.'));
  const bool of_confined = rate.ends_with(".confined_rate");
  const bool is_split = test == "compression" && study.scenario->real("compression.confined_rate") > 0;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const CaseResult& one : study.cases) {
    if (!one.record || one.test() != test || (is_split && is_confined(one) != of_confined)) continue;
    const double* step = one.record->find_result("time_step");
    if (!step || !(*step > 0)) continue;
    least = std::min(least, *step);
    most = std::max(most, *step);
  }
  if (most == 0) return {};
  const double per_step = study.scenario->real(rate);
  const auto range = [&](double factor) {
    const std::string low = number(factor * per_step / most, 2), high = number(factor * per_step / least, 2);
    return low == high ? low : low + " to " + high;
  };
  return ", or " + range(1) + " s⁻¹; the loaded ends move at " + range(length) + " m/s relative to each other";
}

/// A text with the values of the scenario's keys in the place of their names in braces, and of “{RATE in time over LENGTH}” (or
/// “over half of LENGTH”) what rate_in_time() says.
std::string filled(const StudyResult& study, std::string text) {
  constexpr std::string_view in_time = " in time over ", half = "half of ";
  const dem::Scenario& scenario = *study.scenario;
  for (std::size_t at = 0; (at = text.find('{', at)) != std::string::npos;) {
    const std::size_t end = text.find('}', at);
    const std::string name = text.substr(at + 1, end - at - 1);
    std::string put;
    if (const std::size_t over = name.find(in_time); over != std::string::npos) {
      std::string length = name.substr(over + in_time.size());
      const bool halved = length.starts_with(half);
      if (halved) length.erase(0, half.size());
      put = rate_in_time(study, name.substr(0, over), (halved ? 0.5 : 1) * scenario.real(length));
    } else {
      const double value = scenario.real(name);
      put = needs_powers(value) ? number(value, 3) : shortest(value);
    }
    text.replace(at, end - at + 1, put);
  }
  return text;
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
      one["text"] =
          filled(study, one["text"].get<std::string>()) + (study.of_a_paper && !more.empty() ? " " + more : "");
    }
    kept.push_back(std::move(one));
  }
  return kept;
}

}  // namespace reports
