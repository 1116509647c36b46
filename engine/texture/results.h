#pragma once
// From a finished test to its record: tables, results and checks as the report reads them.
#include "engine/core/record.h"
#include "engine/texture/loading.h"

namespace dem::texture {

/// Tables particles, grains, contacts, cracks, history, snapshots/NNNN; results by the names of summary.json; the checks
/// energy_residual (<= 1) and equilibrium. Identity (case id, content, seed) is left to the caller.
Record make_record(const Specimen& specimen, const Settings& settings, const LoadingTest& test);

}  // namespace dem::texture
