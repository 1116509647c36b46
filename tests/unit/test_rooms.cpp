// The rooms of the program: which folder may include which. The drawing is in ARCHITECTURE.md, in two blocks:
//
//   ```rooms                                  a room (a folder without the rooms below it, or one file) and the rooms
//   engine/core:                              that it may include besides itself; they stand above it
//   engine/scenario: engine/core
//   reports/output: engine/core reports/...   X/... is X with all the rooms below it
//   ```
//   ```headers                                headers of a library, by their beginning, and the only rooms that may
//   vtk: render/...                           include them
//   ```
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files.h"

namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

struct Room {
  std::string name;
  Texts uses{};  // names of rooms, X/... written out
};

struct Header {
  std::string beginning;
  Texts rooms{};
};

struct Drawing {
  std::vector<Room> rooms{};
  std::vector<Header> headers{};
  Texts mistakes{};  // of the drawing itself
};

struct Include {
  std::string name;
  bool ours = false;  // "..." and not <...>
  int line = 0;
};

bool is_at_or_below(std::string_view path, std::string_view folder) {
  return path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/');
}

/// The lines of the block ```NAME, without empty ones.
Texts block(const std::string& page, const std::string& name) {
  Texts lines;
  std::istringstream text(page);
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      inside = line == "```" + name;
    } else if (inside && !line.empty()) {
      lines.push_back(line);
    }
  }
  return lines;
}

/// The rooms that `word` stands for, among those that have been drawn.
Texts written_out(const std::string& word, const std::vector<Room>& drawn) {
  constexpr std::string_view below = "/...";
  const bool all = word.ends_with(below);
  const std::string name = all ? word.substr(0, word.size() - below.size()) : word;
  Texts rooms;
  for (const Room& room : drawn) {
    if (all ? is_at_or_below(room.name, name) : room.name == name) rooms.push_back(room.name);
  }
  return rooms;
}

Drawing read_drawing(const std::string& page) {
  Drawing drawing;
  const auto read = [&](const std::string& line, const auto& keep) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) {
      drawing.mistakes.push_back("there is no colon in '" + line + "'");
      return;
    }
    Texts rooms;
    std::istringstream words(line.substr(colon + 1));
    for (std::string word; words >> word;) {
      const Texts found = written_out(word, drawing.rooms);
      if (found.empty()) drawing.mistakes.push_back(line.substr(0, colon) + ": no room " + word + " stands above it");
      rooms.insert(rooms.end(), found.begin(), found.end());
    }
    keep(line.substr(0, colon), rooms);
  };
  for (const std::string& line : block(page, "rooms")) {
    read(line, [&](const std::string& name, const Texts& uses) { drawing.rooms.push_back({name, uses}); });
  }
  for (const std::string& line : block(page, "headers")) {
    read(line, [&](const std::string& name, const Texts& rooms) { drawing.headers.push_back({name, rooms}); });
  }
  return drawing;
}

/// The room of a file: its own, else that of its folder. A folder that is not drawn is no room.
const Room* room_of(const std::string& file, const Drawing& drawing) {
  const std::string folder = fs::path(file).parent_path().string();
  const auto named = [&](const std::string& name) { return std::ranges::find(drawing.rooms, name, &Room::name); };
  auto at = named(file);
  if (at == drawing.rooms.end()) at = named(folder);
  return at == drawing.rooms.end() ? nullptr : &*at;
}

std::vector<Include> includes(const std::string& source) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> all;
  std::istringstream text(source);
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    std::smatch match;
    if (std::regex_search(line, match, pattern)) all.push_back({match[2], match[1] == "\"", number});
  }
  return all;
}

bool has(const Texts& words, const std::string& word) { return std::ranges::find(words, word) != words.end(); }

/// What is wrong with one include of a file in `room`; nothing: it is as drawn.
std::optional<std::string> objection(const Room& room, const Include& include, const Drawing& drawing) {
  if (!include.ours) {
    for (const Header& header : drawing.headers) {
      if (include.name.starts_with(header.beginning) && !has(header.rooms, room.name)) {
        return "<" + include.name + "> is not for " + room.name;
      }
    }
    return std::nullopt;
  }
  const Room* other = room_of(include.name, drawing);
  if (!other) return "\"" + include.name + "\" lies in no room: write paths from the root of the sources";
  if (other->name == room.name || has(room.uses, other->name)) return std::nullopt;
  return "\"" + include.name + "\": " + room.name + " may not use " + other->name;
}

/// What breaks the drawing, one line each: "FILE:LINE: ...".
Texts objections(const std::map<std::string, std::string>& sources, const Drawing& drawing) {
  Texts all = drawing.mistakes;
  std::map<std::string, int> files;
  for (const auto& [file, source] : sources) {
    const Room* room = room_of(file, drawing);
    if (!room) {
      all.push_back(file + ": lies in no room of the drawing");
      continue;
    }
    ++files[room->name];
    for (const Include& include : includes(source)) {
      if (const auto what = objection(*room, include, drawing)) {
        all.push_back(file + ":" + std::to_string(include.line) + ": " + *what);
      }
    }
  }
  for (const Room& room : drawing.rooms) {
    if (files[room.name] == 0) all.push_back("the room " + room.name + " is drawn and empty");
  }
  return all;
}

std::map<std::string, std::string> sources_of(const fs::path& root) {
  std::map<std::string, std::string> sources;
  for (const char* top : {"engine", "render", "reports"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".cpp" && ending != ".h" && ending != ".inc") continue;
      sources.emplace(fs::relative(entry.path(), root).generic_string(), dem::read_file(entry.path()));
    }
  }
  return sources;
}

}  // namespace

TEST_CASE("every include goes where the drawing in ARCHITECTURE.md lets it go") {
  const fs::path root = DEM_SOURCE_DIR;
  const Drawing drawing = read_drawing(dem::read_file(root / "ARCHITECTURE.md"));
  REQUIRE(drawing.rooms.size() > 10);
  REQUIRE(drawing.headers.size() > 1);
  for (const std::string& what : objections(sources_of(root), drawing)) FAIL_CHECK(what);
}

TEST_CASE("a drawing is read as it is meant, and what breaks it is told") {
  const std::string page =
      "```rooms\na:\na/low: a\na/high: a/low\nb: a/...\nb/main.cpp: b\nempty:\n```\ntext\n```headers\nvtk: "
      "a/high\n```\n";
  const Drawing drawing = read_drawing(page);
  CHECK(drawing.mistakes.empty());
  REQUIRE(drawing.rooms.size() == 6);
  CHECK(drawing.rooms[3].uses == Texts{"a", "a/low", "a/high"});
  CHECK(room_of("b/main.cpp", drawing)->name == "b/main.cpp");
  CHECK(room_of("a/low/x.h", drawing)->name == "a/low");
  CHECK(room_of("a/else/x.h", drawing) == nullptr);

  const std::map<std::string, std::string> sources = {
      {"a/x.h", "#include <vector>\n  # include \"a/low/y.h\"\n"},                         // a higher room
      {"a/low/y.h", "#include \"a/x.h\"\n#include <vtkNew.h>\n"},                          // a library of others
      {"a/high/z.cpp", "#include <vtkNew.h>\n#include \"a/x.h\"\n// #include \"b/x.h\""},  // not transitive
      {"b/x.h", "#include \"a/high/z.h\"\n#include \"y.h\"\n"},                            // no path from the root
      {"b/main.cpp", "#include \"b/x.h\"\n"},
      {"c/x.h", ""},
  };
  CHECK(objections(sources, drawing) ==
        Texts{"a/high/z.cpp:2: \"a/x.h\": a/high may not use a", "a/low/y.h:2: <vtkNew.h> is not for a/low",
              "a/x.h:2: \"a/low/y.h\": a may not use a/low",
              "b/x.h:2: \"y.h\" lies in no room: write paths from the root of the sources",
              "c/x.h: lies in no room of the drawing", "the room empty is drawn and empty"});
  CHECK(read_drawing("```rooms\nlow: high\nhigh:\n```\n").mistakes == Texts{"low: no room high stands above it"});
}
