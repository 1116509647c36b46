#include "engine/sheet/fractures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace dem::sheet {
namespace {

// Broken springs by square cells, for neighbours within `reach`.
class Near {
 public:
  Near(const std::vector<Break>& breaks, double reach) : breaks_(breaks), reach_(reach) {
    for (std::size_t b = 0; b < breaks.size(); ++b) cells_[cell(breaks[b])].push_back(static_cast<int>(b));
  }
  template <class Visit>
  void each(std::size_t b, Visit visit) const {
    const auto [cx, cy] = cell(breaks_[b]);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto found = cells_.find({cx + dx, cy + dy});
        if (found == cells_.end()) continue;
        for (const int other : found->second) {
          const Break& o = breaks_[static_cast<std::size_t>(other)];
          if (std::hypot(o.x - breaks_[b].x, o.y - breaks_[b].y) <= reach_) visit(static_cast<std::size_t>(other));
        }
      }
    }
  }

 private:
  [[nodiscard]] std::pair<int, int> cell(const Break& b) const {
    return {static_cast<int>(std::floor(b.x / reach_)), static_cast<int>(std::floor(b.y / reach_))};
  }
  const std::vector<Break>& breaks_;
  double reach_;
  std::map<std::pair<int, int>, std::vector<int>> cells_;
};

}  // namespace

std::vector<int> fractures(const std::vector<Break>& breaks, double spacing) {
  std::vector<int> parent(breaks.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int b) {
    while (parent[static_cast<std::size_t>(b)] != b) {
      b = parent[static_cast<std::size_t>(b)] = parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(b)])];
    }
    return b;
  };
  const Near near(breaks, 1.2 * spacing);
  for (std::size_t b = 0; b < breaks.size(); ++b) {
    near.each(b, [&](std::size_t other) {
      const int p = root(static_cast<int>(b)), q = root(static_cast<int>(other));
      parent[static_cast<std::size_t>(std::max(p, q))] = std::min(p, q);
    });
  }
  std::vector<int> label(breaks.size());
  for (std::size_t b = 0; b < breaks.size(); ++b) label[b] = root(static_cast<int>(b));
  return label;
}

std::vector<double> trends(const std::vector<Break>& breaks, double spacing) {
  const std::vector<int> label = fractures(breaks, spacing);
  const Near near(breaks, 5 * spacing);
  std::vector<double> result(breaks.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t b = 0; b < breaks.size(); ++b) {
    int n = 0;
    double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    near.each(b, [&](std::size_t other) {
      if (label[other] != label[b]) return;
      const double x = breaks[other].x - breaks[b].x, y = breaks[other].y - breaks[b].y;
      ++n, sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
    });
    if (n < 4) continue;
    sxx -= sx * sx / n, sxy -= sx * sy / n, syy -= sy * sy / n;
    const double angle = 0.5 * std::atan2(2 * sxy, sxx - syy);
    result[b] = angle < 0 ? angle + std::numbers::pi : angle;
  }
  return result;
}

Crossing crossing(const std::vector<Break>& breaks, double spacing, double low, double high) {
  std::vector<Break> inside;
  for (const Break& b : breaks) {
    if (b.y >= low && b.y <= high) inside.push_back(b);
  }
  const std::vector<int> label = fractures(inside, spacing);
  struct Span {
    double low = 1e9, high = -1e9, x = 0;
    int n = 0;
  };
  std::map<int, Span> spans;
  for (std::size_t b = 0; b < inside.size(); ++b) {
    Span& s = spans[label[b]];
    s.low = std::min(s.low, inside[b].y);
    s.high = std::max(s.high, inside[b].y);
    s.x += inside[b].x;
    ++s.n;
  }
  // A fracture through a band of n rows has springs in n rows and between them: they span n - 1.
  const double row = 0.5 * std::numbers::sqrt3 * spacing;
  Crossing found;
  for (const auto& [key, s] : spans) {
    if (s.high - s.low >= 0.8 * (high - low - row)) found.places.push_back(s.x / s.n);
  }
  std::sort(found.places.begin(), found.places.end());
  found.mean_spacing = found.scatter = found.chance = std::numeric_limits<double>::quiet_NaN();
  const auto gaps = static_cast<double>(found.places.size()) - 1;
  if (gaps < 1) return found;
  found.mean_spacing = (found.places.back() - found.places.front()) / gaps;
  if (gaps < 2) return found;
  double square = 0;
  for (std::size_t k = 1; k < found.places.size(); ++k) {
    const double off = found.places[k] - found.places[k - 1] - found.mean_spacing;
    square += off * off;
  }
  found.scatter = std::sqrt(square / gaps) / found.mean_spacing;
  found.chance = std::sqrt((gaps - 1) / (gaps + 1));  // of the gaps between uniform random places
  return found;
}

}  // namespace dem::sheet
