#pragma once
// A comparison as a page, as JSON, and as a section of a report.
#include <filesystem>
#include <string>
#include <vector>

#include "reports/comparison/compare.h"

namespace comparison {

/// Two folders of studies, or two studies, against each other.
struct Comparison {
  std::vector<StudyComparison> studies;

  [[nodiscard]] bool well() const;  ///< nothing beyond tolerance in any study, none gone
};

/// One HTML file that needs nothing else and no script, from assets/page/comparison.html. No clock, path or version: the same
/// comparison gives the same bytes. Throws dem::EnvironmentError when an asset is missing or broken.
std::string comparison_page(const Comparison& comparison, const std::filesystem::path& assets);

/// As assets/comparison.schema.json describes it.
std::string comparison_json(const Comparison& comparison);

/// The section "Since the reference" of a report, in HTML: what changed and why; `page` is the file that shows all of it.
std::string since_section(const StudyComparison& study, const std::string& page, const std::filesystem::path& assets);

}  // namespace comparison
