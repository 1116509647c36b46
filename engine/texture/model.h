#pragma once
// The grain texture model (Zhao et al. 2021) as the study runner sees it.
#include <string_view>

#include "engine/model/model.h"
#include "engine/texture/setup.h"

namespace dem::texture {

/// The entry for the table of models: name "grain_texture".
Model model();

/// Settings of one case in the test of that name, from its resolved scenario. Throws InputError for values that are
/// wrong together, and for a test that there is not.
Settings read_settings(const Scenario& scenario, std::string_view test);

}  // namespace dem::texture
