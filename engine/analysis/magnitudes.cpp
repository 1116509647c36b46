#include "engine/analysis/magnitudes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/analysis/goodness.h"

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

bool GutenbergRichter::holds() const { return p >= least_p; }

double GutenbergRichter::at_least(double magnitude) const { return std::pow(10, a - b * magnitude); }

namespace {

// The law by the mean of what lies above the lowest bin, in bins: a share of q^k lies k bins or more above it.
std::optional<Tail> tail_of(std::span<const std::int32_t> above) {
  const double mean = std::accumulate(above.begin(), above.end(), 0.0) / static_cast<double>(above.size());
  if (!(mean > 0)) return std::nullopt;
  const double q = mean / (1 + mean);
  return [q](std::int64_t k) { return std::pow(q, static_cast<double>(k)); };
}

std::optional<GutenbergRichter> fit_from(const MagnitudeBins& bins, std::size_t lowest) {
  GutenbergRichter fit;
  std::vector<std::int32_t> above;
  double sum = 0;
  for (std::size_t k = lowest; k < bins.events.size(); ++k) {
    above.insert(above.end(), bins.events[k], static_cast<std::int32_t>(k - lowest));
    sum += static_cast<double>(bins.events[k]) * bins.centre(k);
  }
  fit.events = above.size();
  const auto n = static_cast<double>(fit.events);
  const double mean = sum / n, width = bins.width;
  fit.complete_from = bins.centre(lowest);
  if (!(mean > fit.complete_from)) return std::nullopt;
  const auto p = plausibility(above, 0, tail_of);
  if (!p) return std::nullopt;
  fit.p = *p;
  fit.b = std::log1p(width / (mean - fit.complete_from)) / (width * std::numbers::ln10);
  double squares = 0;
  for (std::size_t k = lowest; k < bins.events.size(); ++k)
    squares += static_cast<double>(bins.events[k]) * std::pow(bins.centre(k) - mean, 2);
  fit.error = std::numbers::ln10 * fit.b * fit.b * std::sqrt(squares / (n * (n - 1)));
  // All events of the fit lie at or above the lower end of its first bin.
  fit.a = std::log10(n) + fit.b * (fit.complete_from - 0.5 * width);
  return fit;
}

}  // namespace

std::optional<GutenbergRichter> fit_magnitudes(std::span<const double> magnitudes, double width, std::size_t fewest,
                                               double from) {
  const MagnitudeBins bins = bins_of(magnitudes, width);
  if (bins.events.empty()) return std::nullopt;
  constexpr double above_fullest = 0.2;
  const auto fullest = static_cast<std::size_t>(std::ranges::max_element(bins.events) - bins.events.begin());
  std::size_t lowest = fullest + static_cast<std::size_t>(std::lround(above_fullest / width));
  while (lowest < bins.events.size() && bins.centre(lowest) < from - 0.5 * width) ++lowest;
  std::size_t left = 0;
  for (std::size_t k = lowest; k < bins.events.size(); ++k) left += bins.events[k];
  std::optional<GutenbergRichter> first;
  for (; lowest < bins.events.size() && left >= std::max<std::size_t>(fewest, 2); left -= bins.events[lowest++]) {
    const auto fit = fit_from(bins, lowest);
    if (fit && fit->holds()) return fit;
    if (!first) first = fit;
  }
  return first;
}

}  // namespace dem::analysis
