#pragma once
// Inside of engine/scenario: one TOML value checked against the declaration of its key. The only header with toml++.
#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>

#include "engine/scenario/scenario.h"

namespace dem::scenario_detail {

/// The value in SI units. Throws InputError at `where` about `shown` (the key as the user wrote it).
Value convert(const Key& key, const toml::node& node, const Location& where, const std::string& shown);

/// The declared default; a default that does not pass its own declaration is our defect: std::logic_error.
Value standard_value(const Key& key);

/// "a quantity in mm, such as \"0.35 mm\""; "one of: a, b"; "a whole number from 1 to 10".
std::string expectation(const Key& key);

/// As much of a text as a message needs, fit for a terminal.
std::string excerpt(const std::string& text);

/// What "True", "yes" or "off" was meant to say.
std::optional<bool> truth_of(std::string word);

Location location(const std::string& file, const toml::source_region& source);

}  // namespace dem::scenario_detail
