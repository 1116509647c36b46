#include "engine/sheet/grains.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "engine/core/cell_grid.h"
#include "engine/core/errors.h"
#include "engine/core/random.h"

namespace dem::sheet {
namespace {

using Outline = std::vector<Point>;

// Takes from a convex outline what is nearer to b than to a. Most cuts take nothing.
class Cutter {
 public:
  void cut(Outline& outline, const Point& a, const Point& b) {
    const double nx = b[0] - a[0], ny = b[1] - a[1];
    const double level = 0.5 * (b[0] * b[0] + b[1] * b[1] - a[0] * a[0] - a[1] * a[1]);
    const auto beyond = [&](const Point& p) { return nx * p[0] + ny * p[1] - level; };
    if (std::all_of(outline.begin(), outline.end(), [&](const Point& p) { return beyond(p) <= 0; })) return;
    kept_.clear();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Point& p = outline[i];
      const Point& q = outline[(i + 1) % outline.size()];
      const double sp = beyond(p), sq = beyond(q);
      if (sp <= 0) kept_.push_back(p);
      if ((sp < 0 && sq > 0) || (sp > 0 && sq < 0)) {
        const double t = sp / (sp - sq);
        kept_.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
      }
    }
    std::swap(outline, kept_);
  }

 private:
  Outline kept_;
};

// The square of the distance beyond which no centre cuts a cell: twice that of its furthest corner, and rounding.
double reach_of(const Outline& cell, const Point& c) {
  double furthest = 0;
  for (const Point& p : cell) {
    furthest = std::max(furthest, (p[0] - c[0]) * (p[0] - c[0]) + (p[1] - c[1]) * (p[1] - c[1]));
  }
  return 4 * furthest * (1 + 1e-9);
}

// The square of the distance of two centres, or of the nearest images of them.
double square_apart(const Point& a, const Point& b, const VoronoiSettings& s) {
  double x = std::fabs(a[0] - b[0]), y = std::fabs(a[1] - b[1]);
  if (s.periodic) x = std::min(x, std::fabs(1 - x)), y = std::min(y, std::fabs(s.height - y));
  return x * x + y * y;
}

// Which centres may cut a cell. They cut in their order, which decides last bits: the first ones all, and when these have made
// the cell small, of the others those near it.
class Cutters {
 public:
  Cutters(const std::vector<Point>& centres, const VoronoiSettings& s)
      : centres_(centres),
        settings_(s),
        first_(std::min(centres.size(), static_cast<std::size_t>(14 * std::sqrt(centres.size())))),
        edge_(3 * std::sqrt(s.height / static_cast<double>(first_))),
        grid_(centres.size(), edge_, [&](std::size_t i) { return place(centres[i]); }) {}

  [[nodiscard]] std::size_t first() const { return first_; }
  /// Of the others all whose distance squared is at most `reach`, in their order.
  const std::vector<std::size_t>& near(const Point& c, double reach) {
    near_.clear();
    if (reach > edge_ * edge_) {
      for (std::size_t j = first_; j < centres_.size(); ++j) near_.push_back(j);
      return near_;
    }
    for (const double x : images(c[0], 1)) {
      for (const double y : images(c[1], settings_.height)) {
        grid_.around(place({x, y}), [&](std::int32_t other) {
          const auto j = static_cast<std::size_t>(other);
          if (j >= first_ && square_apart(centres_[j], c, settings_) <= reach) near_.push_back(j);
        });
      }
    }
    std::sort(near_.begin(), near_.end());
    near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
    return near_;
  }

 private:
  static std::array<double, 3> place(const Point& p) { return {p[0], p[1], 0}; }
  // Those of a place that lie within an edge of the box.
  [[nodiscard]] std::vector<double> images(double at, double period) const {
    std::vector<double> found{at};
    if (settings_.periodic && at < edge_) found.push_back(at + period);
    if (settings_.periodic && at > period - edge_) found.push_back(at - period);
    return found;
  }

  const std::vector<Point>& centres_;
  const VoronoiSettings& settings_;
  std::size_t first_;
  double edge_;
  CellGrid grid_;
  std::vector<std::size_t> near_;
};

std::vector<Outline> cells(const std::vector<Point>& centres, const VoronoiSettings& s) {
  Cutters cutters(centres, s);
  std::vector<Outline> result;
  Cutter cutter;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Point& c = centres[i];
    Outline cell = s.periodic ? Outline{{c[0] - 1, c[1] - s.height},
                                        {c[0] + 1, c[1] - s.height},
                                        {c[0] + 1, c[1] + s.height},
                                        {c[0] - 1, c[1] + s.height}}
                              : Outline{{0, 0}, {1, 0}, {1, s.height}, {0, s.height}};
    const int images = s.periodic ? 1 : 0;
    double reach = reach_of(cell, c);
    const auto cut_by = [&](std::size_t j) {
      if (square_apart(centres[j], c, s) > reach) return;
      for (int sx = -images; sx <= images; ++sx) {
        for (int sy = -images; sy <= images; ++sy) {
          if (i == j && sx == 0 && sy == 0) continue;
          cutter.cut(cell, c, {centres[j][0] + sx, centres[j][1] + sy * s.height});
        }
      }
      reach = reach_of(cell, c);
    };
    for (std::size_t j = 0; j < cutters.first(); ++j) cut_by(j);
    for (const std::size_t j : cutters.near(c, reach)) cut_by(j);
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
  const std::vector<Outline> cells = outlines(map);
  for (std::size_t f = 0; f < cells.size(); ++f) {
    const Outline& cell = cells[f];
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

namespace {

// Which way round the outlines of grains run; one that runs the other way is the outside.
enum class Sense { counter_clockwise, clockwise, either };

double area_of(double signed_area, Sense sense, double cell) {
  if (sense == Sense::either) return std::fabs(signed_area);
  const double inner = sense == Sense::clockwise ? -signed_area : signed_area;
  return inner >= 0 ? inner : cell + inner;
}

// Elle's files run counter-clockwise, those made of pictures may run clockwise, those made by hand any way: the sense
// by which the flynns fill the cell is the one that is meant.
Sense sense_of(const std::vector<double>& areas, double cell) {
  const auto missed = [&](Sense sense) {
    double total = 0;
    for (const double a : areas) total += area_of(a, sense, cell);
    return std::fabs(total / cell - 1);
  };
  const bool all_clockwise = std::all_of(areas.begin(), areas.end(), [](double a) { return a < 0; });
  Sense best = all_clockwise ? Sense::clockwise : Sense::counter_clockwise;
  if (all_clockwise || missed(best) < 0.01) return best;
  for (const Sense other : {Sense::clockwise, Sense::either}) {
    if (missed(other) < 0.01) return other;
  }
  return best;
}

// Calls visit(row, first column, end column) for the particles inside any image of an outline.
template <class Visit>
void scan_images(const ElleMap& map, const Outline& cell, const Sheet& sheet, Visit visit) {
  const double width = map.high[0] - map.low[0], height = map.high[1] - map.low[1];
  Point low = cell.front(), high = low;
  for (const Point& p : cell) {
    for (std::size_t q = 0; q < 2; ++q) low[q] = std::min(low[q], p[q]), high[q] = std::max(high[q], p[q]);
  }
  const double top = width * (sheet.y.back() + sheet.radius0);
  const auto first = [](double from, double step) { return static_cast<int>(std::floor(from / step)); };
  const auto last = [](double to, double step) { return static_cast<int>(std::ceil(to / step)); };
  for (int sy = first(map.low[1] - high[1], height); sy <= last(map.low[1] + top - low[1], height); ++sy) {
    const double moved = sy * map.shear;
    for (int sx = first(map.low[0] - high[0] - moved, width); sx <= last(map.high[0] - low[0] - moved, width); ++sx) {
      Outline image = cell;
      for (Point& p : image) p[0] += sx * width + moved, p[1] += sy * height;
      scan(image, sheet, map.low[0], map.low[1], width, visit);
    }
  }
}

[[noreturn]] void refuse(const ElleMap& map, std::size_t flynn, const std::string& wrong, const char* right) {
  throw InputError({map.source, map.flynns[flynn].line, 0}, "FLYNNS", wrong, right);
}

std::size_t most(const std::vector<int>& counts) {
  return static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

}  // namespace

Cover cover(const ElleMap& map, const Sheet& sheet) {
  const double width = map.high[0] - map.low[0], height = map.high[1] - map.low[1];
  const std::size_t flynns = map.flynns.size();
  const std::vector<Outline> outlines = sheet::outlines(map);
  std::vector<double> areas;
  for (const Outline& outline : outlines) areas.push_back(area(outline));
  const Sense sense = sense_of(areas, width * height);
  Cover result;
  result.flynn.assign(static_cast<std::size_t>(sheet.particles()), -1);
  std::vector<std::uint8_t> times(result.flynn.size(), 0);
  std::vector<std::uint8_t> inside;
  std::vector<int> doubled(flynns, 0);
  std::vector<std::int32_t> under(flynns, -1);
  double total = 0;
  for (std::size_t f = 0; f < flynns; ++f) {
    total += area_of(areas[f], sense, width * height);
    const auto take = [&](std::size_t i) {
      if (times[i] == 0) {
        result.flynn[i] = static_cast<std::int32_t>(f);
      } else {
        ++doubled[f];
        under[f] = result.flynn[i];
      }
      if (times[i] < 2) ++times[i];
    };
    const bool outside = sense == Sense::clockwise ? areas[f] > 0 : sense != Sense::either && areas[f] < 0;
    if (outside) inside.assign(times.size(), 0);
    scan_images(map, outlines[f], sheet, [&](int row, int begin, int end) {
      for (int c = begin; c < end; ++c) {
        const auto i = static_cast<std::size_t>(row * sheet.lattice.columns + c);
        if (outside)
          inside[i] = 1;
        else
          take(i);
      }
    });
    for (std::size_t i = 0; outside && i < times.size(); ++i) {
      if (!inside[i]) take(i);
    }
  }
  for (const auto t : times) {
    if (t == 0) ++result.holes;
    if (t > 1) ++result.overlaps;
  }
  result.area_share = total / (width * height);
  const int allowed = std::max(2, sheet.particles() / 100);
  const auto share = [&](int count) { return 100.0 * count / sheet.particles(); };
  if (result.overlaps > allowed) {
    const std::size_t f = most(doubled);
    const auto& other = map.flynns[static_cast<std::size_t>(under[f])];
    refuse(map, f,
           fmt::format("{:.2g} % of the cell lie in more than one flynn, most of them in flynn {} and in flynn {} of "
                       "line {}",
                       share(result.overlaps), map.flynns[f].id, other.id, other.line),
           "outlines meet and do not overlap; the outline round a hole runs the other way round");
  }
  if (result.holes == sheet.particles()) refuse(map, 0, "no flynn covers any part of the cell", "outlines fill it");
  const bool many = result.holes > allowed;
  const std::vector<std::int32_t> before = result.flynn;
  if (result.holes > 0) fill_holes(result.flynn, sheet.lattice);
  if (many) {
    std::vector<int> filled(flynns, 0);
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i] < 0) ++filled[static_cast<std::size_t>(result.flynn[i])];
    }
    const std::size_t f = most(filled);
    refuse(map, f,
           fmt::format("{:.2g} % of the cell lie in no flynn, most of them beside flynn {}", share(result.holes),
                       map.flynns[f].id),
           "the outlines fill the cell");
  }
  return result;
}

std::vector<std::int32_t> nearest_unodes(const ElleMap& map, const Sheet& sheet) {
  const double width = map.high[0] - map.low[0], height = map.high[1] - map.low[1];
  const double top = width * (sheet.y.back() + sheet.radius0);
  // Unodes and their images in and round the sheet's box, in buckets of about one unode each.
  const double side = std::sqrt(width * height / static_cast<double>(map.unodes.size()));
  const double margin = std::min(0.5 * std::max(width, height), 4 * side + 0.5 * std::min(width, height));
  const Point low{map.low[0] - margin, map.low[1] - margin}, high{map.high[0] + margin, map.low[1] + top + margin};
  const int nx = 1 + static_cast<int>((high[0] - low[0]) / side), ny = 1 + static_cast<int>((high[1] - low[1]) / side);
  const auto bucket = [&](double at, double from, int n) {
    return std::clamp(static_cast<int>((at - from) / side), 0, n - 1);
  };
  struct Image {
    Point place;
    std::int32_t unode;
  };
  std::vector<std::vector<Image>> buckets(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  for (std::size_t u = 0; u < map.unodes.size(); ++u) {
    const Point& p = map.unodes[u].place;
    const auto lowest = std::ceil((low[1] - p[1]) / height), highest = std::floor((high[1] - p[1]) / height);
    for (double sy = lowest; sy <= highest; ++sy) {
      const double y = p[1] + sy * height, x = p[0] + sy * map.shear;
      for (double sx = std::ceil((low[0] - x) / width); sx <= std::floor((high[0] - x) / width); ++sx) {
        const Point at{x + sx * width, y};
        const auto b = static_cast<std::size_t>(bucket(at[1], low[1], ny)) * static_cast<std::size_t>(nx) +
                       static_cast<std::size_t>(bucket(at[0], low[0], nx));
        buckets[b].push_back({at, static_cast<std::int32_t>(u)});
      }
    }
  }
  std::vector<std::int32_t> nearest;
  nearest.reserve(static_cast<std::size_t>(sheet.particles()));
  for (std::size_t i = 0; i < static_cast<std::size_t>(sheet.particles()); ++i) {
    const double x = map.low[0] + width * (sheet.x[i] - 0.5 * sheet.radius0), y = map.low[1] + width * sheet.y[i];
    const int bx = bucket(x, low[0], nx), by = bucket(y, low[1], ny);
    double best = std::numeric_limits<double>::infinity();
    std::int32_t found = -1;
    for (int ring = 0; ring <= std::max(nx, ny) && (ring - 1) * side <= best; ++ring) {
      for (int iy = std::max(0, by - ring); iy <= std::min(ny - 1, by + ring); ++iy) {
        const bool edge = iy == by - ring || iy == by + ring;
        for (int ix = bx - ring; ix <= bx + ring; ix += edge || ring == 0 ? 1 : 2 * ring) {
          if (ix < 0 || ix >= nx) continue;
          for (const Image& image :
               buckets[static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(ix)]) {
            const double distance = std::hypot(image.place[0] - x, image.place[1] - y);
            if (distance < best || (distance == best && image.unode < found)) best = distance, found = image.unode;
          }
        }
      }
    }
    nearest.push_back(found);
  }
  return nearest;
}

double toughness_factor(int columns, int reference) { return std::sqrt(static_cast<double>(columns) / reference); }

void apply_disorder(Sheet& sheet, const Cover& cover, const std::vector<GrainProperties>& grains,
                    const DisorderSettings& settings, std::uint64_t seed,
                    const std::vector<GrainProperties>& particles) {
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
    const auto i = static_cast<std::size_t>(sheet.first(slot)), j = static_cast<std::size_t>(sheet.second(slot));
    const auto a = static_cast<std::size_t>(cover.flynn[i]), b = static_cast<std::size_t>(cover.flynn[j]);
    sheet.stiffness[k] *= 0.5 * (stiffness[a] + stiffness[b]);
    if (!particles.empty()) sheet.stiffness[k] *= 0.5 * (particles[i].stiffness + particles[j].stiffness);
    sheet.between[k] = a != b ? 1 : 0;
    if (along_wall(sheet, slot)) continue;
    sheet.threshold[k] =
        settings.strength * draw * 0.5 * (grains[a].strength + grains[b].strength) * (a != b ? settings.boundary : 1.0);
    if (!particles.empty()) sheet.threshold[k] *= 0.5 * (particles[i].strength + particles[j].strength);
  }
}

}  // namespace dem::sheet
