// dem-report compare: what is different between two reports, or two folders of them.
#include <fmt/format.h>

#include <iostream>

#include "engine/core/files.h"
#include "engine/model/model.h"
#include "reports/commands/assets.h"
#include "reports/commands/study_options.h"
#include "reports/commands/verbs.h"
#include "reports/comparison/folders.h"

namespace cli {
namespace {

int perform(const Arguments& arguments) {
  const std::filesystem::path page = arguments.text("output");
  const std::filesystem::path assets = assets_folder();
  const comparison::Comparison found =
      comparison::compare_folders(arguments.word("OLD"), arguments.word("NEW"),
                                  {.models = dem::models(), .tolerances = {}, .threads = threads(arguments)});
  std::filesystem::path json = page;
  json.replace_extension(".json");
  dem::write_file(page, comparison::comparison_page(found, assets));
  dem::write_file(json, comparison::comparison_json(found));
  if (!arguments.has("quiet")) {
    for (const comparison::StudyComparison& study : found.studies) {
      std::cout << study.name << ": " << study.sentence() << "\n";
      for (const comparison::Cause& cause : study.causes) std::cout << "  why: " << cause.text << "\n";
    }
    std::cout << page.string() << "\n";
  }
  return found.well() ? 0 : 1;
}

}  // namespace

Command verbs::compare() {
  std::vector<ExitCode> codes = usual_exit_codes();
  codes[0].meaning = "nothing changed beyond tolerance";
  codes.insert(codes.begin() + 1, {"1", "something changed beyond tolerance, came or went"});
  return {
      .name = "compare",
      .summary = "show what is different between two reports, or two folders of them",
      .details =
          "Compares inputs key by key, every result, check and verdict, curves, pictures and the words of the report, "
          "and says what made a difference. Writes a page and, beside it, the same as JSON.",
      .positionals = {{.name = "OLD",
                       .help = "folder of a report or a reference, or one with many",
                       .kind = OptionKind::folder},
                      {.name = "NEW", .help = "the same, made later", .kind = OptionKind::folder}},
      .options = {{.name = "output",
                   .letter = 'o',
                   .value = "FILE",
                   .help = "the page to write",
                   .kind = OptionKind::file,
                   .standard = "comparison.html"},
                  threads_option(),
                  {.name = "quiet", .help = "print nothing but errors"}},
      .examples = {{"dem-report compare out.old out", "all studies that two runs have made"},
                   {"dem-report compare references/ldb_minerals.smoke out/ldb_minerals.smoke -o minerals.html",
                    "one study against its reference"}},
      .exit_codes = codes,
      .perform = perform};
}

}  // namespace cli
