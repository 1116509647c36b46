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

// The first word alone decides: names of columns may follow.
bool is_section(const Words& words) {
  if (!(words[0][0] >= 'A' && words[0][0] <= 'Z')) return false;
  return std::all_of(words[0].begin(), words[0].end(),
                     [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; });
}

std::string text_of(const Words& words, std::size_t first) {
  std::string text;
  for (std::size_t i = first; i < words.size(); ++i) text += (i > first ? " " : "") + std::string(words[i]);
  return text;
}

// Values of flynns; sections of nodes (CONC_A, ...) and of segments are not for this program.
bool is_flynn_attribute(std::string_view name) {
  static constexpr std::string_view known[] = {"MINERAL",   "EXPAND",  "VISCOSITY",  "ENERGY",       "AGE",
                                               "GRAIN",     "SPLIT",   "COLOUR",     "CAXIS",        "EULER_3",
                                               "DISLOCDEN", "PARENTS", "S_EXPONENT", "FLYNN_STRAIN", "FLYNN_STRESS"};
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
             "a section begins with its name in capitals at the start of a line, like FLYNNS");
      }
      section_ = words[0] == "REGIONS" ? "FLYNNS" : std::string(words[0]);  // its name in early files
      const bool again = !seen_.insert(section_).second;
      if (again && (section_ == "OPTIONS" || section_ == "FLYNNS" || section_ == "LOCATION"))
        fail(fmt::format("section {} is given twice", section_), "give it once");
      if (section_ == "OPTIONS")
        have = options(words);
      else if (section_ == "FLYNNS")
        have = flynns(words);
      else if (section_ == "LOCATION")
        have = locations(words);
      else if (section_ == "UNODES" || section_.starts_with("U_") || is_flynn_attribute(section_))
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
  static bool whole(std::string_view word, int& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc{} && end == word.data() + word.size() && value >= 0;
  }
  static bool real(std::string_view word, double& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc{} && end == word.data() + word.size() && std::isfinite(value);
  }
  int integer(std::string_view word) const {
    int value = 0;
    if (!whole(word, value))
      fail(fmt::format("'{}' is no id or count", shown(word)), "a whole number from 0 up is needed here");
    return value;
  }
  double number(std::string_view word) const {
    double value = 0;
    if (!real(word, value)) fail(fmt::format("'{}' is no number", shown(word)), "a finite number is needed here");
    return value;
  }

  bool options(Words& words) {
    while (next(words)) {
      if (is_section(words)) return true;
      if (words[0] != "CellBoundingBox") {
        map_.options.emplace_back(words[0], text_of(words, 1));
        if (words[0] == "SimpleShearOffset" && words.size() > 1) {
          offset_ = number(words[1]);
          offset_line_ = line_;
        }
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
    const double h = n[5] - n[1], w = n[2] - n[0];
    const double off = 1e-9 * (std::fabs(w) + std::fabs(h));
    const bool level = std::fabs(n[3] - n[1]) <= off && std::fabs(n[7] - n[5]) <= off &&
                       std::fabs((n[4] - n[6]) - w) <= off + 1e-6 * std::fabs(w);
    const auto sized = [](double length) { return length > 1e-30 && length < 1e30; };
    if (!sized(w) || !sized(h) || !level) {
      fail("CellBoundingBox is no cell between a level bottom and a level top of the same width",
           "corners go lower left, lower right, upper right, upper left; only the top may be moved sideways");
    }
    if (std::fabs(n[4] - n[2]) > off) {
      map_.high[0] = n[2];
      map_.shear = n[6] - n[0];
    }
    map_.box_line = line_;
    box_ = true;
  }
  // Moved by whole widths the top meets itself, so that Elle's files keep the rest.
  void shear() {
    const double width = map_.high[0] - map_.low[0];
    const auto rest = [&](double moved) {
      moved -= width * std::round(moved / width);
      return std::fabs(moved) < 1e-9 * width ? 0.0 : moved;
    };
    const double drawn = rest(map_.shear), said = rest(offset_);
    map_.shear = drawn != 0 ? drawn : said;
    if (drawn != 0 && offset_line_ > 0 && std::fabs(rest(drawn - said)) > 1e-4 * width) {
      map_.notes.push_back(
          fmt::format("The corners of CellBoundingBox in {} are sheared by {:g}, SimpleShearOffset "
                      "says {:g}: the corners are taken.",
                      map_.source, drawn, offset_));
    }
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
  // Values that cannot be read are no reason to refuse a map that nobody asks for them.
  static void fault(ElleAttribute& a, int line, std::string wrong, std::string right) {
    if (a.faults++ > 0) return;
    a.fault_line = line;
    a.fault = std::move(wrong);
    a.remedy = std::move(right);
  }
  bool attribute(Words& words) {
    ElleAttribute found;
    found.name = section_;
    const bool places = section_ == "UNODES";
    found.of_unodes = places || section_.starts_with("U_");
    for (std::size_t i = 1; i < words.size(); ++i) found.columns.emplace_back(words[i]);
    const char* const what = found.of_unodes ? "unode" : "flynn";
    const int begin = line_;
    bool more = false;
    std::set<int> ids;
    while ((more = next(words)) && !is_section(words)) {
      Point place{};
      const std::size_t first = places ? 3 : 1;  // a unode's place comes before its values
      const std::string value = text_of(words, first);
      if (!places && value.empty()) {
        fault(found, line_, fmt::format("'{}' has no value", shown(words[0])),
              fmt::format("a line holds a {} id, or Default, and a value", what));
        continue;
      }
      if (!places && words[0] == "Default") {
        found.standard = value;
        continue;
      }
      int id = 0;
      if (!whole(words[0], id)) {
        fault(found, line_, fmt::format("'{}' is no id", shown(words[0])), "a whole number from 0 up is needed here");
      } else if (!ids.insert(id).second) {
        fault(found, line_, fmt::format("{} {} has two values", what, id), fmt::format("give one line a {}", what));
      } else if (places && (words.size() < 3 || !real(words[1], place[0]) || !real(words[2], place[1]))) {
        fault(found, line_, fmt::format("unode {} has no place", id), "a line holds id, x and y, and its values");
      } else {
        if (places) map_.unodes.push_back({id, place});
        if (!value.empty()) found.values.emplace_back(id, value);
        lines_[found.name].push_back(line_);
      }
    }
    for (ElleAttribute& a : map_.attributes) {
      if (a.name != found.name) continue;
      fault(a, begin, fmt::format("section {} is given twice", a.name), "give it once");
      return more;
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
    shear();
    check_attributes();
  }
  void check_attributes() {
    std::set<int> unodes;
    for (const auto& unode : map_.unodes) unodes.insert(unode.id);
    for (ElleAttribute& a : map_.attributes) {
      const std::set<int>& known = a.of_unodes ? unodes : flynn_ids_;
      for (std::size_t u = 0; a.name == "UNODES" && u < map_.unodes.size(); ++u) {
        for (std::size_t q = 0; q < 2; ++q) {
          if (std::fabs(map_.unodes[u].place[q] - map_.low[q]) < 100 * (map_.high[q] - map_.low[q])) continue;
          fault(a, lines_[a.name][u], fmt::format("unode {} lies far outside the cell", map_.unodes[u].id),
                "unodes lie in the cell of CellBoundingBox, or one cell beside it");
        }
      }
      std::size_t kept = 0;
      for (std::size_t i = 0; i < a.values.size(); ++i) {
        if (a.name == "UNODES" || known.contains(a.values[i].first)) {
          std::swap(a.values[kept++], a.values[i]);
          continue;
        }
        fault(a, lines_[a.name][i],
              fmt::format("there is no {} {}", a.of_unodes ? "unode" : "flynn", a.values[i].first),
              a.of_unodes ? "values are for unodes listed under UNODES" : "values are for flynns listed under FLYNNS");
      }
      a.values.resize(kept);
      if (a.faults == 0) continue;
      map_.notes.push_back(
          fmt::format("Section {} of {}: {} of its lines cannot be read, the first is line {} ({}). "
                      "Nothing here uses its values.",
                      a.name, map_.source, a.faults, a.fault_line, a.fault));
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::string section_;
  std::set<std::string> seen_;
  std::set<int> flynn_ids_;
  std::map<std::string, std::vector<int>> lines_;  // of values, by section
  bool box_ = false;
  double offset_ = 0;
  int offset_line_ = 0;
  ElleMap map_;
};

}  // namespace

std::string ElleColumn::part(std::string_view value) const {
  if (column < 0) return std::string(value);
  const Words words = split(value);
  const auto at = static_cast<std::size_t>(column);
  return at < words.size() ? std::string(words[at]) : std::string();
}

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

namespace {

// Calls visit(name, column) for each name that the values of a section go by.
template <class Visit>
void each_name(const ElleAttribute& a, Visit visit) {
  const bool places = a.name == "UNODES";
  if (!places) visit(a.name, -1);
  if (!places && a.columns.size() < 2) return;
  for (std::size_t c = 0; c < a.columns.size(); ++c)
    visit(places ? a.columns[c] : a.name + "." + a.columns[c], static_cast<int>(c));
}

}  // namespace

ElleColumn ElleMap::find(std::string_view name) const {
  ElleColumn found;
  for (const bool of_unodes : {false, true}) {
    for (const ElleAttribute& a : attributes) {
      if (a.of_unodes != of_unodes || found) continue;
      each_name(a, [&](const std::string& known, int column) {
        if (!found && known == name) found = {&a, column};
      });
    }
  }
  for (const ElleAttribute& a : attributes) {
    const bool asked = &a == found.section || (found && found.section->of_unodes && a.name == "UNODES");
    if (asked && a.faults > 0) throw InputError({source, a.fault_line, 0}, a.name, a.fault, a.remedy);
  }
  return found;
}

std::vector<std::string> ElleMap::attribute_names() const {
  std::vector<std::string> names;
  for (const ElleAttribute& a : attributes) {
    each_name(a, [&](const std::string& name, int) { names.push_back(name); });
  }
  return names;
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
                     map.high[0] + map.shear, map.high[1], map.low[0] + map.shear, map.high[1]);
  for (const auto& [name, value] : map.options) out += name + " " + value + "\n";
  out += "FLYNNS\n";
  for (const auto& flynn : map.flynns) {
    out += fmt::format("{} {}", flynn.id, flynn.nodes.size());
    for (const int node : flynn.nodes) out += fmt::format(" {}", node);
    out += "\n";
  }
  const auto section = [&](const ElleAttribute& a) {
    out += a.name;
    for (const std::string& column : a.columns) out += " " + column;
    out += "\n";
    if (!a.standard.empty()) out += "Default " + a.standard + "\n";
  };
  for (const auto& a : map.attributes) {
    if (a.of_unodes) continue;
    section(a);
    for (const auto& [id, value] : a.values) out += fmt::format("{} {}\n", id, value);
  }
  out += "LOCATION\n";
  for (const auto& node : map.nodes) out += fmt::format("{} {} {}\n", node.id, node.place[0], node.place[1]);
  for (const auto& a : map.attributes) {
    if (!a.of_unodes) continue;
    section(a);
    const std::map<int, std::string> values(a.values.begin(), a.values.end());
    if (a.name != "UNODES") {
      for (const auto& [id, value] : a.values) out += fmt::format("{} {}\n", id, value);
      continue;
    }
    for (const auto& unode : map.unodes) {
      const auto value = values.find(unode.id);
      out += fmt::format("{} {} {}{}\n", unode.id, unode.place[0], unode.place[1],
                         value == values.end() ? "" : " " + value->second);
    }
  }
  return out;
}

namespace {

std::vector<Point> outline(const ElleMap& map, const ElleFlynn& flynn, const std::unordered_map<int, Point>& places) {
  const Point size{map.high[0] - map.low[0], map.high[1] - map.low[1]};
  const auto nearest = [&](const Point& to, const Point& from) {
    Point p = to;
    const double up = std::round((p[1] - from[1]) / size[1]);
    p[1] -= size[1] * up;
    p[0] -= map.shear * up;
    p[0] -= size[0] * std::round((p[0] - from[0]) / size[0]);
    return p;
  };
  std::vector<Point> points;
  for (const int id : flynn.nodes) {
    const Point& place = places.at(id);
    for (std::size_t q = 0; q < 2; ++q) {
      if (std::fabs(place[q] - map.low[q]) < 100 * size[q]) continue;
      throw InputError(
          {map.source, flynn.line, 0}, "FLYNNS",
          fmt::format("node {} of flynn {} lies at {:g}, {:g}, far outside the cell", id, flynn.id, place[0], place[1]),
          "nodes lie in the cell of CellBoundingBox, or one cell beside it");
    }
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

}  // namespace

std::vector<std::vector<Point>> outlines(const ElleMap& map) {
  std::unordered_map<int, Point> places;
  for (const auto& node : map.nodes) places.emplace(node.id, node.place);
  std::vector<std::vector<Point>> all;
  for (const ElleFlynn& flynn : map.flynns) all.push_back(outline(map, flynn, places));
  return all;
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
