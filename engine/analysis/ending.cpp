#include "engine/analysis/ending.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dem::analysis {
namespace {

bool is_end(const Table& table) { return table.name.starts_with("snapshots/") && table.attribute("moment") == "end"; }

}  // namespace

bool has_end_of_loading(const Record& record) { return std::ranges::any_of(record.tables, is_end); }

std::size_t end_of_loading(const Record& record) {
  const Table& history = record.table("history");
  const std::size_t rows = history.rows(), last = rows == 0 ? 0 : rows - 1;
  if (!history.has("axial_strain") || !history.has("axial_stress")) return last;
  for (const Table& table : record.tables) {
    if (!is_end(table)) continue;
    // The moment keeps six digits of its strain and stress: the row that has them is nearest in both.
    if (table.attribute("strain").empty() || table.attribute("stress").empty()) return last;
    const double strain = std::stod(table.attribute("strain")), stress = std::stod(table.attribute("stress"));
    const auto strains = history.real("axial_strain"), stresses = history.real("axial_stress");
    const auto scale = [](double value) { return std::max(std::abs(value), std::numeric_limits<double>::min()); };
    double least = std::numeric_limits<double>::infinity();
    std::size_t row = last;
    for (std::size_t i = 0; i < rows; ++i) {
      const double off =
          std::max(std::abs(strains[i] - strain) / scale(strain), std::abs(stresses[i] - stress) / scale(stress));
      if (off < least) {
        least = off;
        row = i;
      }
    }
    return row;
  }
  return last;
}

bool is_followed(const Record& record) { return end_of_loading(record) + 1 < record.table("history").rows(); }

}  // namespace dem::analysis
