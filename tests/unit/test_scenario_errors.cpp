// Bad scenarios, one kind a row: where it is (line), which key, what is wrong, what would be right.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <optional>

#include "tests/unit/scenario_keys.h"

using test::changed;
using test::good;
using test::read;

namespace {

struct Bad {
  const char* kind;
  std::string text;
  int line;
  std::string key;
  std::vector<std::string> said;  ///< parts of the message
  std::vector<std::string> overrides = {};
  std::string scale = "paper";
};

std::optional<dem::InputError> error_of(const Bad& bad) {
  try {
    read(bad.text, bad.overrides, bad.scale);
  } catch (const dem::InputError& error) {
    return error;
  }
  return {};
}

std::string many(const std::string& word, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += word;
  return text;
}

std::vector<Bad> bad_scenarios() {
  const std::string diameter = "diameter = \"25 mm\"";
  return {
      {"unknown key",
       changed(good, "diameter", "daimeter"),
       5,
       "specimen.daimeter",
       {"unknown key", "did you mean 'specimen.diameter'?", "known in [specimen]: diameter, height"}},
      {"unknown key far from any",
       changed(good, diameter, diameter + "\ncolour = 3"),
       6,
       "specimen.colour",
       {"unknown key", "known in [specimen]: diameter"}},
      {"key in the wrong table",
       changed(good, "title =", "cohesion = \"1 MPa\"\ntitle ="),
       2,
       "cohesion",
       {"unknown key", "did you mean 'mineral[].cohesion'?"}},
      {"unknown table",
       changed(good, "[specimen]", "[specimn]"),
       4,
       "specimn",
       {"unknown table", "did you mean 'specimen'?"}},
      {"unknown key in a list",
       changed(good, "share = \"60 %\"", "shares = \"60 %\""),
       9,
       "mineral[0].shares",
       {"unknown key", "did you mean 'mineral[].share'?"}},
      {"unknown key in a scale that is not asked for",
       changed(good, "diameter = \"12.5 mm\"", "diamter = \"12.5 mm\""),
       19,
       "scales.draft.specimen.diamter",
       {"unknown key", "did you mean 'specimen.diameter'?"}},
      {"dotted name in quotes",
       changed(good, "title", "\"specimen.height\" = \"5 mm\"\ntitle"),
       2,
       "specimen.height",
       {"unknown key"}},
      {"bare number where a unit is needed",
       changed(good, "\"25 mm\"", "25"),
       5,
       "specimen.diameter",
       {"the bare number 25 has no unit", "such as \"25 mm\""}},
      {"number without unit in quotes",
       changed(good, "\"25 mm\"", "\"25\""),
       5,
       "specimen.diameter",
       {"has no unit", "write \"25 mm\""}},
      {"another dimension",
       changed(good, "\"25 mm\"", "\"25 MPa\""),
       5,
       "specimen.diameter",
       {"in units of stress, but length is needed", "(mm, m, cm, um, km, nm)"}},
      {"unknown unit",
       changed(good, "\"0.3 GPa\"", "\"0.3 Gpa\""),
       13,
       "mineral[1].cohesion",
       {"unknown unit 'Gpa'", "did you mean 'GPa'?"}},
      {"no number",
       changed(good, "\"25 mm\"", "\"wide\""),
       5,
       "specimen.diameter",
       {"does not begin with a number", "write a number and a unit"}},
      {"broken number",
       changed(good, "\"25 mm\"", "\"2.5.1 mm\""),
       5,
       "specimen.diameter",
       {"'2.5.1' is not a number"}},
      {"out of range, shown in the declared unit",
       changed(good, "\"25 mm\"", "\"0.9 m\""),
       5,
       "specimen.diameter",
       {"900 mm is out of range", "allowed is from 1 mm to 500 mm"}},
      {"share above 100 %",
       changed(good, "\"60 %\"", "\"160 %\""),
       9,
       "mineral[0].share",
       {"160 % is out of range", "from 0 % to 100 %"}},
      {"below an open range",
       changed(good, "\"0.3 GPa\"", "\"-1 MPa\""),
       13,
       "mineral[1].cohesion",
       {"-1 MPa is out of range", "allowed is 0 MPa or more"}},
      {"text where a number is needed",
       changed(good, diameter, diameter + "\nratio = \"1.66\""),
       6,
       "specimen.ratio",
       {"wrong type", "without quotes"}},
      {"fraction where a whole number is needed",
       changed(good, diameter, diameter + "\nlayers = 2.5"),
       6,
       "specimen.layers",
       {"wrong type: the number 2.5", "a whole number, from 1 to 9"}},
      {"whole number out of range",
       changed(good, diameter, diameter + "\nlayers = 12"),
       6,
       "specimen.layers",
       {"12 is out of range", "from 1 to 9"}},
      {"not finite", changed(good, diameter, diameter + "\nratio = nan"), 6, "specimen.ratio", {"not a finite number"}},
      {"word where true or false is needed",
       changed(good, diameter, diameter + "\nperiodic = \"yes\""),
       6,
       "specimen.periodic",
       {"wrong type: the text \"yes\"", "write true, without quotes"}},
      {"number where a text is needed",
       changed(good, "\"A study\"", "12"),
       2,
       "title",
       {"wrong type: the number 12", "in quotes"}},
      {"bad choice",
       changed(good, diameter, diameter + "\nshape = \"cylindre\""),
       6,
       "specimen.shape",
       {"'cylindre' is not a choice", "did you mean 'cylinder'?", "the choices are: cylinder, prism"}},
      {"bad choice in a list",
       changed(good, "[sweep]", "[sweep]\ntests = [\"compression\", \"torsion\"]"),
       16,
       "sweep.tests[1]",
       {"'torsion' is not a choice", "compression, tension"}},
      {"one value where a list is needed",
       changed(good, "[1, 2.5]", "2"),
       16,
       "sweep.aspect_ratio",
       {"where a list is needed", "in square brackets"}},
      {"empty sweep",
       changed(good, "[1, 2.5]", "[]"),
       16,
       "sweep.aspect_ratio",
       {"the list is empty", "at least one value"}},
      {"list element out of range, at its own line",
       changed(good, "[1, 2.5]", "[1,\n 0.5]"),
       17,
       "sweep.aspect_ratio[1]",
       {"0.5 is out of range", "from 1 to 10"}},
      {"list element of another type",
       changed(good, "[1, 2.5]", "[1, \"2\"]"),
       16,
       "sweep.aspect_ratio[1]",
       {"wrong type"}},
      {"date", changed(good, "\"A study\"", "2021-05-05"), 2, "title", {"wrong type: a date or time"}},
      {"table where a value is needed",
       changed(good, "diameter = \"25 mm\"", "[specimen.diameter]\nx = 1"),
       5,
       "specimen.diameter",
       {"wrong type: a table", "a quantity, such as \"1 mm\""}},
      {"value where a table is needed",
       "model = \"rock\"\nspecimen = 3\n[scales.paper]\n",
       2,
       "specimen",
       {"is a table, not a value", "[specimen]"}},
      {"list where one table is needed",
       changed(good, "[specimen]", "[[specimen]]"),
       4,
       "specimen",
       {"is one table, not a list"}},
      {"one table where a list is needed",
       "model = \"rock\"\n[mineral]\nname = \"x\"\n[scales.paper]\n",
       2,
       "mineral",
       {"is a list of tables", "[[mineral]]"}},
      {"missing key",
       changed(good, diameter, ""),
       4,
       "specimen.diameter",
       {"the key is missing", "\"1 mm\"", "of the cylinder"}},
      {"missing key with its table missing",
       "model = \"rock\"\n[scales.paper]\n",
       0,
       "specimen.diameter",
       {"the key is missing"}},
      {"missing key in a list", changed(good, "name = \"mica\"\n", ""), 10, "mineral[1].name", {"the key is missing"}},
      {"missing model",
       changed(good, "model = \"rock\"", ""),
       0,
       "model",
       {"the key is missing", "the models are: rock"}},
      {"unknown model",
       changed(good, "\"rock\"", "\"rok\""),
       1,
       "model",
       {"unknown model 'rok'", "the models are: rock"}},
      {"model of a wrong type", changed(good, "\"rock\"", "3"), 1, "model", {"wrong type", "in quotes"}},
      {"key twice", changed(good, diameter, diameter + "\n" + diameter), 6, "", {"not TOML", "diameter"}},
      {"table twice", good + "[specimen]\nheight = \"5 mm\"\n", 21, "", {"not TOML", "specimen"}},
      {"not TOML", changed(good, "title = \"A study\"", "title = A study"), 2, "", {"not TOML"}},
      {"open quotes", changed(good, "\"A study\"", "\"A study"), 2, "", {"not TOML"}},
      {"not UTF-8", changed(good, "A study", "A st\xffudy"), 2, "", {"not TOML"}},
      {"empty file", "", 0, "model", {"the key is missing"}},
      {"scale that is not there", good, 0, "--scale", {"has no scale 'smoke'", "it has: draft, paper"}, {}, "smoke"},
      {"no scales at all",
       "model = \"rock\"\n[specimen]\ndiameter = \"5 mm\"\n",
       0,
       "--scale",
       {"has no scale 'paper'", "add a table [scales.paper]"}},
      {"unknown scale",
       changed(good, "[scales.paper]", "[scales.papier]"),
       20,
       "scales.papier",
       {"unknown scale", "did you mean 'paper'?", "smoke, draft, paper, high"}},
      {"scale that is no table",
       changed(good, "[scales.paper]", "[scales]\npaper = 1"),
       21,
       "scales.paper",
       {"write a table, [scales.paper]"}},
      {"control character in a title",
       changed(good, "A study", "A \\u001b[31mstudy"),
       2,
       "title",
       {"has the control character \\x1b", "leave it out"}},
      {"line end in a title", changed(good, "A study", "A\\nstudy"), 2, "title", {"control character \\x0a"}},
      {"mark that turns the direction of writing",
       changed(good, "A study", "A \\u202estudy"),
       2,
       "title",
       {"control character \\u202e"}},
      {"long title", changed(good, "A study", many("word ", 41)), 2, "title", {"has 205 characters", "at most 200"}},
      {"long word in a title",
       changed(good, "A study", std::string(150, 'a')),
       2,
       "title",
       {"a word of 150 characters", "at most 60"}},
      {"control character in a description",
       changed(good, "title =", "description = \"a\\u0001b\"\ntitle ="),
       2,
       "description",
       {"control character \\x01"}},
      {"long description",
       changed(good, "title =", "description = \"" + many("word ", 1001) + "\"\ntitle ="),
       2,
       "description",
       {"has 5005 characters", "at most 5000"}},
      {"control character in the name of a file",
       changed(good, "title =", "include = \"a\\u0000b\"\ntitle ="),
       2,
       "include",
       {"control character \\x00"}},
      {"control character in a choice",
       changed(good, diameter, diameter + "\nshape = \"\\u001bc\""),
       6,
       "specimen.shape",
       {"control character \\x1b"}},
      {"control character in a quantity",
       changed(good, "\"25 mm\"", "\"25 \\u001bmm\""),
       5,
       "specimen.diameter",
       {"control character \\x1b"}},
      {"control character in a key",
       changed(good, diameter, diameter + "\n\"\\u001bc\" = 1"),
       6,
       "specimen.\\x1bc",
       {"unknown key"}},
      {"name that is a path",
       changed(good, "\"mica\"", "\"../../../../../X\""),
       11,
       "mineral[1].name",
       {"has '.'", "letters, digits, blanks and - _ ( ) +"}},
      {"name with a slash", changed(good, "\"mica\"", "\"mi/ca\""), 11, "mineral[1].name", {"has '/'"}},
      {"name with a NUL",
       changed(good, "\"mica\"", "\"mi\\u0000ca\""),
       11,
       "mineral[1].name",
       {"has the control character \\x00"}},
      {"long name",
       changed(good, "mica", std::string(41, 'm')),
       11,
       "mineral[1].name",
       {"has 41 characters", "at most 40"}},
      {"empty name", changed(good, "\"mica\"", "\"\""), 11, "mineral[1].name", {"the name is empty"}},
      {"name that begins with a sign",
       changed(good, "\"mica\"", "\"-mica\""),
       11,
       "mineral[1].name",
       {"begins with a sign"}},
      {"name that ends with a blank",
       changed(good, "\"mica\"", "\"mica \""),
       11,
       "mineral[1].name",
       {"ends with a blank"}},
      {"name in a sweep that is a path",
       changed(good, "[sweep]", "[sweep]\nmineral = [\"mica\",\n \"../X\"]"),
       17,
       "sweep.mineral[1]",
       {"has '.'"}},
      {"bare number in Pa",
       changed(good, "\"0.3 GPa\"", "50e6"),
       13,
       "mineral[1].cohesion",
       {"the bare number 5e+07 has no unit", "such as \"50 MPa\""}},
      {"bare fraction of a share",
       changed(good, "\"60 %\"", "0.17"),
       9,
       "mineral[0].share",
       {"the bare number 0.17 has no unit", "\"17 %\", or \"0.17 %\" if that is meant"}},
      {"bare share", changed(good, "\"60 %\"", "17"), 9, "mineral[0].share", {"such as \"17 %\""}},
      {"bare length in m",
       changed(good, "\"25 mm\"", "0.025"),
       5,
       "specimen.diameter",
       {"the bare number 0.025 has no unit", "such as \"25 mm\""}},
      {"number of no unit's range", changed(good, "\"25 mm\"", "1e9"), 5, "specimen.diameter", {"from 1 mm to 500 mm"}},
      {"unit in other capitals",
       changed(good, "\"0.3 GPa\"", "\"300 mPa\""),
       13,
       "mineral[1].cohesion",
       {"unknown unit 'mPa'", "did you mean 'MPa'?"}},
      {"decimal comma",
       changed(good, "\"0.3 GPa\"", "\"50,0 GPa\""),
       13,
       "mineral[1].cohesion",
       {"the decimal sign is a point", "write \"50.0 GPa\""}},
      {"decimal comma or thousands",
       changed(good, "\"0.3 GPa\"", "\"1,000 MPa\""),
       13,
       "mineral[1].cohesion",
       {"write \"1.000 MPa\", or \"1000 MPa\" for thousands"}},
      {"decimal comma of a bare number",
       changed(good, diameter, diameter + "\nratio = 1,5"),
       6,
       "",
       {"the decimal sign is a point: write ratio = 1.5"}},
      {"True",
       changed(good, diameter, diameter + "\nperiodic = True"),
       6,
       "",
       {"write periodic = true, in small letters and without quotes"}},
      {"False in quotes",
       changed(good, diameter, diameter + "\nperiodic = \"False\""),
       6,
       "specimen.periodic",
       {"write false, without quotes"}},
      {"text without quotes",
       changed(good, "title = \"A study\"", "title = A study"),
       2,
       "",
       {"write title = \"A study\""}},
      {"quantity without quotes", changed(good, "\"25 mm\"", "25 mm"), 5, "", {"write diameter = \"25 mm\""}},
      {"seed above 2^63",
       changed(good, "title", "seed = 9223372036854775808\ntitle"),
       2,
       "",
       {"the number is too large", "seeds up to 9007199254740992"}},
      {"seed that no double holds",
       changed(good, "title", "seed = 9007199254740993\ntitle"),
       2,
       "seed",
       {"9007199254740993 is out of range", "from 0 to 9007199254740992"}},
      {"key with a blank in its quotes",
       changed(good, "title", "\" seed\" = 1\ntitle"),
       2,
       " seed",
       {"unknown key", "its quotes hold a blank: write seed"}},
      {"--set of a seed above 2^64", good, 0, "seed", {"the number is too large"}, {"seed=99999999999999999999"}},
      {"--set of True",
       good,
       0,
       "specimen.periodic",
       {"write --set specimen.periodic=true, in small letters and without quotes"},
       {"specimen.periodic=True"}},
      {"--set of a list of tables", good, 0, "mineral", {"or drop all with mineral=[]"}, {"mineral=[1]"}},
      {"--set of an entry of a dropped list",
       good,
       0,
       "mineral[0].share",
       {"mineral has 0 entries"},
       {"mineral=[]", "mineral[0].share=\"1 %\""}},
      {"key of a hundred thousand parts",
       changed(good, "title", many("a.", 100000) + "a = 1\ntitle"),
       2,
       "",
       {"more than 500 dots"}},
      {"table of thirty thousand parts",
       changed(good, "title", "[" + many("\"=\" . ", 30000) + "a]\ntitle"),
       2,
       "",
       {"more than 500 dots"}},
      {"--set of a hundred thousand parts",
       good,
       0,
       "title",
       {"more than 500 dots"},
       {"title={" + many("a.", 100000) + "a=1}"}},
      {"lists in lists", changed(good, "[1, 2.5]", many("[", 100000)), 16, "", {"nested more than 8 deep"}},
      {"tables in tables, each below many dots",
       changed(good, "[1, 2.5]", many("{" + many("a.", 400) + "a = [\n", 20) + "1"),
       20,
       "",
       {"nested more than 8 deep"}},
      {"--set of lists in lists", good, 0, "title", {"nested more than 8 deep"}, {"title=" + many("[", 100000)}},
      {"brackets in texts and comments are none",
       changed(good, "[1, 2.5]", "'" + many("[{", 50) + "' # " + many("[", 50)),
       16,
       "sweep.aspect_ratio",
       {"wrong type"}},
      {"model that nobody knows",
       changed(good, "\"rock\"", "\"" + std::string(5000, 'k') + "\""),
       1,
       "model",
       {"kkk...'"}},
      {"negative seed", changed(good, "title", "seed = -1\ntitle"), 2, "seed", {"-1 is out of range", "from 0 to"}},
      {"--set without value", good, 0, "seed", {"there is no value after '='"}, {"seed="}},
      {"--set without =", good, 0, "seed", {"there is no '='", "--set key=value"}, {"seed"}},
      {"--set without key", good, 0, "=3", {"there is no key before '='"}, {"=3"}},
      {"--set of an unknown key", good, 0, "sed", {"--set: sed: unknown key", "did you mean 'seed'?"}, {"sed=1"}},
      {"--set of a table", good, 0, "specimen", {"is a table, not a key", "diameter"}, {"specimen=1"}},
      {"--set out of range", good, 0, "specimen.layers", {"11 is out of range"}, {"specimen.layers=11"}},
      {"--set that lost its quotes",
       good,
       0,
       "specimen.diameter",
       {"'5 mm' is not a TOML value", "--set 'specimen.diameter=\"5 mm\"'"},
       {"specimen.diameter=5 mm"}},
      {"--set of an entry that is not there",
       good,
       0,
       "mineral[2].share",
       {"no such entry", "mineral has 2 entries"},
       {"mineral[2].share=\"1 %\""}},
      {"--set of a list without index", good, 0, "mineral[].share", {"no such entry"}, {"mineral[].share=\"1 %\""}},
      {"--set of two values", good, 0, "seed", {"more than one value"}, {"seed=1\ntitle=\"x\""}},
  };
}

}  // namespace

TEST_CASE("every kind of bad scenario says where, which key, and what would be right") {
  const std::vector<Bad> all = bad_scenarios();
  CHECK(all.size() >= 25);
  for (const Bad& bad : all) {
    CAPTURE(bad.kind);
    const std::optional<dem::InputError> error = error_of(bad);
    REQUIRE(error.has_value());
    const std::string message = error->what();
    CAPTURE(message);
    CHECK(error->key() == bad.key);
    CHECK(error->where().line == bad.line);
    if (bad.overrides.empty()) CHECK(error->where().file.ends_with("study.toml"));
    if (bad.line > 0) CHECK(message.find("study.toml:" + std::to_string(bad.line) + ":") != std::string::npos);
    CHECK(message.find(';') != std::string::npos);
    for (const std::string& part : bad.said) CHECK(message.find(part) != std::string::npos);
  }
}

TEST_CASE("of several mistakes the first in the file is told") {
  const std::string text = changed(changed(good, "\"0.3 GPa\"", "3"), "\"60 %\"", "\"600 %\"");
  CHECK_THROWS_WITH_AS(read(text), doctest::Contains("mineral[0].share"), dem::InputError);
}

TEST_CASE("what a person may write: names, units, a list that is dropped, a key with a blank before it") {
  for (const char* name :
       {"quartz", "K-feldspar", "alkali feldspar (40)", "Glimmer_2", "Hornblende+", "Quarz ä", "石英"}) {
    CAPTURE(name);
    CHECK(read(changed(good, "mica", name)).text("mineral[1].name") == name);
  }
  CHECK(read(changed(good, "\"A study\"", "\"Größe: σ = 3 “MPa”\"")).text("title") == "Größe: σ = 3 “MPa”");
  CHECK(read(good, {"title=\"\""}).text("title").empty());
  CHECK(read(changed(good, "title", "description = \"\"\"one\n\ntwo\"\"\"\ntitle")).text("description") ==
        "one\n\ntwo");
  const dem::Scenario none = read(good, {"mineral=[]"});
  CHECK(none.count("mineral") == 0);
  CHECK_FALSE(none.declares("mineral[0].share"));
  CHECK(read(good, {" seed=3"}).integer("seed") == 3);
  CHECK(read(good, {"seed=9007199254740992"}).seed() == 9007199254740992);
}

TEST_CASE("files that are none, too large or have a name that no page holds") {
  const test::Scratch folder;
  const auto message = [&](const std::string& file) -> std::string {
    try {
      dem::Scenario::read(file, "paper", {}, test::keys_of);
    } catch (const dem::InputError& error) {
      return error.what();
    }
    return {};
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(message("/dev/zero"), "is no plain file"));
  CHECK(has(message("/dev/tty"), "/dev/tty"));
  REQUIRE(::mkfifo((folder / "pipe.toml").c_str(), 0600) == 0);
  CHECK(has(message(folder / "pipe.toml"), "is no plain file"));
  std::ofstream(folder / "large.toml") << good << "#" << std::string(dem::largest_scenario, 'x');
  CHECK(has(message(folder / "large.toml"), "at most 262144 are read"));
  for (const auto& [name, wrong] : {std::pair<std::string, std::string>{"caf\xe9.toml", "is not UTF-8"},
                                    {"a\x1b[2Jb.toml", "has control characters"},
                                    {std::string(230, 'n') + ".toml", "has 230 bytes"}}) {
    CAPTURE(wrong);
    std::ofstream(folder / name) << good;
    CHECK(has(message(folder / name), wrong));
  }
  std::ofstream(folder / "a.toml") << "include = \"pipe.toml\"\n" << good;
  CHECK(has(message(folder / "a.toml"),
            "a.toml:1:11: include: " + (folder / "pipe.toml").string() + " is no plain file"));
  if (std::ifstream("/proc/self/status")) CHECK(has(message("/proc/self/status"), "model"));  // says that it is empty
}

TEST_CASE("a scenario by a symbolic link finds what lies beside its target") {
  const test::Scratch folder;
  std::filesystem::create_directories(folder / "studies/rocks");
  std::filesystem::create_directory(folder / "mine");
  std::ofstream(folder / "studies/rocks/rock.toml") << "seed = 7\n";
  std::ofstream(folder / "studies/study.toml") << "include = \"rocks/rock.toml\"\n" << good;
  std::filesystem::create_symlink("../studies/study.toml", folder / "mine/link.toml");
  const dem::Scenario linked = dem::Scenario::read(folder / "mine/link.toml", "paper", {}, test::keys_of);
  CHECK(linked.name() == "link");
  CHECK(linked.seed() == 7);
  // What lies beside the link goes first.
  std::filesystem::create_directory(folder / "mine/rocks");
  std::ofstream(folder / "mine/rocks/rock.toml") << "seed = 8\n";
  CHECK(dem::Scenario::read(folder / "mine/link.toml", "paper", {}, test::keys_of).seed() == 8);
}

TEST_CASE("an error about a value that comes from elsewhere names that key and its line") {
  const dem::Scenario made = read(good).with("specimen.ratio", 2.5, "sweep.aspect_ratio");
  const dem::InputError error = made.error("specimen.ratio", "it is too large", "");
  CHECK(error.key() == "sweep.aspect_ratio");
  CHECK(error.where().line == 16);
  // A default stands for the table that could have had the key.
  CHECK(read(good).error("specimen.height", "it is too small", "").where().line == 4);
}

TEST_CASE("a missing file, a folder: the message lists the scenarios that are there") {
  const test::Scratch folder;
  std::ofstream(folder / "granite.toml") << good;
  const auto message = [&](const std::string& file) -> std::string {
    try {
      dem::Scenario::read(file, "paper", {}, test::keys_of);
    } catch (const dem::InputError& error) {
      return error.what();
    }
    return {};
  };
  const std::string there = (folder / "granite.toml").string();
  CHECK(message(folder / "granit.toml") == (folder / "granit.toml").string() +
                                               ": there is no such file; did you mean '" + there +
                                               "'? the scenarios there are: " + there);
  CHECK(message(folder.path()).find("this is a folder, not a scenario") != std::string::npos);
  CHECK(message(folder / "nowhere/x.toml").find("give the path of a scenario file") != std::string::npos);
}
