// What was run: the title block and the table of cases.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "engine/model/quantities.h"
#include "reports/granite.h"
#include "reports/page/page.h"
#include "reports/page/page_cases.h"
#include "reports/page/page_parts.h"
#include "reports/page/page_tables.h"
#include "reports/provenance.h"
#include "reports/text.h"

namespace reports {
namespace {

// Those of the first case, and of the first whose specimen has another form.
std::string specimen_text(const StudyResult& study) {
  struct Form {
    std::string words;  // "" where a block has no form of its own
    std::size_t least, most;
  };
  std::vector<Form> forms;
  for (const CaseResult& result : study.cases) {
    const dem::Table* particles = result.record ? result.record->find("particles") : nullptr;
    if (!particles) continue;
    const std::string words = texture::specimen_words(study, result);
    const auto known = std::ranges::find(forms, words, &Form::words);
    if (known == forms.end()) {
      forms.push_back({words, particles->rows(), particles->rows()});
    } else {
      known->least = std::min(known->least, particles->rows());
      known->most = std::max(known->most, particles->rows());
    }
  }
  std::string text;
  for (const Form& form : forms) {
    const std::string most = count(static_cast<double>(form.most));
    text += (text.empty() ? "" : "; ") + (form.words.empty() ? "" : form.words + ", ") +
            (form.least == form.most ? most : count(static_cast<double>(form.least)) + " to " + most) + " particles";
  }
  return text;
}

/// "1", "1 to 5": those of the records.
std::string seeds_text(const StudyResult& study) {
  std::set<std::uint64_t> seeds;
  for (const CaseResult& result : study.cases)
    if (result.record) seeds.insert(result.record->seed);
  if (seeds.size() < 2) return std::to_string(study.scenario->seed());
  const bool in_turn = *seeds.rbegin() - *seeds.begin() + 1 == seeds.size();
  std::vector<std::string> all;
  for (const std::uint64_t seed : seeds) all.push_back(std::to_string(seed));
  return in_turn && seeds.size() > 2 ? all.front() + " to " + all.back() : listed(all);
}

/// The loading steps of a case, where the scenario multiplies those of all: both factors together.
dem::ParameterValue whole_factor(const dem::Scenario& scenario, std::string_view parameter,
                                 const dem::ParameterValue& value) {
  const auto* own = std::get_if<double>(&value);
  if (parameter != "factor" || !own || !scenario.declares("loading.factor")) return value;
  return *own * scenario.real("loading.factor");
}

/// Whether the cases differ in a parameter: what all have alike is in the scenario.
bool varies(const StudyResult& study, std::string_view parameter) {
  std::set<std::string> values;
  for (const CaseResult& result : study.cases) {
    if (const auto* value = dem::find_value(result.parameters, parameter)) values.insert(parameter_text(*value));
  }
  return values.size() > 1;
}

/// Whether it is a choice that each test has its own of, as each has its default, and the study runs several of them.
bool of_each_test(const StudyResult& study, const dem::Parameter& parameter) {
  return !parameter.symbol.empty() && std::ranges::any_of(study.cases, [&](const CaseResult& result) {
    return std::ranges::any_of(result.parameters, [&](const auto& one) {
      return one.first != parameter.id && one.first != "test" &&
             dem::find_parameter(study.parameters, one.first).symbol == parameter.symbol;
    });
  });
}

/// Whether the cases differ in such a choice, those of one test or of two.
bool varies_over_tests(const StudyResult& study, const dem::Parameter& parameter) {
  std::set<std::string> values;
  for (const CaseResult& result : study.cases) {
    for (const auto& [id, value] : result.parameters) {
      if (id != "test" && dem::find_parameter(study.parameters, id).symbol == parameter.symbol)
        values.insert(parameter_text(value));
    }
  }
  return values.size() > 1;
}

/// Whether it tells anything of a case: not where it is nothing in all cases of the test ("σ₃ 0 MPa" of a tension).
bool is_told(const StudyResult& study, const CaseResult& result, std::string_view parameter) {
  const dem::Parameter& declared = dem::find_parameter(study.parameters, parameter);
  if (of_each_test(study, declared)) return varies_over_tests(study, declared);
  if (!varies(study, parameter)) return false;
  return std::ranges::any_of(study.cases, [&](const CaseResult& one) {
    const auto* value = one.test() == result.test() ? dem::find_value(one.parameters, parameter) : nullptr;
    const auto* amount = value ? std::get_if<double>(value) : nullptr;
    return value && (!amount || *amount != 0);
  });
}

/// "5 700", or "5 700–5 712" of several seeds.
std::string size_text(const Repeats& repeats, const dem::Quantity& size) {
  std::vector<double> values;
  for (const CaseResult* one : repeats) {
    if (one->record && one->record->has(size)) values.push_back(one->record->value(size));
  }
  if (values.empty()) return "–";
  const auto [least, most] = std::ranges::minmax(values);
  return least == most ? count(least) : count(least) + "–" + count(most);
}

}  // namespace

std::vector<std::pair<std::string, std::vector<const CaseResult*>>> by_test(const StudyResult& study) {
  std::vector<std::pair<std::string, std::vector<const CaseResult*>>> groups;
  for (const CaseResult& result : study.cases) {
    if (!result.record) continue;
    const std::string test = words(result.test());
    auto group = std::ranges::find(groups, test, [](const auto& g) { return g.first; });
    if (group == groups.end()) group = groups.insert(groups.end(), {test, {}});
    group->second.push_back(&result);
  }
  return groups;
}

std::vector<double> values_of(const Repeats& repeats, std::string_view id) {
  std::vector<double> values;
  for (const CaseResult* result : repeats) {
    if (const double* value = result->record->find_result(id)) values.push_back(*value);
  }
  return values;
}

std::string shown_result(const dem::Quantity& quantity, double value, bool powers) {
  if (!std::isfinite(value)) return "–";
  if (quantity.kind == dem::QuantityKind::count && std::floor(value) == value) return count(value);
  return powers ? scientific(quantity.factor * value, quantity.digits)
                : number(quantity.factor * value, quantity.digits);
}

std::string joined_notes(const std::vector<std::string>& notes) {
  std::vector<std::string> said;
  for (const std::string& note : notes) {
    if (!note.empty()) said.push_back(note);
  }
  return joined(said, " ");
}

std::string case_label(const StudyResult& study, const CaseResult& result, bool with_seed) {
  const dem::Parameters& first = study.cases.front().parameters;
  std::vector<std::string> parts;
  std::string aspect;  // what stands for a case that nothing sets apart
  for (const auto& [id, value] : result.parameters) {
    if (id == "test") continue;
    const dem::Parameter& parameter = dem::find_parameter(study.parameters, id);
    const auto* usual = dem::find_value(first, id);
    const std::string part = parameter_words(parameter, value);
    if (parameter.axis && aspect.empty()) aspect = part;
    const bool told = with_seed && id == "seed" ? varies(study, id)
                      : parameter.axis || of_each_test(study, parameter)
                          ? is_told(study, result, id)
                          : parameter.symbol.empty() || !usual || *usual != value;
    if (told && !part.empty()) parts.push_back(part);
  }
  if (parts.empty() && !aspect.empty()) {
    // Beside cases that differ in a choice, and in nothing that results are plotted against, it is the one they start from.
    const bool base = std::ranges::any_of(result.parameters, [&](const auto& one) {
      return one.first != "test" && one.first != "seed" && !dem::find_parameter(study.parameters, one.first).axis &&
             varies(study, one.first);
    });
    const bool plotted = std::ranges::any_of(result.parameters, [&](const auto& one) {
      return one.first != "test" && dem::find_parameter(study.parameters, one.first).axis && varies(study, one.first);
    });
    parts.push_back(base && !plotted ? "base case" : aspect);
  }
  return parts.empty() ? capital(words(result.id)) : joined(parts, ", ");
}

PageData title_data(const StudyResult& study, const ReportOptions& options) {
  const dem::Scenario& scenario = *study.scenario;
  PageData data;
  data.set("title", scenario.text("title").empty() ? capital(words(scenario.name())) : scenario.text("title"));
  data.set("description", scenario.text("description"));
  data.set("has_description", !scenario.text("description").empty());
  data.set("scenario", scenario.name());
  data.set("model", words(scenario.model()));
  data.set("scale", scenario.scale());
  const std::string seeds = seeds_text(study);
  const std::string seed_word = seeds.find_first_not_of("0123456789") == std::string::npos ? "seed" : "seeds";
  data.set("seed_word", seed_word);
  data.set("seed_head", capital(seed_word));
  data.set("seed", seeds);
  data.set("engine_version", options.engine_version);
  const std::string specimen = specimen_text(study);
  data.set("has_specimen", !specimen.empty());
  data.set("specimen", specimen);
  const Provenance origin = provenance_of(study, options.engine_version);
  data.set("has_physics", !origin.physics_version.empty());
  data.set("physics_version", origin.physics_version);
  data.set("scenario_sha256", origin.scenario_sha256);
  const auto done = std::ranges::count_if(study.cases, [](const CaseResult& c) { return c.record != nullptr; });
  data.set("case_count", static_cast<std::size_t>(done) == study.cases.size()
                             ? fmt::format("{}", done)
                             : fmt::format("{} of {}", done, study.cases.size()));
  return data;
}

PageData cases_data(const StudyResult& study) {
  PageData list = new_list();
  std::vector<const CaseResult*> all;
  for (const CaseResult& result : study.cases) all.push_back(&result);
  for (const Repeats& repeats : analysis::repeats_of(all)) {
    const CaseResult& result = *repeats.front();
    PageData row;
    row.set("id", result.id);
    row.set("failed", !result.record);
    if (result.record) {
      const dem::Record& record = *result.record;
      std::vector<std::string> parameters;
      for (const auto& [id, value] : result.parameters) {
        const bool said = id == "test" || !is_told(study, result, id) || (id == "seed" && repeats.size() > 1);
        const std::string part =
            said ? ""
                 : parameter_words(dem::find_parameter(study.parameters, id), whole_factor(*study.scenario, id, value));
        if (!part.empty()) parameters.push_back(part);
      }
      if (parameters.empty()) {  // nothing sets the cases apart: the first that results are plotted against, else all
        for (const auto& [id, value] : result.parameters) {
          if (id == "test" || id == "seed") continue;
          const dem::Parameter& parameter = dem::find_parameter(study.parameters, id);
          const std::string part =
              parameter.symbol.empty() ? "" : parameter_words(parameter, whole_factor(*study.scenario, id, value));
          if (part.empty()) continue;
          if (parameter.axis) parameters.clear();
          parameters.push_back(part);
          if (parameter.axis) break;
        }
      }
      if (repeats.size() > 1) {
        std::vector<std::string> seeds;
        for (const CaseResult* one : repeats) {
          if (one->record) seeds.push_back(std::to_string(one->record->seed));
        }
        parameters.push_back("seeds " + listed(seeds));
      }
      row.set("test", words(result.test()));
      row.set("parameters", parameters.empty() ? "–" : joined(parameters, ", "));
      using namespace dem::quantity;
      for (const dem::Quantity& size : {particles, contacts, grains, steps}) {
        row.set(std::string(size.id), size_text(repeats, size));
      }
      row.set("seed", std::to_string(record.seed));
    } else {
      row.set("error", result.error.empty() ? "not run" : result.error);
    }
    list.push_back(row);
  }
  return list;
}

}  // namespace reports
