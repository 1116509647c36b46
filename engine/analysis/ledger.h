#pragma once
// The energy ledger of a record: every column of its history that is an energy, whatever the model.
// Columns whose name begins or ends with "work" come in, "residual" is what is left, all others are where the energy is
// or went. A sheet keeps its energies without a unit: multiples of the elastic constant k times the box's width squared.
#include <string>
#include <vector>

#include "engine/core/record.h"

namespace dem::analysis {

struct LedgerTerm {
  std::string column;  ///< of the history table
  std::string label;   ///< "Damping"
  enum class Role { work, share, residual } role = Role::share;
};

/// The energy columns of a history, in its order; empty when it keeps none.
std::vector<LedgerTerm> ledger_terms(const Table& history);

/// True for the energies of a sheet: not joules.
bool in_elastic_constants(const Table& history);

}  // namespace dem::analysis
