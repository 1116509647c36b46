#include "engine/analysis/goodness.h"

#include <algorithm>
#include <cmath>

#include "engine/core/random.h"

namespace dem::analysis {
namespace {

// Draws from a law. The first numbers, which are nearly all of them, come from a table.
class Draws {
 public:
  Draws(const Tail& law, std::int32_t lowest) : law_(law), lowest_(lowest) {
    for (std::int64_t n = lowest; n <= lowest + known; ++n) table_.push_back(law(n));
  }
  std::int32_t operator()(double u) const {  // the largest n with law(n) > u
    if (table_.back() <= u) {
      const auto above = std::ranges::partition_point(table_, [u](double p) { return p > u; });
      return lowest_ + std::max(0, static_cast<std::int32_t>(above - table_.begin()) - 1);
    }
    std::int64_t low = lowest_ + known, high = 2 * low;
    while (high < most && law_(high) > u) low = high, high *= 2;
    while (high - low > 1) {
      const std::int64_t middle = (low + high) / 2;
      (law_(middle) > u ? low : high) = middle;
    }
    return static_cast<std::int32_t>(std::min(low, most));
  }

 private:
  static constexpr std::int64_t known = 64, most = 1'000'000'000;
  Tail law_;
  std::int32_t lowest_;
  std::vector<double> table_;
};

}  // namespace

double distance_to(std::vector<std::int32_t> sample, const Tail& law) {
  std::ranges::sort(sample);
  const auto all = static_cast<double>(sample.size());
  double largest = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    // A share is the same from the number after one of the sample to the next of the sample.
    if (i == 0 || sample[i] != sample[i - 1])
      largest = std::max(largest, std::abs((all - static_cast<double>(i)) / all - law(sample[i])));
    if (i + 1 == sample.size() || sample[i + 1] != sample[i])
      largest =
          std::max(largest, std::abs((all - static_cast<double>(i + 1)) / all - law(std::int64_t{sample[i]} + 1)));
  }
  return largest;
}

std::optional<double> plausibility(std::span<const std::int32_t> sample, std::int32_t lowest, const FitOfTail& fit) {
  const auto law = fit(sample);
  if (!law) return std::nullopt;
  const double distance = distance_to({sample.begin(), sample.end()}, *law);
  const Draws draw(*law, lowest);
  RandomStream random(1, Purpose::law_draws);
  int fitted = 0, as_far = 0;
  std::vector<std::int32_t> drawn(sample.size());
  for (int k = 0; k < law_samples; ++k) {
    for (std::int32_t& n : drawn) n = draw(random.uniform());
    const auto own = fit(drawn);
    if (!own) continue;
    ++fitted;
    as_far += distance_to(drawn, *own) >= distance;
  }
  if (fitted == 0) return std::nullopt;
  return static_cast<double>(as_far) / fitted;
}

}  // namespace dem::analysis
