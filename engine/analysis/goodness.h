#pragma once
// Whether a law of numbers can have given a sample: the distance of Kolmogorov and Smirnov, compared with that of samples drawn
// from the fitted law and fitted again (Clauset, Shalizi & Newman 2009, section 4).
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace dem::analysis {

/// Probability of n or more, n whole; 1 at the lowest n of the law, falling to 0.
using Tail = std::function<double(std::int64_t)>;
/// Fits the law to a sample; nothing where it cannot be fitted.
using FitOfTail = std::function<std::optional<Tail>(std::span<const std::int32_t>)>;

constexpr int law_samples = 200;

/// A law is ruled out where p is below this.
constexpr double least_p = 0.01;

/// Largest difference between the shares of a sample and of a law that are n or more.
double distance_to(std::vector<std::int32_t> sample, const Tail& law);

/// p: share of drawn samples that lie as far from their own fit as this one. `lowest`: where the law begins. Always the same
/// draws. Nothing where the law cannot be fitted.
std::optional<double> plausibility(std::span<const std::int32_t> sample, std::int32_t lowest, const FitOfTail& fit);

}  // namespace dem::analysis
