#include "reports/published/terms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "engine/core/errors.h"
#include "engine/model/case.h"
#include "reports/published/derived.h"
#include "reports/text.h"

namespace reports {
namespace {

using Json = nlohmann::json;

constexpr std::array<const char*, 8> combinations{"quotient", "difference", "distance", "sum",
                                                  "mean",     "largest",    "least",    "apart"};

// The terms that a term is made of; nullptr for one that is about cases.
const Json* parts_of(const Json& term) {
  for (const char* name : combinations) {
    if (term.contains(name)) return &term.at(name);
  }
  return nullptr;
}

// The places of a term {"effect": [...], "on": TERM}: with each parameter raised alone.
std::vector<dem::Parameters> raised_places(const Json& term, const dem::Parameters& at) {
  std::vector<dem::Parameters> places;
  for (const std::string name : term.at("effect")) {
    places.push_back(at);
    places.back().emplace_back("raised", name);
  }
  return places;
}

// A term about one case, whose members are parameters.
bool of_a_case(const Json& term) { return !term.contains("constant") && !term.contains("fit"); }

std::optional<double> seed_of(const CaseResult& one) {
  const dem::ParameterValue* value = dem::find_value(one.parameters, "seed");
  const auto* number = value ? std::get_if<double>(value) : nullptr;
  return number ? std::optional(*number) : std::nullopt;
}

// "compression, AR 2, σ₃ 10 MPa"
std::string case_words(std::span<const dem::Parameter> declared, const dem::Parameters& named) {
  std::vector<std::string> words_of;
  for (const auto& [id, value] : named) {
    const std::string text =
        id == "test" ? parameter_text(value) : parameter_words(dem::find_parameter(declared, id), value);
    if (text.empty()) continue;
    words_of.insert(id == "test" ? words_of.begin() : words_of.end(), text);
  }
  return joined(words_of, ", ");
}

double combined(const Json& term, const std::vector<double>& parts) {
  if (term.contains("quotient")) {
    if (parts.at(1) == 0) throw NotComputed{"the denominator is zero"};
    return parts.at(0) / parts.at(1);
  }
  if (term.contains("difference")) return parts.at(0) - parts.at(1);
  if (term.contains("distance")) return std::abs(parts.at(0) - parts.at(1));
  if (term.contains("largest")) return std::ranges::max(parts);
  if (term.contains("least")) return std::ranges::min(parts);
  double sum = 0;
  for (const double part : parts) sum += part;
  return term.contains("mean") ? sum / static_cast<double>(parts.size()) : sum;
}

}  // namespace

Terms::Terms(const StudyResult& study, Lacking lacking) : study_(study), lacking_(lacking) {
  if (study.scenario)
    usual_ = dem::analysis::Usual{study.parameters, dem::usual_values(study.parameters, *study.scenario)};
  for (const CaseResult& one : study.cases) {
    const auto seed = seed_of(one);
    if (seed && std::ranges::find(seeds_, *seed) == seeds_.end()) seeds_.push_back(*seed);
  }
}

dem::Parameters Terms::named(const Json& term, const dem::Parameters& at) const {
  dem::Parameters parameters;
  for (const auto& [id, value] : term.items()) {
    if (id == "of" || id == "derived" || id == "which" || id == "times") continue;
    if (id != "test") (void)dem::find_parameter(study_.parameters, id);
    parameters.emplace_back(id, value.is_string() ? dem::ParameterValue(value.get<std::string>())
                                                  : dem::ParameterValue(value.get<double>()));
  }
  for (const auto& place : at) {
    if (!dem::find_value(parameters, place.first)) parameters.push_back(place);
  }
  return parameters;
}

std::vector<const CaseResult*> Terms::cases(const Json& term, const dem::Parameters& at) const {
  auto found = dem::analysis::select(study_.cases, {named(term, at)}, usual_);
  if (!found.empty() || lacking_ == Lacking::not_computed || !term.contains("of")) return found;
  const std::string id = term.at("of").get<std::string>();
  for (const CaseResult& one : study_.cases) {
    if (one.record && one.record->find_result(id)) found.push_back(&one);
  }
  return found;
}

bool Terms::has_cases(const Json& term, const dem::Parameters& at) const {
  if (const Json* parts = parts_of(term)) {
    return std::ranges::all_of(*parts, [&](const Json& part) { return has_cases(part, at); });
  }
  if (term.contains("effect")) {
    return has_cases(term.at("on"), at) && std::ranges::all_of(raised_places(term, at), [&](const auto& place) {
             return has_cases(term.at("on"), place);
           });
  }
  if (term.contains("fit")) {  // through compression tests at several pressures
    return std::ranges::any_of(study_.cases, [](const CaseResult& one) { return one.test() == "compression"; });
  }
  return !of_a_case(term) || !cases(term, at).empty();
}

bool Terms::of_size(const Json& term) const {
  if (const Json* parts = parts_of(term)) {
    const auto grows = [&](const Json& part) { return of_size(part); };
    if (term.contains("quotient")) return grows(parts->at(0)) != grows(parts->at(1));
    return std::ranges::any_of(*parts, grows);
  }
  return term.contains("of") && dem::find_quantity(study_.quantities, term.at("of").get<std::string>()).of_size;
}

analysis::Estimate Terms::fitted(const Json& term) const {
  const std::string name = term.at("fit").get<std::string>(), mineral = term.value("mineral", "");
  const auto found = fitted_value(study_, name, mineral);
  const auto is_run = [&](const CaseResult& one) {
    const auto* value = dem::find_value(one.parameters, "mineral");
    const auto* text = value ? std::get_if<std::string>(value) : nullptr;
    return text && *text == mineral;
  };
  if (!found && !mineral.empty() && std::ranges::none_of(study_.cases, is_run))
    throw NotComputed{"not run at this scale: " + mineral};
  if (!found) throw NotComputed{"too few confining pressures for a fit" + (mineral.empty() ? "" : " of " + mineral)};
  return *found;
}

const CaseResult& Terms::case_of(const Json& term, const dem::Parameters& at, std::optional<double> seed) const {
  const auto all = cases(term, at);
  const auto one = std::ranges::find_if(all, [&](const CaseResult* c) { return !seed || seed_of(*c) == seed; });
  if (one == all.end()) throw NotComputed{"not run at this scale: " + case_words(study_.parameters, named(term, at))};
  const CaseResult& result = **one;
  if (!result.record) throw NotComputed{"case " + result.id + (result.error.empty() ? " was not run" : " failed")};
  return result;
}

double Terms::furthest(const Json& term, const dem::Parameters& at, std::optional<double> seed) const {
  const std::string family = term.at("furthest").get<std::string>();
  const dem::Quantity& quantity = dem::find_quantity(study_.quantities, family);
  const std::string_view start = std::string_view(family).substr(0, family.size() - 1);  // without the star
  const dem::Record &a = *case_of(term.at("apart").at(0), at, seed).record,
                    &b = *case_of(term.at("apart").at(1), at, seed).record;
  double most = -1;
  const auto compare = [&](const dem::Record& one, const dem::Record& other) {
    for (const auto& [id, value] : one.results) {
      if (!id.starts_with(start)) continue;
      const double* there = other.find_result(id);  // a group without contacts has no share
      most = std::max(most, std::abs(value - (there ? *there : 0.0)) * quantity.factor);
    }
  };
  compare(a, b);
  compare(b, a);
  if (most < 0) throw NotComputed{"there is no result “" + std::string(quantity.name) + "”"};
  return most;
}

double Terms::value(const Json& term, const dem::Parameters& at, std::optional<double> seed) const {
  double found = 0;
  if (term.contains("furthest")) {
    found = furthest(term, at, seed);
  } else if (const Json* parts = parts_of(term)) {
    std::vector<double> values;
    for (const Json& part : *parts) values.push_back(value(part, at, seed));
    found = combined(term, values);
  } else if (term.contains("effect")) {
    const double as_it_is = value(term.at("on"), at, seed);
    if (as_it_is == 0) throw NotComputed{"nothing to compare with"};
    for (const dem::Parameters& place : raised_places(term, at))
      found += std::abs(value(term.at("on"), place, seed) / as_it_is - 1);
  } else if (term.contains("constant")) {
    found = term.at("constant").get<double>();
  } else if (term.contains("fit")) {
    found = fitted(term).value;
  } else {
    const CaseResult& result = case_of(term, at, seed);
    if (term.contains("derived")) {
      try {
        found =
            derived_value(study_, *result.record, term.at("derived").get<std::string>(), term.value("which", Json()));
      } catch (const std::out_of_range& lacks) {
        throw NotComputed{"case " + result.id + ": " + lacks.what()};
      }
    } else {
      const std::string id = term.at("of").get<std::string>();
      const dem::Quantity& quantity = dem::find_quantity(study_.quantities, id);
      const double* stored = result.record->find_result(id);
      if (!stored) throw NotComputed{"case " + result.id + " has no result “" + std::string(quantity.name) + "”"};
      found = *stored * quantity.factor;
    }
  }
  if (!std::isfinite(found)) throw NotComputed{"the result is not a number"};
  return found * term.value("times", 1.0);
}

std::vector<std::pair<double, double>> Terms::by_seed(const Json& term, const dem::Parameters& at) const {
  if (seeds_.empty()) return {{0.0, value(term, at, std::nullopt)}};
  std::vector<std::pair<double, double>> found;
  for (const double seed : seeds_) {
    try {
      found.emplace_back(seed, value(term, at, seed));
    } catch (const NotComputed&) {
      if (seed == seeds_.front()) throw;
    }
  }
  return found;
}

std::vector<double> Terms::values(const Json& term, const dem::Parameters& at) const {
  std::vector<double> found;
  for (const auto& [seed, value] : by_seed(term, at)) found.push_back(value);
  return found;
}

std::vector<std::pair<std::string, std::string>> results_of(const Json& term) {
  std::vector<std::pair<std::string, std::string>> found;
  if (term.contains("furthest")) {
    found.emplace_back(term.at("furthest").get<std::string>(), "");
  } else if (const Json* parts = parts_of(term)) {
    for (const Json& part : *parts) {
      for (auto& one : results_of(part)) found.push_back(std::move(one));
    }
  } else if (term.contains("on")) {
    found = results_of(term.at("on"));
  } else if (term.contains("of")) {
    found.emplace_back(term.at("of").get<std::string>(), term.value("test", ""));
  }
  return found;
}

}  // namespace reports
