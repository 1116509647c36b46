// dem-report run-case: lines of a manifest, one after the other. It does not know where it runs.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iostream>

#include "engine/core/errors.h"
#include "engine/core/instruction_set.h"
#include "engine/core/text.h"
#include "reports/cluster/manifest.h"
#include "reports/cluster/packs.h"
#include "reports/commands/signals.h"
#include "reports/commands/study_options.h"
#include "reports/commands/terminal.h"
#include "reports/commands/verbs.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

struct Asked {
  fs::path output;
  int threads = 1;
  bool quiet = false;
};

std::size_t line_number(const std::string& word, std::size_t lines, const fs::path& file) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc() && end == word.data() + word.size() && number >= 1 && number <= lines) return number;
  throw dem::InputError(dem::Location{file.string(), 0, 0}, word, "the manifest has no such line",
                        lines == 0   ? "it is empty: everything was kept when it was made"
                        : lines == 1 ? "its only line is 1"
                                     : fmt::format("its lines are 1 to {}", lines));
}

/// Runs a case, or keeps it; false when it failed, which has been said then.
bool run_line(const cluster::Line& line, const Asked& asked) {
  const dem::Study study = cluster::study_of(line);
  dem::StudyOptions options;
  options.output = asked.output;
  options.threads = asked.threads;
  options.stop = &stop_asked();
  dem::ProgressPrinter progress = progress_printer(asked.quiet);
  progress.start(1);
  const auto outcomes = dem::run_study(study, options, progress_listener(progress));
  progress.clear();
  if (outcomes.front().state != dem::CaseState::failed) return true;
  std::cerr << "dem-report: case " << line.case_id << " failed: " << dem::printable(outcomes.front().error, true)
            << "\n";
  return false;
}

/// Only what the case shares with others. A specimen that cannot be made fails with its case, not here.
void make_specimens(const cluster::Line& line, const Asked& asked) {
  const dem::Study study = cluster::study_of(line);
  dem::StudyOptions options;
  options.output = asked.output;
  options.threads = asked.threads;
  options.stop = &stop_asked();
  dem::ProgressPrinter progress = progress_printer(asked.quiet);
  progress.start(1);
  try {
    dem::make_specimens(study, options, progress_listener(progress));
    progress.say(line.case_id + ": its specimen is there");
  } catch (const dem::CaseError& failure) {
    progress.say(line.case_id + ": no specimen: " + failure.what());
  }
}

int perform(const Arguments& arguments) {
  const Asked asked{output_folder(arguments.word("OUT")), threads(arguments), arguments.has("quiet")};
  const fs::path file =
      arguments.has("manifest") ? fs::path(arguments.text("manifest")) : asked.output / "manifest.jsonl";
  const cluster::Manifest manifest = cluster::read_manifest(file);
  cluster::Pack pack;
  if (arguments.has("pack")) {
    if (!arguments.words("LINE").empty()) {
      throw dem::InputError({}, "--pack", "does not go with lines", "choose one of them");
    }
    pack = cluster::read_pack(cluster::packs_file(file), arguments.number("pack"));
  } else {
    for (const std::string& word : arguments.words("LINE")) {
      pack.lines.push_back(line_number(word, manifest.size(), file));
    }
    pack.specimens_only = arguments.has("specimens-only");
    if (pack.lines.empty()) {
      throw dem::InputError({}, {}, "no line of the manifest is named", "write dem-report run-case OUT LINE...");
    }
  }
  (void)dem::instruction_sets();  // a wrong DEM_SIMD is found before anything runs
  listen_to_signals();
  bool well = true;
  try {
    for (const std::size_t number : pack.lines) {
      if (number < 1 || number > manifest.size()) line_number(std::to_string(number), manifest.size(), file);
      const cluster::Line& line = manifest[number - 1];
      if (pack.specimens_only) {
        make_specimens(line, asked);
      } else {
        well = run_line(line, asked) && well;
      }
    }
  } catch (const dem::Interrupted& interrupted) {
    std::cerr << "dem-report: stopped; "
              << (interrupted.kept > 0 ? "the state of the case is kept" : "what is finished is kept")
              << ": give the same command to go on\n";
    return exit_code_of_signal();
  }
  return well ? 0 : 1;
}

}  // namespace

Command verbs::run_case() {
  return {.name = "run-case",
          .summary = "run lines of a manifest that plan has written",
          .details =
              "A case that has its record by now is kept. Lines may be run in any order, twice, and several at a "
              "time, on any machine that sees the folder.",
          .positionals = {{.name = "OUT", .help = "the folder of the plan", .kind = OptionKind::folder},
                          {.name = "LINE",
                           .help = "numbers of lines of OUT/manifest.jsonl, from 1",
                           .least = 0,
                           .most = Positional::any_number}},
          .options = {threads_option(),
                      {.name = "specimens-only", .help = "make only the specimens that the cases need"},
                      {.name = "manifest",
                       .value = "FILE",
                       .help = "another manifest than OUT/manifest.jsonl",
                       .kind = OptionKind::file},
                      {.name = "pack",
                       .value = "N",
                       .help = "the lines of pack N, counted from 0, in packs.jsonl beside the manifest",
                       .kind = OptionKind::number},
                      quiet_option()},
          .examples = {{"dem-report run-case out 3", "run the third case of the plan"}},
          .exit_codes =
              [] {
                std::vector<ExitCode> codes = usual_exit_codes();
                codes.insert(codes.begin() + 1, {"1", "a case failed"});
                codes.push_back({"129, 130, 143", "stopped by a signal: the same command goes on where it stopped"});
                return codes;
              }(),
          .perform = perform};
}

}  // namespace cli
