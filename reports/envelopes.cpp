#include "reports/envelopes.h"

#include <cmath>

#include "reports/figures/texture/parts.h"

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

std::optional<analysis::Estimate> Envelopes::find(std::string_view name) const {
  if (name == "peak.m" && peak_fit) return peak_fit->m;
  if (name.starts_with("free.") && free_fit) {
    if (name == "free.sigma_c") return free_fit->sigma_c;
    if (name == "free.m") return free_fit->m;
  }
  if (name.starts_with("damage.") && damage_fit) {
    if (name == "damage.m") return damage_fit->m;
    if (name == "damage.s") return damage_fit->s;
  }
  for (const Initiation& one : initiation) {
    if (!one.fit || !name.starts_with("initiation." + std::string(one.id) + ".")) continue;
    if (name.ends_with(".intercept")) return one.fit->intercept;
    if (name.ends_with(".slope")) return one.fit->slope;
  }
  return std::nullopt;
}

Envelopes envelopes_of(const StudyResult& study, std::string_view mineral) {
  const auto cases = series_of(texture::of_mineral(study, mineral), texture::test_compression, texture::confining_axis);
  Envelopes found;
  found.peak = points_of(cases, peak_of);
  found.damage = points_of(cases, result("crack_damage_MPa"));
  double unconfined = 0, tests = 0;
  for (std::size_t i = 0; i < found.peak.sigma_3.size(); ++i) {
    if (found.peak.sigma_3[i] != 0) continue;
    unconfined += found.peak.sigma_1[i];
    tests += 1;
  }
  found.ucs = tests > 0 ? unconfined / tests : std::nan("");
  found.peak_fit = analysis::fit_peak_m(found.peak.sigma_3, found.peak.sigma_1, found.ucs);
  found.free_fit = analysis::fit_peak_envelope(found.peak.sigma_3, found.peak.sigma_1);
  found.damage_fit = analysis::fit_damage_envelope(found.damage.sigma_3, found.damage.sigma_1, found.ucs);
  for (const auto& [id, name] : {std::pair{"axial_stiffness", "axial stiffness"},
                                 {"strain_0_1_percent", "stress at 0.1 % strain"},
                                 {"one_percent_of_cracks", "1 % of the cracks at the peak"},
                                 {"crack_volumetric_strain", "crack volumetric strain"}}) {
    Initiation one{id, name, points_of(cases, result("crack_initiation_MPa." + std::string(id))), {}};
    one.fit = analysis::fit_line(one.points.sigma_3, one.points.sigma_1);
    found.initiation.push_back(std::move(one));
  }
  return found;
}

}  // namespace reports
