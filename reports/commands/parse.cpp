#include "reports/commands/parse.h"

// A comma belongs to the value: --set sweep.aspect_ratio=[1,2].
#define CXXOPTS_VECTOR_DELIMITER '\x1f'
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cxxopts.hpp>
#include <filesystem>

#include "engine/core/errors.h"
#include "engine/scenario/suggest.h"
#include "reports/commands/help_text.h"

namespace cli {
namespace {

using Texts = std::vector<std::string>;

/// The key under which cxxopts gathers what belongs to no option; the user cannot write it.
constexpr const char* loose_words = "WORDS";

[[noreturn]] void refuse(const std::string& what, const std::string& wrong, const std::string& right) {
  throw dem::InputError(dem::Location{}, what, wrong, right);
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The command at hand, and how the user called it.
struct Chosen {
  const Command& command;
  std::vector<Option> options;  ///< --help included
  bool by_name = false;         ///< else: the default verb

  [[nodiscard]] std::string program() const { return by_name ? "dem-report " + command.name : "dem-report"; }
  [[nodiscard]] std::string see_help() const { return "see " + program() + " --help"; }
  [[nodiscard]] const Option* find(const std::string& name) const {
    const auto at = std::ranges::find_if(options, [&](const Option& option) {
      return option.name == name || (option.letter != 0 && name == std::string(1, option.letter));
    });
    return at == options.end() ? nullptr : &*at;
  }
};

/// cxxopts stops at the first unknown option without advice, and takes an option for the value of another.
void check_options(const Chosen& chosen, const Texts& words) {
  Texts known;
  for (const Option& option : chosen.options) known.push_back("--" + option.name);
  for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
    const std::string& word = words[i];
    if (!word.starts_with('-') || word == "-") continue;
    const std::size_t equals = word.find('=');
    const bool is_long = word.starts_with("--");
    const std::string name = is_long ? word.substr(2, equals - std::min<std::size_t>(2, equals)) : word.substr(1, 1);
    const Option* option = is_long == (name.size() == 1) ? nullptr : chosen.find(name);
    if (!option) {
      const std::string near = dem::closest(word.substr(0, equals), known);
      refuse(word, "unknown option", near.empty() ? chosen.see_help() : "did you mean '" + near + "'?");
    }
    if (option->kind == OptionKind::flag) {
      if (equals != std::string::npos) refuse(word, "this option takes no value", "leave out what follows '='");
      continue;
    }
    const bool inside = equals != std::string::npos || (!is_long && word.size() > 2);
    if (inside) continue;
    if (i + 1 >= words.size() || (words[i + 1].starts_with("--") && !option->dashes)) {
      refuse(word, "the value is missing", chosen.see_help());
    }
    ++i;
  }
}

struct Split {
  Arguments::Named options;
  Texts words;  ///< that belong to no option
};

Split split(const Chosen& chosen, const Texts& words) {
  cxxopts::Options all("dem-report");
  auto add = all.add_options();
  for (const Option& option : chosen.options) {
    const std::string names = (option.letter != 0 ? std::string(1, option.letter) + "," : "") + option.name;
    if (option.kind == OptionKind::flag) {
      add(names, "");
    } else {
      add(names, "", cxxopts::value<Texts>());
    }
  }
  add(loose_words, "", cxxopts::value<Texts>());
  all.parse_positional({loose_words});
  std::vector<const char*> argv = {"dem-report"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  try {
    const cxxopts::ParseResult result = all.parse(static_cast<int>(argv.size()), argv.data());
    Split split;
    for (const Option& option : chosen.options) {
      if (result.count(option.name) == 0) continue;
      const bool flag = option.kind == OptionKind::flag;
      split.options.emplace(option.name, flag ? Texts{} : result[option.name].as<Texts>());
    }
    if (result.count(loose_words) > 0) split.words = result[loose_words].as<Texts>();
    return split;
  } catch (const cxxopts::exceptions::exception& error) {
    refuse({}, error.what(), chosen.see_help());
  }
}

/// "html, pdf or html,pdf"
std::string list_text(const Texts& choices) {
  std::string all;
  for (const std::string& choice : choices) all += (all.empty() ? "" : ",") + choice;
  return dem::joined(choices) + " or " + all;
}

void check_number(const Option& option, const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && number >= option.low && number <= option.high) return;
  refuse(
      "--" + option.name,
      "'" + text + "' is not a whole number from " + std::to_string(option.low) + " to " + std::to_string(option.high),
      "write, for example, --" + option.name + " " + std::to_string(std::max<std::uint64_t>(2, option.low)));
}

void check_value(const Option& option, const std::string& text) {
  const std::string name = "--" + option.name;
  const auto known = [&](const std::string& word) {
    return option.choices.empty() || std::ranges::find(option.choices, word) != option.choices.end();
  };
  switch (option.kind) {
    case OptionKind::flag:
      return;
    case OptionKind::text:
      if (known(text)) return;
      refuse(name, "unknown " + option.name + " '" + text + "'",
             dem::advice(text, option.choices, "the " + option.name + "s are"));
    case OptionKind::number:
      return check_number(option, text);
    case OptionKind::list:
      for (const std::string& part : parts_of(text)) {
        if (!known(part)) {
          refuse(name, "unknown " + option.name + " '" + part + "'", "write " + list_text(option.choices));
        }
      }
      return;
    case OptionKind::file:
    case OptionKind::folder: {
      if (!text.empty()) return;
      const std::string what = option.kind == OptionKind::file ? "file" : "folder";
      refuse(
          name, "the name of the " + what + " is empty",
          option.standard.empty() ? "name one, or leave the option out" : "leave it out for '" + option.standard + "'");
    }
  }
}

void check_values(const Chosen& chosen, const Arguments::Named& given) {
  for (const Option& option : chosen.options) {
    const auto at = given.find(option.name);
    if (at == given.end()) continue;
    for (const std::string& text : at->second) check_value(option, text);
  }
}

/// The words in the order of the positionals; each takes what it can and leaves what the later ones need.
Arguments::Named placed(const Chosen& chosen, const Texts& words) {
  const std::string right = "write " + chosen.program() + " " + positionals_text(chosen.command, true);
  Arguments::Named placed;
  std::size_t next = 0;
  std::size_t needed = 0;
  for (const Positional& positional : chosen.command.positionals) needed += positional.least;
  for (const Positional& positional : chosen.command.positionals) {
    needed -= positional.least;
    const std::size_t left = words.size() - next;
    const std::size_t takes = std::min(left > needed ? left - needed : 0, positional.most);
    if (takes < positional.least) {
      refuse({}, "no " + lower(positional.name) + " is given", right + ", or " + chosen.see_help());
    }
    Texts& taken = placed[positional.name];
    for (const std::size_t end = next + takes; next < end; ++next) {
      const std::string& word = words[next];
      const Texts& choices = positional.choices;
      if (!choices.empty() && std::ranges::find(choices, word) == choices.end()) {
        const std::string noun = lower(positional.name);
        refuse(word, "unknown " + noun, dem::advice(word, choices, "the " + noun + "s are"));
      }
      taken.push_back(word);
    }
  }
  if (next < words.size()) {
    const bool takes_none = chosen.command.positionals.empty();
    refuse(words[next], takes_none ? "this command takes no argument" : "one argument too many",
           takes_none ? "write " + chosen.program() : right);
  }
  return placed;
}

/// A first word that is no verb is a scenario. When there is no such file either, both may have been meant.
void check_first_word(std::span<const Command> commands, const std::string& word) {
  const bool like_a_verb =
      std::ranges::all_of(word, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
  std::error_code error;
  if (!like_a_verb || std::filesystem::exists(word, error)) return;
  if (find_command(commands, word)) {
    refuse(word, "there is no such scenario file, and a verb comes before its options",
           "write dem-report " + word + " ..., or give the path of a scenario file (.toml)");
  }
  Texts verbs;
  for (const Command& command : commands) verbs.push_back(command.name);
  const bool file_near = std::filesystem::exists(word + ".toml", error);
  refuse(word, "there is no such scenario file, and no such verb",
         (file_near ? "did you mean the file '" + word + ".toml'?"
                    : "to run a scenario give the path of its file (.toml);") +
             " " + dem::advice(word, verbs, "the verbs are"));
}

/// The command that a flag such as --help calls for in the place of its own; nullptr: none was given. Of several the
/// one that stands last in the declaration counts: --help, then --version.
const Option* detour(const Chosen& chosen, const Arguments::Named& given) {
  const auto last = std::ranges::find_if(chosen.options.rbegin(), chosen.options.rend(), [&](const Option& option) {
    return !option.verb.empty() && given.contains(option.name);
  });
  return last == chosen.options.rend() ? nullptr : &*last;
}

}  // namespace

const Command* find_command(std::span<const Command> commands, std::string_view name) {
  const auto at = std::ranges::find(commands, name, &Command::name);
  return at == commands.end() ? nullptr : &*at;
}

Call parse(std::span<const Command> commands, const Texts& words) {
  const Command* named = words.empty() ? nullptr : find_command(commands, words.front());
  Chosen chosen{named ? *named : commands.front(), {}, named != nullptr};
  chosen.options = chosen.command.options;
  chosen.options.push_back(help_option());
  const Texts rest(words.begin() + (named ? 1 : 0), words.end());

  check_options(chosen, rest);
  const Split given = split(chosen, rest);
  if (const Option* flag = detour(chosen, given.options)) {
    const Command* other = find_command(commands, flag->verb);
    if (!other) throw std::logic_error("--" + flag->name + " leads to no command");
    Arguments::Named about;
    if (named && flag->name == "help") about[other->positionals.front().name] = {named->name};
    return {other, Arguments(*other, {}, about)};
  }
  check_values(chosen, given.options);
  const bool files_by_will = std::ranges::find(rest, "--") != rest.end();
  if (!named && !files_by_will && !given.words.empty()) check_first_word(commands, given.words.front());
  return {&chosen.command, Arguments(chosen.command, given.options, placed(chosen, given.words))};
}

}  // namespace cli
