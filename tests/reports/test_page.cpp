// The whole report from made-up records: files, page and PDF.
#include <doctest/doctest.h>

#include <cstdlib>

#include "engine/core/files.h"
#include "reports/report.h"
#include "tests/reports/synthetic.h"
#include "tests/support/scratch.h"

TEST_CASE("a report is made whole") {
  const test::Scratch scratch;
  const synthetic::Study study(scratch.path());
  const char* kept = std::getenv("DEM_KEEP_REPORT");
  const std::filesystem::path folder = kept ? std::filesystem::path(kept) : scratch / "out";
  reports::ReportOptions options;
  options.folder = folder;
  options.assets = std::filesystem::path(DEM_SOURCE_DIR) / "assets";
  options.engine_version = "0.1.0";
  render::Canvas canvas;
  const auto outcome = reports::make_report(study.result(), options, canvas, {{"threads", 2.0}});
  CHECK(outcome.checks_held);
  for (const char* name : {"report.html", "report.pdf", "summary.json", "run.json"}) {
    CAPTURE(name);
    CHECK(std::filesystem::file_size(folder / name) > 0);
  }
}
