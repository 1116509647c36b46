#pragma once
// Folders of studies against each other, and a study against its reference.
#include <filesystem>
#include <map>
#include <string>

#include "reports/comparison/page.h"

namespace comparison {

/// Name and folder of each report or reference that lies in `folder`, in the order of their names.
std::map<std::string, std::filesystem::path> studies_in(const std::filesystem::path& folder);

/// Two folders of one study each, or two with many; a study against a folder with many is looked for by its name.
/// Tolerances are those beside the old ones. Throws dem::InputError when a folder is not there or holds no study.
Comparison compare_folders(const std::filesystem::path& was, const std::filesystem::path& is, Options options);

/// The report in `folder` against its reference below `references`; `page` as for read_report(). Throws dem::InputError for
/// tolerances.toml.
StudyComparison compare_with_reference(const std::filesystem::path& folder, const std::filesystem::path& references,
                                       const std::string& page, Options options);

}  // namespace comparison
