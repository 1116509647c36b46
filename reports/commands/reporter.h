#pragma once
// From the outcomes of a study to its report, and to what a person is told about it.
#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/study/study.h"
#include "render/draw.h"
#include "reports/options.h"

namespace cli {

struct ReporterOptions {
  std::filesystem::path output;  ///< the folder that holds the folders of the studies
  std::filesystem::path assets;
  bool html = true;
  bool pdf = true;
  std::string figure;                    ///< draw only this one; "": all
  std::string part;                      ///< folder below that of the study; "": that of the study
  double dpi = 300;                      ///< of pictures
  int threads = 1;                       ///< processes to draw in
  bool quiet = false;                    ///< do not name the files on stdout
  bool strict = false;                   ///< a published number that is missed is not well
  double pdf_seconds = 900;              ///< WeasyPrint is ended after so long
  std::filesystem::path reference = {};  ///< folder of references to compare with; empty: none
  std::function<void(std::size_t done, std::size_t all)> drawing = {};  ///< told how many pictures are drawn
  std::function<void()> before_words = [] {};                           ///< called before something is printed
  const std::atomic<bool>* stop = nullptr;                              ///< asked while drawing and printing
};

/// Makes reports one after the other, with one canvas for all.
class Reporter {
 public:
  explicit Reporter(ReporterOptions options) : options_(std::move(options)) {}

  /// True when every case that was asked for has a record, every check holds, and nothing changed beyond tolerance since
  /// the reference; else stderr says what does not.
  /// `again` and `installed` are how to make the report again, in a clone and where the program is installed.
  /// Throws dem::EnvironmentError as reports::make_report().
  bool report(const dem::Study& study, const std::vector<dem::CaseOutcome>& outcomes, const reports::Again& again,
              const reports::Again& installed);

 private:
  ReporterOptions options_;
  std::optional<render::Canvas> canvas_;  // made when first needed: a process forked to draw must not inherit one
};

}  // namespace cli
