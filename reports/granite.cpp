#include "reports/granite.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/analysis/series.h"
#include "engine/core/record.h"

namespace reports::texture {

StudyResult of_mineral(const StudyResult& study, std::string_view mineral) {
  StudyResult chosen = study;
  std::erase_if(chosen.cases, [&](const CaseResult& one) {
    const dem::ParameterValue* value = dem::find_value(one.parameters, parameter::mineral.id);
    const auto* name = value ? std::get_if<std::string>(value) : nullptr;
    return !one.record || (name ? std::string_view(*name) : std::string_view()) != mineral;
  });
  return chosen;
}

std::vector<std::string> minerals_tested(const StudyResult& study) {
  std::vector<std::string> found;
  for (const CaseResult& one : study.cases) {
    if (!one.record) continue;
    const auto parameter = std::ranges::find(one.record->parameters, "mineral", [](const auto& p) { return p.first; });
    if (parameter == one.record->parameters.end()) continue;
    const auto* name = std::get_if<std::string>(&parameter->second);
    if (name && !name->empty() && std::ranges::find(found, *name) == found.end()) found.push_back(*name);
  }
  return found;
}

analysis::Envelopes envelopes_of(const StudyResult& study, std::string_view mineral) {
  const auto cases = of_mineral(study, mineral).cases;
  return analysis::envelopes_of(
      analysis::series_of(cases, test_compression, parameter::confining_pressure),
      {quantity::compressive_strength, quantity::crack_damage, quantity::initiation_readings});
}

std::string specimen_words(const StudyResult& study, const CaseResult& result) {
  const dem::Table* particles = result.record ? result.record->find("particles") : nullptr;
  if (!particles) return {};
  const std::string width = particles->attribute("diameter"), height = particles->attribute("height");
  if (width.empty() || height.empty()) return {};
  const auto mm = [](double metres) { return fmt::format("{:g} mm", 1e3 * metres); };
  const auto thickness = [&](const char* key, double otherwise) {
    const double set = study.scenario->real(key);
    return mm(set > 0 ? set : otherwise);
  };
  if (result.test() == test_brazilian) {
    return "disc of " + mm(std::stod(height)) + " × " + thickness("brazilian.thickness", std::stod(height) / 2);
  }
  if (result.test() == test_bending) {
    return "bar of " + mm(std::stod(width)) + " × " + mm(std::stod(height)) + " × " +
           thickness("bending.width", 0.6 * std::stod(height));
  }
  if (result.test() == test_half_disc) {
    return "half disc of " + mm(std::stod(width)) + " × " +
           thickness("semicircular_bending.thickness", 0.4 * std::stod(width));
  }
  if (result.test() == test_shear) return "block of " + mm(std::stod(height));
  return "cylinder of " + mm(std::stod(width)) + " × " + mm(std::stod(height));
}

}  // namespace reports::texture
