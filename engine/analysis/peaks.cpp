#include "engine/analysis/peaks.h"

#include <algorithm>
#include <array>
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

namespace {

// Where grains grow between walls that are held, what is called strain is the growth of their radii.
std::string_view of_growth(std::string_view id) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> names{
      {{"onset_strain", "Growth at the first break"},
       {"strain_at_peak", "Growth at the largest differential stress"},
       {"strain_at_peak_tension", "Growth at the largest tension"},
       {"final_strain", "Growth at the end"}}};
  const auto found = std::ranges::find(names, id, [](const auto& one) { return one.first; });
  return found == names.end() ? std::string_view() : found->second;
}

}  // namespace

std::string_view name_of(const Quantity& quantity, std::span<const Record* const> records) {
  const std::string_view growth = of_growth(quantity.id);
  const bool grows = !growth.empty() && !records.empty() && std::ranges::all_of(records, [](const Record* record) {
    const ParameterValue* test = find_value(record->parameters, "test");
    return test && *test == ParameterValue(std::string("growth"));
  });
  if (grows) return growth;
  const bool peak = !quantity.peak_name.empty() &&
                    std::ranges::all_of(records, [](const Record* record) { return passed_peak(*record); });
  return peak ? quantity.peak_name : quantity.name;
}

}  // namespace dem::analysis
