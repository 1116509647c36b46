#include "engine/analysis/peaks.h"

#include <algorithm>
#include <cmath>

namespace dem::analysis {

bool passed_peak(const Record& record) {
  const Table* history = record.find("history");
  if (!history || !history->has("loaded_stress_xx")) return true;
  const auto loaded_x = history->real("loaded_stress_xx"), loaded_y = history->real("loaded_stress_yy"),
             left_x = history->real("stress_xx"), left_y = history->real("stress_yy");
  double largest = 0;
  for (std::size_t i = 0; i < loaded_x.size(); ++i) largest = std::max(largest, std::abs(loaded_x[i] - loaded_y[i]));
  return largest > 0 && std::abs(left_x.back() - left_y.back()) <= (1 - peak_fall) * largest;
}

std::string_view name_of(const Quantity& quantity, std::span<const Record* const> records) {
  const bool peak = !quantity.peak_name.empty() &&
                    std::ranges::all_of(records, [](const Record* record) { return passed_peak(*record); });
  return peak ? quantity.peak_name : quantity.name;
}

}  // namespace dem::analysis
