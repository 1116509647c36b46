#pragma once
// Scenarios: TOML files whose every key is declared once (type, unit, range, default, help). Reading, messages,
// --explain-keys and the reference page of the documentation come from the declarations.
//
// A quantity with a unit is written as a string with its unit, "0.35 mm", "58 GPa", "50 deg"; a bare number is refused
// there, and so is a unit of another dimension. Numbers without unit are bare. Values reach the engine in SI units
// (angles in radians, shares as fractions: "17 %" is 0.17).
//
// A file:            model = "grain_texture"   title = "..."   seed = 1
//                    [specimen] ...            keys of the model
//                    [[mineral]] ...           a list: its keys are declared as "mineral[].share"
//                    [sweep] aspect_ratio = [1, 2, 3]
//                    [scales.draft.specimen] diameter = "12.5 mm"     overrides of any key at that scale
// Only scales that have a [scales.NAME] table (it may be empty) can be asked for.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/errors.h"

namespace dem {

enum class KeyType {
  boolean,
  integer,
  real,
  text,
  integers,
  reals,
  texts,
  measured,     ///< with its uncertainty (engine/scenario/measured.h); default "\"\"": not measured
  measured_at,  ///< a list of those, each with where it was measured
};

/// What a key decides. The content of a case, which says whether its record is still current, holds the values of the keys
/// that affect its specimen or its test.
enum class Affects {
  undeclared,  ///< refused by a test: a key must say
  cases,       ///< which cases there are, or the value of another key in some of them
  specimen,    ///< the specimen, and so every result
  test,        ///< the loading or what is measured
  drawing,     ///< the report alone
};

/// What a text may hold. Controls, such as ESC, are refused in all, and so is a word of more letters than a line has.
enum class Form {
  line,       ///< up to 200 characters
  paragraph,  ///< up to 5000, line ends included
  name,       ///< of what gets folders and rows: letters, digits, blanks and - _ ( ) +, up to 40; or empty by default
  path,       ///< of a file, up to 1000
};

/// The declaration of one key.
struct Key {
  std::string path = {};  ///< "specimen.diameter", "mineral[].share", "sweep.aspect_ratio"
  KeyType type = KeyType::real;
  std::string unit = {};     ///< unit in which range, default and help are written ("mm", "GPa", "%", "deg"); "" : none
  std::string at_unit = {};  ///< of measured_at: that of where it was measured
  double low = -std::numeric_limits<double>::infinity();  ///< inclusive, in `unit`; for lists: of each element
  double high = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices = {};  ///< for text(s): the allowed words; empty: any
  Form form = Form::line;                 ///< for text(s) without choices
  std::string standard = {};   ///< the default as TOML text ("\"0.35 mm\"", "1.66", "[1]"); "" : the key is required
  std::string otherwise = {};  ///< the key that it follows where it is not given; {NAME}: the word of that neighbour
  Affects affects = Affects::undeclared;
  std::vector<std::string> when = {};  ///< the tests (or solvers, or "loaded") that it matters to; empty: all
  std::string help = {};               ///< one line, with the symbol and source where there is one
};

/// A value in SI units.
using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<std::int64_t>, std::vector<double>,
                           std::vector<std::string>>;

/// A read, checked and resolved scenario: every declared key has a value.
class Scenario {
 public:
  /// Reads `file`, applies [scales.SCALE], then the overrides ("key=value", TOML value syntax, of --set).
  /// `keys_of` gives the declarations for the file's `model`; common keys are added here.
  /// Throws InputError for anything that is wrong; the message names file, line, key, and what would be right.
  static Scenario read(const std::string& file, std::string_view scale, std::span<const std::string> overrides,
                       const std::function<std::span<const Key>(std::string_view model)>& keys_of);

  [[nodiscard]] const std::string& name() const { return name_; }  ///< file stem
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::string& included() const { return included_; }  ///< file of its key `include`; "": none
  [[nodiscard]] const std::string& scale() const { return scale_; }
  [[nodiscard]] std::string model() const { return text("model"); }
  [[nodiscard]] std::uint64_t seed() const { return static_cast<std::uint64_t>(integer("seed")); }

  // Values in SI units. A path that was not declared, or another type: std::logic_error (our defect, not the user's).
  [[nodiscard]] bool boolean(std::string_view path) const;
  [[nodiscard]] std::int64_t integer(std::string_view path) const;
  [[nodiscard]] double real(std::string_view path) const;  ///< integers convert
  [[nodiscard]] const std::string& text(std::string_view path) const;
  [[nodiscard]] const std::vector<std::int64_t>& integers(std::string_view path) const;
  [[nodiscard]] const std::vector<double>& reals(std::string_view path) const;
  [[nodiscard]] const std::vector<std::string>& texts(std::string_view path) const;
  [[nodiscard]] const Value& value(std::string_view path) const;  ///< of any type
  [[nodiscard]] bool declares(std::string_view path) const;       ///< whether its model has the key
  /// Entries of a list of tables: count("mineral") is 4; then real("mineral[0].share").
  [[nodiscard]] std::size_t count(std::string_view list) const;
  [[nodiscard]] bool given(std::string_view path) const;  ///< written by the user (file, scale or --set)

  /// A copy with one value replaced (SI), for the cases of a sweep. `source` is the key that it comes from
  /// ("sweep.mineral"): errors about `path` name that one, and its line.
  [[nodiscard]] Scenario with(std::string_view path, Value value, std::string_view source = {}) const&;
  [[nodiscard]] Scenario with(std::string_view path, Value value,
                              std::string_view source = {}) &&;  ///< itself, changed
  /// An error about the value of `path`, with the line where the user wrote it.
  [[nodiscard]] InputError error(std::string_view path, const std::string& wrong, std::string right) const;
  /// Stable text of the resolved values of the keys declared under these paths ("mineral[].share" stands for that of every
  /// mineral), sorted by path, one "path = value" a line, doubles in shortest round-trip form. The content of a case is made
  /// of this.
  [[nodiscard]] std::string canonical(std::span<const std::string> declared) const;
  [[nodiscard]] std::string canonical() const;                  ///< of all values
  [[nodiscard]] std::string line(std::string_view path) const;  ///< that of one value
  /// What the user wrote of these keys: paths ("mineral[0].share") and their declarations.
  [[nodiscard]] std::vector<std::pair<std::string, const Key*>> given_keys(std::span<const Key> declared) const;

 private:
  struct Entry {
    Value value;
    Location where;
    bool given = false;
    std::string source;  ///< the key that the value comes from, when it is another
  };
  std::string name_, file_, included_, scale_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::map<std::string, std::size_t, std::less<>> counts_;
  [[nodiscard]] const Entry& entry(std::string_view path) const;
};

/// The file that a scenario names, seen from the scenario's folder; where there is none, and the scenario is a symbolic
/// link, from the folder of what it leads to.
std::filesystem::path file_beside(const std::filesystem::path& scenario, const std::filesystem::path& named);

/// Scenarios and what they include are read up to this size, grain maps up to that one.
constexpr std::uint64_t largest_scenario = std::uint64_t{256} << 10;
constexpr std::uint64_t largest_map = std::uint64_t{256} << 20;

/// Up to here every whole number is a double: seeds are numbers in records and in summary.json.
constexpr std::int64_t largest_seed = std::int64_t{1} << 53;

/// The keys that every scenario has: model, title, description, seed, figures.
std::span<const Key> common_keys();

/// "17 %" -> 0.17, "58 GPa" -> 5.8e10; throws InputError (no location) on a bad number, unknown unit or another dimension.
double read_quantity(std::string_view text, std::string_view unit);

/// The text of --explain-keys: path, type, unit, range, default and help of each key.
std::string explain(std::span<const Key> keys);

}  // namespace dem
