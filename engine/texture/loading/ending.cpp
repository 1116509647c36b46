#include "engine/texture/loading/ending.h"

#include <algorithm>

namespace dem::texture {
namespace {

constexpr double least_strain = 1e-3;  // no test ends on the strain of a first, small peak
constexpr double no_local_fall = 0.5;  // of the peak

// The rules. `peak` is the row of the largest stress so far.
bool ends(const HistoryRow& row, const HistoryRow& peak, const Ending& ending) {
  if (peak.axial_stress <= least_peak || row.phase != 0) return false;
  const bool is_local = row.all_cracks() < ending.least_cracks && row.axial_stress > no_local_fall * peak.axial_stress;
  const bool fell = row.axial_stress < ending.stop * peak.axial_stress && !is_local;
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

std::string_view limit_reached(const std::vector<HistoryRow>& history, const Ending& ending) {
  if (history.empty()) return {};
  const HistoryRow& last = history.back();
  if (ending.largest_strain > 0 && last.platen_strain >= ending.largest_strain) return "largest_strain";
  const double steps = last.step - history.front().step;
  if (ending.most_steps > 0 && steps >= static_cast<double>(ending.most_steps)) return "most_steps";
  return {};
}

bool is_over(const std::vector<HistoryRow>& history, const Ending& ending) {
  if (!limit_reached(history, ending).empty()) return true;
  if (!end_row(history, ending)) return false;
  const auto peak = std::ranges::max_element(history, {}, &HistoryRow::axial_stress);
  return history.back().platen_strain >= std::max(ending.follow * peak->platen_strain, ending.follow_strain);
}

}  // namespace dem::texture
