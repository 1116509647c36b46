#pragma once
// When a test ends: the rules of all tests, and how far a test is followed after its end.
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/texture/loading/history.h"

namespace dem::texture {

/// The limits of one test. No rule ends a test before its stress has reached 0.1 MPa.
struct Ending {
  double stop = 0.8;        ///< it ends at this share of the peak stress, after it
  double strain_limit = 0;  ///< or at this multiple of the strain of the peak, and not below a strain of 1e-3; 0: never
  double follow = 0;        ///< it goes on after its end to this multiple of the strain of the peak
};

/// The row at which a rule ends the test; absent while none does.
std::optional<std::size_t> end_row(const std::vector<HistoryRow>& history, const Ending& ending);

/// Whether the test has ended and has been followed as far as was asked for.
bool is_over(const std::vector<HistoryRow>& history, const Ending& ending);

}  // namespace dem::texture
