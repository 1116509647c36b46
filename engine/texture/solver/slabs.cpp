#include "engine/texture/solver/slabs.h"

#include <algorithm>
#include <stdexcept>

#include "engine/texture/solver/packs.h"

namespace dem::texture {
namespace {

struct SlabRule {
  double low = 0, thickness = 1;
  int count = 1;
};

// Slabs 1.3 times as thick as the largest particle: a contact never reaches past the next slab before failure.
SlabRule slab_rule(const std::vector<Vec3>& position, const std::vector<double>& radius, int wanted) {
  SlabRule rule;
  if (position.empty()) return rule;
  double low = huge, high = -huge, largest = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    low = std::min(low, position[i][2]);
    high = std::max(high, position[i][2]);
    largest = std::max(largest, radius[i]);
  }
  const int most = static_cast<int>((high - low) / (2.6 * largest));
  rule.count = std::max(1, wanted > 0 ? std::min(wanted, most) : most);
  if (rule.count > 1 && rule.count % 2 == 1) --rule.count;  // even: two threads share alike
  rule.low = low;
  rule.thickness = (high - low) / rule.count * (1 + 1e-12);
  if (!(rule.thickness > 0)) rule.thickness = 1;
  return rule;
}

int slab_at(const SlabRule& rule, double z) {
  return std::clamp(static_cast<int>((z - rule.low) / rule.thickness), 0, rule.count - 1);
}

std::uint64_t spread(std::uint32_t x) {
  std::uint64_t v = x & 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

}  // namespace

std::vector<std::int32_t> order_in_slabs(const std::vector<Vec3>& position, const std::vector<double>& radius) {
  const SlabRule rule = slab_rule(position, radius, 0);
  std::vector<std::int32_t> order(position.size());
  std::vector<std::uint64_t> key(position.size());
  double largest = 0, x0 = huge, y0 = huge;
  for (std::size_t i = 0; i < position.size(); ++i) {
    order[i] = static_cast<std::int32_t>(i);
    largest = std::max(largest, radius[i]);
    x0 = std::min(x0, position[i][0]);
    y0 = std::min(y0, position[i][1]);
  }
  for (std::size_t i = 0; i < position.size(); ++i) {
    const int slab = slab_at(rule, position[i][2]);
    const auto cell = [&](double a, double from) { return static_cast<std::uint32_t>((a - from) / largest); };
    const double z0 = rule.low + slab * rule.thickness;
    const std::uint64_t curve = spread(cell(position[i][0], x0)) | spread(cell(position[i][1], y0)) << 1 |
                                spread(cell(std::max(position[i][2], z0), z0)) << 2;
    key[i] = static_cast<std::uint64_t>(slab) << 48 | (curve & 0xffffffffffffULL);
  }
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
    return key[ia] != key[ib] ? key[ia] < key[ib] : a < b;
  });
  return order;
}

Slabs cut_in_slabs(const std::vector<Vec3>& position, const std::vector<double>& radius, int wanted) {
  const SlabRule rule = slab_rule(position, radius, wanted);
  Slabs slabs;
  slabs.of.reserve(position.size());
  slabs.begin.assign(static_cast<std::size_t>(rule.count) + 1, 0);
  for (const Vec3& p : position) {
    const int slab = slab_at(rule, p[2]);
    if (!slabs.of.empty() && slab < slabs.of.back()) {
      throw std::logic_error("Assembly: particles are not ordered in slabs");
    }
    slabs.of.push_back(slab);
    ++slabs.begin[static_cast<std::size_t>(slab) + 1];
  }
  for (std::size_t s = 1; s < slabs.begin.size(); ++s) slabs.begin[s] += slabs.begin[s - 1];
  return slabs;
}

std::size_t Slabs::block_of(std::int32_t first, std::int32_t second) const {
  const std::int32_t a = of[static_cast<std::size_t>(first)], b = of[static_cast<std::size_t>(second)];
  if (a == b) return static_cast<std::size_t>(a);
  if (a - b == 1 || b - a == 1) return count() + static_cast<std::size_t>(std::min(a, b));
  return blocks() - 1;
}

}  // namespace dem::texture
