#include "render/chart/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace render {
namespace {

const char* const minus = "\u2212";

/// 1, 2 or 5 times a power of ten, not below `rough`.
double round_step(double rough) {
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

/// The largest of 1, 2, 5 times a power of ten that is not above `value`.
double round_below(double value) {
  const double power = std::pow(10, std::floor(std::log10(value) + 1e-12));
  for (double factor : {5.0, 2.0})
    if (factor * power <= value * (1 + 1e-9)) return factor * power;
  return power;
}

/// Decimals that tell multiples of `step` apart.
int decimals(double step) {
  int digits = 0;
  for (double s = step; digits < 15 && (s < 0.5 || std::abs(s - std::round(s)) > 1e-6 * s); s *= 10) ++digits;
  return digits;
}

void linear_range(Scale& scale, const Axis& axis, const Range& data, int wanted, bool tight) {
  double low = axis.low.value_or(data.any ? data.low : 0), high = axis.high.value_or(data.any ? data.high : 1);
  if (!std::isfinite(low)) low = data.any ? data.low : 0;
  if (!std::isfinite(high)) high = data.any ? data.high : 1;
  if (!axis.low && !axis.high && low > 0 && low < 0.35 * high) low = 0;  // show zero when it is near
  if (!axis.low && !axis.high && high < 0 && high > 0.35 * low) high = 0;
  if (!(high - low > 1e-11 * std::max(std::abs(low), std::abs(high)))) {  // one value only, to double precision
    const double room = low == 0 ? 1 : 0.1 * std::abs(low);
    if (!axis.low || axis.high) low -= room;
    if (!axis.high) high += room;
    if (!(high > low)) high = low + 2 * room;
  }
  if (!tight) {
    const double step = round_step((high - low) / wanted);
    const double slack = 1e-9 * step;
    if (!axis.low) low = step * std::floor((low + slack) / step);
    if (!axis.high) high = step * std::ceil((high - slack) / step);
  }
  scale.low = low;
  scale.high = high;
}

/// A step that gives at least three labels, as many as `wanted` where that is more.
double tick_step(const Scale& scale, int wanted) {
  for (;; ++wanted) {
    const double step = round_step((scale.high - scale.low) / wanted);
    const double first = std::ceil(scale.low / step - 1e-6), last = std::floor(scale.high / step + 1e-6);
    if (!(last - first < 2) || wanted > 12) return step;
  }
}

void linear_ticks(Scale& scale, int wanted) {
  const double step = tick_step(scale, wanted);
  const double largest = std::max(std::abs(scale.low), std::abs(scale.high));
  const int exponent = static_cast<int>(std::floor(std::log10(largest) + 1e-9));
  double unit = 1;
  if (exponent >= 5 || exponent <= -4) {
    unit = std::pow(10, exponent);
    scale.multiplier = "\u00d7\u00a0" + power_of_ten(exponent);
  }
  const int digits = decimals(step / unit);
  const double first = std::ceil(scale.low / step - 1e-6);
  for (double k = first; k * step <= scale.high + 1e-6 * step; ++k)
    scale.ticks.push_back({k * step, k == 0 ? "0" : plain_number(k * step / unit, digits), true});
  const double leading = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
  const int parts = std::lround(leading) == 2 ? 4 : 5;
  const double minor = step / parts;
  for (double k = std::ceil(scale.low / minor - 1e-6); k * minor <= scale.high + 1e-6 * minor; ++k)
    if (std::abs(std::remainder(k, parts)) > 0.5) scale.ticks.push_back({k * minor, "", false});
}

void log_range(Scale& scale, const Axis& axis, const Range& data, bool tight) {
  double low = axis.low.value_or(data.any ? data.low : 1), high = axis.high.value_or(data.any ? data.high : 10);
  if (!(low > 0)) low = high > 0 ? high / 1000 : 1;
  if (!(high > low * (1 + 1e-9))) {
    if (!axis.low) low /= 3;
    high = std::max(high, low) * (axis.high ? 1.0000001 : 3);
  }
  if (!tight) {
    if (!axis.low) low = round_below(low);
    if (!axis.high) high = round_step(high);
  }
  scale.low = low;
  scale.high = high;
}

void log_ticks(Scale& scale, int wanted) {
  const int first = static_cast<int>(std::floor(std::log10(scale.low) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(scale.high) - 1e-9));
  const double span = std::log10(scale.high / scale.low);
  const bool few = span < 2;          // also 2 and 5 carry labels
  const bool very_few = span < 0.75;  // all of 1 ... 9 do
  const int every = std::max(1, (last - first + wanted - 1) / wanted);
  const bool plain = first >= -3 && last <= 4 && every == 1;
  for (int decade = first; decade <= last; ++decade)
    for (int factor = 1; factor < 10; ++factor) {
      const double value = factor * std::pow(10, decade);
      if (value < scale.low * (1 - 1e-9) || value > scale.high * (1 + 1e-9)) continue;
      const bool labelled =
          (factor == 1 && (decade - first) % every == 0) || (few && (factor == 2 || factor == 5)) || very_few;
      if (!labelled && every > 1 && factor != 1) continue;
      std::string label;
      if (labelled && (plain || few)) label = plain_number(value, std::max(0, -decade));
      if (labelled && !(plain || few)) label = power_of_ten(decade);
      scale.ticks.push_back({value, label, factor == 1 || labelled});
    }
}

}  // namespace

double Scale::share(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  if (!(value > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::log(value / low) / std::log(high / low);
}

void Range::take(double value) {
  constexpr double too_large = 1e300;  // differences must stay finite
  if (!(std::abs(value) < too_large)) return;
  low = any ? std::min(low, value) : value;
  high = any ? std::max(high, value) : value;
  any = true;
}

std::string with_thousands(std::string text) {
  constexpr std::size_t fewest = 5, group = 3;
  const std::size_t whole = std::min(text.find_first_not_of("0123456789"), text.size());
  if (whole < fewest) return text;
  for (std::size_t at = whole - group;; at -= group) {
    text.insert(at, "\u202f");
    if (at <= group) return text;
  }
}

std::string plain_number(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), digits);
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  text = with_thousands(std::move(text));
  return value < 0 && !zero ? minus + text : text;
}

std::string power_of_ten(int exponent) {
  static const char* const raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                       "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = "10";
  if (exponent < 0) text += "\u207b";
  for (char digit : std::to_string(std::abs(exponent))) text += raised[digit - '0'];
  return text;
}

Scale make_scale(const Axis& axis, const Range& data, int wanted, bool tight) {
  Scale scale;
  scale.logarithmic = axis.logarithmic;
  wanted = std::max(wanted, 1);
  if (axis.logarithmic)
    log_range(scale, axis, data, tight);
  else
    linear_range(scale, axis, data, wanted, tight);
  if (!axis.ticks.empty()) {
    for (const auto& [value, label] : axis.ticks) scale.ticks.push_back({value, label, true});
  } else if (axis.logarithmic) {
    log_ticks(scale, wanted);
  } else {
    linear_ticks(scale, wanted);
  }
  return scale;
}

}  // namespace render
