// The manual page and the completions: every verb and option is in them, the tools that read them take them without a word,
// and the shells complete what is declared.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "engine/core/files.h"
#include "reports/commands/help_text.h"
#include "reports/commands/man_page.h"
#include "reports/commands/shells.h"
#include "reports/commands/table.h"
#include "tests/cli/program.h"
#include "tests/support/scratch.h"

namespace {

using Texts = std::vector<std::string>;
using Words = std::set<std::string>;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string page() { return cli::man_page(cli::commands(), "1.2.3", "2026-01-31"); }

/// "--dry-run" as roff writes it.
std::string roff(std::string text) {
  for (std::size_t at = 0; (at = text.find('-', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

/// What a shell offers for each line, whose last word (may be "") is the one at hand. `script` reads the lines from the file
/// "lines", has the completions in the file "completion", and prints a line "==" after the words of each.
std::map<std::string, Words> offers(const std::string& shell, const std::string& script, const Texts& lines) {
  const test::Scratch folder;
  std::ofstream(folder / "completion") << cli::completion(shell, cli::commands());
  std::ofstream(folder / "script") << script;
  std::ofstream all(folder / "lines");
  for (const std::string& line : lines) all << line << "\n";
  all.close();
  std::filesystem::create_directories(folder / "here/sub");
  for (const char* name : {"a.toml", "b.txt", "two words.toml"}) std::ofstream(folder / "here" / name);
  const test::Outcome outcome =
      test::run_shell(folder / "here", "export HOME=\"$PWD\" TERM=dumb LC_ALL=C.UTF-8; exec " + shell + " ../script");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.empty());
  std::map<std::string, Words> found;
  std::istringstream text(outcome.out);
  std::size_t at = 0;
  for (std::string line; std::getline(text, line);) {
    REQUIRE(at < lines.size());
    if (line == "==") {
      found[lines[at++]];
    } else if (!line.empty()) {
      found[lines[at]].insert(line.substr(0, line.find('\t')));
    }
  }
  REQUIRE(at == lines.size());
  return found;
}

// "=" is a word of its own for bash, as readline splits there.
constexpr const char* in_bash = R"sh(
source ../completion
while IFS= read -r line; do
  COMPREPLY=()
  IFS=' ' read -ra COMP_WORDS <<<"${line//=/ = }"
  [[ $line == *' ' || $line == *= ]] && COMP_WORDS+=('')
  [[ $line == *= ]] && unset 'COMP_WORDS[-1]'
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _dem_report
  ((${#COMPREPLY[@]} == 0)) || printf '%s\n' "${COMPREPLY[@]}"
  echo ==
done <../lines
)sh";

constexpr const char* in_fish = R"sh(
source ../completion
while read -l line
    complete -C "$line"
    echo ==
end <../lines
)sh";

// A zsh on a terminal of its own: the line is typed, the tabulator pressed, and what the terminal shows is read up to a mark.
constexpr const char* in_zsh = R"sh(
zmodload zsh/zpty
zpty shell TERM=dumb COLUMNS=400 zsh -f -i
zpty -w shell 'PS1= PS2= LISTMAX=10000; stty -echo; autoload -Uz compinit; compinit -u -D; source ../completion'
zpty -w shell "zstyle ':completion:*' verbose no; zstyle ':completion:*' list-separator ''; unsetopt prompt_cr prompt_sp beep"
zpty -w shell 'print -r -- rea""dy'
zpty -r shell shown '*ready*'
while IFS= read -r line; do
  zpty -n -w shell "$line"$'\t'
  sleep PAUSE
  zpty -n -w shell $'\025'
  zpty -w shell 'print -r -- en""d'
  zpty -r shell shown '*end'$'\r'$'\n''*'
  print -r -- "${shown//$'\r'/ }" | tr '\n' ' '
  print
  print -r -- '=='
done <../lines
)sh";

struct Asked {
  std::string line;
  Words words;
};

/// All that the declaration promises.
std::vector<Asked> promises() {
  std::vector<Asked> all;
  Words verbs;
  for (const cli::Command& command : cli::commands()) verbs.insert(command.name);
  for (const cli::Command& command : cli::commands()) {
    const std::string head = "dem-report " + command.name + " ";
    Words names;
    for (const cli::Option& option : cli::options_of(command)) {
      names.insert("--" + option.name);
      if (option.choices.empty()) continue;
      all.push_back({head + "--" + option.name + " ", {option.choices.begin(), option.choices.end()}});
    }
    all.push_back({head + "--", names});
    const cli::Positional* one = command.positionals.empty() ? nullptr : &command.positionals.front();
    if (one && one->verbs) all.push_back({head, verbs});
    if (one && !one->choices.empty()) all.push_back({head, {one->choices.begin(), one->choices.end()}});
  }
  return all;
}

Texts lines_of(const std::vector<Asked>& asked, const Texts& more) {
  Texts lines = more;
  for (const Asked& one : asked) lines.push_back(one.line);
  return lines;
}

}  // namespace

TEST_CASE("every verb and option of the declaration is in the manual page and in the completion of each shell") {
  const std::string manual = page();
  CHECK(has(manual, ".TH DEM\\-REPORT 1 2026-01-31 \"dem\\-report 1.2.3\""));
  for (const cli::Command& command : cli::commands()) {
    CAPTURE(command.name);
    CHECK(has(manual, ".SS \"dem\\-report " + roff(command.name) + "\""));
    for (const cli::Option& option : cli::options_of(command)) {
      CAPTURE(option.name);
      CHECK(has(manual, "\\fB" + roff("--" + option.name) + "\\fR"));
      for (const std::string& shell : cli::shells()) {
        CAPTURE(shell);
        CHECK(has(cli::completion(shell, cli::commands()), option.name));
      }
    }
  }
  CHECK(test::run_program("/", {"help", "--man"}).out.starts_with(".\\\""));
  for (const std::string& shell : cli::shells()) {
    CHECK(test::run_program("/", {"completion", shell}).out == cli::completion(shell, cli::commands()));
  }
}

TEST_CASE("the manual page is taken by groff, mandoc and man without a word") {
  const test::Scratch folder;
  std::ofstream(folder / "dem-report.1") << page();
  for (const char* command :
       {"groff -ww -man -z -Tutf8 dem-report.1", "mandoc -Tlint -Wwarning dem-report.1",
        "LC_ALL=C.UTF-8 MANROFFSEQ= MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z ./dem-report.1 >/dev/null"}) {
    CAPTURE(command);
    const test::Outcome outcome = test::run_shell(folder.path(), command);
    CHECK(outcome.code == 0);
    CHECK(outcome.out == "");
    CHECK(outcome.err == "");
  }
  const test::Outcome read = test::run_shell(folder.path(), "mandoc -Tutf8 dem-report.1 | col -b");
  CHECK(has(read.out, "--set KEY=VALUE"));
  CHECK(has(read.out, "dem-report accept [options] [NAME...]"));
}

TEST_CASE("bash and fish complete verbs, options, fixed values, and scenarios") {
  const std::vector<Asked> promised = promises();
  const Texts more = {"dem-report ",
                      "dem-report comp",
                      "dem-report compare ",
                      "dem-report compare sub ",
                      "dem-report plan --scale draft ",
                      "dem-report --format html,",
                      "dem-report a.toml --junit ",
                      "dem-report a.toml -o ",
                      "dem-report run-case sub "};
  for (const std::string shell : {"bash", "fish"}) {
    CAPTURE(shell);
    auto found = offers(shell, shell == "bash" ? in_bash : in_fish, lines_of(promised, more));
    for (const Asked& one : promised) {
      CAPTURE(one.line);
      CHECK(found[one.line] == one.words);
    }
    Words opening = {"a.toml", "two words.toml"};
    for (const cli::Command& command : cli::commands()) opening.insert(command.name);
    const std::string sub = shell == "bash" ? "sub" : "sub/";  // readline adds the slash
    opening.insert(sub);
    CHECK(found["dem-report "] == opening);
    CHECK(found["dem-report comp"] == Words{"compare", "completion"});
    CHECK(found["dem-report compare "] == Words{sub});
    CHECK(found["dem-report compare sub "] == Words{sub});
    CHECK(found["dem-report plan --scale draft "] == Words{"a.toml", "two words.toml", sub});
    CHECK(found["dem-report --format html,"].contains("html,pdf"));
    CHECK(found["dem-report a.toml --junit "] == Words{"a.toml", "b.txt", "two words.toml", sub});
    CHECK(found["dem-report a.toml -o "] == Words{sub});
    if (shell == "bash") CHECK(found["dem-report run-case sub "].empty());
  }
  // With "=" the words of bash are split.
  auto found = offers("bash", in_bash, {"dem-report plan --scale=", "dem-report plan --scale=d", "dem-report -- --"});
  CHECK(found["dem-report plan --scale="] == Words{"smoke", "draft", "paper", "high"});
  CHECK(found["dem-report plan --scale=d"] == Words{"draft"});
  CHECK(found["dem-report -- --"].empty());
}

TEST_CASE("zsh completes verbs, options, fixed values, and scenarios") {
  std::vector<Asked> asked = promises();
  asked.push_back({"dem-report ", {"a.toml", "sub/"}});
  for (const cli::Command& command : cli::commands()) asked.back().words.insert(command.name);
  asked.push_back({"dem-report plan ", {"a.toml", "sub/"}});
  asked.push_back({"dem-report compare ", {"sub/"}});
  asked.push_back({"dem-report a.toml --format html,p", {"df"}});
  asked.push_back({"dem-report plan --scale=dr", {"aft"}});
  std::map<std::string, std::string> shown;
  const auto lacks = [&](const Asked& one) {
    return !std::ranges::all_of(one.words, [&](const std::string& word) { return has(shown[one.line], word); });
  };
  // On a busy machine the next key may come before the list is shown, and zsh leaves it out: then again, more slowly.
  for (const char* pause : {"0", "0.3", "3"}) {
    Texts lines;
    for (const Asked& one : asked) {
      if (lacks(one)) lines.push_back(one.line);
    }
    if (lines.empty()) break;
    const std::string script = std::regex_replace(std::string(in_zsh), std::regex("PAUSE"), pause);
    for (const auto& [line, said] : offers("zsh", script, lines)) shown[line] = *said.begin();
  }
  const auto text = [&](const std::string& line) { return shown.at(line); };
  for (const Asked& one : asked) {
    CAPTURE(one.line);
    CAPTURE(text(one.line));
    for (const std::string& word : one.words) CHECK(has(text(one.line), word));
  }
  for (const char* line : {"dem-report ", "dem-report plan "}) CHECK_FALSE(has(text(line), "b.txt"));
  CHECK_FALSE(has(text("dem-report compare "), "a.toml"));
}
