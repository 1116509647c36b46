#include "reports/commands/cli.h"

// A comma belongs to the value: --set sweep.aspect_ratio=[1,2].
#define CXXOPTS_VECTOR_DELIMITER '\x1f'
#include <algorithm>
#include <charconv>
#include <cxxopts.hpp>
#include <thread>

#include "engine/core/errors.h"
#include "engine/scenario/suggest.h"

namespace cli {
namespace {

using Texts = std::vector<std::string>;

const Texts scales = {"smoke", "draft", "paper", "high"};
const Texts flags = {"report-only", "force", "quiet", "strict", "list-figures", "explain-keys", "version", "help"};
const Texts valued = {"output", "scale", "threads", "seed", "only", "case", "set", "format"};

cxxopts::Options options() {
  cxxopts::Options all("dem-report", "Simulates the cases of a scenario and makes an HTML and a PDF report of them.\n");
  all.custom_help("[options]").positional_help("SCENARIO...");
  auto add = all.add_options();
  const auto text = [] { return cxxopts::value<std::string>(); };
  add("o,output", "folder for everything that is written", text()->default_value("out"), "DIR");
  add("scale", "smoke, draft, paper or high", text()->default_value("draft"), "SCALE");
  add("threads",
      "threads to simulate with (default: all of the machine), one case on each; results do not depend on it", text(),
      "N");
  add("seed", "seed of the random numbers, in the place of the scenario's", text(), "N");
  add("only", "draw only this figure", text(), "FIGURE");
  add("case", "run only this case", text(), "ID");
  add("set", "override a scenario key, in TOML: --set 'specimen.diameter=\"10 mm\"'; may be repeated",
      cxxopts::value<Texts>(), "KEY=VALUE");
  add("report-only", "draw from the records that are there, simulate nothing");
  add("force", "simulate also the cases whose record is current");
  add("format", "html, pdf or html,pdf", text()->default_value("html,pdf"), "LIST");
  add("strict", "exit with 1 also when a published number is missed");
  add("list-figures", "list the figures and the publications that they mirror");
  add("explain-keys", "list the scenario keys with unit, range and default");
  add("quiet", "no progress, only errors");
  add("version", "print the version");
  add("h,help", "print this help");
  add("scenario", "scenario files", cxxopts::value<Texts>());
  all.parse_positional({"scenario"});
  return all;
}

[[noreturn]] void refuse(const std::string& option, const std::string& wrong, const std::string& right) {
  throw dem::InputError(dem::Location{}, option, wrong, right);
}

/// cxxopts stops at the first unknown option without advice, and takes an option for the value of another.
void check_words(const Texts& arguments) {
  Texts known;
  for (const Texts* words : {&flags, &valued}) {
    for (const std::string& word : *words) known.push_back("--" + word);
  }
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string& word = arguments[i];
    if (!word.starts_with('-') || word == "-") continue;
    const std::size_t equals = word.find('=');
    const std::string name =
        word.starts_with("--") ? word.substr(2, equals - std::min<std::size_t>(2, equals)) : word.substr(1, 1);
    const bool is_valued = std::ranges::find(valued, name) != valued.end() || name == "o";
    const bool is_flag = std::ranges::find(flags, name) != flags.end() || name == "h";
    if (!is_valued && !is_flag) {
      const std::string near = dem::closest(word.substr(0, equals), known);
      refuse(word, "unknown option", near.empty() ? "see dem-report --help" : "did you mean '" + near + "'?");
    }
    if (is_flag && equals != std::string::npos)
      refuse(word, "this option takes no value", "leave out what follows '='");
    const bool inside = equals != std::string::npos || (name == "o" && word.size() > 2);
    if (!is_valued || inside) continue;
    if (i + 1 >= arguments.size() || arguments[i + 1].starts_with("--")) {
      refuse(word, "the value is missing", "see dem-report --help");
    }
    ++i;
  }
}

std::uint64_t whole_number(const std::string& option, const std::string& text, std::uint64_t low, std::uint64_t high) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < low || number > high) {
    refuse(option, "'" + text + "' is not a whole number from " + std::to_string(low) + " to " + std::to_string(high),
           "write, for example, " + option + " 2");
  }
  return number;
}

void read_formats(const std::string& list, CommandLine& line) {
  line.html = line.pdf = false;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t comma = std::min(list.find(',', from), list.size());
    const std::string format = list.substr(from, comma - from);
    if (format == "html") {
      line.html = true;
    } else if (format == "pdf") {
      line.pdf = true;
    } else {
      refuse("--format", "unknown format '" + format + "'", "write html, pdf or html,pdf");
    }
    from = comma + 1;
  }
}

Action action(const cxxopts::ParseResult& result) {
  if (result.count("help") > 0) return Action::help;
  if (result.count("version") > 0) return Action::version;
  if (result.count("list-figures") > 0) return Action::list_figures;
  if (result.count("explain-keys") > 0) return Action::explain_keys;
  return Action::run;
}

CommandLine interpret(const cxxopts::ParseResult& result) {
  CommandLine line;
  line.action = action(result);
  if (result.count("scenario") > 0) line.scenarios = result["scenario"].as<Texts>();
  if (line.action == Action::run && line.scenarios.empty()) {
    refuse({}, "no scenario is given", "write dem-report SCENARIO.toml, or see dem-report --help");
  }
  line.output = result["output"].as<std::string>();
  if (line.output.empty()) refuse("--output", "the name of the folder is empty", "leave it out for 'out'");
  line.scale = result["scale"].as<std::string>();
  if (std::ranges::find(scales, line.scale) == scales.end()) {
    refuse("--scale", "unknown scale '" + line.scale + "'", dem::advice(line.scale, scales, "the scales are"));
  }
  line.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (result.count("threads") > 0) {
    line.threads = static_cast<int>(whole_number("--threads", result["threads"].as<std::string>(), 1, 1024));
  }
  if (result.count("set") > 0) line.overrides = result["set"].as<Texts>();
  if (result.count("seed") > 0) {
    const std::string text = result["seed"].as<std::string>();
    line.overrides.push_back("seed=" + std::to_string(whole_number("--seed", text, 0, std::uint64_t{1} << 53)));
  }
  if (result.count("only") > 0) line.figure = result["only"].as<std::string>();
  if (result.count("case") > 0) line.only_case = result["case"].as<std::string>();
  read_formats(result["format"].as<std::string>(), line);
  line.report_only = result.count("report-only") > 0;
  line.force = result.count("force") > 0;
  if (line.report_only && line.force) refuse("--report-only", "does not go with --force", "choose one of them");
  line.quiet = result.count("quiet") > 0;
  line.strict = result.count("strict") > 0;
  return line;
}

std::string shell_quoted(const std::string& text) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/=+,:%";
  if (text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

}  // namespace

CommandLine parse(const Texts& arguments) {
  check_words(arguments);
  std::vector<const char*> words = {"dem-report"};
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  cxxopts::Options all = options();
  try {
    return interpret(all.parse(static_cast<int>(words.size()), words.data()));
  } catch (const cxxopts::exceptions::exception& error) {
    refuse({}, error.what(), "see dem-report --help");
  }
}

std::string help() {
  return options().help() +
         "\nExit codes: 0 all well; 1 a case or one of its checks failed (with --strict also: a published number was\n"
         "missed), the report is made all the same; 2 wrong input or usage, nothing is written; 3 the machine or the\n"
         "program failed; 130 or 143 stopped by a signal: the same command goes on where it stopped.\n";
}

std::string command_text(const CommandLine& line, const std::string& scenario) {
  const std::filesystem::path path(scenario);
  const bool of_this_machine = path.is_absolute() || path.lexically_normal().string().starts_with("..");
  std::string text = "dem-report " + shell_quoted((of_this_machine ? path.filename() : path).string());
  if (line.scale != "draft") text += " --scale " + line.scale;
  for (const std::string& override : line.overrides) text += " --set " + shell_quoted(override);
  if (!line.figure.empty()) text += " --only " + shell_quoted(line.figure);
  if (!line.only_case.empty()) text += " --case " + shell_quoted(line.only_case);
  return text;
}

}  // namespace cli
