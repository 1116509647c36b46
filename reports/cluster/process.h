#pragma once
// Other programs, started by their words: no shell in between, so that nothing in a name means anything.
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace cluster {

struct Said {
  int code = 0;     ///< exit code; 127: there is no such program; 128 + N: a signal ended it
  std::string out;  ///< stdout
  std::string err;  ///< stderr
};

/// Runs `words`, the first of them looked up in PATH, to its end: in a process group of its own, so that Ctrl-C here does not cut
/// it off half done. When `stopped` says so it is ended, and counts as ended by a signal. Throws dem::EnvironmentError when no
/// process can be made.
Said run_words(
    const std::vector<std::string>& words, const std::function<bool()>& stopped = [] { return false; });

/// "--account=a 'two words' b\"c d\"" as a shell would take it apart, but for $, `, * and their like, which are letters here.
/// Throws dem::InputError about `option` when a quote is not closed.
std::vector<std::string> split_words(std::string_view text, const std::string& option);

}  // namespace cluster
