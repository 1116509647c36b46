#include "reports/figures/texture/nets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/chart/chart.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

using Place = std::array<double, 2>;  // px

constexpr double text_size = 12.5, line_height = 16;
constexpr std::string_view ink = "#333333", mark = "#b34700";

std::string hex(const render::Colour& c) {
  const auto part = [](double v) { return static_cast<int>(std::lround(255 * v)); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(c.red), part(c.green), part(c.blue));
}

std::string text(double x, double y, std::string_view words, std::string_view anchor = "middle", bool bold = false) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\"{} fill=\"{}\">{}</text>", x,
                     y, anchor, text_size, bold ? " font-weight=\"bold\"" : "", ink, words);
}

std::string circle(const Place& at, double radius, std::string_view fill, std::string_view stroke, double width) {
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>",
                     at[0], at[1], radius, fill, stroke, width);
}

std::string path(const std::string& d, std::string_view fill, std::string_view stroke, double width) {
  return fmt::format("<path d=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>", d,
                     fill, stroke, width);
}

std::string page(int width, double height, const std::string& body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
      "height=\"{1:.0f}\" font-family=\"DejaVu Sans\">{2}</svg>",
      width, height, body);
}

/// Places for drawings in rows: as many beside each other as fill rows evenly. One alone is as wide as a column.
struct Rows {
  explicit Rows(std::size_t count)
      : all(count),
        columns(count == 4 || count > 6 ? 4 : 3),
        width(count == 1 ? render::column_width : render::page_width) {
    cell = static_cast<double>(render::page_width) / static_cast<double>(columns);
    radius = columns == 4 ? 78 : 96;
  }
  std::size_t all, columns;
  int width;                               // px
  double cell = 0, radius = 0, words = 0;  // px; `words`: lines below each
  [[nodiscard]] double pitch() const { return 2 * radius + 62 + line_height * words; }
  [[nodiscard]] Place centre(std::size_t k) const {
    const std::size_t row = k / columns, here = std::min(columns, all - row * columns);
    const double left = 0.5 * (width - cell * static_cast<double>(here));
    return {left + cell * (static_cast<double>(k % columns) + 0.5), 42 + radius + pitch() * static_cast<double>(row)};
  }
  [[nodiscard]] double height() const { return pitch() * static_cast<double>((all + columns - 1) / columns); }
};

template <class Item>
Rows rows_of(const std::vector<Item>& items) {
  Rows rows(items.size());
  for (const Item& item : items) rows.words = std::max(rows.words, static_cast<double>(item.words.size()));
  return rows;
}

// Label, frame with its two directions, and the words below.
template <class Item>
std::string around(const Rows& rows, const Place& c, const Item& item) {
  const double r = rows.radius;
  std::string body = circle(c, r, "none", ink, 1.2);
  for (int k = 0; k < 4; ++k) {
    const double u = k == 0 ? 1 : k == 2 ? -1 : 0, v = k == 1 ? 1 : k == 3 ? -1 : 0;
    body += path(
        fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", c[0] + r * u, c[1] - r * v, c[0] + (r + 5) * u, c[1] - (r + 5) * v),
        "none", ink, 1.2);
  }
  body += text(c[0] + r + 9, c[1] + 4, "x", "start") + text(c[0] + 9, c[1] - r - 5, "y", "start");
  body += text(c[0] - 6, c[1] - r - 20, item.label, "middle", true);
  for (std::size_t k = 0; k < item.words.size(); ++k)
    body += text(c[0], c[1] + r + 22 + line_height * static_cast<double>(k), item.words[k]);
  return body;
}

// Values of a density over the disc and a little beyond, on a square grid.
struct Field {
  static constexpr int steps = 52;
  static constexpr double reach = 1.04;
  std::vector<double> value;
  static double place(int i) { return reach * (2.0 * i / steps - 1); }
  [[nodiscard]] double at(int i, int j) const { return value[static_cast<std::size_t>(j * (steps + 1) + i)]; }
};

Field field_of(const analysis::PoleDensity& density) {
  Field field;
  for (int j = 0; j <= Field::steps; ++j) {
    for (int i = 0; i <= Field::steps; ++i) {
      const double x = Field::place(i), y = Field::place(j);
      const bool near = std::hypot(x, y) < Field::reach + 0.05;
      field.value.push_back(near ? density.times_uniform(analysis::from_schmidt(x, y)) : 0);
    }
  }
  return field;
}

/// A square of the grid, cut by a level.
struct Square {
  std::array<Place, 4> corner;
  std::array<double, 4> value;
  [[nodiscard]] Place between(std::size_t a, std::size_t b, double level) const {
    const double part = (level - value[a]) / (value[b] - value[a]);
    return {corner[a][0] + part * (corner[b][0] - corner[a][0]), corner[a][1] + part * (corner[b][1] - corner[a][1])};
  }
};

std::string points(const std::vector<Place>& of) {
  std::string d;
  for (std::size_t k = 0; k < of.size(); ++k)
    d += fmt::format("{}{:.1f} {:.1f}", k == 0 ? "M" : "L", of[k][0], of[k][1]);
  return d;
}

template <class Take>
void for_squares(const Field& field, const Place& c, double radius, Take take) {
  for (int j = 0; j < Field::steps; ++j) {
    for (int i = 0; i < Field::steps; ++i) {
      Square square;
      for (std::size_t k = 0; k < 4; ++k) {
        const int u = i + (k == 1 || k == 2), v = j + (k > 1);
        square.corner[k] = {c[0] + radius * Field::place(u), c[1] - radius * Field::place(v)};
        square.value[k] = field.at(u, v);
      }
      take(square);
    }
  }
}

// All of the disc where the density is above a level, as one path: squares that are whole, in runs, and parts of others.
std::string above(const Field& field, double level, const Place& c, double radius) {
  std::string d;
  std::vector<Place> run;  // left and right sides of whole squares in a row
  const auto close = [&] {
    if (!run.empty()) d += points(run) + "Z";
    run.clear();
  };
  for_squares(field, c, radius, [&](const Square& s) {
    const auto inside = [&](std::size_t k) { return s.value[k] >= level; };
    const int count = inside(0) + inside(1) + inside(2) + inside(3);
    const bool goes_on = !run.empty() && run[0][1] == s.corner[0][1];
    if (count == 4 && goes_on) {
      run[1] = s.corner[1];
      run[2] = s.corner[2];
      return;
    }
    close();
    if (count == 4) run.assign(s.corner.begin(), s.corner.end());
    if (count == 4 || count == 0) return;
    std::vector<Place> part;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      if (inside(k)) part.push_back(s.corner[k]);
      if (inside(k) != inside(next)) part.push_back(s.between(k, next, level));
    }
    d += points(part) + "Z";
  });
  close();
  return d;
}

std::string contour(const Field& field, double level, const Place& c, double radius) {
  std::string d;
  for_squares(field, c, radius, [&](const Square& s) {
    std::vector<Place> ends;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      if ((s.value[k] >= level) != (s.value[next] >= level)) ends.push_back(s.between(k, next, level));
    }
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) d += points({ends[k], ends[k + 1]});
  });
  return d;
}

// What lies beyond the disc, in white.
std::string rim(const Place& c, double r) {
  const double side = r * (Field::reach + 0.02);
  return fmt::format(
      "<path d=\"M{0:.1f} {1:.1f}h{2:.1f}v{2:.1f}h-{2:.1f}ZM{3:.1f} {4:.1f}a{5:.1f} {5:.1f} 0 1 0 "
      "{6:.1f} 0a{5:.1f} {5:.1f} 0 1 0 -{6:.1f} 0Z\" fill=\"#ffffff\" fill-rule=\"evenodd\"/>",
      c[0] - side, c[1] - side, 2 * side, c[0] - r, c[1], r, 2 * r);
}

Place on_disc(const analysis::Direction& pole, const Place& c, double r) {
  const auto [x, y] = analysis::schmidt(pole);
  return {c[0] + r * x, c[1] - r * y};
}

// The plane of a pole as its great circle.
std::string great_circle(const analysis::Direction& pole, const Place& c, double r) {
  const double across = std::hypot(pole[0], pole[1]);
  const analysis::Direction u =
      across > 1e-9 ? analysis::Direction{-pole[1] / across, pole[0] / across, 0} : analysis::Direction{1, 0, 0};
  analysis::Direction v{pole[1] * u[2] - pole[2] * u[1], pole[2] * u[0] - pole[0] * u[2],
                        pole[0] * u[1] - pole[1] * u[0]};
  if (v[2] > 0) v = {-v[0], -v[1], -v[2]};
  std::vector<Place> line;
  constexpr int steps = 48;
  for (int k = 0; k <= steps; ++k) {
    const double t = std::numbers::pi * k / steps, a = std::cos(t), b = std::sin(t);
    const analysis::Direction d{a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]};
    // The two ends lie on the rim, where either hemisphere would do.
    const auto [x, y] = k == 0 || k == steps ? std::array{d[0], d[1]} : analysis::schmidt(d);
    line.push_back({c[0] + r * x, c[1] - r * y});
  }
  return points(line);
}

// Levels that the largest density of all nets asks for: 1 and, in round steps, up to five more.
std::vector<double> levels_for(double largest) {
  constexpr std::array steps{0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0};
  const auto* step = std::ranges::find_if(steps, [&](double s) { return 1 + 6 * s >= largest; });
  const double width = step == steps.end() ? steps.back() : *step;
  std::vector<double> levels;
  for (int k = 0; k < 6; ++k)
    if (k == 0 || 1 + k * width < largest) levels.push_back(1 + k * width);
  return levels;
}

std::string fill_of(std::size_t level, std::size_t levels) {
  // Dark enough to be seen on white, light enough for what is drawn over it.
  return hex(render::ordered(level + 1, std::max<std::size_t>(levels, 3) + 3));
}

// A key below drawings: entries beside each other as far as there is room.
class Key {
 public:
  Key(int width, double y) : width_(width), y_(y) {}
  /// `draw` is given the place of an entry of so many px, and returns it.
  template <class Draw>
  void add(double wide, const Draw& draw) {
    if (x_ > margin && x_ + wide > width_) x_ = margin, y_ += line;
    body_ += draw(x_, y_);
    x_ += wide;
  }
  [[nodiscard]] const std::string& body() const { return body_; }
  [[nodiscard]] double bottom() const { return y_ + line; }

 private:
  static constexpr double margin = 12, line = 22;
  double width_, x_ = margin, y_;
  std::string body_;
};

Key key_of(const std::vector<double>& levels, int width, double y, bool dots) {
  Key key(width, y);
  // Levels that do not fit beside their words stand together below them.
  const double lead = 232, step = 72, all = lead + step * static_cast<double>(levels.size());
  key.add(all < width ? lead : width,
          [](double x, double at) { return text(x, at + 11, "density, in multiples of uniform:", "start"); });
  for (std::size_t k = 0; k < levels.size(); ++k) {
    key.add(step, [&](double x, double at) {
      return fmt::format(
                 "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"16\" height=\"14\" fill=\"{}\" stroke=\"{}\" "
                 "stroke-width=\"0.6\"/>",
                 x, at, fill_of(k, levels.size()), ink) +
             text(x + 21, at + 11, fmt::format("≥ {:g}", levels[k]), "start");
    });
  }
  key.add(330, [](double x, double at) {
    return path(fmt::format("M{:.1f} {:.1f}h26", x, at + 7), "none", ink, 1) +
           text(x + 33, at + 11, "three standard deviations above uniform", "start");
  });
  key.add(290, [](double x, double at) {
    return path(fmt::format("M{:.1f} {:.1f}h26", x, at + 7), "none", mark, 2.2) +
           circle({x + 13, at + 7}, 4, "#ffffff", mark, 2) +
           text(x + 33, at + 11, "largest density: its pole, its plane", "start");
  });
  if (dots) {
    key.add(120, [](double x, double at) {
      return circle({x + 6, at + 7}, 2.6, ink, "none", 0) + text(x + 15, at + 11, "poles, where few", "start");
    });
  }
  return key;
}

}  // namespace

std::string nets_drawing(const std::vector<Net>& nets, double largest) {
  Rows rows = rows_of(nets);
  largest = std::max(largest, 1.0);
  bool dots = false;
  for (const Net& net : nets) {
    if (net.maximum) largest = std::max(largest, net.maximum->times_uniform);
    dots = dots || !net.maximum;
  }
  const std::vector<double> levels = levels_for(largest);
  std::string body;
  for (std::size_t n = 0; n < nets.size(); ++n) {
    const Net& net = nets[n];
    const Place c = rows.centre(n);
    const double r = rows.radius;
    if (net.maximum) {
      const analysis::PoleDensity density(net.poles);
      const Field field = field_of(density);
      for (std::size_t k = 0; k < levels.size(); ++k) {
        const std::string d = above(field, levels[k], c, r);
        if (!d.empty()) body += path(d, fill_of(k, levels.size()), "none", 0);
      }
      const std::string chance = contour(field, density.from_deviations(3), c, r);
      if (!chance.empty()) body += path(chance, "none", ink, 0.9);
      body += rim(c, r);
      const std::string plane = great_circle(net.maximum->pole, c, r);
      body += path(plane, "none", "#ffffff", 4.2) + path(plane, "none", mark, 2.2);
      body += circle(on_disc(net.maximum->pole, c, r), 4.5, "#ffffff", mark, 2);
    } else {
      for (const analysis::Direction& pole : net.poles.direction)
        body += circle(on_disc(pole, c, r), 2.6, ink, "none", 0);
    }
    body += around(rows, c, net);
  }
  const Key key = key_of(levels, rows.width, rows.height() + 4, dots);
  return page(rows.width, key.bottom(), body + key.body());
}

std::string roses_drawing(const std::vector<Rose>& roses) {
  Rows rows = rows_of(roses);
  double most = 0;
  for (const Rose& rose : roses)
    for (const double s : rose.share) most = std::max(most, s);
  std::string body;
  for (std::size_t n = 0; n < roses.size() && most > 0; ++n) {
    const Rose& rose = roses[n];
    const Place c = rows.centre(n);
    const double r = rows.radius;
    const auto sectors = rose.share.size();
    for (std::size_t k = 0; k < 2 * sectors; ++k) {
      const double width = std::numbers::pi / static_cast<double>(sectors), from = width * static_cast<double>(k),
                   to = from + width, length = r * std::sqrt(rose.share[k % sectors] / most);
      if (!(length > 0)) continue;
      body += path(fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}A{:.1f} {:.1f} 0 0 0 {:.1f} {:.1f}Z", c[0], c[1],
                               c[0] + length * std::cos(from), c[1] - length * std::sin(from), length, length,
                               c[0] + length * std::cos(to), c[1] - length * std::sin(to)),
                   hex(render::palette(5)), hex(render::palette(0)), 0.6);
    }
    const double even = r * std::sqrt(1 / (most * static_cast<double>(sectors)));
    body += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"none\" stroke=\"{}\" "
        "stroke-width=\"1.4\" stroke-dasharray=\"5 3\"/>",
        c[0], c[1], even, mark);
    body += around(rows, c, rose);
  }
  Key key(rows.width, rows.height() + 4);
  key.add(150, [](double x, double at) {
    return fmt::format(
               "<path d=\"M{:.1f} {:.1f}h26\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\" stroke-dasharray=\"5 "
               "3\"/>",
               x, at + 7, mark) +
           text(x + 33, at + 11, "uniform", "start");
  });
  key.add(300, [&](double x, double at) {
    return text(x, at + 11, fmt::format("rim: {} of the trace length in 10° of strike", percent(most, 1)), "start");
  });
  return page(rows.width, key.bottom(), body + key.body());
}

}  // namespace reports::texture
