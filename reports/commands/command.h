#pragma once
// A command of the program ("dem-report VERB ..."), declared once: what it takes, what it is for, what performs it.
// A new command is one file that returns its Command, one line in verbs.h and one in table.cpp.
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "reports/commands/arguments.h"
#include "reports/commands/option.h"

namespace cli {

/// What stands on the command line without an option before it.
struct Positional {
  static constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

  std::string name;         ///< "SCENARIO"
  std::string help = {};    ///< one line
  std::string ending = {};  ///< of the files that are meant: ".toml"; "": any
  std::size_t least = 1;    ///< how many must be there
  std::size_t most = 1;
  std::vector<std::string> choices = {};  ///< the allowed words; empty: any
  OptionKind kind = OptionKind::text;     ///< file or folder: a shell completes those
  bool verbs = false;                     ///< it names a verb
};

struct Example {
  std::string command;  ///< "dem-report scenarios/my_rock.toml"
  std::string says;     ///< what it does
};

struct ExitCode {
  std::string code;  ///< "0", "130, 143"
  std::string meaning;
};

struct Command {
  std::string name;     ///< the verb: small letters and hyphens
  std::string summary;  ///< one line, in the imperative: "list the figures ..."
  std::string details = {};
  std::vector<Positional> positionals = {};  ///< only the last one may take any number
  std::vector<Option> options = {};          ///< --help is added to all
  std::vector<Example> examples = {};
  std::vector<ExitCode> exit_codes = {};
  /// Does it and returns the exit code. Throws as main.cpp expects: dem::InputError for what the user can put right,
  /// before anything is written; dem::EnvironmentError for what the machine is to blame for.
  int (*perform)(const Arguments&) = nullptr;
};

/// The exit codes that every command has: 0, 2 and 3.
std::vector<ExitCode> usual_exit_codes();

}  // namespace cli
