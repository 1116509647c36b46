#include "engine/analysis/magnitudes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem::analysis {

MagnitudeBins bins_of(std::span<const double> magnitudes, double width) {
  MagnitudeBins bins{.width = width, .events = {}};
  if (magnitudes.empty()) return bins;
  const auto [low, high] = std::ranges::minmax(magnitudes);
  const auto at = [&](double m) { return static_cast<long>(std::floor(m / width + 0.5)); };
  const long first = at(low);
  bins.first = width * static_cast<double>(first);
  bins.events.assign(static_cast<std::size_t>(at(high) - first + 1), 0);
  for (const double m : magnitudes) ++bins.events[static_cast<std::size_t>(at(m) - first)];
  return bins;
}

double GutenbergRichter::at_least(double magnitude) const { return std::pow(10, a - b * magnitude); }

std::optional<GutenbergRichter> fit_magnitudes(std::span<const double> magnitudes, double width, std::size_t fewest) {
  const MagnitudeBins bins = bins_of(magnitudes, width);
  if (bins.events.empty()) return std::nullopt;
  constexpr double above_fullest = 0.2;
  const auto fullest = static_cast<std::size_t>(std::ranges::max_element(bins.events) - bins.events.begin());
  const std::size_t lowest = fullest + static_cast<std::size_t>(std::lround(above_fullest / width));
  GutenbergRichter fit;
  double sum = 0;
  for (std::size_t k = lowest; k < bins.events.size(); ++k) {
    fit.events += bins.events[k];
    sum += static_cast<double>(bins.events[k]) * bins.centre(k);
  }
  if (fit.events < std::max<std::size_t>(fewest, 2)) return std::nullopt;
  const auto n = static_cast<double>(fit.events);
  const double mean = sum / n;
  fit.complete_from = bins.centre(lowest);
  if (!(mean > fit.complete_from)) return std::nullopt;
  fit.b = std::log1p(width / (mean - fit.complete_from)) / (width * std::numbers::ln10);
  double squares = 0;
  for (std::size_t k = lowest; k < bins.events.size(); ++k)
    squares += static_cast<double>(bins.events[k]) * std::pow(bins.centre(k) - mean, 2);
  fit.error = std::numbers::ln10 * fit.b * fit.b * std::sqrt(squares / (n * (n - 1)));
  // All events of the fit lie at or above the lower end of its first bin.
  fit.a = std::log10(n) + fit.b * (fit.complete_from - 0.5 * width);
  return fit;
}

}  // namespace dem::analysis
