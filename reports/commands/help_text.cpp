#include "reports/commands/help_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/scenario/suggest.h"

namespace cli {
namespace {

constexpr std::size_t columns = 80;

/// `text` after `head`, in lines that begin at column `indent`.
std::string hung(std::string head, std::size_t indent, std::string_view text) {
  std::string line = std::move(head);
  std::string all;
  if (line.size() + 2 > indent && line.find_first_not_of(' ') != std::string::npos) {
    all = line + "\n";
    line.clear();
  }
  line.resize(indent, ' ');
  bool empty = true;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t space = std::min(text.find(' ', from), text.size());
    const std::string_view word = text.substr(from, space - from);
    from = space + 1;
    if (!empty && line.size() + 1 + word.size() > columns) {
      all += line + "\n";
      line.assign(indent, ' ');
      empty = true;
    }
    line += (empty ? "" : " ") + std::string(word);
    empty = false;
  }
  return all + line + "\n";
}

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string table(const std::string& title, const Rows& rows) {
  if (rows.empty()) return {};
  constexpr std::size_t widest = 24;  // of the first column; a longer entry has a line of its own
  std::size_t indent = 0;
  for (const auto& [first, second] : rows) {
    if (first.size() + 4 <= widest) indent = std::max(indent, first.size() + 4);
  }
  std::string text = "\n" + title + ":\n";
  for (const auto& [first, second] : rows) text += hung("  " + first, std::max<std::size_t>(indent, 6), second);
  return text;
}

Rows option_rows(const Command& command) {
  Rows rows;
  for (const Option& option : options_of(command)) {
    const std::string letter = option.letter != 0 ? fmt::format("-{}, ", option.letter) : "    ";
    rows.emplace_back(letter + "--" + option.name + (option.value.empty() ? "" : " " + option.value),
                      option_text(option));
  }
  return rows;
}

std::string rest_of_help(const Command& command, const std::string& options_title) {
  Rows positionals, codes;
  for (const Positional& positional : command.positionals) {
    std::string help = positional.help;
    if (!positional.choices.empty()) help += " (" + one_of(positional.choices) + ")";
    positionals.emplace_back(positional.name, help);
  }
  for (const ExitCode& code : command.exit_codes) codes.emplace_back(code.code, code.meaning);
  std::string text = table("Arguments", positionals) + table(options_title, option_rows(command));
  if (!command.examples.empty()) text += "\nExamples:\n";
  for (const Example& example : command.examples) {
    text += "  " + example.command + "\n" + hung("", 6, example.says);
  }
  return text + table("Exit codes", codes);
}

std::string usage(const std::string& program, const Command& command) {
  const std::string words = positionals_text(command);
  return "  " + program + " [options]" + (words.empty() ? "" : " " + words) + "\n";
}

}  // namespace

std::vector<ExitCode> usual_exit_codes() {
  return {
      {"0", "all well"}, {"2", "wrong input or usage; nothing is written"}, {"3", "the machine or the program failed"}};
}

std::vector<Option> options_of(const Command& command) {
  std::vector<Option> options = command.options;
  options.push_back(help_option());
  return options;
}

std::string one_of(const std::vector<std::string>& choices) {
  if (choices.size() < 2) return dem::joined(choices);
  return dem::joined(std::span(choices).first(choices.size() - 1)) + " or " + choices.back();
}

std::string option_text(const Option& option) {
  std::string more;
  const auto add = [&](const std::string& part) { more += (more.empty() ? "" : "; ") + part; };
  if (option.kind == OptionKind::list) {
    add("one or more of " + dem::joined(option.choices) + ", with commas between them");
  } else if (!option.choices.empty()) {
    add(one_of(option.choices));
  }
  if (option.kind == OptionKind::number) {
    const bool open = option.high == std::numeric_limits<std::uint64_t>::max();
    add(open ? fmt::format("from {}", option.low) : fmt::format("{} to {}", option.low, option.high));
  }
  if (option.repeatable) add("may be repeated");
  if (!option.standard.empty()) add("default: " + option.standard);
  return option.help + (more.empty() ? "" : " (" + more + ")");
}

std::string sentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text + ".";
}

std::string_view program_summary() {
  return "dem-report simulates the cases of a scenario and makes an HTML and a PDF report of them.";
}

std::string positionals_text(const Command& command, bool endings) {
  std::string text;
  for (const Positional& positional : command.positionals) {
    std::string word = positional.name;
    if (endings) {
      word += positional.ending;
    } else if (positional.most > 1) {
      word += "...";
    }
    if (positional.least == 0) word = fmt::format("[{}]", word);
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

std::string program_help(std::span<const Command> commands) {
  const Command& first = commands.front();
  Rows verbs;
  for (const Command& command : commands) {
    verbs.emplace_back(command.name,
                       command.summary + (&command == &first ? "; this is done when no verb is given" : ""));
  }
  return hung("", 0, program_summary()) + "\nUsage:\n" + usage("dem-report", first) +
         "  dem-report VERB [options] [arguments]\n" + table("Verbs (dem-report VERB --help says more)", verbs) +
         rest_of_help(first, "Options of " + first.name);
}

std::string command_help(const Command& command) {
  std::string text = hung("", 0, sentence(command.summary));
  if (!command.details.empty()) text += "\n" + hung("", 0, command.details);
  return text + "\nUsage:\n" + usage("dem-report " + command.name, command) + rest_of_help(command, "Options");
}

}  // namespace cli
