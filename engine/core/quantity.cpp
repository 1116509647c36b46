#include "engine/core/quantity.h"

#include <algorithm>
#include <stdexcept>

namespace dem {

bool Quantity::covers(std::string_view result) const {
  if (!family()) return result == id;
  const std::string_view start = id.substr(0, id.size() - 1);
  return result.size() > start.size() && result.starts_with(start);
}

bool Quantity::given_by(std::string_view test) const {
  if (tests.empty()) return true;
  for (std::string_view left = tests; !left.empty();) {
    const std::size_t end = std::min(left.find(' '), left.size());
    if (left.substr(0, end) == test) return true;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return false;
}

const ParameterValue* find_value(const Parameters& parameters, std::string_view id) {
  const auto at = std::ranges::find(parameters, id, [](const auto& p) -> std::string_view { return p.first; });
  return at == parameters.end() ? nullptr : &at->second;
}

const Quantity& find_quantity(std::span<const Quantity> declared, std::string_view result) {
  const auto at = std::ranges::find_if(declared, [&](const Quantity& q) { return q.covers(result); });
  if (at == declared.end()) throw std::out_of_range("no result '" + std::string(result) + "' is declared");
  return *at;
}

const Parameter& find_parameter(std::span<const Parameter> declared, std::string_view id) {
  const auto at = std::ranges::find(declared, id, &Parameter::id);
  if (at == declared.end()) throw std::out_of_range("no parameter '" + std::string(id) + "' is declared");
  return *at;
}

}  // namespace dem
