#include "engine/analysis/envelopes.h"

#include <cmath>
#include <string>

namespace dem::analysis {
namespace {

StrengthPoints points_of(std::span<const Point> series, const Quantity& strength) {
  StrengthPoints points;
  for (const Point& point : series) {
    for (const Record* record : point.repeats) {
      const double value = record->value_or_nan(strength);
      if (!std::isfinite(value)) continue;
      points.sigma_3.push_back(point.value);
      points.sigma_1.push_back(value);
    }
  }
  return points;
}

}  // namespace

std::optional<Estimate> Envelopes::find(std::string_view name) const {
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
    if (name.ends_with(".r_squared")) return Estimate{one.fit->r_squared, std::nan(""), std::nan("")};
  }
  return std::nullopt;
}

Envelopes envelopes_of(std::span<const Point> series, const EnvelopeQuantities& of) {
  Envelopes found;
  found.peak = points_of(series, of.peak);
  found.damage = points_of(series, of.damage);
  double unconfined = 0, tests = 0;
  for (std::size_t i = 0; i < found.peak.sigma_3.size(); ++i) {
    if (found.peak.sigma_3[i] != 0) continue;
    unconfined += found.peak.sigma_1[i];
    tests += 1;
  }
  found.ucs = tests > 0 ? unconfined / tests : std::nan("");
  found.peak_fit = fit_peak_m(found.peak.sigma_3, found.peak.sigma_1, found.ucs);
  found.free_fit = fit_peak_envelope(found.peak.sigma_3, found.peak.sigma_1);
  found.damage_fit = fit_damage_envelope(found.damage.sigma_3, found.damage.sigma_1, found.ucs);
  for (const Reading& reading : of.initiation) {
    Initiation one{reading.id, reading.name, points_of(series, reading.quantity), {}};
    one.fit = fit_line(one.points.sigma_3, one.points.sigma_1);
    found.initiation.push_back(std::move(one));
  }
  return found;
}

}  // namespace dem::analysis
