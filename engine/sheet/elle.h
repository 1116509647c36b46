#pragma once
// Elle files: maps of grains as polygons ("flynns") over shared nodes in a periodic cell (Bons 2000; Jessell et al.
// 2001). Text, one section after the other: OPTIONS, FLYNNS, LOCATION, attribute sections, UNODES. A word in capitals
// at the start of a line begins a section; words after it name the columns of its values.
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dem::sheet {

using Point = std::array<double, 2>;

/// A section of values for flynns, e.g. MINERAL, or for unodes: a default and exceptions by id.
struct ElleAttribute {
  std::string name;
  std::string standard = {};  ///< the `Default` line; "" when there is none
  std::vector<std::pair<int, std::string>> values = {};
  std::vector<std::string> columns = {};  ///< their names, where the section's first line gives them
  bool of_unodes = false;                 ///< UNODES itself and sections U_...
  int faults = 0;                         ///< lines that could not be read; nothing is wrong as long as nobody asks
  int fault_line = 0;                     ///< the first of them
  std::string fault = {}, remedy = {};    ///< what is wrong there, and what would be right
};

/// An attribute by the name that a rule has for it: MINERAL, AGE.CYCLE, CONC_A (a column of UNODES).
struct ElleColumn {
  const ElleAttribute* section = nullptr;
  int column = -1;  ///< -1: the whole value

  [[nodiscard]] std::string part(std::string_view value) const;
  explicit operator bool() const { return section != nullptr; }
};

struct ElleFlynn {
  int id = 0;
  std::vector<int> nodes;  ///< ids, in order around the grain
  int line = 0;            ///< where it was read; 0: made here
};

/// A node of an outline, or a unode: a point inside grains that carries values of its own.
struct ElleNode {
  int id = 0;
  Point place{};
};

struct ElleMap {
  std::string source;                                        ///< file name for messages; "" when made here
  Point low{0, 0}, high{1, 1};                               ///< the cell (CellBoundingBox), its shear undone
  double shear = 0;                                          ///< the cell's top against its bottom, along x
  int box_line = 0;                                          ///< where it was read
  std::vector<std::pair<std::string, std::string>> options;  ///< the other options, kept as text
  std::vector<ElleFlynn> flynns;
  std::vector<ElleNode> nodes;
  std::vector<ElleAttribute> attributes;
  std::vector<ElleNode> unodes;
  std::vector<std::string> notes;  ///< what was left out, a sentence each

  /// The value of an attribute for the flynn at `index`; "" when neither a value nor a default is given.
  [[nodiscard]] std::string attribute(std::string_view name, std::size_t index) const;
  /// The attribute of that name, of flynns before unodes; none: false. Throws InputError when its section is broken.
  [[nodiscard]] ElleColumn find(std::string_view name) const;
  /// All that find() knows.
  [[nodiscard]] std::vector<std::string> attribute_names() const;
};

/// Reads a file. Throws InputError with line and reason for a broken outline, cell or node; unknown sections become a
/// note, and so do values that cannot be read: those are refused by ElleMap::find().
ElleMap read_elle(const std::filesystem::path& file);
/// The same from text; `name` stands in messages.
ElleMap parse_elle(std::string_view text, const std::string& name);
/// The map as a file's text: what was read comes back with the same polygons, attributes and options.
std::string elle_text(const ElleMap& map);

/// The outline of each flynn with the cell's periodicity undone: each point is the image nearest to the one before.
/// Throws InputError (with the flynn's line) for an outline that runs right across the cell or lies far outside it.
std::vector<std::vector<Point>> outlines(const ElleMap& map);
double area(const std::vector<Point>& outline);  ///< positive counter-clockwise

}  // namespace dem::sheet
