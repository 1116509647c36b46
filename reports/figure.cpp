#include "reports/figure.h"

#include <algorithm>

namespace reports {

const dem::Record* StudyResult::find(std::string_view id) const {
  const auto found = std::ranges::find(cases, id, &CaseResult::id);
  return found == cases.end() ? nullptr : found->record;
}

bool of_published_rock(const StudyResult& study) {
  return !study.scenario || study.scenario->model() != "grain_texture" || study.scenario->text("rock") == "Lac du Bonnet granite";
}

}  // namespace reports
