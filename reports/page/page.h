#pragma once
// The page: one HTML file from assets/page/report.html and report.css, with the style sheet inlined.
#include <string>
#include <vector>

#include "reports/drawn.h"
#include "reports/options.h"
#include "reports/published/published.h"

namespace reports {

/// Pictures as data URIs, so that the page is whole in itself; or named, for a page that lies in the output folder while
/// the PDF is printed (reading megabytes of base64 is slow).
enum class Images { embedded, linked };

/// Throws dem::EnvironmentError when an asset is missing or broken.
std::string page(const StudyResult& study, const Comparisons& comparisons, const std::vector<DrawnFigure>& figures,
                 const ReportOptions& options, Images images = Images::embedded);

}  // namespace reports
