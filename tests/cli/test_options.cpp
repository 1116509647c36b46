// The options of the command line, without running anything.
#include <doctest/doctest.h>

#include "engine/core/errors.h"
#include "reports/commands/cli.h"

namespace {

std::string refusal(const std::vector<std::string>& arguments) {
  try {
    cli::parse(arguments);
  } catch (const dem::InputError& error) {
    return error.what();
  }
  return "accepted";
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("defaults") {
  const cli::CommandLine line = cli::parse({"a.toml"});
  CHECK(line.action == cli::Action::run);
  CHECK(line.scenarios == Texts{"a.toml"});
  CHECK(line.output == "out");
  CHECK(line.scale == "draft");
  CHECK(line.threads >= 1);
  CHECK(line.overrides.empty());
  CHECK(line.html);
  CHECK(line.pdf);
  CHECK_FALSE(line.strict);
  CHECK_FALSE(line.quiet);
}

TEST_CASE("every option, in both spellings, between scenarios") {
  const cli::CommandLine line = cli::parse({"a.toml",
                                            "-o",
                                            "results",
                                            "--scale=paper",
                                            "--threads",
                                            "3",
                                            "--seed",
                                            "7",
                                            "--only=stress_strain",
                                            "--case",
                                            "compression_ar_2",
                                            "--set",
                                            "sweep.aspect_ratio=[1, 2]",
                                            "--set",
                                            "title=\"a,b\"",
                                            "--report-only",
                                            "--format",
                                            "html",
                                            "--quiet",
                                            "--strict",
                                            "b.toml"});
  CHECK(line.scenarios == Texts{"a.toml", "b.toml"});
  CHECK(line.output == "results");
  CHECK(line.scale == "paper");
  CHECK(line.threads == 3);
  CHECK(line.overrides == Texts{"sweep.aspect_ratio=[1, 2]", "title=\"a,b\"", "seed=7"});
  CHECK(line.figure == "stress_strain");
  CHECK(line.only_case == "compression_ar_2");
  CHECK(line.report_only);
  CHECK(line.html);
  CHECK_FALSE(line.pdf);
  CHECK(line.quiet);
  CHECK(line.strict);
  CHECK(cli::parse({"--output=x", "--force", "a.toml"}).force);
  CHECK(cli::parse({"-ox", "a.toml"}).output == "x");
  CHECK(cli::parse({"a.toml", "--format=pdf"}).pdf);
  CHECK(cli::parse({"--set", "seed=-1", "a.toml"}).overrides == Texts{"seed=-1"});
}

TEST_CASE("what needs no scenario") {
  CHECK(cli::parse({"--help"}).action == cli::Action::help);
  CHECK(cli::parse({"-h"}).action == cli::Action::help);
  CHECK(cli::parse({"--version"}).action == cli::Action::version);
  CHECK(cli::parse({"--list-figures"}).action == cli::Action::list_figures);
  CHECK(cli::parse({"--explain-keys"}).action == cli::Action::explain_keys);
  for (const char* option :
       {"--output", "--scale", "--threads", "--seed", "--only", "--case", "--set", "--report-only", "--force",
        "--format", "--list-figures", "--explain-keys", "--quiet", "--version", "--strict", "--help"}) {
    CAPTURE(option);
    CHECK(cli::help().find(option) != std::string::npos);
  }
}

TEST_CASE("wrong usage is told with what would be right") {
  const auto says = [](const Texts& arguments, const std::string& part) {
    const std::string message = refusal(arguments);
    CAPTURE(message);
    CHECK(message.find(part) != std::string::npos);
  };
  says({}, "no scenario is given");
  says({"--quiet"}, "no scenario is given");
  says({"a.toml", "--treads", "2"}, "--treads: unknown option; did you mean '--threads'?");
  says({"a.toml", "--nonsense"}, "see dem-report --help");
  says({"a.toml", "-x"}, "-x: unknown option");
  says({"a.toml", "--scale", "papier"}, "did you mean 'paper'? the scales are: smoke, draft, paper, high");
  says({"a.toml", "--threads", "0"}, "'0' is not a whole number from 1 to 1024");
  says({"a.toml", "--threads", "two"}, "'two' is not a whole number");
  says({"a.toml", "--threads=-2"}, "'-2' is not a whole number");
  says({"a.toml", "--seed", "1.5"}, "--seed: '1.5' is not a whole number from 0");
  says({"a.toml", "--format", "html,docx"}, "unknown format 'docx'; write html, pdf or html,pdf");
  says({"a.toml", "--format", ""}, "unknown format ''");
  says({"a.toml", "--only"}, "--only: the value is missing");
  says({"a.toml", "--only", "--quiet"}, "--only: the value is missing");
  says({"a.toml", "--quiet=yes"}, "takes no value");
  says({"a.toml", "--force", "--report-only"}, "does not go with --force");
  says({"a.toml", "--output="}, "empty");
}

TEST_CASE("the command that makes a report again names no folder of this machine") {
  const cli::CommandLine line = cli::parse({"/home/me/a b.toml", "-o", "/tmp/x", "--threads", "2", "--scale", "paper",
                                            "--set", "specimen.diameter=\"10 mm\"", "--seed", "3", "--quiet"});
  CHECK(cli::command_text(line, "/home/me/a b.toml") ==
        "dem-report 'a b.toml' --scale paper --set 'specimen.diameter=\"10 mm\"' --set seed=3");
  CHECK(cli::command_text(cli::parse({"scenarios/a.toml"}), "scenarios/a.toml") == "dem-report scenarios/a.toml");
  CHECK(cli::command_text(cli::parse({"../a.toml"}), "../a.toml") == "dem-report a.toml");
}
