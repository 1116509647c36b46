#include "reports/after_peak.h"

#include <algorithm>
#include <limits>

namespace reports {

double common_reach(const std::vector<SeriesCase>& cases) {
  double reach = std::numeric_limits<double>::infinity();
  for (const SeriesCase& item : cases) {
    for (const dem::Record* record : item.repeats) {
      const auto strain = record->table("history").real("platen_strain"),
                 stress = record->table("history").real("axial_stress");
      if (strain.empty()) continue;
      const auto peak = static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin());
      reach = std::min(reach, 100 * (strain.back() - strain[peak]));
    }
  }
  return reach;
}

Measure stress_after_peak(double reach) {
  return [reach](const dem::Record& record) {
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

}  // namespace reports
