#pragma once
// The spring sheet as the study runner sees it.
//
// Tables of a record (lengths in box widths, stresses and energies in units of the elastic constant k, which stands for
// 10 GPa):
//   particles       position (2), radius, grain, fixed; attributes columns, rows, shift of the first row
//   grains          flynn, elastic constant, growth;  outlines: flynn, point (2)
//   cracks          step, strain, mode (0 tension), place (0 intra, 1 inter grain), position (2), trend, ratio, margin
//   history         one row a load step
//   snapshots/NNNN  displacement (2), mean and differential stress of each particle; attribute strain
#include "engine/model/model.h"
#include "engine/sheet/keys.h"

namespace dem::sheet {

/// The entry for the table of models: name "sheet".
Model model();

/// Mean and differential stress, and displacement, of every particle.
Table snapshot_table(const std::string& name, const Specimen& specimen, const Experiment& experiment);
/// All tables, results and checks of a finished run.
void add_results(Record& record, const Settings& settings, const Specimen& specimen, const Experiment& experiment,
                 const SolverWork& work);

}  // namespace dem::sheet
