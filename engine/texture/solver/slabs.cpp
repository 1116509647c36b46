#include "engine/texture/solver/slabs.h"

#include <algorithm>
#include <stdexcept>

#include "engine/core/space_filling.h"
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

}  // namespace

std::vector<std::int32_t> order_in_slabs(const std::vector<Vec3>& position, const std::vector<double>& radius) {
  const SlabRule rule = slab_rule(position, radius, 0);
  double largest = 0, x0 = huge, y0 = huge;
  for (std::size_t i = 0; i < position.size(); ++i) {
    largest = std::max(largest, radius[i]);
    x0 = std::min(x0, position[i][0]);
    y0 = std::min(y0, position[i][1]);
  }
  const auto cell = [&](double a, double from) { return static_cast<std::uint32_t>((a - from) / largest); };
  return slab_order<std::int32_t>(position.size(), [&](std::size_t i) -> SlabCell {
    const auto& [x, y, z] = position[i];
    const int slab = slab_at(rule, z);
    const double z0 = rule.low + slab * rule.thickness;
    return {static_cast<std::uint32_t>(slab), cell(x, x0), cell(y, y0), cell(std::max(z, z0), z0)};
  });
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
