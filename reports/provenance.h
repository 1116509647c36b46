#pragma once
// What a report is of, to the bit: the page, summary.json, the facts in pictures and ro-crate-metadata.json say it.
#include <cstdint>
#include <string>

#include "reports/figure.h"

namespace reports {

struct Provenance {
  std::string scenario_sha256;  ///< of all values of the scenario but those that name a file
  std::string engine_version;   ///< "0.1.0"
  std::string physics_version;  ///< "grain_texture 6", from the records; "": there is none
  std::uint64_t seed = 0;       ///< of the scenario
};

Provenance provenance_of(const StudyResult& study, const std::string& engine_version);

}  // namespace reports
