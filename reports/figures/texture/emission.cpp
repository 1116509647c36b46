// Acoustic emission: events of cracks, how many there are at which stress, their magnitudes, sources and places.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/analysis/ending.h"
#include "reports/figures/emission.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"

namespace reports::texture {
namespace {

// Of shear waves through the specimen, from its modulus and density, m/s. Poisson's ratio is that of the study's first
// compression where a test does not measure it.
double shear_wave(const StudyResult& study, const dem::Record& record) {
  double young = record.value_or_nan(quantity::young_modulus), ratio = record.value_or_nan(quantity::poisson_ratio);
  for (const CaseResult& one : study.cases) {
    if (!one.record || one.test() != test_compression) continue;
    if (!std::isfinite(ratio)) ratio = one.record->value_or_nan(quantity::poisson_ratio);
    if (!std::isfinite(young)) young = one.record->value_or_nan(quantity::young_modulus);
  }
  if (!std::isfinite(ratio)) ratio = 0.25;
  const dem::Scenario& s = *study.scenario;
  double density = 0, shares = 0;
  for (std::size_t place = 0; place < s.count("mineral"); ++place) {
    std::string name = s.text(fmt::format("mineral[{}].name", place));
    std::ranges::replace(name, ' ', '_');
    const double share = record.value_or_nan(quantity::mineral_share, name);
    if (!std::isfinite(share)) continue;
    density += share * s.real(fmt::format("mineral[{}].density", place));
    shares += share;
  }
  density *= (1 - record.value_or_nan(quantity::porosity)) / shares;
  return std::sqrt(1e9 * young / (2 * (1 + ratio)) / density);
}

Emitter emitter_of(const StudyResult& study, const dem::Record& record) {
  const Size size = size_of(record);
  const double half = 0.5 * size.diameter;
  return {.window = study.scenario->real("emission.window"),
          .duration = study.scenario->real("emission.duration"),
          .shear_wave = shear_wave(study, record),
          .diameter = mean_diameter(record),
          .strain = "platen_strain",
          .heat = {"bond_tension", "bond_shear"},
          .outline = {
              render::Outline::Shape::cylinder, {-half, -half, size.z_low}, {half, half, size.z_low + size.height}}};
}

}  // namespace

FigureContent acoustic_emission(const StudyResult& study) {
  FigureContent content;
  const auto pressed = swept_by_test(study, test_compression), pulled = swept_by_test(study, test_tension);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  std::vector<Emission> all;
  for (const SeriesCase& item : pressed)
    if (auto found = emission_of(item, emitter_of(study, *item.record))) all.push_back(std::move(*found));
  if (!pulled.empty()) {
    SeriesCase looks = pulled.front();
    looks.label = tension_label(study, pulled.front());
    looks.id = "tension";
    looks.colour = {0.35, 0.35, 0.35};
    looks.line = render::line_style(all.size());
    if (auto found = emission_of(looks, emitter_of(study, *looks.record))) all.push_back(std::move(*found));
  }
  add_emission(content, all);
  if (std::ranges::any_of(all, [](const Emission& e) { return analysis::is_followed(*e.looks.record); }))
    content.finding += " All are counted up to the end of loading.";
  return content;
}

}  // namespace reports::texture
