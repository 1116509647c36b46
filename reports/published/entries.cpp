#include "reports/published/entries.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace reports {
namespace {

using Json = nlohmann::json;

using Names = std::set<std::string, std::less<>>;

[[noreturn]] void wrong(const std::string& id, const std::string& what) {
  throw std::invalid_argument("entry “" + id + "”: " + what);
}

void check_members(const Json& entry, const std::string& id, const Names& needed, const Names& allowed) {
  for (const std::string& name : needed) {
    if (!entry.contains(name)) wrong(id, "the member “" + name + "” is missing");
  }
  for (const auto& [name, value] : entry.items()) {
    if (!needed.contains(name) && !allowed.contains(name)) wrong(id, "there is no member “" + name + "”");
  }
}

void check_tolerance(const Json& entry, const std::string& id) {
  const Json& tolerance = entry.at("tolerance");
  if (tolerance.size() != 1 || !(tolerance.contains("relative") || tolerance.contains("absolute"))) {
    wrong(id, "the tolerance is {\"relative\": X} or {\"absolute\": X}");
  }
  if (!(tolerance.front().get<double>() >= 0)) wrong(id, "the tolerance is negative");
  const Json& published = entry.at("published");
  const bool zero = published.is_array() ? published.at(0) == 0.0 || published.at(1) == 0.0 : published == 0.0;
  if (tolerance.contains("relative") && zero) wrong(id, "a tolerance relative to nothing");
}

void check_kind(const Json& entry, const std::string& id) {
  const Names needed = {"id", "topics", "source", "quantity", "kind", "of"};
  const Names allowed = {"unit",    "statement", "optional", "scale",    "fitted",    "theory",
                         "follows", "stated",    "derived",  "readings", "of_loading"};
  const auto with = [](Names names, std::initializer_list<const char*> more) {
    names.insert(more.begin(), more.end());
    return names;
  };
  const std::string kind = entry.at("kind").get<std::string>();
  if (kind == "value") {
    check_members(entry, id, with(needed, {"published", "tolerance"}), allowed);
    check_tolerance(entry, id);
  } else if (kind == "trend") {
    check_members(entry, id, with(needed, {"published", "over"}), with(allowed, {"published_values", "resolution"}));
    if (entry.at("published") != "rises" && entry.at("published") != "falls") wrong(id, "a trend rises or falls");
  } else if (kind == "greater") {
    check_members(entry, id, with(needed, {"than"}), with(allowed, {"resolution"}));
  } else {
    wrong(id, "the kind “" + kind + "” is none of value, trend, greater");
  }
}

void check_role(const Json& entry, const std::string& id) {
  const int roles = static_cast<int>(entry.contains("fitted")) + static_cast<int>(entry.contains("theory")) +
                    static_cast<int>(entry.contains("follows")) +
                    static_cast<int>(entry.contains("stated") && !entry.contains("fitted"));
  if (roles > 1) wrong(id, "one of fitted, theory, follows and stated at most, but stated beside fitted");
  if (entry.contains("stated") && entry.contains("derived")) wrong(id, "a statement in words is not derived");
  const std::array<std::pair<const char*, const char*>, 4> texts{
      {{"fitted", "why"}, {"theory", "why"}, {"stated", "the paper’s words"}, {"derived", "from what"}}};
  for (const auto& [name, what] : texts) {
    if (entry.contains(name) && entry.at(name).get<std::string>().empty()) {
      wrong(id, "the member “" + std::string(name) + "” says " + what);
    }
  }
  constexpr std::array<std::string_view, 5> scales{"any", "smoke", "draft", "paper", "high"};
  if (entry.contains("scale") && std::ranges::find(scales, entry.at("scale").get<std::string>()) == scales.end()) {
    wrong(id, "there is no scale " + entry.at("scale").dump());
  }
}

}  // namespace

void check_entries(const Json& file) {
  Names ids;
  const auto add = [&](const std::string& id) {
    if (!ids.insert(id).second) wrong(id, "the id is there twice");
  };
  for (const Json& entry : file.at("numbers")) {
    const std::string id = entry.at("id").get<std::string>();
    add(id);
    check_kind(entry, id);
    check_role(entry, id);
    for (const Json& reading : entry.value("readings", Json::array())) {
      const std::string name = reading.at("id").get<std::string>();
      add(name);
      check_members(reading, name, {"id", "reading", "of"}, entry.at("kind") == "greater" ? Names{"than"} : Names{});
    }
  }
  for (const Json& entry : file.at("numbers")) {
    const std::string id = entry.at("id").get<std::string>();
    for (const std::string& other : declared_role(entry).of) {
      if (other == id || !ids.contains(other)) wrong(id, "it cannot follow from “" + other + "”");
    }
  }
  for (const Json& entry : file.value("quoted", Json::array())) {
    const std::string id = entry.at("id").get<std::string>();
    add(id);
    check_members(entry, id, {"id", "source", "quantity", "published"}, {"unit"});
  }
  for (const Json& entry : file.value("unchecked", Json::array())) {
    check_members(entry, entry.value("statement", "?"), {"source", "statement", "why"}, {});
  }
}

Declared declared_role(const Json& entry) {
  if (entry.contains("fitted")) return {Role::fitted, entry.at("fitted").get<std::string>(), {}};
  if (entry.contains("theory")) return {Role::theory, entry.at("theory").get<std::string>(), {}};
  if (entry.contains("stated")) return {Role::stated, "", {}};
  if (entry.contains("follows")) return {Role::follows, "", entry.at("follows").get<std::vector<std::string>>()};
  if (entry.contains("derived")) return {Role::derived, "", {}};
  return {};
}

}  // namespace reports
