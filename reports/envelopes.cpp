#include "reports/envelopes.h"

#include <cmath>

#include "reports/figures/texture_parts.h"

namespace reports {
namespace {

StrengthPoints points_of(const std::vector<SeriesCase>& cases, const Measure& strength) {
  StrengthPoints points;
  for (const SeriesCase& item : cases) {
    for (const dem::Record* record : item.repeats) {
      const double value = strength(*record);
      if (!std::isfinite(value)) continue;
      points.sigma_3.push_back(item.value);
      points.sigma_1.push_back(value);
    }
  }
  return points;
}

double peak_of(const dem::Record& record) {
  return record.has_result("ucs_MPa") ? record.result("ucs_MPa") : result_or_nan(record, "confined_strength_MPa");
}

}  // namespace

std::optional<Estimate> Envelopes::find(std::string_view name) const {
  if (name.starts_with("peak.") && peak_fit) {
    if (name == "peak.sigma_c") return peak_fit->sigma_c;
    if (name == "peak.m") return peak_fit->m;
  }
  if (name.starts_with("damage.") && damage_fit) {
    if (name == "damage.m") return damage_fit->m;
    if (name == "damage.s") return damage_fit->s;
  }
  if (name.starts_with("initiation.") && initiation_fit) {
    if (name == "initiation.intercept") return initiation_fit->intercept;
    if (name == "initiation.slope") return initiation_fit->slope;
  }
  return std::nullopt;
}

Envelopes envelopes_of(const StudyResult& study, std::string_view mineral) {
  const auto cases = series_of(texture::of_mineral(study, mineral), texture::test_compression, texture::confining_axis);
  Envelopes found;
  found.peak = points_of(cases, peak_of);
  found.damage = points_of(cases, result("crack_damage_MPa"));
  found.initiation = points_of(cases, result("crack_initiation_MPa.axial_stiffness"));
  found.peak_fit = fit_peak_envelope(found.peak.sigma_3, found.peak.sigma_1);
  if (found.peak_fit) {
    found.damage_fit = fit_damage_envelope(found.damage.sigma_3, found.damage.sigma_1, found.peak_fit->sigma_c.value);
  }
  found.initiation_fit = fit_line(found.initiation.sigma_3, found.initiation.sigma_1);
  return found;
}

}  // namespace reports
