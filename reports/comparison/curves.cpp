// CSV files as curves, and curves with fewer points.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "reports/comparison/snapshot.h"

namespace comparison {
namespace {

using Cells = std::vector<std::string>;

/// RFC 4180.
std::vector<Cells> rows_of(std::string_view text) {
  std::vector<Cells> rows;
  Cells row;
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        cell += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cell += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      row.push_back(std::move(cell));
      cell.clear();
    } else if (c == '\n') {
      row.push_back(std::move(cell));
      cell.clear();
      rows.push_back(std::move(row));
      row.clear();
    } else if (c != '\r') {
      cell += c;
    }
  }
  if (!cell.empty() || !row.empty()) {
    row.push_back(std::move(cell));
    rows.push_back(std::move(row));
  }
  return rows;
}

bool read(const std::string& cell, double& value) {
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

/// True when most of its cells that are not empty are numbers: a head may stand in the midst of a file.
bool is_numeric(const std::vector<Cells>& rows, std::size_t column) {
  std::size_t numbers = 0, words = 0;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    if (column >= rows[r].size() || rows[r][column].empty()) continue;
    double value = 0;
    ++(read(rows[r][column], value) ? numbers : words);
  }
  return numbers > words;
}

struct Span {
  double low = 0, high = 0;
  [[nodiscard]] double size() const {
    return high > low ? high - low : std::max({std::abs(high), std::abs(low), 1e-300});
  }
};

Span span_of(const Curve& curve, bool of_y) {
  Span span;
  bool first = true;
  for (const auto& [x, y] : curve.points) {
    const double value = of_y ? y : x;
    if (!std::isfinite(value)) continue;
    span.low = first ? value : std::min(span.low, value);
    span.high = first ? value : std::max(span.high, value);
    first = false;
  }
  return span;
}

using Point = std::pair<double, double>;

double distance(const Point& p, const Point& a, const Point& b, double width, double height) {
  const double bx = (b.first - a.first) / width, by = (b.second - a.second) / height;
  const double px = (p.first - a.first) / width, py = (p.second - a.second) / height;
  const double length = bx * bx + by * by;
  const double at = length > 0 ? std::clamp((px * bx + py * by) / length, 0.0, 1.0) : 0.0;
  return std::hypot(px - at * bx, py - at * by);
}

double rounded(double value) { return std::stod(fmt::format("{:.5g}", value)); }

}  // namespace

std::vector<Curve> curves_of_csv(std::string_view text) {
  const std::vector<Cells> rows = rows_of(text);
  if (rows.size() < 2) return {};
  const Cells& head = rows.front();
  std::vector<std::size_t> numbers, words;
  for (std::size_t c = 0; c < head.size(); ++c) (is_numeric(rows, c) ? numbers : words).push_back(c);
  std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;
  std::map<std::string, std::size_t> places;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    std::string key;
    for (const std::size_t c : words) {
      if (c < rows[r].size() && !rows[r][c].empty()) key += (key.empty() ? "" : ", ") + rows[r][c];
    }
    const auto [at, is_new] = places.try_emplace(key, groups.size());
    if (is_new) groups.push_back({key, {}});
    groups[at->second].second.push_back(r);
  }
  std::vector<Curve> curves;
  for (const auto& [key, members] : groups) {
    const bool has_x = numbers.size() > 1 && members.size() > 1;
    if (numbers.empty()) curves.push_back({key, {}, {}, {{0, 0}}, 0});
    for (std::size_t n = has_x ? 1 : 0; n < numbers.size(); ++n) {
      Curve curve{key, has_x ? head[numbers[0]] : "row", head[numbers[n]], {}, 0};
      for (std::size_t i = 0; i < members.size(); ++i) {
        const Cells& row = rows[members[i]];
        double x = static_cast<double>(i), y = 0;
        if (has_x && (numbers[0] >= row.size() || !read(row[numbers[0]], x))) continue;
        if (numbers[n] >= row.size() || !read(row[numbers[n]], y)) continue;
        if (std::isfinite(x) && std::isfinite(y)) curve.points.emplace_back(x, y);
      }
      if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
  }
  return curves;
}

Curve reduced(const Curve& curve, Detail detail) {
  const double share = detail == Detail::fine ? 5e-4 : 1e-3;
  const std::size_t most = detail == Detail::fine ? 400 : 64;
  if (curve.points.size() <= 16) return curve;
  const double width = span_of(curve, false).size(), height = span_of(curve, true).size();
  // Douglas and Peucker (1973), the farthest point first, so that the first `most` are the best ones.
  struct Piece {
    double far;
    std::size_t from, to, at;
    bool operator<(const Piece& other) const { return far < other.far || (far == other.far && from > other.from); }
  };
  const auto piece = [&](std::size_t from, std::size_t to) {
    Piece found{0, from, to, from};
    for (std::size_t i = from + 1; i < to; ++i) {
      const double far = distance(curve.points[i], curve.points[from], curve.points[to], width, height);
      if (far > found.far) found = {far, from, to, i};
    }
    return found;
  };
  std::vector<Piece> heap{piece(0, curve.points.size() - 1)};
  std::vector<std::size_t> kept{0, curve.points.size() - 1};
  while (!heap.empty() && heap.front().far > share && kept.size() < most) {
    std::pop_heap(heap.begin(), heap.end());
    const Piece worst = heap.back();
    heap.pop_back();
    kept.push_back(worst.at);
    for (const auto& [from, to] : {std::pair{worst.from, worst.at}, std::pair{worst.at, worst.to}}) {
      heap.push_back(piece(from, to));
      std::push_heap(heap.begin(), heap.end());
    }
  }
  std::ranges::sort(kept);
  Curve less{curve.key, curve.x, curve.y, {}, heap.empty() ? 0 : heap.front().far};
  for (const std::size_t i : kept) {
    const auto [x, y] = curve.points[i];
    less.points.emplace_back(detail == Detail::fine ? Point{x, y} : Point{rounded(x), rounded(y)});
  }
  return less;
}

}  // namespace comparison
