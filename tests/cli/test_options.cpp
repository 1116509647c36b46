// The options of the command line, without running anything.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/study/study.h"
#include "reports/commands/again.h"
#include "reports/commands/help_text.h"
#include "reports/commands/parse.h"
#include "reports/commands/run.h"
#include "reports/commands/table.h"
#include "tests/support/scratch.h"

namespace {

using Texts = std::vector<std::string>;

/// The command that is performed for these words, and with what.
cli::Call call(const Texts& words) { return cli::parse(cli::commands(), words); }

std::string verb(const Texts& words) { return call(words).command->name; }

cli::RunRequest request(const Texts& words) {
  const cli::Call made = call(words);
  REQUIRE(made.command->name == "run");
  return cli::run_request(made.arguments);
}

std::string refusal(const Texts& words) {
  try {
    const cli::Call made = call(words);
    if (made.command->name == "run") cli::run_request(made.arguments);
  } catch (const dem::InputError& error) {
    return error.what();
  }
  return "accepted";
}

void says(const Texts& words, const std::string& part) {
  const std::string message = refusal(words);
  CAPTURE(message);
  CHECK(message.find(part) != std::string::npos);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("defaults") {
  const cli::RunRequest line = request({"a.toml"});
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
  const cli::RunRequest line = request({"a.toml",
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
  CHECK(request({"--output=x", "--force", "a.toml"}).force);
  CHECK(request({"-ox", "a.toml"}).output == "x");
  CHECK(request({"a.toml", "--format=pdf"}).pdf);
  CHECK(request({"--set", "seed=-1", "a.toml"}).overrides == Texts{"seed=-1"});
}

TEST_CASE("what needs no scenario") {
  CHECK(verb({"--help"}) == "help");
  CHECK(verb({"-h"}) == "help");
  CHECK(verb({"--version"}) == "version");
  CHECK(verb({"--list-figures"}) == "figures");
  CHECK(verb({"--explain-keys"}) == "keys");
  for (const char* option :
       {"--output", "--scale", "--threads", "--seed", "--only", "--case", "--set", "--report-only", "--force",
        "--format", "--list-figures", "--explain-keys", "--quiet", "--version", "--strict", "--help"}) {
    CAPTURE(option);
    CHECK(has(cli::program_help(cli::commands()), option));
  }
}

TEST_CASE("wrong usage is told with what would be right") {
  says({}, "no scenario is given");
  says({"--quiet"}, "no scenario is given");
  says({"a.toml", "--treads", "2"}, "--treads: unknown option; did you mean '--threads'?");
  says({"a.toml", "--nonsense"}, "see dem-report --help");
  says({"a.toml", "-x"}, "-x: unknown option");
  says({"a.toml", "--scale", "papier"}, "did you mean 'paper'? the scales are: smoke, draft, paper, high");
  says({"a.toml", "--threads", "0"}, "'0' is not a whole number from 1 to 1024");
  says({"a.toml", "--threads", "two"}, "'two' is not a whole number");
  says({"a.toml", "--threads=-2"}, "'-2' is not a whole number");
  says({"a.toml", "--dpi", "30"}, "--dpi: '30' is not a whole number from 72 to 1200");
  says({"a.toml", "--dpi", "fine"}, "--dpi: 'fine' is not a whole number");
  says({"a.toml", "--seed", "1.5"}, "--seed: '1.5' is not a whole number from 0");
  says({"a.toml", "--format", "html,docx"}, "unknown format 'docx'; write html, pdf or html,pdf");
  says({"a.toml", "--format", ""}, "unknown format ''");
  says({"a.toml", "--only"}, "--only: the value is missing");
  says({"a.toml", "--only", "--quiet"}, "--only: the value is missing");
  says({"a.toml", "--quiet=yes"}, "takes no value");
  says({"a.toml", "--force", "--report-only"}, "does not go with --force");
  says({"a.toml", "--output="}, "empty");
}

namespace {

/// What makes the report of `file` again, by the words of a command line.
reports::Again again(const std::string& file, Texts words = {}, cli::Home home = cli::Home::clone) {
  words.insert(words.begin(), file);
  const cli::RunRequest line = request(words);
  const dem::Study study = dem::read_study(file, line.scale, line.overrides, dem::models());
  return cli::how_again(line, study.scenario, DEM_SOURCE_DIR "/scenarios", home);
}

}  // namespace

TEST_CASE("the command that makes a report again works in a clone and names no folder of this machine") {
  const std::string shipped = DEM_SOURCE_DIR "/scenarios/ldb_minerals.toml";
  const std::string rock = "scenarios/rocks/lac_du_bonnet.toml";
  CHECK(again(shipped, {"-o", "/tmp/x", "--threads", "2", "--quiet"}).command ==
        "./dem-report scenarios/ldb_minerals.toml");
  CHECK(again(shipped, {"--scale", "smoke", "--set", "specimen.diameter=\"10 mm\"", "--seed", "3"}).command ==
        "./dem-report scenarios/ldb_minerals.toml --scale smoke --set 'specimen.diameter=\"10 mm\"' --seed 3");
  CHECK(again(shipped).scenario.shipped);
  CHECK(again(shipped).rock.shipped);
  // From any folder, and by a path that goes up and down.
  CHECK(again(DEM_SOURCE_DIR "/tests/../scenarios/ldb_minerals.toml").command == again(shipped).command);

  const test::Scratch folder;
  std::filesystem::create_directories(folder / "deep/rocks");
  const std::string copy = folder / "deep/ldb_minerals.toml";
  dem::write_file(copy, dem::read_file(shipped));
  dem::write_file(folder / "deep" / "rocks" / "lac_du_bonnet.toml", dem::read_file(DEM_SOURCE_DIR "/" + rock));
  CHECK(again(copy).command == again(shipped).command);

  // Another text: it has to be saved in the clone; its rock is the shipped one still.
  dem::write_file(copy, dem::read_file(shipped) + "\n# mine\n");
  const reports::Again own = again(copy, {"--case", "compression_quartz", "--only", "mineral_properties"});
  CHECK(own.command == "./dem-report ldb_minerals.toml --set 'include=\"" + rock +
                           "\"' --only mineral_properties --case compression_quartz");
  CHECK_FALSE(own.scenario.shipped);
  CHECK(own.rock.shipped);
  // Given again, that command asks for the same.
  CHECK(again(copy, {"--set", "include=\"" DEM_SOURCE_DIR "/" + rock + "\""}).command == again(copy).command);

  dem::write_file(folder / "mine.toml", dem::read_file(DEM_SOURCE_DIR "/" + rock) + "# mine\n");
  const reports::Again other = again(shipped, {"--set", "include=\"" + (folder / "mine.toml").string() + "\""});
  CHECK(other.command == "./dem-report scenarios/ldb_minerals.toml --set 'include=\"mine.toml\"'");
  CHECK_FALSE(other.rock.shipped);

  // A study and a rock of one name, both one's own, are told apart in one folder.
  std::filesystem::create_directories(folder / "own/rocks");
  dem::write_file(folder / "own/my_rock.toml", dem::read_file(DEM_SOURCE_DIR "/scenarios/my_rock.toml") + "# mine\n");
  dem::write_file(folder / "own/rocks/my_rock.toml",
                  dem::read_file(DEM_SOURCE_DIR "/scenarios/rocks/my_rock.toml") + "# mine\n");
  CHECK(again(folder / "own/my_rock.toml").command ==
        "./dem-report my_rock.toml --set 'include=\"rock_my_rock.toml\"'");
}

TEST_CASE("where the program is installed, its scenarios are named where the package has them") {
  const auto installed = [](const std::string& file, const Texts& words = {}) {
    return again(file, words, cli::Home::installed);
  };
  const std::string shipped = DEM_SOURCE_DIR "/scenarios/ldb_minerals.toml";
  CHECK(installed(shipped, {"--scale", "smoke"}).command ==
        "dem-report /usr/share/dem-report/scenarios/ldb_minerals.toml --scale smoke");
  CHECK(installed(shipped).scenario.shipped);

  const test::Scratch folder;
  std::filesystem::create_directories(folder / "rocks");
  dem::write_file(folder / "ldb_minerals.toml", dem::read_file(shipped) + "\n# mine\n");
  dem::write_file(folder / "rocks/lac_du_bonnet.toml",
                  dem::read_file(DEM_SOURCE_DIR "/scenarios/rocks/lac_du_bonnet.toml"));
  CHECK(installed(folder / "ldb_minerals.toml").command ==
        "dem-report ldb_minerals.toml --set 'include=\"/usr/share/dem-report/scenarios/rocks/lac_du_bonnet.toml\"'");

  // A map lies beside its scenario: where only root may put one, the scenario is saved beside the map.
  const Texts map = {"--scale", "smoke",
                     "--set",   "grains.source=\"file\"",
                     "--set",   "grains.file=\"" DEM_SOURCE_DIR "/tests/fuzz/corpus/elle/two_flynns.elle\""};
  const reports::Again sheet = installed(DEM_SOURCE_DIR "/scenarios/elle_polycrystal.toml", map);
  CHECK(sheet.command ==
        "dem-report elle_polycrystal.toml --scale smoke --set 'grains.source=\"file\"' --set "
        "'grains.file=\"two_flynns.elle\"'");
  CHECK_FALSE(sheet.scenario.shipped);
  CHECK(sheet.needs == "two_flynns.elle");
}

TEST_CASE("a report of one figure or one case has a folder of its own") {
  CHECK(cli::part_folder(request({"a.toml"})).empty());
  CHECK(cli::part_folder(request({"a.toml", "--only", "x"})) == "only.x");
  CHECK(cli::part_folder(request({"a.toml", "--case", "y"})) == "case.y");
  CHECK(cli::part_folder(request({"a.toml", "--case", "y", "--only", "x"})) == "case.y.only.x");
}

TEST_CASE("verbs: run is the default one, each says what it takes") {
  CHECK(verb({"a.toml"}) == "run");
  CHECK(verb({"run", "a.toml"}) == "run");
  CHECK(request({"run", "a.toml", "--scale", "smoke"}).scale == "smoke");
  CHECK(request({"./run"}).scenarios == Texts{"./run"});
  CHECK(request({"--", "run"}).scenarios == Texts{"run"});
  CHECK(request({"a.toml", "keys"}).scenarios == Texts{"a.toml", "keys"});
  CHECK(verb({"figures"}) == "figures");
  CHECK(verb({"keys"}) == "keys");
  CHECK(call({"keys", "grain_texture", "--markdown"}).arguments.word("MODEL") == "grain_texture");
  CHECK(call({"keys", "grain_texture", "--markdown"}).arguments.has("markdown"));
  CHECK(verb({"help"}) == "help");
  CHECK(call({"help", "keys"}).arguments.word("VERB") == "keys");
  CHECK(verb({"version"}) == "version");

  says({"run"}, "no scenario is given; write dem-report run SCENARIO.toml, or see dem-report run --help");
  says({"keys", "--quiet"}, "--quiet: unknown option; see dem-report keys --help");
  says({"keys", "--markdwon"}, "did you mean '--markdown'?");
  says({"keys", "grain_textur"}, "grain_textur: unknown model; did you mean 'grain_texture'? the models are: ");
  says({"keys", "grain_texture", "lattice"}, "lattice: one argument too many; write dem-report keys [MODEL]");
  says({"figures", "a.toml"}, "a.toml: this command takes no argument; write dem-report figures");
}

TEST_CASE("a first word that is neither a file nor a verb: both may have been meant") {
  says({"figurs"}, "figurs: there is no such scenario file, and no such verb");
  says({"figurs"}, "give the path of its file (.toml); did you mean 'figures'? the verbs are: run, ");
  says({"--quiet", "figurs"}, "no such verb");
  says({"--quiet", "figures"}, "a verb comes before its options; write dem-report figures ...");
  CHECK(refusal({"nowhere.toml"}) == "accepted");  // the reader of scenarios tells what is there
  CHECK(refusal({"some/where"}) == "accepted");

  const test::Scratch folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  dem::write_file("figurs", "model = 1");
  dem::write_file("granite.toml", "model = 1");
  CHECK(request({"figurs"}).scenarios == Texts{"figurs"});
  says({"granite"}, "did you mean the file 'granite.toml'?");
  std::filesystem::current_path(before);
}

TEST_CASE("help of a command names all that it takes") {
  for (const cli::Command& command : cli::commands()) {
    CAPTURE(command.name);
    CHECK(verb({command.name, "--help"}) == "help");
    CHECK(call({command.name, "-h"}).arguments.word("VERB") == command.name);
    const std::string help = cli::command_help(command);
    CHECK(has(help, "Usage:\n  dem-report " + command.name + " [options]"));
    for (const cli::Option& option : command.options) CHECK(has(help, "--" + option.name));
    for (const cli::Positional& positional : command.positionals) CHECK(has(help, "\n  " + positional.name));
    for (const char* code : {"\n  0  ", "\n  2  ", "\n  3  "}) CHECK(has(help, code));
    CHECK(has(cli::program_help(cli::commands()), "\n  " + command.name));
  }
  CHECK(has(cli::command_help(*cli::find_command(cli::commands(), "run")), "smoke, draft, paper or high"));
  // Help is shown however wrong the rest is.
  CHECK(verb({"--scale", "huge", "--help"}) == "help");
  CHECK(verb({"--list-figures", "--version"}) == "version");
}

TEST_CASE("the declarations are sound") {
  std::set<std::string> verbs;
  for (const cli::Command& command : cli::commands()) {
    CAPTURE(command.name);
    CHECK(verbs.insert(command.name).second);
    CHECK(static_cast<bool>(command.perform));
    CHECK_FALSE(command.summary.empty());
    std::set<std::string> names = {"help", "h"};
    for (const cli::Option& option : command.options) {
      CAPTURE(option.name);
      CHECK(option.name.size() > 1);
      CHECK(names.insert(option.name).second);
      if (option.letter != 0) CHECK(names.insert(std::string(1, option.letter)).second);
      CHECK_FALSE(option.help.empty());
      CHECK((option.kind == cli::OptionKind::flag) == option.value.empty());
      if (!option.verb.empty()) CHECK(cli::find_command(cli::commands(), option.verb) != nullptr);
      if (option.kind == cli::OptionKind::list) CHECK_FALSE(option.choices.empty());
    }
    for (std::size_t i = 0; i + 1 < command.positionals.size(); ++i) {
      CHECK(command.positionals[i].most != cli::Positional::any_number);
    }
  }
}
