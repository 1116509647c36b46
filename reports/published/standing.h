#pragma once
// What stands before "Ours" of a figure that has a published statement: whether ours agrees with it.
#include "reports/drawn.h"
#include "reports/published/published.h"

namespace reports {

/// Sets agreement and standing of a figure that has a statement, by the published numbers that it stands on: one that is missed
/// makes it disagree, one that is undecided or not computed leaves it undecided. At another scale than the published one the
/// same rule is applied to what is compared there, and the words name the scale. A figure without such numbers, or with
/// none that could be computed, keeps the agreement that it found itself; with neither it has no standing.
void set_standing(DrawnFigure& figure, const Comparisons& comparisons, const std::string& scale);

}  // namespace reports
