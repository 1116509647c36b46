#include "engine/scenario/reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>

#include "engine/core/files.h"
#include "engine/core/text.h"
#include "engine/scenario/convert.h"
#include "engine/scenario/suggest.h"
#include "engine/scenario/units.h"

namespace dem::scenario_detail {
namespace {

const std::vector<std::string> scale_names = {"smoke", "draft", "paper", "high"};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// What one layer (the file, a scale, an override) says.
struct Layer {
  std::map<std::string, ReadValue, std::less<>> values;
  std::map<std::string, std::size_t, std::less<>> counts;
  std::map<std::string, Location, std::less<>> tables;  ///< where each table and list entry begins
};

/// The declarations, by path and by table.
class Declared {
 public:
  explicit Declared(std::vector<Key> keys) : keys_(std::move(keys)) {
    for (const Key& key : keys_) {
      if (!by_path_.emplace(key.path, &key).second) {
        throw std::logic_error("the scenario key " + key.path + " is declared twice");
      }
      for (std::size_t dot = key.path.find('.'); dot != std::string::npos; dot = key.path.find('.', dot + 1)) {
        tables_.insert(key.path.substr(0, dot));
      }
    }
  }
  Declared(const Declared&) = delete;
  Declared& operator=(const Declared&) = delete;

  [[nodiscard]] const std::vector<Key>& keys() const { return keys_; }
  [[nodiscard]] const Key* find(std::string_view pattern) const {
    const auto at = by_path_.find(pattern);
    return at == by_path_.end() ? nullptr : at->second;
  }
  /// Whether `pattern` ("specimen", "mineral[]") holds declared keys.
  [[nodiscard]] bool has_table(std::string_view pattern) const { return tables_.contains(pattern); }

  /// What would be right in the place of the unknown `pattern`.
  [[nodiscard]] std::string advice_for(std::string_view pattern) const {
    const std::size_t dot = pattern.rfind('.');
    const std::string table(dot == std::string_view::npos ? "" : pattern.substr(0, dot + 1));
    const std::string leaf(pattern.substr(table.size()));
    std::vector<std::string> siblings;
    std::vector<std::string> all;
    for (const auto& [path, key] : by_path_) {
      all.push_back(path);
      if (path.starts_with(table)) siblings.push_back(child(path, table.size()));
    }
    siblings.erase(std::unique(siblings.begin(), siblings.end()), siblings.end());
    const std::string known = (table.empty() ? std::string("known here") : "known in " + header(table)) + ": ";
    std::string near = closest(leaf, siblings);
    if (!near.empty()) near = table + near;
    if (near.empty()) near = closest(pattern, all);
    if (near.empty() && tables_.contains(leaf))
      return "did you mean a key of " + header(leaf + ".") + ": " + inside(leaf) + "? " + known + joined(siblings);
    if (near.empty()) near = same_leaf(leaf);
    return (near.empty() ? "" : "did you mean '" + near + "'? ") + known + joined(siblings);
  }

 private:
  /// "specimen.diameter" from 0 -> "specimen"; from 9 -> "diameter"
  static std::string child(const std::string& path, std::size_t from) {
    std::string name = path.substr(from, path.find('.', from) - from);
    return name.ends_with("[]") ? name.substr(0, name.size() - 2) : name;
  }
  static std::string header(const std::string& table) {
    const std::string name = table.substr(0, table.size() - 1);
    return name.ends_with("[]") ? "[[" + name.substr(0, name.size() - 2) + "]]" : "[" + name + "]";
  }
  /// The names of what a table holds.
  [[nodiscard]] std::string inside(const std::string& table) const {
    std::vector<std::string> names;
    for (const auto& [path, key] : by_path_) {
      if (!path.starts_with(table + ".")) continue;
      const std::string name = child(path, table.size() + 1);
      if (names.empty() || names.back() != name) names.push_back(name);
    }
    return joined(names);
  }
  /// A declared key of the same last word in another table.
  [[nodiscard]] std::string same_leaf(const std::string& leaf) const {
    for (const auto& [path, key] : by_path_) {
      if (path.ends_with("." + leaf)) return path;
    }
    return {};
  }

  std::vector<Key> keys_;
  std::map<std::string, const Key*, std::less<>> by_path_;
  std::set<std::string, std::less<>> tables_;
};

/// Walks a file. Problems are collected, so that the first in the file is told, not the first in the alphabet.
class Walk {
 public:
  Walk(const std::string& file, const Declared& declared) : file_(file), declared_(declared) {}

  /// Reads `table` as keys below `path`; `shown` goes before the key in messages ("scales.draft.").
  void table(const toml::table& table, const std::string& path, const std::string& shown, Layer& layer) {
    layer.tables[path] = location(file_, table.source());
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (path.empty() && shown.empty() && name == "scales") continue;  // read by scales()
      const std::string full = path.empty() ? name : path + "." + name;
      entry(full, name, node, location(file_, key.source()), shown, layer);
    }
  }

  void scales(const toml::node& node, std::map<std::string, Layer, std::less<>>& layers) {
    const auto* table_of_scales = node.as_table();
    if (!table_of_scales) {
      problem({location(file_, node.source()), "scales", "wrong type", "write tables such as [scales.draft.specimen]"});
      return;
    }
    for (const auto& [key, content] : *table_of_scales) {
      const std::string name(key.str());
      const Location where = location(file_, key.source());
      if (std::ranges::find(scale_names, name) == scale_names.end()) {
        problem({where, "scales." + excerpt(name), "unknown scale", advice(name, scale_names, "the scales are")});
      } else if (const auto* one = content.as_table()) {
        table(*one, "", "scales." + name + ".", layers[name]);
      } else {
        problem({where, "scales." + name, "wrong type", "write a table, [scales." + name + "], even when it is empty"});
      }
    }
  }

  void problem(InputError error) { problems_.push_back(std::move(error)); }

  void throw_first() const {
    if (problems_.empty()) return;
    throw *std::ranges::min_element(
        problems_, {}, [](const InputError& error) { return std::pair(error.where().line, error.where().column); });
  }

 private:
  void entry(const std::string& path, const std::string& name, const toml::node& node, const Location& where,
             const std::string& shown, Layer& layer) {
    const std::string pattern = pattern_of(path);
    const bool plain = name.find_first_of(".[]") == std::string::npos;
    if (const Key* key = plain ? declared_.find(pattern) : nullptr) {
      guarded([&] { layer.values[path] = {convert(*key, node, where, shown + path), where, true}; });
    } else if (plain && declared_.has_table(pattern)) {
      if (const auto* inner = node.as_table()) return table(*inner, path, shown, layer);
      problem({where, shown + path, node.is_array_of_tables() ? "is one table, not a list" : "is a table, not a value",
               "write [" + shown + path + "] once, with its keys below"});
    } else if (plain && declared_.has_table(pattern + "[]")) {
      list(path, node, where, shown, layer);
    } else {
      const std::string kind = node.is_table() || node.is_array_of_tables() ? "unknown table" : "unknown key";
      const std::string_view bare = trimmed(name);
      const bool blanks =
          bare.size() != name.size() && declared_.find(pattern_of(parent_of(path, name) + std::string(bare)));
      problem({where, excerpt(shown + path), kind,
               blanks ? "its quotes hold a blank: write " + std::string(bare) : declared_.advice_for(pattern)});
    }
  }

  /// "specimen. diameter" -> "specimen."
  static std::string parent_of(const std::string& path, const std::string& name) {
    return path.substr(0, path.size() - name.size());
  }

  void list(const std::string& path, const toml::node& node, const Location& where, const std::string& shown,
            Layer& layer) {
    const auto* entries = node.as_array();
    const std::string header = "write each entry below its own [[" + shown + path + "]]";
    if (!entries) return problem({where, shown + path, "is a list of tables", header});
    if (entries->empty()) return problem({where, shown + path, "the list is empty", header});
    layer.counts[path] = entries->size();
    for (std::size_t i = 0; i < entries->size(); ++i) {
      const auto* one = entries->get(i)->as_table();
      if (!one) return problem({where, shown + path, "is a list of tables", header});
      table(*one, path + "[" + std::to_string(i) + "]", shown, layer);
    }
  }

  template <class Action>
  void guarded(Action action) {
    try {
      action();
    } catch (const InputError& error) {
      problem(error);
    }
  }

  const std::string& file_;
  const Declared& declared_;
  std::vector<InputError> problems_;
};

/// What was meant by a value that is no TOML: "write ..."; "" when nobody can tell. `key` goes before it.
std::string meant_by(std::string_view value, const std::string& key) {
  const std::string word(value);
  if (word == "true" || word == "false") return {};  // something else is wrong
  if (const std::optional<bool> truth = truth_of(word)) {
    const std::string right = key + (*truth ? "true" : "false");
    if (word.size() >= 4) return "write " + right + ", in small letters and without quotes";
    return "write " + right + ", or, where a text is meant, " + key + "\"" + word + "\"";  // yes, no, on, off
  }
  if (value.empty() || value.find_first_of("\"'[]{}#") != std::string_view::npos) return {};
  const std::string_view digits = value.substr(value.find_first_not_of("+-") == 1 ? 1 : 0);
  if (digits.size() > 18 && digits.find_first_not_of("0123456789_") == std::string_view::npos) {
    return "the number is too large: whole numbers go up to 9223372036854775807, seeds up to 9007199254740992";
  }
  if (const std::size_t comma = value.find(','); comma != std::string_view::npos) {
    const std::string point = word.substr(0, comma) + "." + word.substr(comma + 1);
    if (read_number(point)) return "the decimal sign is a point: write " + key + point;
  }
  return {};
}

/// The same of the line of a file at which the reading of TOML ended.
std::string meant_in_line(std::string_view text, std::uint32_t line) {
  for (; line > 1 && text.find('\n') != std::string_view::npos; --line) text.remove_prefix(text.find('\n') + 1);
  std::string_view said = text.substr(0, text.find('\n'));
  const std::size_t equals = said.find('=');
  if (equals == std::string_view::npos) return {};
  const std::string key = excerpt(std::string(trimmed(said.substr(0, equals)))) + " = ";
  said.remove_prefix(equals + 1);
  const std::string_view value = trimmed(said.substr(0, said.find('#')));
  if (const std::string meant = meant_by(value, key); !meant.empty()) return meant;
  const bool letters = std::ranges::any_of(value, [](unsigned char c) { return std::isalpha(c) != 0 || c >= 128; });
  const bool bare = letters && value.find_first_of("\"'[]{}=") == std::string_view::npos && value.size() < 60 &&
                    value != "true" && value != "false";
  return bare ? "texts and quantities need quotes: write " + key + "\"" + excerpt(std::string(value)) + "\""
              : std::string();
}

constexpr int most_dots = 500, most_nested = 8;

/// The first line with more dots, 0: there is none. toml++ goes one call deeper for each dot of a key, and with tens of
/// thousands beyond the stack.
int line_of_many_dots(std::string_view text) {
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (std::ranges::count(text.substr(0, end), '.') > most_dots) return line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return 0;
}

/// The first line where lists and tables are nested deeper, 0: there is none; each level may have a key of many dots.
int line_of_deep_nesting(std::string_view text) {
  int line = 1, depth = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\n') ++line;
    if (c == '#') at = std::min(text.find('\n', at), text.size()) - 1;
    if (c == '"' || c == '\'') {  // to the end of the text
      const bool wide = text.substr(at, 3) == std::string(3, c);
      const std::string end(wide ? 3 : 1, c);
      for (at += end.size(); at < text.size() && text.substr(at, end.size()) != end; ++at) {
        if (text[at] == '\n') {
          if (!wide) break;  // not TOML: the parser says so
          ++line;
        }
        if (c == '"' && text[at] == '\\') ++at;
      }
      at += end.size() - 1;
      if (at < text.size() && text[at] == '\n') ++line;
    }
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') depth = std::max(depth - 1, 0);
    if (depth > most_nested) return line;
  }
  return 0;
}

toml::table parse(const std::string& text, const std::string& file) {
  if (const int line = line_of_deep_nesting(text); line > 0) {
    throw InputError({file, line, 1}, {},
                     "lists and tables are nested more than " + std::to_string(most_nested) + " deep",
                     "no key of a scenario needs more than two");
  }
  if (const int line = line_of_many_dots(text); line > 0) {
    throw InputError({file, line, 1}, {}, "the line has more than " + std::to_string(most_dots) + " dots",
                     "break long lists over several lines");
  }
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    const std::string meant = meant_in_line(text, error.source().begin.line);
    throw InputError(location(file, error.source()), {}, "not TOML: " + std::string(error.description()),
                     meant.empty() ? "values are numbers, true or false, \"texts\" or [lists]" : meant);
  }
}

/// The declarations of the file's model, errors about the model placed in the file.
std::vector<Key> declarations(const toml::table& root, const std::string& file, const std::optional<std::string>& named,
                              const KeysOf& keys_of) {
  const toml::node* node = root.get("model");
  std::string model = named.value_or("");
  Location where{file, 0, 0};
  if (node && !named) {
    where = location(file, node->source());
    const auto* text = node->as_string();
    if (!text) throw InputError(where, "model", "wrong type", "write the name of a model in quotes");
    model = text->get();
  }
  try {
    const std::span<const Key> common = common_keys();
    const std::span<const Key> own = keys_of(model);
    std::vector<Key> keys(common.begin(), common.end());
    keys.insert(keys.end(), own.begin(), own.end());
    return keys;
  } catch (const InputError& error) {
    const bool missing = !node && !named;
    throw InputError(where, "model", missing ? "the key is missing" : "unknown model '" + excerpt(model) + "'",
                     error.right());
  }
}

/// One --set: "key=value".
struct Override {
  std::string path;
  std::string text;  ///< the whole of it, for messages
  toml::table parsed;
};

Override parse_override(const std::string& text) {
  const Location where{"--set", 0, 0};
  const std::size_t equals = text.find('=');
  const std::string example = "write --set key=value, such as --set seed=2 or --set 'title=\"My title\"'";
  if (equals == std::string::npos) throw InputError(where, text, "there is no '='", example);
  const std::string path(trimmed(text.substr(0, equals)));
  const std::string value = text.substr(equals + 1);
  if (path.empty()) throw InputError(where, text, "there is no key before '='", example);
  if (value.find_first_not_of(" \t") == std::string::npos) {
    throw InputError(where, path, "there is no value after '='", example);
  }
  try {
    if (line_of_deep_nesting(value) > 0) {
      throw InputError(where, path, "lists and tables are nested more than " + std::to_string(most_nested) + " deep",
                       example);
    }
    if (line_of_many_dots(value) > 0) {
      throw InputError(where, path, "more than " + std::to_string(most_dots) + " dots", example);
    }
    toml::table parsed = toml::parse("value = " + value);
    if (parsed.size() != 1) throw InputError(where, path, "more than one value", example);
    return {path, text, std::move(parsed)};
  } catch (const toml::parse_error&) {
    const std::string meant = meant_by(trimmed(value), "--set " + path + "=");
    if (!meant.empty()) throw InputError(where, path, "'" + excerpt(value) + "' is not a TOML value", meant);
    throw InputError(where, path, "'" + excerpt(value) + "' is not a TOML value",
                     "texts and quantities need their quotes, which the shell takes away: --set '" + path + "=\"" +
                         excerpt(value) + "\"'");
  }
}

/// Every entry of a list of tables goes.
void drop_list(const std::string& list, ReadScenario& scenario) {
  const std::string start = list + "[";
  std::erase_if(scenario.values, [&](const auto& item) { return item.first.starts_with(start); });
  std::erase_if(scenario.counts, [&](const auto& item) { return item.first.starts_with(start); });
  scenario.counts[list] = 0;
}

void apply_override(const Override& override, const Declared& declared, ReadScenario& scenario) {
  const Location where{"--set", 0, 0};
  const std::string pattern = pattern_of(override.path);
  const Key* key = declared.find(pattern);
  if (!key) {
    if (declared.has_table(pattern + "[]")) {
      const auto* list = override.parsed.get("value")->as_array();
      if (list && list->empty()) return drop_list(override.path, scenario);
      throw InputError(where, override.path, "is a list of tables",
                       "name one table and key of it, as in " + override.path + "[0].KEY=VALUE, or drop all with " +
                           override.path + "=[]");
    }
    if (declared.has_table(pattern)) {
      throw InputError(where, override.path, "is a table, not a key", declared.advice_for(pattern + "."));
    }
    throw InputError(where, override.path, "unknown key", declared.advice_for(pattern));
  }
  for (std::size_t open = override.path.find('['); open != std::string::npos;
       open = override.path.find('[', open + 1)) {
    const std::string list = override.path.substr(0, open);
    const auto count = scenario.counts.find(list);
    const std::size_t size = count == scenario.counts.end() ? 0 : count->second;
    const std::size_t close = override.path.find(']', open);
    const std::string index = override.path.substr(open + 1, close - open - 1);
    const bool number =
        !index.empty() && index.size() < 7 && index.find_first_not_of("0123456789") == std::string::npos;
    if (!number || std::stoul(index) >= size) {
      throw InputError(where, override.path, "no such entry",
                       list + " has " + std::to_string(size) + " entries, counted from 0");
    }
  }
  scenario.values[override.path] = {convert(*key, *override.parsed.get("value"), where, override.path), where, true};
}

/// Lays `layer` over `scenario`. A list of tables replaces the list below it as a whole.
void lay_over(const Layer& layer, ReadScenario& scenario) {
  for (const auto& [list, count] : layer.counts) drop_list(list, scenario);
  for (const auto& [list, count] : layer.counts) scenario.counts[list] = count;
  for (const auto& [path, value] : layer.values) scenario.values[path] = value;
}

/// Every concrete path of a declared pattern: "mineral[].share" -> "mineral[0].share", ...
void concrete_paths(const std::string& pattern, const ReadScenario& scenario, std::vector<std::string>& paths) {
  const std::size_t open = pattern.find("[]");
  if (open == std::string::npos) {
    paths.push_back(pattern);
    return;
  }
  const std::string list = pattern.substr(0, open);
  const auto count = scenario.counts.find(list);
  for (std::size_t i = 0; count != scenario.counts.end() && i < count->second; ++i) {
    concrete_paths(list + "[" + std::to_string(i) + "]" + pattern.substr(open + 2), scenario, paths);
  }
}

/// The key that one without a value follows: "planes.{test}" names another key of its own table, whose word stands there.
std::string followed(const Key& key, const std::string& path, const ReadScenario& scenario) {
  const std::size_t open = key.otherwise.find('{'), close = key.otherwise.find('}');
  if (open == std::string::npos) return key.otherwise;
  const std::string beside = path.substr(0, path.rfind('.') + 1) + key.otherwise.substr(open + 1, close - open - 1);
  return key.otherwise.substr(0, open) + std::get<std::string>(scenario.values.at(beside).value) +
         key.otherwise.substr(close + 1);
}

/// Puts the defaults in, or says which required key is missing, at the table that lacks it.
void complete(const Declared& declared, const std::string& file, std::span<const Layer* const> layers,
              ReadScenario& scenario) {
  for (const Key& key : declared.keys()) {
    std::vector<std::string> paths;
    concrete_paths(key.path, scenario, paths);
    for (const std::string& path : paths) {
      if (scenario.values.contains(path)) continue;
      Location where{file, 0, 0};
      const std::size_t dot = path.rfind('.');
      for (const Layer* layer : layers) {
        const auto table = layer->tables.find(dot == std::string::npos ? std::string() : path.substr(0, dot));
        if (dot != std::string::npos && where.line == 0 && table != layer->tables.end()) where = table->second;
      }
      if (!key.standard.empty()) {
        scenario.values[path] = {standard_value(key), where, false};
        continue;
      }
      if (!key.otherwise.empty()) continue;
      throw InputError(where, path, "the key is missing", "add " + expectation(key) + " (" + key.help + ")");
    }
  }
  for (const Key& key : declared.keys()) {
    if (key.otherwise.empty()) continue;
    std::vector<std::string> paths;
    concrete_paths(key.path, scenario, paths);
    for (const std::string& path : paths) {
      if (scenario.values.contains(path)) continue;
      scenario.values[path] = scenario.values.at(followed(key, path, scenario));
      scenario.values[path].given = false;
    }
  }
}

/// The file named by the key `include`: by --set from the caller's folder, else from the folder of the scenario. Empty: none.
struct Included {
  std::string file;
  Location where;
};

Included included_file(const toml::table& root, const std::string& file, std::span<const Override> overrides) {
  Included found;
  const auto text = [](const toml::node* node, const Location& where) {
    const auto* word = node->as_string();
    if (!word) throw InputError(where, "include", "wrong type", "write the path of a file in quotes");
    const auto keys = common_keys();
    const auto include = std::ranges::find(keys, std::string("include"), &Key::path);
    return std::get<std::string>(convert(*include, *node, where, "include"));
  };
  if (const toml::node* node = root.get("include")) {
    found.where = location(file, node->source());
    const std::filesystem::path named = text(node, found.where);
    if (!named.empty()) found.file = file_beside(file, named).string();
  }
  for (const Override& override : overrides) {
    if (override.path != "include") continue;
    found.where = Location{"--set", 0, 0};
    found.file = text(override.parsed.get("value"), found.where);
  }
  return found;
}

/// Numbered entries only: "mineral[2]" is an index, "mineral[]" and "mineral[x]" are for the caller to refuse.
bool digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::string pattern_of(std::string_view path) {
  std::string pattern;
  for (std::size_t i = 0; i < path.size(); ++i) {
    pattern += path[i];
    if (path[i] != '[') continue;
    const std::size_t close = path.find(']', i);
    if (close != std::string_view::npos && digits(path.substr(i + 1, close - i - 1))) i = close - 1;
  }
  return pattern;
}

std::string read_text(const std::string& file) {
  namespace fs = std::filesystem;
  const fs::path path(file);
  std::error_code error;
  const bool folder = fs::is_directory(path, error);
  if (folder || !fs::exists(path, error)) {
    std::vector<std::string> near;
    const fs::path around = folder ? path : path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (fs::directory_iterator at(around, error), end; !error && at != end; at.increment(error)) {
      if (at->path().extension() == ".toml")
        near.push_back((folder || path.has_parent_path() ? at->path() : at->path().filename()).string());
    }
    std::ranges::sort(near);
    const std::string right =
        near.empty() ? "give the path of a scenario file (.toml)" : advice(file, near, "the scenarios there are");
    throw InputError(Location{file, 0, 0}, {}, folder ? "this is a folder, not a scenario" : "there is no such file",
                     right);
  }
  return read_input(path, largest_scenario, Location{file, 0, 0});
}

/// The name becomes a folder's, and a word of the report and of summary.json.
void check_name(const std::string& file) {
  const std::string name = std::filesystem::path(file).stem().string();
  const auto refuse = [&](const std::string& wrong, const std::string& right) {
    throw InputError(Location{file, 0, 0}, {}, wrong, right);
  };
  if (!is_utf8(name)) refuse("the name of the file is not UTF-8", "rename it, best to letters, digits, _ and -");
  if (printable(name) != name) {
    refuse("the name of the file has control characters", "rename it, best to letters, digits, _ and -");
  }
  if (name.size() > 200) refuse("the name of the file has " + std::to_string(name.size()) + " bytes", "at most 200 do");
}

ReadScenario read_scenario(const std::string& file, std::string_view scale, std::span<const std::string> overrides,
                           const KeysOf& keys_of) {
  const std::string bytes = read_text(file);
  check_name(file);
  const toml::table root = parse(bytes, file);
  std::vector<Override> parsed;
  std::optional<std::string> model;
  for (const std::string& text : overrides) {
    parsed.push_back(parse_override(text));
    if (parsed.back().path == "model") model = parsed.back().parsed["value"].value<std::string>();
  }
  const Declared declared(declarations(root, file, model, keys_of));

  Layer below;
  const Included include = included_file(root, file, parsed);
  if (!include.file.empty()) {
    std::error_code error;
    if (!std::filesystem::exists(include.file, error)) {
      throw InputError(include.where, "include", "there is no file " + excerpt(include.file),
                       "give the path of a file with keys to start from, seen from this file's folder");
    }
    const std::string text = read_input(include.file, largest_scenario, include.where, "include");
    if (text.empty()) {
      throw InputError(include.where, "include", excerpt(include.file) + " is empty", "give a file with keys");
    }
    const toml::table start = parse(text, include.file);
    for (const char* name : {"include", "scales"}) {
      if (const toml::node* node = start.get(name)) {
        throw InputError(location(include.file, node->source()), name, "does not belong into an included file",
                         "write it in the scenario itself");
      }
    }
    Walk walk(include.file, declared);
    walk.table(start, "", "", below);
    walk.throw_first();
  }

  Walk walk(file, declared);
  Layer base;
  std::map<std::string, Layer, std::less<>> scales;
  walk.table(root, "", "", base);
  if (const toml::node* node = root.get("scales")) walk.scales(*node, scales);
  walk.throw_first();

  const auto chosen = scales.find(scale);
  if (chosen == scales.end()) {
    std::vector<std::string> names;
    for (const std::string& name : scale_names) {
      if (scales.contains(name)) names.push_back(name);
    }
    throw InputError(Location{file, 0, 0}, "--scale", "this scenario has no scale '" + std::string(scale) + "'",
                     names.empty() ? "add a table [scales." + std::string(scale) + "], which may be empty"
                                   : "it has: " + joined(names));
  }
  ReadScenario scenario;
  scenario.included = include.file;
  lay_over(below, scenario);
  lay_over(base, scenario);
  lay_over(chosen->second, scenario);
  for (const Override& override : parsed) apply_override(override, declared, scenario);
  const std::array<const Layer*, 3> layers = {&base, &chosen->second, &below};
  complete(declared, file, layers, scenario);
  return scenario;
}

}  // namespace dem::scenario_detail
