#pragma once
// An option of a command, declared once. Parsing, error messages and help all read this declaration.
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace cli {

enum class OptionKind {
  flag,    ///< given or not; takes no value
  text,    ///< any text, or one of `choices`
  number,  ///< a whole number from `low` to `high`
  list,    ///< one or more of `choices`, separated by commas
  file,    ///< path of a file
  folder,  ///< path of a folder; not empty
};

struct Option {
  std::string name;        ///< "output", given as --output
  char letter = 0;         ///< 'o', given as -o; 0: none
  std::string value = {};  ///< what stands for the value in help: "DIR"; "" for flags
  std::string help = {};   ///< one line, without the default and the choices: those are added
  OptionKind kind = OptionKind::flag;
  std::string standard = {};              ///< the value when it is not given, as it would be written; "": none
  bool repeatable = false;                ///< all values count; of other options the last one does
  bool dashes = false;                    ///< its value may begin with --, as options of another program do
  std::vector<std::string> choices = {};  ///< for text and list: the allowed words; empty: any
  std::uint64_t low = 0;                  ///< for numbers, inclusive
  std::uint64_t high = std::numeric_limits<std::uint64_t>::max();
  std::string verb = {};  ///< for flags: performs this command in the place of its own
};

/// --help, which every command has.
inline Option help_option() { return {.name = "help", .letter = 'h', .help = "print this help", .verb = "help"}; }

}  // namespace cli
