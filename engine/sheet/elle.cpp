#include "engine/sheet/elle.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/scenario/scenario.h"

namespace dem::sheet {
namespace {

using Words = std::vector<std::string_view>;

Words split(std::string_view line) {
  Words words;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && (line[i] == ' ' || line[i] == '\t' || line[i] == '\r')) ++i;
    const std::size_t begin = i;
    while (i < line.size() && line[i] != ' ' && line[i] != '\t' && line[i] != '\r') ++i;
    if (i > begin) words.push_back(line.substr(begin, i - begin));
  }
  return words;
}

// As much of a word as a message needs; bytes that are no plain text would upset a terminal.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return word.size() > 40 ? text + "..." : text;
}

bool is_section(const Words& words) {
  if (words.size() != 1 || !(words[0][0] >= 'A' && words[0][0] <= 'Z')) return false;
  return std::all_of(words[0].begin(), words[0].end(),
                     [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; });
}

// Values of flynns; sections of nodes (CONC_A, ...) and of unodes (U_...) are not for this program.
bool is_flynn_attribute(std::string_view name) {
  static constexpr std::string_view known[] = {"MINERAL",   "EXPAND",  "VISCOSITY", "ENERGY", "AGE",
                                               "GRAIN",     "SPLIT",   "COLOUR",    "CAXIS",  "EULER_3",
                                               "DISLOCDEN", "PARENTS", "S_LOCATION"};
  return std::find(std::begin(known), std::end(known), name) != std::end(known) || name.starts_with("F_ATTRIB_");
}

class Reader {
 public:
  Reader(std::string_view text, std::string name) : text_(text) { map_.source = std::move(name); }

  ElleMap read() {
    Words words;
    bool have = next(words);
    while (have) {
      if (!is_section(words)) {
        fail(fmt::format("'{}' stands outside every section", shown(words[0])),
             "a section begins with its name in capitals alone on a line, like FLYNNS");
      }
      section_ = std::string(words[0]);
      if (!seen_.insert(section_).second) fail(fmt::format("section {} is given twice", section_), "give it once");
      if (section_ == "OPTIONS")
        have = options(words);
      else if (section_ == "FLYNNS")
        have = flynns(words);
      else if (section_ == "LOCATION")
        have = locations(words);
      else if (section_ == "UNODES")
        have = unodes(words);
      else if (is_flynn_attribute(section_))
        have = attribute(words);
      else
        have = skip(words);
    }
    check();
    return std::move(map_);
  }

 private:
  bool next(Words& words) {
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      std::string_view line = text_.substr(at_, end - at_);
      at_ = end + 1;
      ++line_;
      line = line.substr(0, line.find('#'));
      words = split(line);
      if (!words.empty()) return true;
    }
    return false;
  }
  [[noreturn]] void fail(const std::string& wrong, std::string right, int line = 0) const {
    throw InputError({map_.source, line > 0 ? line : line_, 0}, section_, wrong, std::move(right));
  }
  int integer(std::string_view word) const {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || value < 0) {
      fail(fmt::format("'{}' is no id or count", shown(word)), "a whole number from 0 up is needed here");
    }
    return value;
  }
  double number(std::string_view word) const {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
      fail(fmt::format("'{}' is no number", shown(word)), "a finite number is needed here");
    }
    return value;
  }

  bool options(Words& words) {
    while (next(words)) {
      if (is_section(words)) return true;
      if (words[0] != "CellBoundingBox") {
        std::string value;
        for (std::size_t i = 1; i < words.size(); ++i) value += (i > 1 ? " " : "") + std::string(words[i]);
        map_.options.emplace_back(words[0], value);
        continue;
      }
      std::vector<double> numbers;
      for (std::size_t i = 1; i < words.size(); ++i) numbers.push_back(number(words[i]));
      while (numbers.size() < 8) {
        if (!next(words)) fail("the file ends inside CellBoundingBox", "four corners, x and y each, are needed");
        for (const auto word : words) numbers.push_back(number(word));
      }
      if (numbers.size() > 8) fail("CellBoundingBox has more than four corners", "give x and y of four corners");
      box(numbers);
    }
    return false;
  }
  void box(const std::vector<double>& n) {
    map_.low = {n[0], n[1]};
    map_.high = {n[4], n[5]};
    const double w = n[4] - n[0], h = n[5] - n[1], off = 1e-9 * (std::fabs(w) + std::fabs(h));
    const bool square = std::fabs(n[2] - n[4]) <= off && std::fabs(n[3] - n[1]) <= off &&
                        std::fabs(n[6] - n[0]) <= off && std::fabs(n[7] - n[5]) <= off;
    if (!(w > 0) || !(h > 0) || !square) {
      fail("CellBoundingBox is no upright rectangle",
           "corners go lower left, lower right, upper right, upper left, without shear");
    }
    box_ = true;
  }
  bool flynns(Words& words) {
    while (next(words)) {
      if (is_section(words)) return true;
      ElleFlynn flynn;
      flynn.line = line_;
      flynn.id = integer(words[0]);
      if (!flynn_ids_.insert(flynn.id).second) fail(fmt::format("flynn {} is given twice", flynn.id), "ids are unique");
      if (words.size() < 2) fail("a flynn without nodes", "a line holds id, number of nodes, and the nodes");
      const int count = integer(words[1]);
      for (std::size_t i = 2; i < words.size(); ++i) flynn.nodes.push_back(integer(words[i]));
      if (static_cast<std::size_t>(count) != flynn.nodes.size()) {
        fail(fmt::format("flynn {} says {} nodes and lists {}", flynn.id, count, flynn.nodes.size()),
             "the second number counts the node ids after it");
      }
      if (count < 3) fail(fmt::format("flynn {} has {} nodes", flynn.id, count), "an outline has three nodes or more");
      map_.flynns.push_back(std::move(flynn));
    }
    return false;
  }
  bool locations(Words& words) {
    std::set<int> ids;
    while (next(words)) {
      if (is_section(words)) return true;
      if (words.size() != 3) fail("a node needs three numbers", "a line holds id, x and y");
      const ElleNode node{integer(words[0]), {number(words[1]), number(words[2])}};
      if (!ids.insert(node.id).second) fail(fmt::format("node {} is given twice", node.id), "ids are unique");
      map_.nodes.push_back(node);
    }
    return false;
  }
  bool unodes(Words& words) {
    while (next(words)) {
      if (is_section(words)) return true;
      ++map_.unodes;
    }
    return false;
  }
  bool attribute(Words& words) {
    ElleAttribute found{section_, "", {}};
    bool more = false;
    std::set<int> ids;
    while ((more = next(words)) && !is_section(words)) {
      std::string value;
      for (std::size_t i = 1; i < words.size(); ++i) value += (i > 1 ? " " : "") + std::string(words[i]);
      if (value.empty())
        fail(fmt::format("'{}' has no value", shown(words[0])), "a line holds a flynn id, or Default, and a value");
      if (words[0] == "Default") {
        found.standard = value;
        continue;
      }
      const int id = integer(words[0]);
      if (!ids.insert(id).second) fail(fmt::format("flynn {} has two values", id), "give one value a flynn");
      places_.push_back({section_, id, line_});
      found.values.emplace_back(id, value);
    }
    map_.attributes.push_back(std::move(found));
    return more;
  }
  bool skip(Words& words) {
    const std::string name(words[0]);
    int lines = 0;
    bool more = false;
    while ((more = next(words)) && !is_section(words)) ++lines;
    map_.notes.push_back(fmt::format("Section {} ({} lines) of {} was left out: this program has no use for it.", name,
                                     lines, map_.source));
    return more;
  }
  void check() {
    section_.clear();
    if (map_.flynns.empty())
      fail("no grains: section FLYNNS is missing or empty", "FLYNNS lists the outlines of grains");
    if (map_.nodes.empty())
      fail("no nodes: section LOCATION is missing or empty", "LOCATION lists node ids with x and y");
    if (!box_) map_.notes.push_back(map_.source + " gives no CellBoundingBox: a cell from 0 to 1 is taken.");
    std::set<int> nodes;
    for (const auto& node : map_.nodes) nodes.insert(node.id);
    for (const auto& flynn : map_.flynns) {
      for (const int id : flynn.nodes) {
        if (nodes.contains(id)) continue;
        section_ = "FLYNNS";
        fail(fmt::format("flynn {} uses node {}, which LOCATION does not place", flynn.id, id),
             "every node of an outline needs a place", flynn.line);
      }
    }
    for (const auto& place : places_) {
      if (flynn_ids_.contains(place.id)) continue;
      section_ = place.section;
      fail(fmt::format("there is no flynn {}", place.id), "values are for flynns listed under FLYNNS", place.line);
    }
    if (map_.unodes > 0) {
      map_.notes.push_back(fmt::format("{} unodes of {} were counted and left out.", map_.unodes, map_.source));
    }
  }

  struct Place {
    std::string section;
    int id, line;
  };
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::string section_;
  std::set<std::string> seen_;
  std::set<int> flynn_ids_;
  std::vector<Place> places_;
  bool box_ = false;
  ElleMap map_;
};

}  // namespace

std::string ElleMap::attribute(std::string_view name, std::size_t index) const {
  for (const auto& a : attributes) {
    if (a.name != name) continue;
    for (const auto& [id, value] : a.values) {
      if (id == flynns[index].id) return value;
    }
    return a.standard;
  }
  return {};
}

ElleMap parse_elle(std::string_view text, const std::string& name) { return Reader(text, name).read(); }

ElleMap read_elle(const std::filesystem::path& file) {
  const std::string text = read_input(file, largest_map, {file.string(), 0, 0}, "grains.file");
  return parse_elle(text, file.filename().string());
}

std::string elle_text(const ElleMap& map) {
  std::string out = "# Grain map\nOPTIONS\n";
  out += fmt::format("CellBoundingBox {} {}\n", map.low[0], map.low[1]);
  out += fmt::format("                {} {}\n                {} {}\n                {} {}\n", map.high[0], map.low[1],
                     map.high[0], map.high[1], map.low[0], map.high[1]);
  for (const auto& [name, value] : map.options) out += name + " " + value + "\n";
  out += "FLYNNS\n";
  for (const auto& flynn : map.flynns) {
    out += fmt::format("{} {}", flynn.id, flynn.nodes.size());
    for (const int node : flynn.nodes) out += fmt::format(" {}", node);
    out += "\n";
  }
  for (const auto& a : map.attributes) {
    out += a.name + "\n";
    if (!a.standard.empty()) out += "Default " + a.standard + "\n";
    for (const auto& [id, value] : a.values) out += fmt::format("{} {}\n", id, value);
  }
  out += "LOCATION\n";
  for (const auto& node : map.nodes) out += fmt::format("{} {} {}\n", node.id, node.place[0], node.place[1]);
  return out;
}

std::vector<Point> outline(const ElleMap& map, std::size_t index) {
  std::unordered_map<int, Point> places;
  const ElleFlynn& flynn = map.flynns[index];
  const std::set<int> wanted(flynn.nodes.begin(), flynn.nodes.end());
  for (const auto& node : map.nodes) {
    if (wanted.contains(node.id)) places.emplace(node.id, node.place);
  }
  const Point size{map.high[0] - map.low[0], map.high[1] - map.low[1]};
  const auto nearest = [&](const Point& to, const Point& from) {
    Point p = to;
    for (std::size_t q = 0; q < 2; ++q) p[q] -= size[q] * std::round((p[q] - from[q]) / size[q]);
    return p;
  };
  std::vector<Point> points;
  for (const int id : flynn.nodes) {
    const Point& place = places.at(id);
    points.push_back(points.empty() ? place : nearest(place, points.back()));
  }
  const Point closed = nearest(points.front(), points.back());
  if (std::fabs(closed[0] - points.front()[0]) + std::fabs(closed[1] - points.front()[1]) >
      1e-6 * (size[0] + size[1])) {
    throw InputError({map.source, flynn.line, 0}, "FLYNNS",
                     fmt::format("the outline of flynn {} runs across the whole cell and does not close", flynn.id),
                     "an outline closes on itself, with no step longer than half the cell");
  }
  return points;
}

double area(const std::vector<Point>& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point& a = p[i];
    const Point& b = p[(i + 1) % p.size()];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return 0.5 * twice;
}

}  // namespace dem::sheet
