#pragma once
// The close-packed lattice (Liu et al. 2017) as the study runner sees it.
#include "engine/lattice/keys.h"
#include "engine/model/model.h"

namespace dem::lattice {

/// The entry for the table of models: name "lattice".
Model model();

/// Tables and results of a finished strength test, added to `record`.
void add_strength(Record& record, const Settings& settings, const Block& block, const StrengthTest& test);
/// The same for an elastic series.
void add_elastic(Record& record, const Settings& settings, const Block& block, const std::vector<ElasticPoint>& points);
/// Elements and bonds at rest.
void add_block(Record& record, const Block& block);

}  // namespace dem::lattice
