#pragma once
// The entries of assets/papers/PAPER/published.json as they must be; their form is told in published.h.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/published/verdict.h"

namespace reports {

/// Throws std::invalid_argument naming the entry and its member: one that is unknown or missing, an id that is there twice or
/// that nothing has, a tolerance or scale that means nothing, two roles at once.
void check_entries(const nlohmann::json& file);

/// What an entry declares itself to be.
struct Declared {
  Role role = Role::number;
  std::string why;              ///< of a fitted row: which choice; of theory: what is compared
  std::vector<std::string> of;  ///< ids of the rows that it follows from
};
Declared declared_role(const nlohmann::json& entry);

}  // namespace reports
