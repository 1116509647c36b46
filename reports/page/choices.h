#pragma once
// Which declared choices and citations are about a study.
#include <nlohmann/json_fwd.hpp>

#include "reports/figure.h"

namespace reports {

/// Entries of choices.json or citations.json without those about the paper's rock (`rock`) where another one is studied, and
/// those about a `test`, a pressure (`confined`), a kind of `specimen` ("grains", "one mineral"), a key's value (`when`;
/// `unless`: about all others) or a `varied` parameter that the study does not have. Conditions are taken off, and keys in
/// braces in `text` become the scenario's values.
nlohmann::json about(const StudyResult& study, const nlohmann::json& entries);

}  // namespace reports
