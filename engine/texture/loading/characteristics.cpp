#include "engine/texture/loading/characteristics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem::texture {
namespace {

// The gauge moves as the ends do, within this power of two; else the wave has not come to it, and there is no modulus.
constexpr double most_octaves = 1.5;

// First row at or above `stress`, on the way up.
std::size_t first_above(const std::vector<HistoryRow>& h, std::size_t peak, double stress) {
  std::size_t i = 0;
  while (i < peak && h[i].axial_stress < stress) ++i;
  return i;
}

}  // namespace

double axial_stiffness(const std::vector<HistoryRow>& h, std::size_t row) {
  const double strain = h[row].axial_strain - h.front().axial_strain;
  constexpr double least = 5e-5;  // below, the quotient shows the start of the platens and not the rock
  return strain > least ? (h[row].axial_stress - h.front().axial_stress) / strain
                        : std::numeric_limits<double>::quiet_NaN();
}

double kinetic_share(const Characteristics& c, double length, double mass) {
  const double speed = 0.5 * length * c.strain_rate;
  return c.elastic_energy > 0 ? mass * speed * speed / 6 / c.elastic_energy : 0;
}

double rate_bias(double kinetic_share, double sensitivity, bool of_modulus) {
  constexpr double modulus = 30;  // falls with the energy, strengths with the speed
  return std::max(sensitivity * std::sqrt(kinetic_share), of_modulus ? modulus * kinetic_share : 0);
}

std::optional<double> secant_poisson_ratio(const std::vector<HistoryRow>& h, std::size_t peak) {
  if (h.empty()) return {};
  const std::size_t half = first_above(h, peak, 0.5 * h[peak].axial_stress);
  if (half == 0 || h[half].axial_strain <= 0) return {};
  return -h[half].lateral_strain / h[half].axial_strain;
}

Characteristics characterise(const std::vector<HistoryRow>& h, double departure, bool crack_stages,
                             double confining_pressure) {
  Characteristics c;
  if (h.size() < 3) return c;
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (h[i].axial_stress > h[c.peak].axial_stress) c.peak = i;
  }
  const auto at_share = [&](double share) {
    return first_above(h, c.peak, confining_pressure + share * (h[c.peak].axial_stress - confining_pressure));
  };
  const std::size_t low = at_share(0.10), middle = at_share(0.25), high = at_share(0.30), half = at_share(0.50);
  if (high > low + 1) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = low; i <= high; ++i) {
      n += 1;
      x += h[i].axial_strain;
      y += h[i].axial_stress;
    }
    x /= n;
    y /= n;
    for (std::size_t i = low; i <= high; ++i) {
      xx += (h[i].axial_strain - x) * (h[i].axial_strain - x);
      xy += (h[i].axial_strain - x) * (h[i].axial_stress - y);
    }
    const double moved = h[high].axial_strain - h[low].axial_strain;
    c.gauge_share = moved / (h[high].platen_strain - h[low].platen_strain);
    if (xx > 0 && std::abs(std::log2(c.gauge_share)) < most_octaves) c.young_modulus = xy / xx;
  }
  double way = 0;
  for (std::size_t i = low; i <= half; ++i) {
    c.elastic_energy += h[i].ledger.elastic / static_cast<double>(half - low + 1);
    if (i > low) way += std::abs(h[i].platen_strain - h[i - 1].platen_strain);
  }
  if (h[half].time > h[low].time) c.strain_rate = way / (h[half].time - h[low].time);
  if (!crack_stages) return c;
  const bool gauge_still = high > low + 1 && !c.young_modulus;
  if (half > 0 && h[half].axial_strain > 0 && !gauge_still)
    c.poisson_ratio = -h[half].lateral_strain / h[half].axial_strain;
  if (middle > low) {
    double plateau = 0;
    for (std::size_t i = low; i <= middle; ++i)
      plateau += axial_stiffness(h, i) / static_cast<double>(middle - low + 1);
    for (std::size_t i = middle; i <= c.peak; ++i) {
      if (std::abs(axial_stiffness(h, i) / plateau - 1) > departure) {
        c.initiation_stiffness = i;
        break;
      }
    }
  }
  for (std::size_t i = 1; i <= c.peak; ++i) {
    if (h[i - 1].axial_strain < 1e-3 && h[i].axial_strain >= 1e-3) {
      const double f = (1e-3 - h[i - 1].axial_strain) / (h[i].axial_strain - h[i - 1].axial_strain);
      c.stress_at_strain = h[i - 1].axial_stress + f * (h[i].axial_stress - h[i - 1].axial_stress);
      break;
    }
  }
  const double one_percent = 0.01 * h[c.peak].all_cracks();
  for (std::size_t i = 0; one_percent > 0 && i <= c.peak; ++i) {
    if (h[i].all_cracks() >= one_percent) {
      c.initiation_cracks = i;
      break;
    }
  }
  std::size_t damage = 0;
  for (std::size_t i = 0; i <= c.peak; ++i) {
    if (h[i].volumetric_strain() > h[damage].volumetric_strain()) damage = i;
  }
  if (damage > 0) c.damage = damage;
  if (c.young_modulus && c.poisson_ratio && low > 0) {
    // Elastic part with the early lateral ratio: the crack volumetric strain is what is left.
    const double early = -h[high].lateral_strain / h[high].axial_strain;
    const auto crack_volume = [&](std::size_t i) {
      return h[i].volumetric_strain() - (1 - 2 * early) / *c.young_modulus * (h[i].axial_stress - confining_pressure);
    };
    std::size_t turn = low;
    for (std::size_t i = low; i <= c.peak; ++i) {
      if (crack_volume(i) > crack_volume(turn)) turn = i;
    }
    c.initiation_volume = turn;
  }
  return c;
}

}  // namespace dem::texture
