#pragma once
// Energy plots for any model: what a history's ledger holds, stacked, under the work that came in.
#include <vector>

#include "reports/figures/parts.h"

namespace reports {

/// One panel a case (stacked energies and the work as a line) and one with the residuals of all cases against the limit of
/// their check "energy_residual". Cases without a ledger get a note.
FigureContent energy_figure(const StudyResult& study, std::string_view test, const std::vector<SeriesCase>& cases,
                            const std::string& x_column, const std::string& x_title, double x_factor);

}  // namespace reports
