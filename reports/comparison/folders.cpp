#include "reports/comparison/folders.h"

#include "engine/core/errors.h"
#include "reports/comparison/reference.h"

namespace comparison {
namespace {

namespace fs = std::filesystem;

bool is_study(const fs::path& folder) { return is_report(folder) || is_reference(folder); }

void check_folder(const fs::path& folder, const std::string& which) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw dem::InputError({}, which, "there is no folder " + folder.string(),
                          "give the folder of a report, or one with many");
  }
  if (!is_study(folder) && studies_in(folder).empty()) {
    throw dem::InputError({}, which, "no report and no reference lies in " + folder.string(),
                          "give a folder NAME.SCALE that a run has made, or the one that holds them");
  }
}

StudyComparison compare_two(const fs::path& was, const fs::path& is, const std::string& name, const Options& options) {
  std::string which = "old";
  try {
    const Snapshot before = read_either(was);
    which = "new";
    const Snapshot now = read_either(is);
    if (before.scale != now.scale) {
      return {.name = name, .problem = "the old one is of the scale " + before.scale + ", the new one of " + now.scale};
    }
    return compare(before, now, options);
  } catch (const Unreadable& error) {
    return {.name = name, .problem = "the " + which + " one cannot be read: " + error.what()};
  }
}

std::string name_of(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

std::map<std::string, fs::path> studies_in(const fs::path& folder) {
  std::map<std::string, fs::path> studies;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (is_study(at->path())) studies[at->path().filename().string()] = at->path();
  }
  return studies;
}

Comparison compare_folders(const fs::path& was, const fs::path& is, Options options) {
  check_folder(was, "OLD");
  check_folder(is, "NEW");
  options.tolerances = read_tolerances(is_study(was) ? was / ".." : was);
  if (is_study(was) && is_study(is)) return {{compare_two(was, is, name_of(is), options)}};
  const auto listed = [](const fs::path& folder) {
    return is_study(folder) ? std::map<std::string, fs::path>{{name_of(folder), folder}} : studies_in(folder);
  };
  const auto old_ones = listed(was), new_ones = listed(is);
  Comparison comparison;
  for (const auto& [name, folder] : new_ones) {
    if (const auto before = old_ones.find(name); before != old_ones.end()) {
      comparison.studies.push_back(compare_two(before->second, folder, name, options));
    } else if (!is_study(was)) {
      comparison.studies.push_back({.name = name, .is_new = true});
    }
  }
  for (const auto& [name, folder] : old_ones) {
    if (!new_ones.contains(name) && !is_study(is)) comparison.studies.push_back({.name = name, .is_gone = true});
  }
  if (comparison.studies.empty()) {
    throw dem::InputError({}, {}, "the two folders have no study in common", "compare two runs of the same scenarios");
  }
  return comparison;
}

StudyComparison compare_with_reference(const fs::path& folder, const fs::path& references, const std::string& page,
                                       Options options) {
  options.tolerances = read_tolerances(references);
  StudyComparison failed{.name = name_of(folder)};
  try {
    const Snapshot now = read_report(folder, page);
    failed.name = now.name();
    if (!is_reference(references / now.name())) {
      failed.is_new = true;
      return failed;
    }
    return compare(read_reference(references / now.name()), now, options);
  } catch (const Unreadable& error) {
    failed.problem = error.what();
    return failed;
  }
}

}  // namespace comparison
