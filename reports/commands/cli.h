#pragma once
// The command line of dem-report.
#include <filesystem>
#include <string>
#include <vector>

namespace cli {

enum class Action { run, help, version, list_figures, explain_keys };

struct CommandLine {
  Action action = Action::run;
  std::vector<std::string> scenarios;
  std::filesystem::path output = "out";
  std::string scale = "draft";
  int threads = 1;                     ///< default: those of the machine
  std::vector<std::string> overrides;  ///< of --set, then --seed, as "key=value"
  std::string figure;                  ///< --only; "": all
  std::string only_case;               ///< --case; "": all
  bool report_only = false;
  bool force = false;
  bool html = true;
  bool pdf = true;
  bool quiet = false;
  bool strict = false;
};

/// Throws dem::InputError that says what would be right. `arguments` without the program's name.
CommandLine parse(const std::vector<std::string>& arguments);

std::string help();

/// How to make a report again: the options that shape it, without folders of this machine.
std::string command_text(const CommandLine& line, const std::string& scenario);

}  // namespace cli
