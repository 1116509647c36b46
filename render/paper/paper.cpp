#include "render/paper/paper.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/paper/text.h"

namespace render {

void Paper::polygon(std::vector<Vec2> convex, const Colour& colour, double opacity) {
  if (convex.size() >= 3) items_.emplace_back(Fill{std::move(convex), {}, colour, opacity});
}

void Paper::rectangle(const Rect& r, const Colour& colour, double opacity) {
  polygon({{r.left, r.top}, {r.right, r.top}, {r.right, r.bottom}, {r.left, r.bottom}}, colour, opacity);
}

void Paper::band(std::vector<Vec2> upper, std::vector<Vec2> lower, const Colour& colour, double opacity) {
  if (upper.size() >= 2 && upper.size() == lower.size())
    items_.emplace_back(Fill{std::move(upper), std::move(lower), colour, opacity});
}

void Paper::line(std::vector<Vec2> points, const Stroke& stroke) {
  if (points.size() >= 2 && stroke.line != Line::none) items_.emplace_back(Path{std::move(points), stroke});
}

void Paper::frame(const Rect& r, const Stroke& stroke) {
  // One more step along the first side closes the corner.
  line({{r.left, r.top}, {r.right, r.top}, {r.right, r.bottom}, {r.left, r.bottom}, {r.left, r.top}, {r.right, r.top}},
       stroke);
}

void Paper::hatch(const Rect& r, Pattern pattern, double gap, const Stroke& stroke) {
  if (pattern == Pattern::none) return;
  const double height = r.height(), step = gap * std::numbers::sqrt2;
  // Lines keep their places on the paper, so that bars beside each other are hatched alike.
  for (double k = std::ceil((r.left - height) / step); k * step < r.right; ++k) {
    const Vec2 low{k * step, r.bottom}, high{k * step + height, r.top};
    const std::vector<Vec2> across = pattern == Pattern::rising ? std::vector<Vec2>{low, high}
                                                                : std::vector<Vec2>{{low.x, r.top}, {high.x, r.bottom}};
    for (auto& piece : clip(across, r)) line(std::move(piece), stroke);
  }
}

void Paper::marker(Marker marker, const Vec2& at, double size, const Colour& colour, bool hollow) {
  if (hollow && marker != Marker::none && marker != Marker::cross) {
    this->marker(marker, at, size + 2.4, colour);
    // The rim of a triangle is as wide as that of a circle when its middle shrinks by twice as much.
    this->marker(marker, at, marker == Marker::triangle ? size - 2.6 : size - 0.8, {1, 1, 1});
    return;
  }
  const double r = size / 2;
  const auto corners = [&](int count, double turn, double radius) {
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) {
      const double angle = turn + 2 * std::numbers::pi * i / count;
      points.push_back({at.x + radius * std::cos(angle), at.y + radius * std::sin(angle)});
    }
    return points;
  };
  constexpr double quarter = std::numbers::pi / 4;
  switch (marker) {
    case Marker::none:
      break;
    case Marker::circle:
      polygon(corners(20, 0, r), colour);
      break;
    case Marker::square:
      polygon(corners(4, quarter, 1.25 * r), colour);
      break;
    case Marker::diamond:
      polygon(corners(4, 0, 1.25 * r), colour);
      break;
    case Marker::triangle:
      polygon(corners(3, -2 * quarter, 1.25 * r), colour);
      break;
    case Marker::cross: {
      const Stroke stroke{colour, std::max(1.2, size / 5), Line::solid};
      line({{at.x - r, at.y - r}, {at.x + r, at.y + r}}, stroke);
      line({{at.x - r, at.y + r}, {at.x + r, at.y - r}}, stroke);
      break;
    }
  }
}

void Paper::text(const std::string& text, const Vec2& at, const TextStyle& style) {
  const std::vector<Piece> pieces = pieces_of(text);
  if (pieces.size() == 1 && pieces[0].shift == 0) {  // the reader's own font may differ: keep the anchor
    items_.emplace_back(Run{at, pieces[0].text, style, false});
    return;
  }
  const double width = text_width(text, style.size, style.bold);
  double along = style.anchor == Anchor::start ? 0 : style.anchor == Anchor::middle ? -width / 2 : -width;
  for (const Piece& piece : pieces) {
    TextStyle own = style;
    own.anchor = Anchor::start;
    own.size = style.size * piece.scale;
    const double rise = piece.shift * style.size;
    const Vec2 place = style.upward ? Vec2{at.x - rise, at.y - along} : Vec2{at.x + along, at.y - rise};
    items_.emplace_back(Run{place, piece.text, own, piece.shift != 0});
    along += run_width(piece.text, own.size, own.bold);
  }
}

void Paper::append(const Paper& other, const Vec2& by) {
  const auto move = [&](std::vector<Vec2>& points) {
    for (Vec2& p : points) p = {p.x + by.x, p.y + by.y};
  };
  for (Item item : other.items_) {
    if (auto* fill = std::get_if<Fill>(&item)) {
      move(fill->edge);
      move(fill->lower);
    } else if (auto* path = std::get_if<Path>(&item)) {
      move(path->points);
    } else {
      Run& run = std::get<Run>(item);
      run.at = {run.at.x + by.x, run.at.y + by.y};
    }
    items_.push_back(std::move(item));
  }
}

std::vector<std::vector<Vec2>> clip(const std::vector<Vec2>& line, const Rect& window) {
  std::vector<std::vector<Vec2>> pieces;
  bool open = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 &a = line[i], &b = line[i + 1];
    if (!std::isfinite(a.x) || !std::isfinite(a.y) || !std::isfinite(b.x) || !std::isfinite(b.y)) {
      open = false;
      continue;
    }
    double from = 0, to = 1;
    const auto limit = [&](double step, double room) {  // keeps t with step * t <= room
      if (step == 0) {
        if (room < 0) to = -1;
      } else if (step > 0) {
        to = std::min(to, room / step);
      } else {
        from = std::max(from, room / step);
      }
    };
    const double dx = b.x - a.x, dy = b.y - a.y;
    limit(dx, window.right - a.x);
    limit(-dx, a.x - window.left);
    limit(dy, window.bottom - a.y);
    limit(-dy, a.y - window.top);
    if (from > to) {
      open = false;
      continue;
    }
    if (!open || from > 0) pieces.push_back({{a.x + from * dx, a.y + from * dy}});
    pieces.back().push_back({a.x + to * dx, a.y + to * dy});
    open = to >= 1;
  }
  return pieces;
}

}  // namespace render
