#pragma once
// Whether a run went on beyond the peak of its curve: the largest value of one that still rose at its end is no peak.
#include <span>
#include <string_view>

#include "engine/core/record.h"

namespace dem::analysis {

/// The share of its largest value that a stress must have lost at the end of a run before it is called a peak. A load step
/// of the sheet can lose a fifth and have it back in the next.
inline constexpr double peak_fall = 0.25;

/// Of a record of the sheet: whether the differential stress on the walls ends below its largest value by peak_fall or more.
/// True for other records: their tests follow the stress beyond its peak, or give no strength.
bool passed_peak(const Record& record);

/// What a result is called: its peak_name where it has one and every record passed its peak, else its name; growth instead of
/// strain where the test of all is the growth of grains.
std::string_view name_of(const Quantity& quantity, std::span<const Record* const> records);

}  // namespace dem::analysis
