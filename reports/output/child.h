#pragma once
// A program that works for this one: in a process group of its own, which ends with this process, with its time or when
// this process is asked to stop.
#include <functional>
#include <string>
#include <vector>

namespace reports {

struct ChildProgram {
  std::string path;                      ///< of the program; not looked up
  std::vector<std::string> words;        ///< after its name
  std::vector<std::string> environment;  ///< "NAME=VALUE"
  std::string folder;                    ///< that it runs in
  std::string log;                       ///< file for what it says, made anew
};

struct ChildEnd {
  int code = 0;       ///< exit code
  int signal = 0;     ///< that ended it; 0: none
  bool late = false;  ///< it was ended because its time was over
};

/// Runs the program, at most `seconds`. Throws dem::EnvironmentError when no process can be made, and dem::Interrupted when
/// `stopped` says so, or when somebody ended the program with SIGTERM, SIGINT or SIGHUP. No process of the group is left
/// then; this holds also when this process is killed.
ChildEnd run_child(const ChildProgram& program, double seconds, const std::function<bool()>& stopped);

/// fork(), in a way that no signal by which people end programs is lost on the child: until it has dropped this program's
/// answers to them, such a signal waits.
int fork_for_work();

/// dem::Interrupted for the signals by which people end programs; for others, and 0, nothing.
void throw_if_asked_to_end(int signal);

}  // namespace reports
