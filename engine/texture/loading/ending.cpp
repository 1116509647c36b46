#include "engine/texture/loading/ending.h"

#include <algorithm>

namespace dem::texture {
namespace {

constexpr double least_peak = 1e5;     // Pa: a test cannot end on the noise before it has begun
constexpr double least_strain = 1e-3;  // nor on the strain of a first, small peak

// The rules. `peak` is the row of the largest stress so far.
bool ends(const HistoryRow& row, const HistoryRow& peak, const Ending& ending) {
  if (peak.axial_stress <= least_peak) return false;
  const bool fell = row.axial_stress < ending.stop * peak.axial_stress;
  const bool far = ending.strain_limit > 0 && row.platen_strain > ending.strain_limit * peak.platen_strain &&
                   row.platen_strain > least_strain;
  return fell || far;
}

}  // namespace

std::optional<std::size_t> end_row(const std::vector<HistoryRow>& history, const Ending& ending) {
  std::size_t peak = 0;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (history[i].axial_stress > history[peak].axial_stress) peak = i;
    if (ends(history[i], history[peak], ending)) return i;
  }
  return {};
}

bool is_over(const std::vector<HistoryRow>& history, const Ending& ending) {
  if (!end_row(history, ending)) return false;
  const auto peak = std::ranges::max_element(history, {}, &HistoryRow::axial_stress);
  return history.back().platen_strain >= ending.follow * peak->platen_strain;
}

}  // namespace dem::texture
