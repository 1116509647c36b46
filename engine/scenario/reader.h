#pragma once
// Inside of engine/scenario: from TOML to checked values. Scenario::read() is the way in.
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "engine/scenario/scenario.h"

namespace dem::scenario_detail {

struct ReadValue {
  Value value;
  Location where;
  bool given = false;
};

struct ReadScenario {
  std::map<std::string, ReadValue, std::less<>> values;  ///< by path with indices: "mineral[0].share"
  std::map<std::string, std::size_t, std::less<>> counts;
  std::string included;  ///< path of the included file; empty: none
};

using KeysOf = std::function<std::span<const Key>(std::string_view model)>;

ReadScenario read_scenario(const std::string& file, std::string_view scale, std::span<const std::string> overrides,
                           const KeysOf& keys_of);

/// "mineral[3].share" -> "mineral[].share"
std::string pattern_of(std::string_view path);

/// The bytes of a scenario file; InputError when it is missing, a folder, or cannot be read.
std::string read_text(const std::string& file);

}  // namespace dem::scenario_detail
