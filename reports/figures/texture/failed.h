#pragma once
// Specimens after failure, whatever the test: which ones figures on cracks, events and fragments look at, and what they are.
#include <string_view>
#include <vector>

#include "reports/figures/parts.h"
#include "reports/granite.h"

namespace reports::texture {

/// Brazilian discs by their jaws: "flat platens", "jaws of 1.5 R".
std::vector<SeriesCase> discs_of(const StudyResult& study);

/// All tests of the study that break something: compressions along the swept parameter, cylinders with unloading loops, discs,
/// bars, half discs and blocks, one direct tension, and the compression of each mineral alone. Labels tell them apart; ids,
/// colours and lines are of this list.
std::vector<SeriesCase> failed(const StudyResult& study);
/// Which of these tests have cases without a result.
void add_missing_failed(FigureContent& content, const StudyResult& study);

/// Pictures of them beside each other: fewer of bodies that are wide.
int pictures_per_row(const std::vector<SeriesCase>& cases);

/// Whether a test breaks a cylinder along its axis.
bool is_of_cylinder(const dem::Record& record);
/// The body: a cylinder, a disc, or the box that holds a half disc, a bar or a block.
render::Outline outline_of(const dem::Record& record);
/// What is pushed together along which axis: "the load is along z", "the shear is along x".
std::string_view load_words(const dem::Record& record);

}  // namespace reports::texture
