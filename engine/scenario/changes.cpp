#include "engine/scenario/changes.h"

#include <algorithm>
#include <charconv>
#include <map>

#include "engine/scenario/units.h"

namespace dem {
namespace {

using Lines = std::map<std::string, std::string, std::less<>>;

/// "path = value" lines; a line of another form stands for itself.
Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    const std::size_t equals = line.find(" = ");
    if (equals == std::string_view::npos) {
      if (!line.empty()) lines[std::string(line)] = "";
    } else {
      lines[std::string(line.substr(0, equals))] = line.substr(equals + 3);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool matches(std::string_view pattern, std::string_view path) {
  while (!pattern.empty() && !path.empty()) {
    if (pattern.front() != path.front()) return false;
    const bool index = pattern.starts_with("[]");
    pattern.remove_prefix(index ? 2 : 1);
    path.remove_prefix(index ? std::min(path.find(']'), path.size() - 1) + 1 : 1);
  }
  return pattern.empty() && path.empty();
}

/// The numbers of "2.92e+08" or "[1, 2]" in the declared unit, as a person writes them.
std::string in_words(std::string_view value, std::string_view unit) {
  std::string text;
  while (!value.empty()) {
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error == std::errc()) {
      text += in_unit(number, unit);
      value.remove_prefix(static_cast<std::size_t>(end - value.data()));
    } else {
      text += value.front();
      value.remove_prefix(1);
    }
  }
  return text;
}

std::string shown(const Lines& lines, const std::string& path, std::span<const Key> keys) {
  const auto at = lines.find(path);
  if (at == lines.end()) return "(none)";
  for (const Key& key : keys) {
    const bool number = key.type == KeyType::real || key.type == KeyType::reals;
    if (number && !key.unit.empty() && matches(key.path, path)) return in_words(at->second, key.unit);
  }
  return at->second;
}

}  // namespace

std::vector<std::string> changed_lines(std::string_view before, std::string_view now, std::span<const Key> keys) {
  const Lines old_lines = lines_of(before);
  const Lines new_lines = lines_of(now);
  Lines all = old_lines;
  all.insert(new_lines.begin(), new_lines.end());
  std::vector<std::string> changed;
  for (const auto& [path, unused] : all) {
    const auto a = old_lines.find(path);
    const auto b = new_lines.find(path);
    if (a != old_lines.end() && b != new_lines.end() && a->second == b->second) continue;
    changed.push_back(path + ": " + shown(old_lines, path, keys) + " -> " + shown(new_lines, path, keys));
  }
  return changed;
}

std::string changes(std::string_view before, std::string_view now, std::span<const Key> keys) {
  if (before == now) return {};
  constexpr std::size_t most = 4;  // more would hide what matters
  const std::vector<std::string> changed = changed_lines(before, now, keys);
  std::string text;
  for (std::size_t i = 0; i < std::min(changed.size(), most); ++i) text += (i > 0 ? ", " : "") + changed[i];
  if (changed.size() > most) text += " and " + std::to_string(changed.size() - most) + " more";
  return text.empty() ? "the order of its content" : text;
}

}  // namespace dem
