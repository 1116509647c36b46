#pragma once
// A plan as files: what is to be run, for whoever runs it, and what is to be reported in the end.
//   OUT/manifest.jsonl  one line a case that is not kept; line I is what `run-case OUT I` runs
//   OUT/plan.json       what `collect OUT` reports
// Both are whole or not there. Names travel as JSON, so that blanks, quotes and $() mean nothing on their way.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/study/study.h"

namespace cluster {

/// How a study is read again, anywhere that sees the same files.
struct Source {
  std::string folder;    ///< that the command was given in, absolute
  std::string scenario;  ///< as given
  std::string scale;
  std::vector<std::string> overrides;  ///< "key=value"

  /// The scenario's path from wherever this process works.
  [[nodiscard]] std::string path() const;
};

/// A case to be run.
struct Line {
  Source source;
  std::string study;  ///< "NAME.SCALE"
  std::string case_id;
  std::string content;                 ///< SHA-256 of the case's content
  double seconds = 0;                  ///< estimated
  std::string seconds_from;            ///< Estimate::from
  std::uint64_t memory = 0;            ///< bytes, estimated
  int threads = 1;                     ///< that serve it
  std::vector<std::string> specimens;  ///< files in OUT/specimens that it shares with others of this manifest
};

using Manifest = std::vector<Line>;

/// The cases of `studies` whose record is not current in `output`; `sources` are theirs, one each. `only_case`: "" for all.
Manifest plan(const std::vector<dem::Study>& studies, const std::vector<Source>& sources,
              const std::filesystem::path& output, const std::string& only_case);

/// Throws dem::InputError for a text that JSON cannot carry (not UTF-8).
std::string to_text(const Manifest& manifest);
/// Throws dem::InputError naming `file` and the line.
Manifest manifest_of(const std::string& text, const std::string& file);

/// The manifest in a file; throws dem::InputError when there is none, or when it is broken.
Manifest read_manifest(const std::filesystem::path& file);

/// The study of a line with its case alone. Throws dem::InputError when the scenario cannot be read any more, or when the case
/// is another one by now: its content is not what was planned.
dem::Study study_of(const Line& line);

}  // namespace cluster
