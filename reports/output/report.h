#pragma once
// From the records of a study to its report: figures, data, verdicts, page and PDF, in the output folder of the scenario.
//   report.html  report.pdf  summary.json  run.json  figures/ID.{png,svg}  data/ID.csv
// Every file is written aside (same folder, temporary name) and renamed when whole. Everything but run.json depends on
// the records, the scenario and the assets only: the same input gives the same bytes.
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "render/draw.h"
#include "reports/figure.h"

namespace reports {

struct ReportOptions {
  std::filesystem::path folder;  ///< out/NAME.SCALE; made when missing
  std::filesystem::path assets;  ///< the folder with page template, style sheet, published numbers, choices, citations
  bool html = true;              ///< write report.html
  bool pdf = true;               ///< write report.pdf (needs weasyprint)
  std::string only;              ///< draw only this figure; "": all that belong to the scenario
  std::string command;           ///< how to make it again, one line without paths of this machine: shown in the report
  std::string engine_version;    ///< "0.1.0"
  int workers = 1;               ///< processes to draw in; the same bytes with any number
};

/// What varies between runs of the same input, for run.json: {"host", ...}, {"threads", 2.0}; a dot nests ("wall_s.total").
/// The GL renderer and the time spent on the report are added.
using RunFacts = std::vector<std::pair<std::string, std::variant<double, std::string>>>;

struct ReportOutcome {
  bool checks_held = true;                   ///< every case has a record and every check of every case held
  bool published_all_met = true;             ///< no comparison was missed (those that could not be made do not count)
  std::vector<std::filesystem::path> files;  ///< the pages: report.html, report.pdf, summary.json
};

/// The canvas of this process, made when first asked for: processes forked to draw must not inherit one.
using CanvasSource = std::function<render::Canvas&()>;

/// Makes the report of a study. A failed case appears with its error in its figures' place.
/// Throws dem::InputError when `only` names no figure of this scenario, dem::EnvironmentError when an asset is missing or
/// broken, a file cannot be written, or WeasyPrint is missing or reports an error.
ReportOutcome make_report(StudyResult study, const ReportOptions& options, const CanvasSource& canvas,
                          const RunFacts& run);

/// The text of --list-figures: id, source, title and scenarios of every figure, a line each, grouped by model.
std::string list_figures();

}  // namespace reports
