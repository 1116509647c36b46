#pragma once
// The page: one self-contained HTML file (pictures as data URIs, style sheet inlined), from assets/report.html and report.css.
#include <string>
#include <vector>

#include "reports/drawing.h"
#include "reports/published.h"
#include "reports/report.h"

namespace reports {

/// Throws dem::EnvironmentError when an asset is missing or broken.
std::string page(const StudyResult& study, const Comparisons& comparisons, const std::vector<DrawnFigure>& figures,
                 const ReportOptions& options);

/// RFC 4648.
std::string base64(std::string_view bytes);

}  // namespace reports
