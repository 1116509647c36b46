#include "reports/output/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "engine/core/files.h"
#include "engine/model/model.h"
#include "reports/output/crate.h"
#include "reports/output/drawing.h"
#include "reports/output/pdf.h"
#include "reports/output/summary.h"
#include "reports/page/page.h"
#include "reports/published/laboratory.h"
#include "reports/published/papers.h"
#include "reports/published/published.h"
#include "reports/published/standing.h"
#include "reports/text.h"

namespace reports {
namespace {

bool all_held(const StudyResult& study) {
  return std::ranges::all_of(study.cases, [](const CaseResult& result) {
    return result.record && std::ranges::all_of(result.record->checks, &dem::Check::held);
  });
}

}  // namespace

ReportOutcome make_report(StudyResult study, const ReportOptions& options, const CanvasSource& canvas,
                          const RunFacts& run) {
  const auto start = std::chrono::steady_clock::now();
  const std::string earlier = take_crate(options.folder);
  study.of_a_paper = of_a_paper(*study.scenario, options.assets / "papers");
  study.published = published_numbers(study, options.assets / "papers");
  study.laboratory = laboratory_numbers(study);
  const auto chosen = chosen_figures(study, options.only);
  const Comparisons comparisons = compare(study, options.assets / "papers");
  Drawings drawings = draw_figures(study, chosen, options, canvas);
  for (DrawnFigure& figure : drawings.figures) set_standing(figure, comparisons, study.scenario->scale());
  const std::vector<DrawnFigure>& drawn = drawings.figures;

  ReportOutcome outcome;
  outcome.checks_held = all_held(study);
  outcome.verdicts = comparisons.tally();
  if (!comparisons.rows.empty()) outcome.verdicts_text = tally_text(outcome.verdicts, comparisons.scale);
  const auto written = [&](const char* name, const auto& write) {
    if (options.stopped()) throw dem::Interrupted{};
    const std::filesystem::path path = options.folder / name;
    write(path);
    outcome.files.push_back(path);
  };
  written("summary.json", [&](const auto& path) {
    dem::write_file(path, summary_json(study, comparisons, drawn, options.engine_version));
  });
  ReportOptions shown = options;
  if (options.compare_with_reference) {
    shown.since_reference = options.compare_with_reference(page(study, comparisons, drawn, options, Images::embedded));
  }
  if (options.html || options.pdf) {
    if (options.html) {
      const std::string html = page(study, comparisons, drawn, shown, Images::embedded);
      written("report.html", [&](const auto& path) { dem::write_file(path, html); });
    }
    if (options.pdf) {
      const std::string html = page(study, comparisons, drawn, shown, Images::linked);
      written("report.pdf", [&](const auto& path) {
        print_pdf(html, options.assets / "page" / "print.css", path, {options.pdf_seconds, options.stopped});
      });
    }
  }
  RunFacts facts = run;
  facts.emplace_back("gl_renderer", drawings.gl_renderer);
  facts.emplace_back("report_seconds", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  dem::write_file(options.folder / "run.json", run_json(facts));
  if (options.date) write_crate(study, drawn, options, earlier, options.date());
  return outcome;
}

std::string list_figures() {
  std::string text;
  std::string_view model;
  for (const Figure& figure : figures()) {
    if (figure.model != model) text += fmt::format("{}{}:\n", text.empty() ? "" : "\n", words(figure.model));
    model = figure.model;
    text += fmt::format("  {:<24} {:<34} {}\n", figure.id, figure.source, figure.title);
  }
  return text;
}

}  // namespace reports
