#pragma once
// Numbers of events by magnitude: log10 N(>= M) = a - b M (Gutenberg & Richter 1944).
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace dem::analysis {

/// Events in bins of `width`, centred at its multiples.
struct MagnitudeBins {
  double first = 0, width = 0.1;  ///< centre of the first bin
  std::vector<std::size_t> events;
  [[nodiscard]] double centre(std::size_t k) const { return first + width * static_cast<double>(k); }
};
MagnitudeBins bins_of(std::span<const double> magnitudes, double width = 0.1);

struct GutenbergRichter {
  double b = 0, error = 0;                                ///< standard error (Shi & Bolt 1982)
  double a = 0;                                           ///< of all events that the fit counts
  double complete_from = 0;                               ///< M_c, centre of the lowest bin that is fitted
  double p = 0;                                           ///< of a catalogue of the law (goodness.h)
  std::size_t events = 0;                                 ///< in it and above
  [[nodiscard]] double at_least(double magnitude) const;  ///< number of events
  [[nodiscard]] bool holds() const;                       ///< it is not ruled out
};

/// Complete from the fullest bin (maximum curvature, Wiemer & Wyss 2000), plus 0.2 (Woessner & Wiemer 2005), or from `from` if
/// that is higher; then from the lowest bin on from which the law is not ruled out (as their goodness of fit, here by goodness.h).
/// Where there is none, the first of these fits. b by maximum likelihood for bins (Tinti & Mulargia 1987):
/// ln(1 + w / (mean - M_c)) / (w ln 10), which is Aki's (1965) as the width w goes to zero and does not have the bias of Bender's
/// (1983) examples. Nothing where fewer than `fewest` events are left.
std::optional<GutenbergRichter> fit_magnitudes(std::span<const double> magnitudes, double width = 0.1,
                                               std::size_t fewest = 30, double from = -1e9);

}  // namespace dem::analysis
