#include "reports/provenance.h"

#include <algorithm>

#include "engine/core/hash.h"

namespace reports {
namespace {

/// What a file holds counts, not how its path was typed.
std::string without_paths(const std::string& canonical) {
  std::string kept;
  for (std::size_t from = 0; from < canonical.size();) {
    const std::size_t end = std::min(canonical.find('\n', from), canonical.size() - 1) + 1;
    const std::string_view line(&canonical[from], end - from);
    if (!line.starts_with("include = ") && !line.starts_with("grains.file = ")) kept += line;
    from = end;
  }
  return kept;
}

}  // namespace

Provenance provenance_of(const StudyResult& study, const std::string& engine_version) {
  const auto done = std::ranges::find_if(study.cases, [](const CaseResult& c) { return c.record != nullptr; });
  return {dem::sha256(without_paths(study.scenario->canonical())), engine_version,
          done == study.cases.end() ? "" : done->record->physics_version, study.scenario->seed()};
}

}  // namespace reports
