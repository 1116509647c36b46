#include "reports/commands/shells.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "reports/commands/help_text.h"

namespace cli {
namespace {

using Texts = std::vector<std::string>;

std::string spaced(const Texts& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
  return all;
}

/// In single quotes of a shell: `quote` is how it writes one inside.
std::string quoted(const std::string& text, std::string_view quote) {
  std::string all;
  for (const char c : text) c == '\'' ? all += quote : all += c;
  return "'" + all + "'";
}

Texts names_of(const Option& option) {
  Texts names;
  if (option.letter != 0) names.push_back(std::string("-") + option.letter);
  names.push_back("--" + option.name);
  return names;
}

bool takes_value(const Option& option) { return option.kind != OptionKind::flag; }

Texts verb_names(std::span<const Command> commands) {
  Texts names;
  for (const Command& command : commands) names.push_back(command.name);
  return names;
}

/// The words that an operand may be: declared ones, or the verbs.
Texts words_of(const Positional& positional, std::span<const Command> commands) {
  return positional.verbs ? verb_names(commands) : positional.choices;
}

// --- bash: one function that looks at the words so far. It needs nothing of the package bash-completion. ---

constexpr std::string_view bash_head = R"sh(# Completion of dem-report in bash, made by: dem-report completion bash

_dem_report_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }

# One or more of the words, with commas between them.
_dem_report_list() {
  local before=
  [[ $cur == *,* ]] && before=${cur%,*},
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${cur##*,}")
}

# Files whose names end so, and folders.
_dem_report_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <({ compgen -f -X "!*$1" -- "$cur"; compgen -d -- "$cur"; } | sort -u)
}

_dem_report_folders() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$cur")
}

_dem_report() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}
  local first=1 verb options valued ended= count=0 i
  COMPREPLY=()
  # "=" is a word of its own here.
  if [[ $cur == '=' ]]; then
    cur=
  elif [[ $prev == '=' ]]; then
    prev=${COMP_WORDS[COMP_CWORD - 2]}
  fi
)sh";

constexpr std::string_view bash_count = R"sh(  # How many operands there are, and whether "--" has ended the options.
  for ((i = first; i < COMP_CWORD; i++)); do
    if [[ $ended ]]; then
      ((count++))
    elif [[ ${COMP_WORDS[i]} == -- ]]; then
      ended=1
    elif [[ " $valued " == *" ${COMP_WORDS[i]} "* ]]; then
      [[ ${COMP_WORDS[i + 1]} == '=' ]] && ((i++))
      ((i++))
    elif [[ ${COMP_WORDS[i]} != -* ]]; then
      ((count++))
    fi
  done
)sh";

std::string bash_files(OptionKind kind, const std::string& ending = {}) {
  if (kind == OptionKind::folder) return "_dem_report_folders";
  return kind == OptionKind::file ? "_dem_report_files '" + ending + "'" : "";
}

std::string bash_value(const Option& option) {
  if (option.choices.empty()) return bash_files(option.kind);
  const std::string words = " '" + spaced(option.choices) + "'";
  return (option.kind == OptionKind::list ? "_dem_report_list" : "_dem_report_words") + words;
}

std::string bash(std::span<const Command> commands) {
  const std::string& first = commands.front().name;
  std::string verbs, options, values, operands;
  for (const Command& command : commands) {
    verbs += (verbs.empty() ? "" : " | ") + command.name;
    Texts names, valued;
    for (const Option& option : options_of(command)) {
      const Texts spelt = names_of(option);
      names.insert(names.end(), spelt.begin(), spelt.end());
      if (!takes_value(option)) continue;
      valued.insert(valued.end(), spelt.begin(), spelt.end());
      std::string pattern;
      for (const std::string& name : spelt) pattern += (pattern.empty() ? "" : " | ") + command.name + ":" + name;
      const std::string value = bash_value(option);
      values += fmt::format("      {}) {}return ;;\n", pattern, value.empty() ? "" : value + " && ");
    }
    options +=
        fmt::format("    {})\n      options='{}'\n      valued='{}' ;;\n", command.name, spaced(names), spaced(valued));
    std::size_t place = 0;
    for (const Positional& one : command.positionals) {
      const Texts words = words_of(one, commands);
      const std::string what =
          words.empty() ? bash_files(one.kind, one.ending) : "_dem_report_words '" + spaced(words) + "'";
      const std::string at = one.most == Positional::any_number ? "*" : std::to_string(place);
      operands += fmt::format("    {}:{}) {}{};;\n", command.name, at, what, what.empty() ? "" : " ");
      place += one.most == Positional::any_number ? 0 : one.most;
    }
  }
  std::string all(bash_head);
  all += fmt::format(
      "  verb={}\n  if ((COMP_CWORD > 1)); then\n    case ${{COMP_WORDS[1]}} in\n      {})\n"
      "        verb=${{COMP_WORDS[1]}}\n        first=2 ;;\n    esac\n  fi\n",
      first, verbs);
  all += "  case $verb in\n" + options + "  esac\n" + std::string(bash_count);
  all += "  if [[ -z $ended ]]; then\n    case $verb:$prev in\n" + values + "    esac\n" +
         "    if [[ $cur == -* ]]; then\n      _dem_report_words \"$options\"\n      return\n    fi\n  fi\n";
  all += "  case $verb:$count in\n" + operands + "  esac\n";
  all += fmt::format(
      "  if ((COMP_CWORD == 1)); then\n    mapfile -t -O ${{#COMPREPLY[@]}} COMPREPLY < <(compgen -W '{}' -- "
      "\"$cur\")\n"
      "  fi\n}}\n\ncomplete -F _dem_report dem-report\n",
      spaced(verb_names(commands)));
  return all;
}

// --- zsh: _arguments for each verb. ---

std::string zsh_quoted(const std::string& text) { return quoted(text, "'\\''"); }

/// Inside of a specification of _arguments.
std::string zsh_text(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') all += '\\';
    all += c;
  }
  return all;
}

std::string zsh_files(OptionKind kind, const std::string& ending = {}) {
  if (kind == OptionKind::folder) return "_files -/";
  if (kind != OptionKind::file) return " ";
  return ending.empty() ? "_files" : "_files -g \"*" + ending + "\"";
}

std::string zsh_value(const Option& option) {
  if (!takes_value(option)) return {};
  std::string what = zsh_files(option.kind);
  if (!option.choices.empty()) {
    what = option.kind == OptionKind::list ? "_values -s , " + option.name + " " + spaced(option.choices)
                                           : "(" + spaced(option.choices) + ")";
  }
  return ":" + zsh_text(option.value) + ":" + what;
}

std::string zsh_option(const Option& option) {
  const Texts names = names_of(option);
  const std::string tail = zsh_quoted("[" + zsh_text(option_text(option)) + "]" + zsh_value(option));
  const char* const equals = takes_value(option) ? "=" : "";
  if (names.size() == 1) return (option.repeatable ? "'*'" : "") + names[0] + equals + tail;
  const char* const joined = takes_value(option) ? "+" : "";
  const std::string others = option.repeatable ? "'*'" : zsh_quoted("(" + spaced(names) + ")");
  return others + "{" + names[0] + joined + "," + names[1] + equals + "}" + tail;
}

std::string zsh_operands(const Command& command, std::span<const Command> commands) {
  std::string all;
  std::size_t place = 1;
  for (const Positional& one : command.positionals) {
    const Texts words = words_of(one, commands);
    const std::string what = words.empty() ? zsh_files(one.kind, one.ending) : "(" + spaced(words) + ")";
    const std::string at = one.most == Positional::any_number ? "*" : std::to_string(place++);
    all += " \\\n        " + zsh_quoted(at + ":" + zsh_text(one.name) + ":" + what);
  }
  return all;
}

std::string zsh(std::span<const Command> commands) {
  const Command& first = commands.front();
  std::string described, pattern, cases;
  for (const Command& command : commands) {
    described += "    " + zsh_quoted(command.name + ":" + command.summary) + "\n";
    pattern += (pattern.empty() ? "" : "|") + command.name;
    std::string options;
    for (const Option& option : options_of(command)) options += " \\\n        " + zsh_option(option);
    cases += fmt::format("    {})\n      _arguments -s -S : {}{}{} && ret=0 ;;\n", command.name,
                         &command == &first ? "$opening" : "", options, zsh_operands(command, commands));
  }
  return fmt::format(
      R"sh(#compdef dem-report
# Completion of dem-report in zsh, made by: dem-report completion zsh

_dem_report_verbs() {{
  local -a verbs=(
{}  )
  _describe -t verbs verb verbs
}}

# The first word is a verb or a scenario.
_dem_report_opening() {{
  _alternative 'verbs:verb:_dem_report_verbs' {}
}}

_dem_report() {{
  local verb={} ret=1
  local -a opening=('1: :_dem_report_opening')
  if ((CURRENT > 2)) && [[ $words[2] == ({}) ]]; then
    verb=$words[2] opening=()
    shift words
    ((CURRENT--))
  fi
  case $verb in
{}  esac
  return ret
}}

if [[ $funcstack[1] == _dem-report ]]; then
  _dem_report "$@"
else
  compdef _dem_report dem-report
fi
)sh",
      described,
      zsh_quoted("scenarios:scenario:" + zsh_files(first.positionals.front().kind, first.positionals.front().ending)),
      first.name, pattern, cases);
}

// --- fish: a line for each thing that may be written, with the condition under which it may. ---

std::string fish_quoted(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (c == '\'' || c == '\\') all += '\\';
    all += c;
  }
  return "'" + all + "'";
}

std::string fish_value(const Option& option) {
  if (!takes_value(option)) return {};
  if (option.kind == OptionKind::list) return " -x -a '(__fish_append , " + spaced(option.choices) + ")'";
  if (!option.choices.empty()) return " -x -a '" + spaced(option.choices) + "'";
  if (option.kind == OptionKind::folder) return " -x -a '(__fish_complete_directories)'";
  return option.kind == OptionKind::file ? " -r -F" : " -x";
}

std::string fish_operand(const Positional& positional, std::span<const Command> commands) {
  const Texts words = words_of(positional, commands);
  if (!words.empty()) return " -a '" + spaced(words) + "'";
  if (positional.kind == OptionKind::folder) return " -a '(__fish_complete_directories)'";
  if (positional.kind != OptionKind::file) return {};
  return positional.ending.empty() ? " -F" : " -k -a '(__dem_report_files " + positional.ending + ")'";
}

std::string fish(std::span<const Command> commands) {
  const std::string names = spaced(verb_names(commands));
  std::string all = fmt::format(R"sh(# Completion of dem-report in fish, made by: dem-report completion fish

function __dem_report_is -d 'whether this verb is at hand'
    set -l words (commandline -opc)
    set -l verb {}
    if set -q words[2]; and contains -- $words[2] {}
        set verb $words[2]
    end
    test $verb = $argv[1]
end

function __dem_report_first -d 'whether nothing is written yet'
    set -l words (commandline -opc)
    test (count $words) -eq 1
end

function __dem_report_files -d 'files whose names end so, and folders'
    set -l ending (string escape --style=regex -- $argv[1])
    __fish_complete_path (commandline -ct) | string match -r '^[^\t]*(?:/|'$ending')(?:\t.*)?$'
end

complete -c dem-report -f
)sh",
                                commands.front().name, names);
  for (const Command& command : commands) {
    all += fmt::format("complete -c dem-report -n __dem_report_first -a {} -d {}\n", command.name,
                       fish_quoted(command.summary));
  }
  for (const Command& command : commands) {
    const std::string when = "complete -c dem-report -n '__dem_report_is " + command.name + "'";
    all += "\n";
    for (const Positional& one : command.positionals) {
      if (const std::string what = fish_operand(one, commands); !what.empty()) all += when + what + "\n";
    }
    for (const Option& option : options_of(command)) {
      all += when + (option.letter != 0 ? fmt::format(" -s {}", option.letter) : "") + " -l " + option.name +
             fish_value(option) + " -d " + fish_quoted(option_text(option)) + "\n";
    }
  }
  return all;
}

}  // namespace

std::vector<std::string> shells() { return {"bash", "zsh", "fish"}; }

std::string completion(std::string_view shell, std::span<const Command> commands) {
  if (shell == "bash") return bash(commands);
  if (shell == "zsh") return zsh(commands);
  if (shell == "fish") return fish(commands);
  throw std::logic_error("no completion for " + std::string(shell));
}

}  // namespace cli
