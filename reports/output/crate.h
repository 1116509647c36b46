#pragma once
// ro-crate-metadata.json: where a report comes from, for archives and for programs. RO-Crate 1.1 with the profile Process Run
// Crate 0.5: https://w3id.org/ro/crate/1.1, https://w3id.org/ro/wfrun/process/0.5.
#include <filesystem>
#include <string>
#include <vector>

#include "reports/drawn.h"
#include "reports/options.h"

namespace reports {

/// What lay in the folder from an earlier run; "": nothing. It is removed: it does not describe what is now being written.
std::string take_crate(const std::filesystem::path& folder);

/// Copies scenario, rock and map into the folder's `inputs` and describes all that the report is made of. The standard asks for a
/// date: `date` as "2026-11-29T02:16:55+00:00", or that of `earlier` (take_crate()) when nothing else has changed since.
void write_crate(const StudyResult& study, const std::vector<DrawnFigure>& figures, const ReportOptions& options,
                 const std::string& earlier, const std::string& date);

}  // namespace reports
