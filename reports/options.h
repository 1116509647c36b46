#pragma once
// What a report is made from besides the records: its options, and the facts of the run.
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace reports {

/// A file that a report is made from: where it goes below the folder at hand, and whether it comes with the program.
struct InputFile {
  std::string path;  ///< "scenarios/ldb_texture.toml", "mine.toml"; "": none
  bool shipped = false;
};

/// How a report is made again, without paths of this machine: in the folder of a clone, or where the program is installed.
struct Again {
  std::string command;  ///< one line: "./dem-report scenarios/ldb_texture.toml --scale smoke"
  InputFile scenario;   ///< one that is not shipped must be saved there first
  InputFile rock;       ///< the file that it includes; the same
  std::string needs;    ///< a file that must lie there as well (an Elle file); "": none
};

/// What the page says at its top of what changed since a reference, in HTML: on the screen, and in print.
struct SinceReference {
  std::string shown, printed;
};

struct ReportOptions {
  std::filesystem::path folder;  ///< out/NAME.SCALE or a folder in it; made when missing
  std::filesystem::path assets;  ///< the folder with page template, style sheet, published numbers, choices, citations
  bool html = true;              ///< write report.html
  bool pdf = true;               ///< write report.pdf (needs weasyprint)
  std::string only;              ///< draw only this figure; "": all that belong to the scenario
  Again again, again_installed;  ///< how to make it again, in a clone and where it is installed: shown in the report
  std::string engine_version;    ///< "0.1.0"
  double dpi = 300;              ///< of pictures, 85 mm wide in a column and 170 mm over the page
  int workers = 1;               ///< processes to draw in; the same bytes with any number
  double pdf_seconds = 900;      ///< WeasyPrint is ended after so long
  std::function<bool()> stopped = [] { return false; };                 ///< asked for while drawing and printing
  std::function<void(std::size_t done, std::size_t all)> drawing = {};  ///< told how many pictures are drawn
  /// Asked for the date that ro-crate-metadata.json has to have: "2026-11-29T02:16:55+00:00". None: that file is not written.
  std::function<std::string()> date = {};
  /// Asked when summary.json, figures and data are written, with the page as it is without the answer. None: nothing.
  std::function<SinceReference(const std::string& page)> compare_with_reference = {};
  SinceReference since_reference{};  ///< its answer
};

/// What varies between runs of the same input, for run.json: {"host", ...}, {"threads", 2.0}; a dot nests ("wall_s.total").
/// The GL renderer and the time spent on the report are added.
using RunFacts = std::vector<std::pair<std::string, std::variant<double, std::string>>>;

}  // namespace reports
