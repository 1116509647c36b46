#pragma once
// The end of loading of a granite test: where its rules end it (the stress has fallen to `stop` of the peak, or the strain has
// come to `strain_limit` of the peak's). Cracks, snapshots, fragments and events of a record are those up to there; its history
// goes on where the test was followed further for a residual (`follow`).
#include <cstddef>

#include "engine/core/record.h"

namespace dem::analysis {

/// Whether the record keeps that moment.
bool has_end_of_loading(const Record& record);

/// Its row of the history; the last row where the record keeps no such moment.
std::size_t end_of_loading(const Record& record);

/// Whether the history goes on beyond it.
bool is_followed(const Record& record);

}  // namespace dem::analysis
