#include "engine/analysis/fragments.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "engine/analysis/goodness.h"

namespace dem::analysis {
namespace {

// Sets of particles as a forest; the root of a set is its lowest particle.
class Sets {
 public:
  explicit Sets(std::size_t n) : above_(n) { std::iota(above_.begin(), above_.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    above_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> above_;
};

}  // namespace

std::size_t Fragments::of_at_least(double share_asked) const {
  std::size_t found = 0;
  while (found < all.size() && share(found) >= share_asked) ++found;
  return found;
}

std::size_t Fragments::single() const {
  return static_cast<std::size_t>(std::ranges::count(all, 1, &Fragment::particles));
}

Fragments fragments_of(std::span<const std::int32_t> pair, const std::vector<bool>& alive,
                       std::span<const double> position, std::span<const double> radius) {
  const std::size_t particles = radius.size();
  Sets sets(particles);
  for (std::size_t b = 0; b < alive.size(); ++b)
    if (alive[b]) sets.join(static_cast<std::size_t>(pair[2 * b]), static_cast<std::size_t>(pair[2 * b + 1]));
  std::vector<Fragment> found;
  std::vector<std::size_t> number(particles, particles);  // of a root's fragment, in the order of lowest particles
  std::vector<std::size_t> mine(particles);
  for (std::size_t i = 0; i < particles; ++i) {
    const std::size_t root = sets.root(i);
    if (number[root] == particles) {
      number[root] = found.size();
      found.emplace_back();
    }
    mine[i] = number[root];
    Fragment& f = found[mine[i]];
    const double volume = 4.0 / 3 * std::numbers::pi * std::pow(radius[i], 3);
    ++f.particles;
    f.volume += volume;
    for (std::size_t k = 0; k < 3; ++k) f.centre[k] += volume * position[3 * i + k];
  }
  std::vector<std::size_t> order(found.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t k) { return found[k].volume; });
  Fragments result;
  std::vector<std::int32_t> place(found.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = static_cast<std::int32_t>(k);
    Fragment& f = result.all.emplace_back(found[order[k]]);
    for (double& c : f.centre) c /= f.volume;
    result.volume += f.volume;
  }
  for (const std::size_t k : mine) result.of.push_back(place[k]);
  return result;
}

std::vector<bool> living_bonds(const dem::Record& record) {
  constexpr std::int32_t elements_of_joint = 3;
  const dem::Table& contacts = record.table("contacts");
  const dem::Table& cracks = record.table("cracks");
  std::vector<std::int32_t> left(contacts.rows(), 1);
  if (contacts.has("kind")) {  // grains: 0 flat joint, 1 parallel bond
    const auto kind = contacts.integer("kind");
    for (std::size_t i = 0; i < left.size(); ++i)
      if (kind[i] == 0) left[i] = elements_of_joint;
    for (const std::int32_t contact : cracks.integer("contact")) --left.at(static_cast<std::size_t>(contact));
  } else {  // a lattice: a bond is an element and a direction
    const auto pair = contacts.integer("pair"), direction = contacts.integer("direction");
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> bond;
    for (std::size_t i = 0; i < left.size(); ++i) bond[{pair[2 * i], direction[i]}] = i;
    const auto element = cracks.integer("element"), across = cracks.integer("direction");
    for (std::size_t k = 0; k < cracks.rows(); ++k) --left[bond.at({element[k], across[k]})];
  }
  std::vector<bool> alive;
  for (const std::int32_t n : left) alive.push_back(n > 0);
  return alive;
}

Fragments fragments_of(const dem::Record& record) {
  const dem::Table& particles = record.table("particles");
  return fragments_of(record.table("contacts").integer("pair"), living_bonds(record), particles.real("position"),
                      particles.real("radius"));
}

double hurwitz_zeta(double s, double a) {
  // Euler and Maclaurin, from the twentieth term on.
  constexpr int terms = 20;
  double sum = 0;
  for (int k = 0; k < terms; ++k) sum += std::pow(a + k, -s);
  const double x = a + terms;
  sum += std::pow(x, 1 - s) / (s - 1) + 0.5 * std::pow(x, -s) + s / 12 * std::pow(x, -s - 1);
  sum -= s * (s + 1) * (s + 2) / 720 * std::pow(x, -s - 3);
  return sum + s * (s + 1) * (s + 2) * (s + 3) * (s + 4) / 30240 * std::pow(x, -s - 5);
}

bool PowerLaw::holds() const { return p >= least_p; }

double PowerLaw::at_least(double n) const {
  return hurwitz_zeta(exponent.value, n) / hurwitz_zeta(exponent.value, least);
}

namespace {

// The exponent under which the mean of ln n is what it is. It is -zeta'/zeta and falls with the exponent. Curvature by differences.
struct Likely {
  std::int32_t least;
  [[nodiscard]] double mean(double s) const { return -(logarithm(s + 1e-5) - logarithm(s - 1e-5)) / 2e-5; }
  [[nodiscard]] double exponent(double mean_logarithm) const {
    double low = 1.0001, high = 30;
    for (int step = 0; step < 40; ++step) {
      const double middle = 0.5 * (low + high);
      (mean(middle) > mean_logarithm ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

 private:
  [[nodiscard]] double logarithm(double s) const { return std::log(hurwitz_zeta(s, least)); }
};

double mean_logarithm(std::span<const std::int32_t> numbers) {
  double sum = 0;
  for (const std::int32_t n : numbers) sum += std::log(n);
  return sum / static_cast<double>(numbers.size());
}

}  // namespace

std::optional<PowerLaw> fit_power_law(std::span<const std::int32_t> particles, std::int32_t least) {
  constexpr std::size_t fewest = 30, fewest_sizes = 5;
  PowerLaw law;
  law.least = least;
  std::vector<std::int32_t> fitted;
  std::ranges::copy_if(particles, std::back_inserter(fitted), [least](std::int32_t n) { return n >= least; });
  law.fragments = fitted.size();
  if (law.fragments < fewest || std::set(fitted.begin(), fitted.end()).size() < fewest_sizes) return std::nullopt;
  const Likely likely{least};
  const double s = likely.exponent(mean_logarithm(fitted));
  const double curvature = -(likely.mean(s + 1e-3) - likely.mean(s - 1e-3)) / 2e-3;
  const double half = 1.959964 / std::sqrt(static_cast<double>(law.fragments) * curvature);
  law.exponent = {s, s - half, s + half};
  const auto p = plausibility(fitted, least, [&](std::span<const std::int32_t> sample) -> std::optional<Tail> {
    const double exponent = likely.exponent(mean_logarithm(sample));
    return [exponent, least, all = hurwitz_zeta(exponent, least)](std::int64_t n) {
      return hurwitz_zeta(exponent, static_cast<double>(n)) / all;
    };
  });
  law.p = p.value_or(0);
  return law;
}

}  // namespace dem::analysis
