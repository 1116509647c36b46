#include "reports/granite.h"

#include "engine/analysis/series.h"

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

analysis::Envelopes envelopes_of(const StudyResult& study, std::string_view mineral) {
  const auto cases = of_mineral(study, mineral).cases;
  return analysis::envelopes_of(
      analysis::series_of(cases, test_compression, parameter::confining_pressure),
      {quantity::compressive_strength, quantity::crack_damage, quantity::initiation_readings});
}

}  // namespace reports::texture
