#include "reports/commands/reporter.h"

#include <fmt/format.h>

#include <iostream>

#include "engine/core/text.h"
#include "reports/cluster/estimate.h"
#include "reports/commands/machine.h"
#include "reports/output/report.h"

namespace cli {
namespace {

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

}  // namespace

bool Reporter::report(const dem::Study& study, const std::vector<dem::CaseOutcome>& outcomes,
                      const reports::Again& again) {
  reports::StudyResult result{.scenario = &study.scenario,
                              .cases = {},
                              .quantities = study.model->quantities(),
                              .parameters = study.model->parameters()};
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
  report.engine_version = DEM_VERSION;
  report.workers = options_.threads;
  report.pdf_seconds = options_.pdf_seconds;
  if (options_.stop) report.stopped = [stop = options_.stop] { return stop->load(); };
  const auto own_canvas = [&]() -> render::Canvas& {
    if (!canvas_) canvas_.emplace();
    return *canvas_;
  };
  const reports::ReportOutcome made =
      reports::make_report(result, report, own_canvas, run_facts(options_.threads, study, outcomes, options_.output));
  if (!options_.quiet) {
    for (const std::filesystem::path& file : made.files) std::cout << file.string() << "\n" << std::flush;
  }
  const bool met = made.published_all_met || !options_.strict;
  if (!met) std::cerr << "dem-report: a published number is missed (see the table in the report)\n";
  return all_well(outcomes) && met;
}

}  // namespace cli
