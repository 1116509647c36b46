#include "reports/comparison/tolerances.h"

#include <toml++/toml.h>
#include <array>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/scenario/suggest.h"

namespace comparison {
namespace {

constexpr std::uint64_t largest_file = 1 << 20;

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  std::vector<Tolerance> read(const std::string& text) {
    std::vector<Tolerance> all;
    try {
      const toml::table table = toml::parse(text, file_);
      for (const auto& [key, node] : table) {
        if (key != "tolerance" || !node.is_array_of_tables()) {
          refuse(node, std::string(key), "unknown key", "write tables [[tolerance]]");
        }
        for (const toml::node& one : *node.as_array()) all.push_back(tolerance(*one.as_table()));
      }
    } catch (const toml::parse_error& error) {
      throw dem::InputError(place(error.source()), {}, std::string(error.description()), "correct the TOML");
    }
    return all;
  }

 private:
  [[nodiscard]] dem::Location place(const toml::source_region& source) const {
    return {file_, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
  }
  [[noreturn]] void refuse(const toml::node& node, const std::string& key, const std::string& wrong,
                           const std::string& right) const {
    throw dem::InputError(place(node.source()), key, wrong, right);
  }

  std::string text(const toml::node& node, const std::string& key) const {
    const auto value = node.value<std::string>();
    if (!value || value->empty()) refuse(node, key, "this is no text, or an empty one", "write " + key + " = \"...\"");
    return *value;
  }
  double number(const toml::node& node, const std::string& key) const {
    const auto value = node.value<double>();
    if (!value || !(*value > 0))
      refuse(node, key, "this is no number above 0", "write, for example, " + key + " = 0.01");
    return *value;
  }

  Tolerance tolerance(const toml::table& table) const {
    Tolerance one;
    for (const auto& [name, node] : table) {
      const std::string key(name);
      if (key == "study") {
        one.study = text(node, key);
      } else if (key == "item") {
        one.item = text(node, key);
      } else if (key == "reason") {
        one.reason = text(node, key);
      } else if (key == "relative") {
        one.relative = number(node, key);
      } else if (key == "absolute") {
        one.absolute = number(node, key);
      } else if (key == "share") {
        one.share = number(node, key);
      } else {
        const std::vector<std::string> known = {"study", "item", "relative", "absolute", "share", "reason"};
        refuse(node, key, "unknown key", dem::advice(key, known, "the keys are"));
      }
    }
    if (one.item.empty()) refuse(table, "item", "it is missing", "say what the tolerance is for: item = \"results/*\"");
    if (one.reason.empty()) refuse(table, "reason", "it is missing", "say why: the page shows it beside each number");
    if ((one.relative > 0) + (one.absolute > 0) + (one.share > 0) != 1) {
      refuse(table, one.item, "a tolerance is one number", "give one of relative, absolute and share");
    }
    return one;
  }

  std::string file_;
};

}  // namespace

std::vector<Tolerance> read_tolerances(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "tolerances.toml";
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  return Reader(path.string()).read(dem::read_input(path, largest_file, {path.string()}));
}

const Tolerance* find_tolerance(const std::vector<Tolerance>& all, std::string_view study, std::string_view item) {
  for (const Tolerance& one : all) {
    if (fits_pattern(one.study, study) && fits_pattern(one.item, item)) return &one;
  }
  return nullptr;
}

bool fits_pattern(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, mark = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      mark = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p, ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++mark;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace comparison
