#pragma once
// Elle files: maps of grains as polygons ("flynns") over shared nodes in a periodic cell (Bons 2000; Jessell et al.
// 2001). Text, one section after the other: OPTIONS, FLYNNS, LOCATION, attribute sections, UNODES.
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dem::sheet {

using Point = std::array<double, 2>;

/// A section of values for flynns, e.g. MINERAL: a default and exceptions by flynn id.
struct ElleAttribute {
  std::string name;
  std::string standard;  ///< the `Default` line; "" when there is none
  std::vector<std::pair<int, std::string>> values;
};

struct ElleFlynn {
  int id = 0;
  std::vector<int> nodes;  ///< ids, in order around the grain
  int line = 0;            ///< where it was read; 0: made here
};

struct ElleNode {
  int id = 0;
  Point place{};
};

struct ElleMap {
  std::string source;                                        ///< file name for messages; "" when made here
  Point low{0, 0}, high{1, 1};                               ///< the cell (CellBoundingBox)
  std::vector<std::pair<std::string, std::string>> options;  ///< the other options, kept as text
  std::vector<ElleFlynn> flynns;
  std::vector<ElleNode> nodes;
  std::vector<ElleAttribute> attributes;
  int unodes = 0;                  ///< counted, not kept
  std::vector<std::string> notes;  ///< what was left out, a sentence each

  /// The value of an attribute for the flynn at `index`; "" when neither a value nor a default is given.
  [[nodiscard]] std::string attribute(std::string_view name, std::size_t index) const;
};

/// Reads a file. Throws InputError with line and reason for anything broken; unknown sections become a note.
ElleMap read_elle(const std::filesystem::path& file);
/// The same from text; `name` stands in messages.
ElleMap parse_elle(std::string_view text, const std::string& name);
/// The map as a file's text: what was read comes back with the same polygons, attributes and options.
std::string elle_text(const ElleMap& map);

/// A flynn's outline with the cell's periodicity undone: each point is the image nearest to the one before.
/// Throws InputError (with the flynn's line) for an outline that runs right across the cell.
std::vector<Point> outline(const ElleMap& map, std::size_t flynn);
double area(const std::vector<Point>& outline);  ///< positive counter-clockwise

}  // namespace dem::sheet
