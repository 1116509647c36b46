// dem-report accept: the reports of today become what later ones are compared with.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <iostream>

#include "engine/core/errors.h"
#include "engine/model/model.h"
#include "engine/scenario/suggest.h"
#include "reports/commands/study_options.h"
#include "reports/commands/verbs.h"
#include "reports/comparison/folders.h"
#include "reports/comparison/reference.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// "ldb_minerals" or "ldb_minerals.smoke" -> its folder below `output`.
fs::path study_folder(const fs::path& output, const std::string& name) {
  if (comparison::is_report(output / name)) return output / name;
  std::vector<std::string> names, meant;
  for (const auto& [study, folder] : comparison::studies_in(output)) {
    names.push_back(study);
    if (study.substr(0, study.rfind('.')) == name) meant.push_back(study);
  }
  if (meant.size() == 1) return output / meant[0];
  if (meant.size() > 1) {
    throw dem::InputError({}, name, "it was reported at several scales", "name one of " + dem::joined(meant));
  }
  throw dem::InputError({}, name, "no report of that name lies in " + output.string(),
                        names.empty() ? "run it first" : dem::advice(name, names, "the studies are"));
}

int perform(const Arguments& arguments) {
  const fs::path output = arguments.text("output");
  const fs::path references = arguments.text("reference");
  comparison::Acceptance acceptance{arguments.texts("item"), arguments.text("reason"),
                                    fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))};
  if (acceptance.reason.find_first_not_of(" \t\n") == std::string::npos) {
    throw dem::InputError({}, "--reason", "no reason is given", "say why this is now right: --reason \"TEXT\"");
  }
  std::vector<fs::path> folders;
  for (const std::string& name : arguments.words("NAME")) folders.push_back(study_folder(output, name));
  if (arguments.has("all")) {
    if (!folders.empty()) throw dem::InputError({}, "--all", "does not go with names", "choose one of them");
    for (const auto& [name, folder] : comparison::studies_in(output)) folders.push_back(folder);
    if (folders.empty())
      throw dem::InputError({}, "--all", "no report lies in " + output.string(), "run scenarios first");
  }
  if (folders.empty()) throw dem::InputError("no study is named", "name one, or write --all");
  comparison::Options options{
      .models = dem::models(), .tolerances = comparison::read_tolerances(references), .threads = threads(arguments)};
  for (const fs::path& folder : folders) {
    const std::string name = folder.filename().string();
    try {
      const comparison::Accepted accepted = comparison::accept(folder, references, acceptance, options);
      if (arguments.has("quiet")) continue;
      const std::string what = accepted.is_new ? "first reference" : fmt::format("{} changes", accepted.changed.size());
      std::cout << fmt::format("{}: accepted, {}; {} kB", name, what, (accepted.bytes + 500) / 1000);
      if (accepted.without_picture > 0) {
        std::cout << fmt::format(", {} pictures as hashes alone", accepted.without_picture);
      }
      std::cout << "\n" << std::flush;
    } catch (const comparison::Unreadable& error) {
      throw dem::InputError({}, name, error.what(), "run it again, or name the whole study without --item");
    }
  }
  return 0;
}

}  // namespace

Command verbs::accept() {
  Option reference = reference_option();
  reference.standard = "references";
  Option output = output_option();
  output.help = "folder with the reports";
  return {
      .name = "accept",
      .summary = "make reports, or single items of them, the reference of later runs",
      .details =
          "Copies what a comparison needs, whole or not at all, and writes a line with the reason to "
          "DIR/accepted.jsonl.",
      .positionals = {{.name = "NAME",
                       .help = "studies: ldb_minerals, or ldb_minerals.smoke",
                       .least = 0,
                       .most = Positional::any_number}},
      .options = {{.name = "reason", .value = "TEXT", .help = "why this is right; required", .kind = OptionKind::text},
                  {.name = "all", .help = "all reports in the folder"},
                  {.name = "item",
                   .value = "ID",
                   .help = "only this item, as the comparison names it; * stands for anything: 'figures/crack_*'",
                   .kind = OptionKind::text,
                   .repeatable = true},
                  reference,
                  output,
                  threads_option(),
                  quiet_option()},
      .examples = {{"dem-report accept ldb_minerals --reason \"physics 7: friction after a break\"", "the whole study"},
                   {"dem-report accept ldb_minerals --item 'figures/*' --reason \"a wider legend\"",
                    "its figures, and nothing else"}},
      .exit_codes = usual_exit_codes(),
      .perform = perform};
}

}  // namespace cli
