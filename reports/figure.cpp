#include "reports/figure.h"

#include <algorithm>
#include <cmath>

namespace reports {

const dem::Record* StudyResult::find(std::string_view id) const {
  const auto found = std::ranges::find(cases, id, &CaseResult::id);
  return found == cases.end() ? nullptr : found->record;
}

double StudyResult::published_value(std::string_view id) const {
  const auto found = std::ranges::find(published, id, &PublishedNumber::id);
  return found == published.end() ? std::nan("") : found->low;
}

}  // namespace reports
