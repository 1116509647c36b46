// Acoustic emission: events of cracks, how many there are at which stress, their magnitudes, sources and places.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/analysis/ending.h"
#include "reports/figures/emission.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/failed.h"
#include "reports/figures/texture/parts.h"

namespace reports::texture {
namespace {

// Of shear waves through the specimen, m/s. Where a test does not measure modulus and Poisson's ratio they are those of the
// first one of the study that does; in a study without any, the mean modulus of the contacts and 0.25 stand for them.
struct Waves {
  double speed = 0;
  bool by_contacts = false;
};

Waves waves_in(const StudyResult& study, const dem::Record& record) {
  double young = record.value_or_nan(quantity::young_modulus), ratio = record.value_or_nan(quantity::poisson_ratio);
  const std::string mineral = record.text(parameter::mineral.id);
  for (const CaseResult& one : of_mineral(study, mineral).cases) {
    if (!std::isfinite(ratio)) ratio = one.record->value_or_nan(quantity::poisson_ratio);
    if (!std::isfinite(young)) young = one.record->value_or_nan(quantity::young_modulus);
  }
  const dem::Scenario& s = *study.scenario;
  double density = 0, modulus = 0, shares = 0;
  for (std::size_t place = 0; place < s.count("mineral"); ++place) {
    std::string name = s.text(fmt::format("mineral[{}].name", place));
    std::ranges::replace(name, ' ', '_');
    const double share = record.value_or_nan(quantity::mineral_share, name);
    if (!std::isfinite(share)) continue;
    density += share * s.real(fmt::format("mineral[{}].density", place));
    modulus += share * s.real(fmt::format("mineral[{}].modulus", place));
    shares += share;
  }
  density *= (1 - record.value_or_nan(quantity::porosity)) / shares;
  const bool by_contacts = !std::isfinite(young);
  const double stiffness = by_contacts ? modulus / shares : 1e9 * young;
  if (!std::isfinite(ratio)) ratio = 0.25;
  return {std::sqrt(stiffness / (2 * (1 + ratio)) / density), by_contacts};
}

Emitter emitter_of(const StudyResult& study, const dem::Record& record) {
  Emitter of{.window = study.scenario->real("emission.window"),
             .duration = study.scenario->real("emission.duration"),
             .shear_wave = waves_in(study, record).speed,
             .diameter = mean_diameter(record),
             .strain = "platen_strain",
             .heat = {"bond_tension", "bond_shear"},
             .outline = outline_of(record)};
  if (!is_of_cylinder(record)) of.strain_title = "Displacement of the load over the size (%)";
  return of;
}

}  // namespace

FigureContent acoustic_emission(const StudyResult& study) {
  FigureContent content;
  add_missing_failed(content, study);
  std::vector<Emission> all;
  bool by_contacts = false;
  for (const SeriesCase& item : failed(study)) {
    auto found = emission_of(item, emitter_of(study, *item.record));
    if (!found) continue;
    by_contacts = by_contacts || waves_in(study, *item.record).by_contacts;
    all.push_back(std::move(*found));
  }
  add_emission(content, all);
  if (std::ranges::any_of(all, [](const Emission& e) { return analysis::is_followed(*e.looks.record); }))
    content.finding += " All are counted up to the end of loading.";
  if (by_contacts)
    content.finding +=
        " No test of this study measures Young’s modulus: the speed of shear waves, which sets the window in time, is "
        "that "
        "by the mean modulus of the contacts.";
  return content;
}

}  // namespace reports::texture
