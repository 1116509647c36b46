#pragma once
// From a finished test to its record: tables, results and checks as the report reads them.
#include "engine/core/record.h"
#include "engine/texture/loading/loading.h"

namespace dem::texture {

/// Of a finished test: the tables particles, grains, contacts, cracks, history, snapshots/NNNN; the results of quantities.h;
/// the checks energy_residual, equilibrium and, under confining pressure, servo.
void add_test(Record& record, const Specimen& specimen, const Settings& settings, const Loading& loading);

/// Of a specimen that is not loaded: the tables particles, grains, contacts; the check packing_pressure.
void add_specimen(Record& record, const Specimen& specimen, const Settings& settings);

}  // namespace dem::texture
