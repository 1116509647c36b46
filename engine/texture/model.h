#pragma once
// The grain texture model (Zhao et al. 2021) as the study runner sees it.
#include "engine/model/model.h"
#include "engine/texture/setup.h"

namespace dem::texture {

/// The entry for the table of models: name "grain_texture".
Model model();

/// Settings of one case from its resolved scenario. Throws InputError for values that are wrong together.
Settings read_settings(const Scenario& scenario, TestKind test);

}  // namespace dem::texture
