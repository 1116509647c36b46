#pragma once
// One page over many studies, and the same as JSON.
#include <filesystem>
#include <string>
#include <vector>

#include "reports/overview/history.h"
#include "reports/overview/study_row.h"

namespace overview {

/// One HTML file without scripts, from assets/page/index.html: a row a study, filters, thumbnails; with a history, where its
/// numbers stepped. Throws dem::EnvironmentError when an asset is missing or broken.
std::string index_page(const std::vector<StudyRow>& rows, const History* history, const std::filesystem::path& assets);

/// As assets/index.schema.json describes it.
std::string index_json(const std::vector<StudyRow>& rows, const History* history);

/// Writes index.html and index.json into `output`, each whole.
void write_index(const std::filesystem::path& output, const std::vector<StudyRow>& rows, const History* history,
                 const std::filesystem::path& assets);

}  // namespace overview
