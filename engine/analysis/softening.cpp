#include "engine/analysis/softening.h"

#include <algorithm>
#include <limits>

namespace dem::analysis {

double common_reach(std::span<const Point> points) {
  double reach = std::numeric_limits<double>::infinity();
  for (const Point& item : points) {
    for (const Record* record : item.repeats) {
      const auto strain = record->table("history").real("platen_strain"),
                 stress = record->table("history").real("axial_stress");
      if (strain.empty()) continue;
      const auto peak = static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin());
      reach = std::min(reach, 100 * (strain.back() - strain[peak]));
    }
  }
  return reach;
}

ValueOf stress_after_peak(double reach) {
  return [reach](const Record& record) {
    const auto strain = record.table("history").real("platen_strain"),
               stress = record.table("history").real("axial_stress");
    if (strain.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto peak = static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin());
    double sum = 0, count = 0;
    for (std::size_t i = peak; i < strain.size(); ++i) {
      const double after = 100 * (strain[i] - strain[peak]) / reach;
      if (after < 0.9 || after > 1 + 1e-9) continue;
      sum += stress[i];
      ++count;
    }
    return sum / count / stress[peak];
  };
}

}  // namespace dem::analysis
