#include "engine/scenario/scenario.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "engine/scenario/reader.h"
#include "engine/scenario/units.h"

namespace dem {
namespace {

[[noreturn]] void defect(std::string_view path, const std::string& what) {
  throw std::logic_error("scenario key '" + std::string(path) + "' " + what);
}

template <class T>
const T& typed(const Value& value, std::string_view path) {
  const T* found = std::get_if<T>(&value);
  if (!found) defect(path, "is asked for as another type than it is declared");
  return *found;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n') {
      out += "\\n";
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out + "\"";
}

std::string written(bool value) { return value ? "true" : "false"; }
std::string written(std::int64_t value) { return std::to_string(value); }
std::string written(double value) { return shortest(value); }
std::string written(const std::string& value) { return quoted(value); }
template <class T>
std::string written(const std::vector<T>& values) {
  std::string text = "[";
  for (const T& value : values) text += (text.size() > 1 ? ", " : "") + written(value);
  return text + "]";
}

std::string line_of(const std::string& path, const Value& value) {
  return path + " = " + std::visit([](const auto& v) { return written(v); }, value) + "\n";
}

}  // namespace

Scenario Scenario::read(const std::string& file, std::string_view scale, std::span<const std::string> overrides,
                        const std::function<std::span<const Key>(std::string_view model)>& keys_of) {
  scenario_detail::ReadScenario read = scenario_detail::read_scenario(file, scale, overrides, keys_of);
  Scenario scenario;
  scenario.name_ = std::filesystem::path(file).stem().string();
  scenario.file_ = file;
  scenario.included_ = read.included;
  scenario.scale_ = scale;
  for (auto& [path, item] : read.values) {
    scenario.entries_[path] = {std::move(item.value), std::move(item.where), item.given, {}};
  }
  scenario.counts_ = std::move(read.counts);
  return scenario;
}

const Scenario::Entry& Scenario::entry(std::string_view path) const {
  const auto at = entries_.find(path);
  if (at == entries_.end()) defect(path, "is not declared");
  return at->second;
}

bool Scenario::boolean(std::string_view path) const { return typed<bool>(entry(path).value, path); }
std::int64_t Scenario::integer(std::string_view path) const { return typed<std::int64_t>(entry(path).value, path); }
double Scenario::real(std::string_view path) const {
  const Value& value = entry(path).value;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return typed<double>(value, path);
}
const std::string& Scenario::text(std::string_view path) const { return typed<std::string>(entry(path).value, path); }
const std::vector<std::int64_t>& Scenario::integers(std::string_view path) const {
  return typed<std::vector<std::int64_t>>(entry(path).value, path);
}
const std::vector<double>& Scenario::reals(std::string_view path) const {
  return typed<std::vector<double>>(entry(path).value, path);
}
const std::vector<std::string>& Scenario::texts(std::string_view path) const {
  return typed<std::vector<std::string>>(entry(path).value, path);
}
const Value& Scenario::value(std::string_view path) const { return entry(path).value; }
bool Scenario::declares(std::string_view path) const { return entries_.contains(path); }
std::size_t Scenario::count(std::string_view list) const {
  const auto at = counts_.find(list);
  return at == counts_.end() ? 0 : at->second;
}
bool Scenario::given(std::string_view path) const {
  const auto at = entries_.find(path);
  if (at != entries_.end()) return at->second.given;
  return counts_.contains(path);
}

Scenario Scenario::with(std::string_view path, Value value, std::string_view source) const& {
  return Scenario(*this).with(path, std::move(value), source);
}
Scenario Scenario::with(std::string_view path, Value value, std::string_view source) && {
  if (entry(path).value.index() != value.index()) defect(path, "is replaced by a value of another type");
  Entry& replaced = entries_.find(path)->second;
  replaced.value = std::move(value);
  if (!source.empty() && source != path) {
    replaced.source = source;
    replaced.where = entry(source).where;
  }
  return std::move(*this);
}

InputError Scenario::error(std::string_view path, const std::string& wrong, std::string right) const {
  Location where{file_, 0, 0};
  const auto at = entries_.find(path);
  if (at != entries_.end()) {
    where = at->second.where;
    if (!at->second.source.empty()) return {where, at->second.source, wrong, std::move(right)};
  } else {
    // A table or a list: where its first given key stands.
    for (const auto& [name, entry] : entries_) {
      const bool inside =
          name.size() > path.size() && name.starts_with(path) && (name[path.size()] == '.' || name[path.size()] == '[');
      const bool earlier = where.line == 0 || entry.where.line < where.line;
      if (inside && entry.given && entry.where.line > 0 && earlier) where = entry.where;
    }
  }
  return {where, std::string(path), wrong, std::move(right)};
}

std::filesystem::path file_beside(const std::filesystem::path& scenario, const std::filesystem::path& named) {
  const std::filesystem::path beside = scenario.parent_path() / named;  // `named` itself when it is absolute
  std::error_code error;
  if (std::filesystem::exists(beside, error) || !std::filesystem::is_symlink(scenario, error)) return beside;
  const std::filesystem::path target = std::filesystem::canonical(scenario, error);
  if (error) return beside;
  const std::filesystem::path there = target.parent_path() / named;
  return std::filesystem::exists(there, error) ? there : beside;
}

std::string Scenario::canonical() const {
  std::string text;
  for (const auto& [path, entry] : entries_) text += line_of(path, entry.value);
  return text;
}

std::string Scenario::line(std::string_view path) const { return line_of(std::string(path), entry(path).value); }

std::vector<std::pair<std::string, const Key*>> Scenario::given_keys(std::span<const Key> declared) const {
  std::vector<std::pair<std::string, const Key*>> given;
  for (const auto& [path, entry] : entries_) {
    if (!entry.given) continue;
    const auto key = std::ranges::find(declared, scenario_detail::pattern_of(path), &Key::path);
    if (key != declared.end()) given.emplace_back(path, &*key);
  }
  return given;
}

std::string Scenario::canonical(std::span<const std::string> declared) const {
  std::string text;
  for (const auto& [path, entry] : entries_) {
    if (std::ranges::find(declared, scenario_detail::pattern_of(path)) != declared.end())
      text += line_of(path, entry.value);
  }
  return text;
}

}  // namespace dem
