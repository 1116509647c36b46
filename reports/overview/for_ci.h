#pragma once
// What a continuous integration reads: JUnit XML and a summary in Markdown.
#include <string>
#include <vector>

#include "reports/overview/study_row.h"

namespace overview {

/// A test suite for each study; a test case for the study, each case (with its time), each check, each item that was compared
/// with the reference, and each published number. A number that is missed is a failure only when `strict`; its text stands
/// in system-out. In the form that Jenkins reads (junit-10.xsd).
std::string junit(const std::vector<StudyRow>& rows, bool strict);

/// For the page of a job or a merge request: below 60 000 bytes, whatever was run.
std::string markdown(const std::vector<StudyRow>& rows);

/// "::error file=a.toml,line=3,col=1::what is wrong": an annotation of GitHub. `file` may be empty, `line` 0.
std::string github_annotation(const std::string& file, int line, int column, const std::string& message);

}  // namespace overview
