#pragma once
// Runs the program as a user does, from a folder of its own.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace test {

struct Outcome {
  int code = -1;    ///< exit code; 128 + N when a signal ended it
  std::string out;  ///< stdout
  std::string err;  ///< stderr
};

/// What to do with the running program, by its process id; returns when done.
using WhileRunning = std::function<void(int process)>;

/// Runs dem-report with `arguments` in `folder`.
Outcome run_program(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                    const WhileRunning& meanwhile = {});

/// Runs a script of sh in `folder`, with the program as "$PROGRAM".
Outcome run_shell(const std::filesystem::path& folder, const std::string& script);

/// The processes that `process` has started and that live.
std::vector<int> children_of(int process);

/// Waits until `holds` or so many seconds are over; what it said last.
bool wait_until(const std::function<bool()>& holds, double seconds);

}  // namespace test
