// What the program says to people: phrases that a technical editor struck out must not come back.
#include <doctest/doctest.h>

#include <array>
#include <filesystem>
#include <regex>
#include <string>

#include "engine/core/files.h"

namespace {

namespace fs = std::filesystem;

struct Banned {
  const char* pattern;
  const char* instead;
};

const std::array banned{
    Banned{"hangs? on (the|no|it|a|rounding)", "depends on"},
    Banned{"fell where they fell", "say what was looked at"},
    Banned{"as large as they are", "at ... of their diameter"},
    Banned{"differ from this turn by", "point where this rotation puts them"},
    Banned{"Mean of 1 |Over 1 blocks|\\b1 blocks", "one block"},
    Banned{"lost in scatter|no trend beyond its scatter", "no clear trend"},
    Banned{"by the minerals at their ends", "by the minerals of the two particles"},
    Banned{"[Cc]racks within grains|[Cc]racks between grains", "intra-grain, inter-grain cracks"},
    Banned{"[Cc]ontacts between grains", "inter-grain contacts"},
    Banned{"simulated, no record", "starting, no record yet"},
    Banned{"look alike", "are similar"},
};

// Texts of reports: string literals of the program, and the files that are shown as they are.
std::string without_comments(const std::string& code) {
  std::string kept;
  for (std::size_t i = 0; i < code.size();) {
    const std::size_t end = std::min(code.find('\n', i), code.size());
    const std::string line = code.substr(i, end - i);
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string::npos && (line.compare(first, 2, "//") == 0 || line[first] == '#')) {
      i = end + 1;
      continue;
    }
    kept += std::regex_replace(line, std::regex("//[^\"]*$"), "") + "\n";
    i = end + 1;
  }
  return std::regex_replace(kept, std::regex("\"\\s*\n\\s*\""), "");  // literals that go on in the next line
}

}  // namespace

TEST_CASE("no text of a report uses a phrase that was struck out") {
  const fs::path source = DEM_SOURCE_DIR;
  std::size_t read = 0;
  for (const char* folder : {"reports", "assets", "scenarios", "engine"}) {
    for (const auto& file : fs::recursive_directory_iterator(source / folder)) {
      const std::string kind = file.path().extension().string();
      if (kind != ".cpp" && kind != ".h" && kind != ".json" && kind != ".toml" && kind != ".html") continue;
      ++read;
      const std::string text = without_comments(dem::read_file(file.path()));
      for (const Banned& one : banned) {
        std::smatch found;
        const bool there = std::regex_search(text, found, std::regex(one.pattern));
        CAPTURE(file.path().string());
        CAPTURE(one.instead);
        CHECK_MESSAGE(!there, (there ? found.str() : std::string()));
      }
    }
  }
  CHECK(read > 100);
}
