#include "reports/published/derived.h"

#include <stdexcept>
#include <string>

#include "engine/analysis/orientation.h"
#include "engine/analysis/softening.h"
#include "reports/granite.h"

namespace reports {

std::optional<analysis::Estimate> fitted_value(const StudyResult& study, std::string_view name,
                                               std::string_view mineral) {
  return texture::envelopes_of(study, mineral).find(name);
}

double derived_value(const StudyResult& study, const dem::Record& record, std::string_view name) {
  if (name == "crack_angle") return analysis::orientation_of(record.table("cracks"), 0).mean;
  if (name == "stress_after_peak") {
    const auto cases = texture::of_mineral(study, "").cases;
    const auto series = analysis::series_of(cases, texture::test_compression, texture::parameter::confining_pressure);
    (void)record.table("history");
    return analysis::stress_after_peak(analysis::common_reach(series))(record);
  }
  throw std::invalid_argument("unknown derived value '" + std::string(name) + "'");
}

}  // namespace reports
