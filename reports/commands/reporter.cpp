#include "reports/commands/reporter.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string_view>

#include "engine/core/files.h"
#include "engine/core/text.h"
#include "reports/cluster/estimate.h"
#include "reports/commands/machine.h"
#include "reports/commands/terminal.h"
#include "reports/comparison/folders.h"
#include "reports/output/report.h"
#include "reports/overview/study_row.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// With the seconds of each case, also of those that an earlier run has made, here or on another machine.
reports::RunFacts run_facts(int threads, const dem::Study& study, const std::vector<dem::CaseOutcome>& outcomes,
                            const std::filesystem::path& output) {
  reports::RunFacts facts = {{"host", host_name()},
                             {"threads", static_cast<double>(threads)},
                             {"compiler", std::string("g++ ") + __VERSION__},
                             {"engine_version", std::string(DEM_VERSION)}};
  for (const dem::CaseOutcome& outcome : outcomes) {
    double seconds = outcome.seconds;
    if (seconds <= 0 && outcome.record) {
      const auto earlier = cluster::earlier_run(dem::case_folder(output, study, outcome.id));
      if (earlier) seconds = earlier->seconds;
    }
    if (seconds > 0) facts.emplace_back("case_seconds." + outcome.id, seconds);
  }
  return facts;
}

/// True when every case that was asked for has a record and every check holds; else says what does not.
bool all_well(const std::vector<dem::CaseOutcome>& outcomes) {
  bool well = true;
  for (const dem::CaseOutcome& outcome : outcomes) {
    if (outcome.state == dem::CaseState::failed || outcome.state == dem::CaseState::missing) {
      std::cerr << "dem-report: case " << outcome.id << " failed: " << dem::printable(outcome.error, true) << "\n";
      well = false;
    }
    if (!outcome.record) continue;
    for (const dem::Check& check : outcome.record->checks) {
      if (check.held) continue;
      std::cerr << fmt::format("dem-report: case {}: the check {} does not hold: {:.4g}, limit {:.4g}\n", outcome.id,
                               check.id, check.value, check.limit);
      well = false;
    }
  }
  return well;
}

/// Now, or the moment that SOURCE_DATE_EPOCH stands for, as in the PDF.
std::string date_of_report() {
  constexpr std::time_t last = 253402300799;  // of the year 9999
  std::time_t seconds = std::time(nullptr);
  if (const char* asked = std::getenv("SOURCE_DATE_EPOCH")) {
    const std::string_view text(asked);
    std::time_t there = -1;  // check_printing() refuses what is no moment; without a PDF nobody looks
    std::from_chars(text.data(), text.data() + text.size(), there);
    if (there >= 0 && there <= last) seconds = there;
  }
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}+00:00", fmt::gmtime(seconds));
}

/// What a person opens: the page, else the PDF.
fs::path shown_file(const std::vector<fs::path>& files) {
  const auto page = std::ranges::find_if(files, [](const fs::path& file) { return file.extension() == ".html"; });
  return page == files.end() ? files.back() : *page;
}

}  // namespace

bool Reporter::report(const dem::Study& study, const std::vector<dem::CaseOutcome>& outcomes,
                      const reports::Again& again, const reports::Again& installed) {
  reports::StudyResult result{.scenario = &study.scenario,
                              .cases = {},
                              .quantities = study.model->quantities(),
                              .parameters = study.model->parameters()};
  if (study.model->measurables) result.measurables = study.model->measurables();
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const dem::CaseOutcome& outcome = outcomes[i];
    result.cases.push_back(
        {outcome.id, study.cases[i].parameters, outcome.record ? &*outcome.record : nullptr, outcome.error});
  }
  reports::ReportOptions report;
  report.folder = options_.output / study.folder() / options_.part;
  report.assets = options_.assets;
  report.html = options_.html;
  report.pdf = options_.pdf;
  report.only = options_.figure;
  report.again = again;
  report.again_installed = installed;
  report.date = date_of_report;
  report.engine_version = DEM_VERSION;
  report.dpi = options_.dpi;
  report.workers = options_.threads;
  report.pdf_seconds = options_.pdf_seconds;
  if (options_.stop) report.stopped = [stop = options_.stop] { return stop->load(); };
  report.drawing = options_.drawing;
  const fs::path page = report.folder / "comparison.html", json = report.folder / "comparison.json";
  std::optional<comparison::StudyComparison> since;
  if (options_.reference.empty()) {
    std::error_code ignored;  // of an earlier run
    fs::remove(page, ignored);
    fs::remove(json, ignored);
  } else {
    report.compare_with_reference = [&](const std::string& words) {
      since =
          comparison::compare_with_reference(report.folder, options_.reference, words,
                                             {.models = dem::models(), .tolerances = {}, .threads = options_.threads});
      dem::write_file(page, comparison::comparison_page({{*since}}, options_.assets));
      dem::write_file(json, comparison::comparison_json({{*since}}));
      return reports::SinceReference{comparison::since_section(*since, page.filename().string(), options_.assets),
                                     comparison::since_section(*since, {}, options_.assets)};
    };
  }
  const auto own_canvas = [&]() -> render::Canvas& {
    if (!canvas_) canvas_.emplace();
    return *canvas_;
  };
  const reports::ReportOutcome made =
      reports::make_report(result, report, own_canvas, run_facts(options_.threads, study, outcomes, options_.output));
  options_.before_words();
  const bool changed = since && !since->well();
  if (!options_.quiet) {
    const overview::StudyRow row = overview::read_row(report.folder, false);
    const bool bad = row.state() != "well" && coloured(STDOUT_FILENO);
    std::cout << (bad ? "\033[31m" : "")
              << dem::printable(study.scenario.name() + " " + study.scenario.scale() + ": " + row.verdict())
              << (bad ? "\033[0m" : "") << "; " << shown_file(made.files).string() << "\n"
              << std::flush;
  }
  if (changed) std::cerr << "dem-report: " << study.folder() << ": " << since->sentence() << " since the reference\n";
  const bool met = made.verdicts.missed == 0 || !options_.strict;
  if (!met) std::cerr << "dem-report: a published number is missed (see the table in the report)\n";
  return all_well(outcomes) && met && !changed;
}

}  // namespace cli
