#pragma once
// What a run of many studies leaves besides their reports: a page over all, files for a continuous integration, a line in
// the history; and what is known before it begins.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/core/errors.h"
#include "engine/study/study.h"
#include "reports/commands/arguments.h"
#include "reports/commands/option.h"

namespace cli {

struct NightRequest {
  std::filesystem::path reference;                 ///< --reference; empty: none
  std::filesystem::path junit, markdown, history;  ///< files; empty: none
  std::string label;                               ///< of the line in the history
};

std::vector<Option> night_options();
Option history_option();  ///< --history FILE
NightRequest night_request(const Arguments& arguments);

/// Writes what was asked for, of the studies in these folders below `output`; of several the index of the whole folder, too.
/// Throws dem::EnvironmentError.
void end_night(const NightRequest& request, const std::filesystem::path& output,
               const std::vector<std::string>& folders, bool strict);

/// "could not run" for the pages: run.json of the study says so.
void write_failure(const std::filesystem::path& folder, const std::string& error);

struct StudyPlan {
  std::vector<std::string> lines{};  ///< a case each: kept, or why it has to be simulated, and how long that may take
  std::size_t to_run = 0;
  double seconds = 0;  ///< wall time, with the report
};
/// From earlier runs. Writes nothing.
StudyPlan plan_of(const dem::Study& study, const dem::StudyOptions& options);

/// Prints what a run would do, on stdout.
void print_dry_run(std::span<const dem::Study> studies, const dem::StudyOptions& options);

/// On GitHub an annotation at the place of the error; elsewhere nothing.
void annotate(const dem::InputError& error);

}  // namespace cli
