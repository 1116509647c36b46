#pragma once
// From a finished test to its record: tables, results and checks as the report reads them.
#include "engine/core/record.h"
#include "engine/texture/loading/loading.h"

namespace dem::texture {

/// Tables particles, grains, contacts, cracks, history, snapshots/NNNN; results by the names of summary.json; the
/// checks energy_residual (<= 1e-2), equilibrium (<= 1e-2) and, under confining pressure, servo (<= 1e-2). Identity
/// (case id, content, seed) is left to the caller.
Record make_record(const Specimen& specimen, const Settings& settings, const Loading& loading);

/// The record of a specimen that is not loaded: tables particles, grains, contacts; the check packing_pressure.
Record make_specimen_record(const Specimen& specimen, const Settings& settings);

}  // namespace dem::texture
