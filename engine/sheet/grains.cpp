#include "engine/sheet/grains.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "engine/core/errors.h"
#include "engine/core/random.h"

namespace dem::sheet {
namespace {

using Outline = std::vector<Point>;

// The part of a convex outline on the side of a that is nearer to a than to b.
Outline nearer(const Outline& outline, const Point& a, const Point& b) {
  const double nx = b[0] - a[0], ny = b[1] - a[1];
  const double level = 0.5 * (b[0] * b[0] + b[1] * b[1] - a[0] * a[0] - a[1] * a[1]);
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point& p = outline[i];
    const Point& q = outline[(i + 1) % outline.size()];
    const double sp = nx * p[0] + ny * p[1] - level, sq = nx * q[0] + ny * q[1] - level;
    if (sp <= 0) kept.push_back(p);
    if ((sp < 0 && sq > 0) || (sp > 0 && sq < 0)) {
      const double t = sp / (sp - sq);
      kept.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
    }
  }
  return kept;
}

std::vector<Outline> cells(const std::vector<Point>& centres, const VoronoiSettings& s) {
  std::vector<Outline> result;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Point& c = centres[i];
    Outline cell = s.periodic ? Outline{{c[0] - 1, c[1] - s.height},
                                        {c[0] + 1, c[1] - s.height},
                                        {c[0] + 1, c[1] + s.height},
                                        {c[0] - 1, c[1] + s.height}}
                              : Outline{{0, 0}, {1, 0}, {1, s.height}, {0, s.height}};
    const int images = s.periodic ? 1 : 0;
    for (std::size_t j = 0; j < centres.size(); ++j) {
      for (int sx = -images; sx <= images; ++sx) {
        for (int sy = -images; sy <= images; ++sy) {
          if (i == j && sx == 0 && sy == 0) continue;
          cell = nearer(cell, c, {centres[j][0] + sx, centres[j][1] + sy * s.height});
        }
      }
    }
    result.push_back(std::move(cell));
  }
  return result;
}

Point centroid(const Outline& p) {
  double twice = 0, x = 0, y = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point& a = p[i];
    const Point& b = p[(i + 1) % p.size()];
    const double cross = (a[0] - p[0][0]) * (b[1] - p[0][1]) - (b[0] - p[0][0]) * (a[1] - p[0][1]);
    twice += cross;
    x += cross * (a[0] + b[0] - 2 * p[0][0]);
    y += cross * (a[1] + b[1] - 2 * p[0][1]);
  }
  return {p[0][0] + x / (3 * twice), p[0][1] + y / (3 * twice)};
}

// Nodes shared by outlines: places that agree to 1e-9 of the box are one node.
class Nodes {
 public:
  Nodes(ElleMap& map, bool periodic, double height) : map_(map), periodic_(periodic), height_(height) {}
  int at(Point p) {
    if (periodic_) {
      p[0] -= std::floor(p[0] + 1e-9);
      p[1] -= height_ * std::floor(p[1] / height_ + 1e-9);
    }
    const auto x = std::llround(p[0] * 1e8), y = std::llround(p[1] * 1e8);
    for (long long dx = -1; dx <= 1; ++dx) {
      for (long long dy = -1; dy <= 1; ++dy) {
        const auto found = known_.find({x + dx, y + dy});
        if (found != known_.end()) return found->second;
      }
    }
    const int id = static_cast<int>(map_.nodes.size());
    map_.nodes.push_back({id, p});
    known_[{x, y}] = id;
    return id;
  }

 private:
  ElleMap& map_;
  bool periodic_;
  double height_;
  std::map<std::pair<long long, long long>, int> known_;
};

void add_flynn(ElleMap& map, Nodes& nodes, const Outline& cell) {
  ElleFlynn flynn;
  flynn.id = static_cast<int>(map.flynns.size());
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const Point& p = cell[i];
    const Point& q = cell[(i + 1) % cell.size()];
    // Steps stay short beside the cell, so that the nearest image is always the next point.
    const int parts =
        std::max(1, static_cast<int>(std::ceil(std::max(std::fabs(q[0] - p[0]), std::fabs(q[1] - p[1])) / 0.2)));
    for (int k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const int node = nodes.at({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
      if (flynn.nodes.empty() || flynn.nodes.back() != node) flynn.nodes.push_back(node);
    }
  }
  while (flynn.nodes.size() > 1 && flynn.nodes.front() == flynn.nodes.back()) flynn.nodes.pop_back();
  map.flynns.push_back(std::move(flynn));
}

// Calls visit(row, first column, end column) for the particles inside an outline (even-odd rule, edges half open).
template <class Visit>
void scan(const Outline& outline, const Sheet& s, double x0, double y0, double scale, Visit visit) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point& p : outline) low = std::min(low, p[1]), high = std::max(high, p[1]);
  const double spacing = s.lattice.rows > 1 ? s.y[static_cast<std::size_t>(s.lattice.columns)] - s.y[0] : 1.0;
  const int first = std::max(0, static_cast<int>(std::floor(((low - y0) / scale - s.y[0]) / spacing)));
  const int last = std::min(s.lattice.rows - 1, static_cast<int>(std::ceil(((high - y0) / scale - s.y[0]) / spacing)));
  std::vector<double> crossings;
  for (int r = first; r <= last; ++r) {
    const double y = y0 + scale * s.y[static_cast<std::size_t>(r * s.lattice.columns)];
    crossings.clear();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      Point a = outline[i], b = outline[(i + 1) % outline.size()];
      if (b[1] < a[1]) std::swap(a, b);  // the same sum for both grains of an edge
      if (!(a[1] <= y && y < b[1])) continue;
      crossings.push_back(a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      // Rows alternate by one radius: half a radius to the left centres the sheet on the cell.
      const double start = s.x[static_cast<std::size_t>(r * s.lattice.columns)] - 0.5 * s.radius0;
      const auto column = [&](double x) {
        return static_cast<int>(std::ceil(((x - x0) / scale - start) / (2 * s.radius0)));
      };
      const int begin = std::max(0, column(crossings[k])), end = std::min(s.lattice.columns, column(crossings[k + 1]));
      if (begin < end) visit(r, begin, end);
    }
  }
}

// Particles without a grain take that of the nearest covered neighbour, ring by ring, lowest direction first.
void fill_holes(std::vector<std::int32_t>& flynn, const Lattice& lattice) {
  std::vector<int> open;
  for (int i = 0; i < lattice.particles(); ++i) {
    if (flynn[static_cast<std::size_t>(i)] < 0) open.push_back(i);
  }
  while (!open.empty()) {
    std::vector<std::pair<int, std::int32_t>> found;
    std::vector<int> left;
    for (const int i : open) {
      std::int32_t grain = -1;
      for (int d = 0; d < 6 && grain < 0; ++d) {
        const int j = lattice.neighbour(i, d);
        if (j >= 0) grain = flynn[static_cast<std::size_t>(j)];
      }
      if (grain >= 0)
        found.emplace_back(i, grain);
      else
        left.push_back(i);
    }
    for (const auto& [i, grain] : found) flynn[static_cast<std::size_t>(i)] = grain;
    open = std::move(left);
  }
}

}  // namespace

namespace {

std::vector<Outline> grown(const VoronoiSettings& settings) {
  RandomStream random(settings.seed, Purpose::sheet_grain_centres);
  std::vector<Point> centres;
  for (int g = 0; g < settings.grains; ++g) {
    const double x = random.uniform();
    centres.push_back({x, settings.height * random.uniform()});
  }
  std::vector<Outline> outlines = cells(centres, settings);
  for (int step = 0; step < settings.lloyd; ++step) {
    for (std::size_t g = 0; g < centres.size(); ++g) centres[g] = centroid(outlines[g]);
    outlines = cells(centres, settings);
  }
  return outlines;
}

}  // namespace

ElleMap voronoi_map(const VoronoiSettings& settings) {
  if (settings.grains < 4) throw InputError("a grown map needs at least 4 grains", "raise grains.count");
  ElleMap map;
  map.high = {1, settings.height};
  Nodes nodes(map, settings.periodic, settings.height);
  for (const Outline& cell : grown(settings)) add_flynn(map, nodes, cell);
  return map;
}

ElleMap layered_map(double height, double low, double high, const VoronoiSettings& grains) {
  ElleMap map;
  map.high = {1, height};
  Nodes nodes(map, false, height);
  VoronoiSettings inside = grains;
  inside.periodic = false;
  inside.height = high - low;
  std::vector<Outline> layer{{{0, 0}, {1, 0}, {1, inside.height}, {0, inside.height}}};
  if (grains.grains > 1) layer = grown(inside);
  // The matrix has the nodes of the layer's grains along their common edges.
  Outline below{{0, 0}, {1, 0}}, above{{1, height}, {0, height}};
  std::vector<double> lower, upper;
  for (Outline& cell : layer) {
    for (Point& p : cell) {
      if (p[1] < 1e-9 * height) lower.push_back(p[0]);
      if (p[1] > inside.height - 1e-9 * height) upper.push_back(p[0]);
      p[1] += low;
    }
  }
  std::sort(lower.begin(), lower.end(), std::greater<>());
  std::sort(upper.begin(), upper.end());
  const auto same = [](double a, double b) { return std::fabs(a - b) < 1e-9; };
  lower.erase(std::unique(lower.begin(), lower.end(), same), lower.end());
  upper.erase(std::unique(upper.begin(), upper.end(), same), upper.end());
  for (const double x : lower) below.push_back({x, low});
  for (const double x : upper) above.push_back({x, high});
  add_flynn(map, nodes, below);
  ElleAttribute mineral{"MINERAL", "MATRIX", {}};
  for (const Outline& cell : layer) {
    mineral.values.emplace_back(static_cast<int>(map.flynns.size()), "LAYER");
    add_flynn(map, nodes, cell);
  }
  add_flynn(map, nodes, above);
  map.attributes.push_back(std::move(mineral));
  return map;
}

TooFewInside::TooFewInside(int found, int wanted)
    : InputError(fmt::format("only {} grains lie inside the box, {} should expand", found, wanted),
                 "lower grains.expanding or raise grains.count"),
      inside(found) {}

void mark_expanding(ElleMap& map, int count, const std::string& mineral, std::uint64_t seed) {
  std::vector<int> inner;
  for (std::size_t f = 0; f < map.flynns.size(); ++f) {
    const Outline cell = outline(map, f);
    const double margin = 0.02 * (map.high[0] - map.low[0]);
    const bool inside = std::all_of(cell.begin(), cell.end(), [&](const Point& p) {
      return p[0] > map.low[0] + margin && p[0] < map.high[0] - margin && p[1] > map.low[1] + margin &&
             p[1] < map.high[1] - margin;
    });
    if (inside) inner.push_back(map.flynns[f].id);
  }
  if (static_cast<int>(inner.size()) < count) throw TooFewInside(static_cast<int>(inner.size()), count);
  RandomStream random(seed, Purpose::sheet_grain_centres, 1);
  std::vector<int> chosen;
  for (int k = 0; k < count; ++k) {
    const auto pick = static_cast<std::ptrdiff_t>(random.below(inner.size()));
    chosen.push_back(inner[static_cast<std::size_t>(pick)]);
    inner.erase(inner.begin() + pick);
  }
  std::sort(chosen.begin(), chosen.end());
  ElleAttribute expand{"EXPAND", "0", {}}, kind{"MINERAL", "MATRIX", {}};
  for (const int id : chosen) {
    expand.values.emplace_back(id, "1");
    kind.values.emplace_back(id, mineral);
  }
  map.attributes.push_back(std::move(expand));
  map.attributes.push_back(std::move(kind));
}

Cover cover(const ElleMap& map, const Sheet& sheet) {
  const double width = map.high[0] - map.low[0], height = map.high[1] - map.low[1];
  const double scale = width;
  Cover result;
  result.flynn.assign(static_cast<std::size_t>(sheet.particles()), -1);
  std::vector<std::uint8_t> times(result.flynn.size(), 0);
  double total = 0;
  for (std::size_t f = 0; f < map.flynns.size(); ++f) {
    const Outline cell = outline(map, f);
    total += std::fabs(area(cell));
    for (int sx = -1; sx <= 1; ++sx) {
      for (int sy = -1; sy <= 1; ++sy) {
        Outline image = cell;
        for (Point& p : image) p[0] += sx * width, p[1] += sy * height;
        scan(image, sheet, map.low[0], map.low[1], scale, [&](int row, int begin, int end) {
          for (int c = begin; c < end; ++c) {
            const auto i = static_cast<std::size_t>(row * sheet.lattice.columns + c);
            if (times[i] == 0) result.flynn[i] = static_cast<std::int32_t>(f);
            if (times[i] < 2) ++times[i];
          }
        });
      }
    }
  }
  for (const auto t : times) {
    if (t == 0) ++result.holes;
    if (t > 1) ++result.overlaps;
  }
  result.area_share = total / (width * height);
  if (2 * result.holes > sheet.particles()) {
    throw InputError(
        {map.source, 0, 0}, "FLYNNS",
        fmt::format("the grains cover only {} of {} particles", sheet.particles() - result.holes, sheet.particles()),
        "the outlines should fill the cell");
  }
  if (result.holes > 0) fill_holes(result.flynn, sheet.lattice);
  return result;
}

void apply_disorder(Sheet& sheet, const Cover& cover, const std::vector<GrainProperties>& grains,
                    const DisorderSettings& settings, std::uint64_t seed) {
  RandomStream constants(seed, Purpose::sheet_grain_stiffness), thresholds(seed, Purpose::sheet_spring_thresholds);
  std::vector<double> stiffness;
  for (const GrainProperties& grain : grains) {
    double factor = 0;
    do factor = 1 + settings.stiffness_sd * constants.normal();
    while (factor < 0.2);
    stiffness.push_back(settings.stiffness * factor * grain.stiffness);
  }
  sheet.grain = cover.flynn;
  for (int slot = 0; slot < sheet.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    const double draw = thresholds.uniform(1 - settings.strength_spread, 1 + settings.strength_spread);
    if (sheet.stiffness[k] <= 0) continue;
    const auto a = static_cast<std::size_t>(cover.flynn[static_cast<std::size_t>(sheet.first(slot))]);
    const auto b = static_cast<std::size_t>(cover.flynn[static_cast<std::size_t>(sheet.second(slot))]);
    sheet.stiffness[k] *= 0.5 * (stiffness[a] + stiffness[b]);
    sheet.between[k] = a != b ? 1 : 0;
    if (along_wall(sheet, slot)) continue;
    sheet.threshold[k] =
        settings.strength * draw * 0.5 * (grains[a].strength + grains[b].strength) * (a != b ? settings.boundary : 1.0);
  }
}

}  // namespace dem::sheet
