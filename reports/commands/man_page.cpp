#include "reports/commands/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "engine/core/text.h"
#include "reports/commands/help_text.h"

namespace cli {
namespace {

struct Entry {
  const char* name;
  const char* says;
};

constexpr std::array variables{
    Entry{"DEM_REPORT_ASSETS",
          "the folder with the page template and the published numbers, in the place of the one "
          "that is found from where the program lies"},
    Entry{"DEM_SIMD", "sse2, avx2 or avx512: leaves the solvers one instruction set; the results are the same bits"},
    Entry{"SOURCE_DATE_EPOCH", "seconds since 1970: the date in the PDF and in ro-crate-metadata.json"},
    Entry{"NO_COLOR, TERM", "with NO_COLOR set, or TERM=dumb, nothing is coloured"},
    Entry{"GITHUB_ACTIONS", "true: an error in a scenario is also an annotation at its file and line"},
};

constexpr std::array files{
    Entry{"out/NAME.SCALE/",
          "a study: report.html, report.pdf, summary.json, run.json, ro-crate-metadata.json, "
          "figures/, data/, inputs/, cases/"},
    Entry{"out/specimens/", "packings, shared by all studies of the folder"},
    Entry{"/usr/share/dem-report/scenarios/", "the scenarios that come with the program, with their rocks"},
    Entry{"/usr/share/dem-report/assets/", "page templates, published numbers, JSON schemas of the files it writes"},
    Entry{"/usr/share/doc/dem-report/use/", "how to read a report, to compare reports, to run studies every night"},
};

/// Text as roff takes it: what it would obey or draw otherwise is written out.
std::string roff(std::string_view text) {
  std::string all;
  while (!text.empty()) {
    const dem::Character c = dem::first_character(text);
    switch (c.code) {
      case '\\':
        all += "\\e";
        break;
      case '-':
        all += "\\-";
        break;
      case '\'':
        all += "\\(aq";
        break;
      case '`':
        all += "\\(ga";
        break;
      case '^':
        all += "\\(ha";
        break;
      case '~':
        all += "\\(ti";
        break;
      default:
        if (c.code < 0x80) {
          all += static_cast<char>(c.code);
        } else {
          all += fmt::format("\\[u{:04X}]", static_cast<unsigned>(c.code));
        }
    }
    text.remove_prefix(c.bytes);
  }
  return (all.starts_with('.') ? "\\&" : "") + all;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

/// A paragraph with its head.
std::string tagged(const std::string& head, const std::string& says) {
  return ".TP\n" + head + "\n" + roff(says) + "\n";
}

std::string section(std::string title) {
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return ".SH " + title + "\n";
}

std::string subsection(const std::string& title) { return ".SS \"" + roff(title) + "\"\n"; }

std::string synopsis(const std::string& program, const Command& command) {
  const std::string words = positionals_text(command);
  return bold(program) + " [" + italic("options") + "]" + (words.empty() ? "" : " " + italic(words)) + "\n";
}

std::string option_head(const Option& option) {
  std::string head = option.letter != 0 ? bold("-" + std::string(1, option.letter)) + ", " : "";
  head += bold("--" + option.name);
  return option.value.empty() ? head : head + " " + italic(option.value);
}

std::string command_text(const Command& command, bool is_first) {
  std::string text = subsection("dem-report " + command.name);
  text += roff(sentence(command.summary) + (command.details.empty() ? "" : " " + command.details));
  text += is_first ? "\nThis is done when no verb is given.\n" : "\n";
  for (const Positional& positional : command.positionals) {
    const std::string more = positional.choices.empty() ? "" : " (" + one_of(positional.choices) + ")";
    text += tagged(italic(positional.name), sentence(positional.help + more));
  }
  for (const Option& option : options_of(command)) text += tagged(option_head(option), sentence(option_text(option)));
  return text;
}

}  // namespace

std::string man_page(std::span<const Command> commands, const std::string& version, const std::string& date) {
  std::string page = ".\\\" Made by dem-report help --man from the declarations of its commands.\n";
  page += fmt::format(".TH DEM\\-REPORT 1 {} \"dem\\-report {}\" \"User Commands\"\n", date, roff(version));
  page += section("name") + "dem\\-report \\- discrete element studies of brittle rock, from scenario to report\n";
  page += section("synopsis") + synopsis("dem-report", commands.front());
  for (const Command& command : commands.subspan(1)) page += ".br\n" + synopsis("dem-report " + command.name, command);
  page += section("description") + roff(program_summary()) + "\n";
  page += section("verbs");
  for (const Command& command : commands) page += command_text(command, &command == &commands.front());
  page += section("exit status");
  for (const Command& command : commands) {
    page += subsection("dem-report " + command.name);
    for (const ExitCode& code : command.exit_codes) page += tagged(bold(code.code), sentence(code.meaning));
  }
  page += section("environment");
  for (const Entry& one : variables) page += tagged(bold(one.name), sentence(one.says));
  page += section("files");
  for (const Entry& one : files) page += tagged(italic(one.name), sentence(one.says));
  page += section("examples");
  for (const Command& command : commands) {
    for (const Example& example : command.examples) page += tagged(bold(example.command), sentence(example.says));
  }
  return page + section("see also") + ".BR weasyprint (1),\n.BR sbatch (1)\n";
}

}  // namespace cli
