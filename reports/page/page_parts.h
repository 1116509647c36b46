#pragma once
// The parts of the page as data for the template (assets/page/report.html). One function a part; names of fields are the
// names in the template.
#include <string>
#include <vector>

#include "reports/drawn.h"
#include "reports/options.h"
#include "reports/published/published.h"
#include "reports/template.h"

namespace reports {

PageData title_data(const StudyResult& study, const ReportOptions& options);  ///< title block
PageData cases_data(const StudyResult& study);                                ///< what was run
PageData findings_data(const StudyResult& study, const Comparisons& comparisons,
                       const std::vector<DrawnFigure>& figures);  ///< what came out, in short
/// A table of results for each test: of what the study is made for, or of counts and diagnostics.
PageData results_data(const StudyResult& study, bool diagnostics);
PageData comparisons_data(const Comparisons& comparisons);
PageData laboratory_data(const StudyResult& study);  ///< what the user's laboratory measured, beside ours
/// Pictures and downloads are read from `folder` and embedded; pictures are named when it is empty.
PageData figures_data(const std::vector<DrawnFigure>& figures, const std::filesystem::path& folder);
PageData ledger_data(const StudyResult& study);
PageData checks_data(const StudyResult& study);
std::string checks_summary(const StudyResult& study);  ///< "All 12 checks of the runs held."
bool checks_held(const StudyResult& study);
PageData notes_data(const StudyResult& study);

/// "AR 2", "AR 1, seed scale 0.675": the aspect ratio and what else sets a case apart from the first one of the study; the
/// id when there is neither, or no record.
std::string case_label(const StudyResult& study, const CaseResult& result, bool with_seed = false);

}  // namespace reports
