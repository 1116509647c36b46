#pragma once
// When a test ends: the rules of all tests, and how far a test is followed after its end.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/texture/loading/history.h"

namespace dem::texture {

/// No rule ends a test before its stress has reached so much, Pa: it cannot end on the noise before it has begun.
inline constexpr double least_peak = 1e5;

/// The limits of one test. The rules (`stop`, `strain_limit`) say that it has ended in failure; a test that none of them
/// ends is given up at its limits (`largest_strain`, `most_steps`): a specimen may hang together by nothing, or harden on.
struct Ending {
  double stop = 0.8;        ///< it ends at this share of the peak stress, after it
  double least_cracks = 0;  ///< a fall with fewer cracks is a local one and ends nothing, unless to half of the peak
  double strain_limit = 0;  ///< or at this multiple of the strain of the peak, and not below a strain of 1e-3; 0: never
  double follow = 0;        ///< it goes on after its end to this multiple of the strain of the peak
  double follow_strain = 0;     ///< and to this strain of the ends
  double largest_strain = 0;    ///< of the ends; it is given up there, ended or not; 0: no limit
  std::int64_t most_steps = 0;  ///< of the test proper; it is given up after so many; 0: no limit
};

/// The row at which a rule ends the test; absent while none does.
std::optional<std::size_t> end_row(const std::vector<HistoryRow>& history, const Ending& ending);

/// The limit that the last row has come to, as the end of its key: "largest_strain", "most_steps"; empty: none.
std::string_view limit_reached(const std::vector<HistoryRow>& history, const Ending& ending);

/// Whether the test has ended and has been followed as far as was asked for, or has come to a limit.
bool is_over(const std::vector<HistoryRow>& history, const Ending& ending);

}  // namespace dem::texture
