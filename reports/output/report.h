#pragma once
// From the records of a study to its report: figures, data, verdicts, page and PDF, in the output folder of the scenario.
//   report.html  report.pdf  summary.json  run.json  ro-crate-metadata.json  figures/ID.{png,svg}  data/ID.csv  inputs/
// Every file is written aside (same folder, temporary name) and renamed when whole. Everything but run.json and
// ro-crate-metadata.json, which has a date, depends on the records, the scenario and the assets only: the same input gives the
// same bytes.
#include <filesystem>
#include <string>
#include <vector>

#include "reports/figure.h"
#include "reports/options.h"
#include "reports/output/drawing.h"
#include "reports/published/verdict.h"

namespace reports {

struct ReportOutcome {
  bool checks_held = true;                   ///< every case has a record and every check of every case held
  Tally verdicts;                            ///< of the published numbers
  std::string verdicts_text;                 ///< the same in words; "" where nothing is published
  std::vector<std::filesystem::path> files;  ///< the pages: report.html, report.pdf, summary.json
};

/// Makes the report of a study. A failed case appears with its error in its figures' place.
/// Throws dem::InputError when `only` names no figure of this scenario, dem::EnvironmentError when an asset is missing or
/// broken, a file cannot be written, or WeasyPrint is missing or reports an error; dem::Interrupted when asked to stop.
ReportOutcome make_report(StudyResult study, const ReportOptions& options, const CanvasSource& canvas,
                          const RunFacts& run);

/// The text of --list-figures: id, source, title and scenarios of every figure, a line each, grouped by model.
std::string list_figures();

}  // namespace reports
