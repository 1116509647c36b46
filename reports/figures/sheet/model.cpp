// The model itself: six neighbours, the deformation box, the order of work, grains under the particles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/sheet/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::sheet {
namespace {

constexpr std::string_view wall_fill = "#9b6a3c", particle_fill = "#c9d7e3", spring_colour = "#333333";

struct Particles {
  std::span<const double> place;
  std::span<const std::int32_t> grain, fixed;
};
Particles particles_of(const dem::Record& r) {
  const dem::Table& t = r.table("particles");
  return {t.real("position"), t.integer("grain"), t.integer("fixed")};
}

// A window of columns [c0, c1) and rows [r0, r1) with its particles and springs.
struct Window {
  int c0, c1, r0, r1;
};

/// The part of a line that lies within bounds (Liang and Barsky): false where none does.
bool clip(std::array<double, 2>& a, std::array<double, 2>& b, const std::array<double, 2>& low,
          const std::array<double, 2>& high) {
  double from = 0, to = 1;
  for (std::size_t k = 0; k < 2; ++k) {
    const double way = b[k] - a[k];
    if (way == 0) {
      if (a[k] < low[k] || a[k] > high[k]) return false;
      continue;
    }
    const double one = (low[k] - a[k]) / way, other = (high[k] - a[k]) / way;
    from = std::max(from, std::min(one, other)), to = std::min(to, std::max(one, other));
  }
  if (from > to) return false;
  const std::array<double, 2> start = a;
  for (std::size_t k = 0; k < 2; ++k) {
    const double way = b[k] - start[k];
    a[k] = start[k] + from * way, b[k] = start[k] + to * way;
  }
  return true;
}

template <class Fill>
Drawing draw_window(const dem::Record& r, const Window& w, double width, bool outlines, Fill fill) {
  const Layout l = layout_of(r);
  const Particles p = particles_of(r);
  const auto at = [&](int c, int row) { return static_cast<std::size_t>(row * l.columns + c); };
  const auto x = [&](int c, int row) { return p.place[2 * at(c, row)]; };
  const auto y = [&](int row) { return p.place[2 * at(0, row) + 1]; };
  Drawing d(x(w.c0, w.r0) - 1.6 * l.radius, y(w.r0) - 1.6 * l.radius, x(w.c1 - 1, w.r0) + 2.6 * l.radius,
            y(w.r1 - 1) + 1.6 * l.radius, width);
  for (int row = w.r0; row < w.r1; ++row) {
    for (int c = w.c0; c < w.c1; ++c) {
      const std::size_t i = at(c, row);
      d.circle(x(c, row), y(row), l.radius, fill(i), "#777777", 0.6);
    }
  }
  for (int row = w.r0; row < w.r1; ++row) {
    for (int c = w.c0; c < w.c1; ++c) {
      const int shift = row % 2;
      const int to[3][2] = {{c + 1, row}, {c + shift, row + 1}, {c + shift - 1, row + 1}};
      for (const auto& t : to) {
        if (t[0] < w.c0 || t[0] >= w.c1 || t[1] >= w.r1) continue;
        d.line(x(c, row), y(row), x(t[0], t[1]), y(t[1]), spring_colour, 1.1);
      }
    }
  }
  if (outlines) {  // as far as the particles reach
    const std::array<double, 2> low{x(w.c0, w.r0) - l.radius, y(w.r0) - l.radius},
        high{x(w.c1 - 1, w.r0) + 2 * l.radius, y(w.r1 - 1) + l.radius};
    const double node = 0.35 * l.radius;
    for (const auto& cell : outlines_of(r)) {
      for (std::size_t k = 0; k < cell.size(); ++k) {
        auto a = cell[k], b = cell[(k + 1) % cell.size()];
        if (clip(a, b, low, high)) d.line(a[0], a[1], b[0], b[1], "#c03020", 3);
      }
      for (const auto& a : cell) {
        const bool whole =
            a[0] - node > low[0] && a[0] + node < high[0] && a[1] - node > low[1] && a[1] + node < high[1];
        if (whole) d.circle(a[0], a[1], node, "#ffffff", "#c03020", 2);
      }
    }
  }
  return d;
}

bool holds(const std::vector<std::array<double, 2>>& outline, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const auto &a = outline[i], &b = outline[j];
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

// Particles that lie inside the outline of their grain; outlines go on at the other side of the box.
long inside_their_grain(const dem::Record& r) {
  const auto outlines = outlines_of(r);
  const Layout l = layout_of(r);
  const Particles p = particles_of(r);
  long found = 0;
  for (std::size_t i = 0; i < p.grain.size(); ++i) {
    const auto& outline = outlines.at(static_cast<std::size_t>(p.grain[i]));
    bool inside = false;
    for (const double dx : {0.0, -1.0, 1.0}) {
      for (const double dy : {0.0, -l.height, l.height})
        inside = inside || holds(outline, p.place[2 * i] + dx, p.place[2 * i + 1] + dy);
    }
    found += inside ? 1 : 0;
  }
  return found;
}

}  // namespace

FigureContent neighbours(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Particles lie on a triangular lattice, so that each has at most six neighbours, and are joined by linear "
      "elastic springs.";
  content.rows = {"sheet_neighbours"};
  const dem::Record* r = main_record(study);
  if (!r) return content;
  const Layout l = layout_of(*r);
  const int c = l.columns / 2 - 3, row = l.rows / 2 / 2 * 2;
  const std::size_t middle = static_cast<std::size_t>((row + 1) * l.columns + c + 3);
  Drawing d = draw_window(*r, {c, c + 7, row, row + 3}, render::column_width, false, [&](std::size_t i) {
    const auto p = particles_of(*r).place;
    const double distance = std::hypot(p[2 * i] - p[2 * middle], p[2 * i + 1] - p[2 * middle + 1]);
    return std::string(i == middle ? "#e69f00" : distance < 2.2 * l.radius ? "#f3d9a4" : std::string(particle_fill));
  });
  content.panels.push_back({.id = "",
                            .caption = "Part of the model: a particle, its six neighbours, and the springs.",
                            .alt = "A patch of 21 discs in rows; one is joined to six neighbours by springs.",
                            .content = d.finish_with_key({{"#e69f00", "a particle", false},
                                                          {"#f3d9a4", "its six neighbours", false},
                                                          {std::string(spring_colour), "springs", true}}),
                            .per_row = 2});
  content.finding = fmt::format("This sheet has {} particles in {} rows of {}, joined by {} springs.",
                                count(r->value(quantity::particles)), count(l.rows), count(l.columns),
                                count(r->value(quantity::contacts)));
  return content;
}

FigureContent box(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "The outer rows are wall particles: fixed across the boundary, free to move along it, so that the walls have no "
      "friction.";
  content.rows = {"sheet_free_slip"};
  const dem::Record* r = main_record(study);
  if (!r) return content;
  const Layout l = layout_of(*r);
  const Particles p = particles_of(*r);
  const int n = std::min(12, l.columns), m = std::min(10, l.rows);
  Drawing corner = draw_window(*r, {0, n, 0, m}, render::column_width, false,
                               [&](std::size_t i) { return std::string(p.fixed[i] ? wall_fill : particle_fill); });
  content.panels.push_back({.id = "corner",
                            .caption = "The lower left corner: wall particles (brown) and the sheet inside.",
                            .alt = "Discs along the left and lower edge are brown, all others pale.",
                            .content = corner.finish_with_key({{std::string(wall_fill), "wall particles", false},
                                                               {std::string(particle_fill), "the sheet", false}}),
                            .per_row = 2});
  content.finding =
      fmt::format("{} of {} particles are wall particles.",
                  count(static_cast<double>(std::ranges::count_if(p.fixed, [](int f) { return f != 0; }))),
                  count(r->value(quantity::particles)));
  Picture whole;
  render::Spheres spheres;
  const std::vector<std::string> fills = grain_fills(*r);
  for (std::size_t i = 0; i < p.grain.size(); ++i) {
    spheres.centre.push_back({p.place[2 * i], p.place[2 * i + 1], 0});
    spheres.radius.push_back(l.radius);
    render::Colour colour{0.61, 0.42, 0.24};
    if (!p.fixed[i]) {
      const std::string& fill = fills.at(static_cast<std::size_t>(p.grain[i]));
      const auto part = [&](std::size_t at) { return std::stoi(fill.substr(at, 2), nullptr, 16) / 255.0; };
      colour = {part(1), part(3), part(5)};
    }
    spheres.colour.push_back(colour);
  }
  whole.scene.spheres = {spheres};
  whole.scene.cuts.push_back({{0, 0, 0}, {0, 0, 1}});
  whole.scene.camera.direction = {0, 0, -1};
  whole.scene.camera.up = {0, 1, 0};
  whole.scene.width = 800;
  whole.scene.height = 800;
  whole.label = "All particles, by grain";
  whole.scale_bar = false;
  whole.legend = {{{0.61, 0.42, 0.24}, "wall particles"}};
  whole.scene.axes = true;
  content.panels.push_back({.id = "whole",
                            .caption = layered(*r)
                                           ? "The deformation box: the layer, the matrix (grey) and the walls (brown)."
                                           : "The deformation box: particles coloured by grain, walls brown.",
                            .alt = fmt::format("A square of {} discs in {} grains within a brown frame.",
                                               count(r->value(quantity::particles)), count(r->value(quantity::grains))),
                            .content = whole,
                            .per_row = 2});
  return content;
}

FigureContent flow(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "After a deformation step the sheet relaxes to equilibrium; while a spring exceeds its tensile strength, the one "
      "most likely to break does, and the sheet relaxes again; then the next step begins.";
  const dem::Record* r = main_record(study);
  const bool growth = r && r->text("test") == "growth";
  std::string body;
  const auto box_at = [&](double x, double y, double w, const std::vector<std::string_view>& lines,
                          std::string_view fill) {
    body += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"7\" fill=\"{}\" stroke=\"#333\" "
        "stroke-width=\"1.5\"/>",
        x, y, w, 10 + 17 * lines.size(), fill);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      body += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x + w / 2, y + 18 + 17.0 * k,
                          lines[k]);
    }
  };
  const auto arrow = [&](double x0, double y0, double x1, double y1, bool tip = true) {
    body += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"#333\" stroke-width=\"1.6\"/>", x0, y0,
                        x1, y1);
    if (!tip) return;
    const double ux = x1 > x0 ? 1 : x1 < x0 ? -1 : 0, uy = y1 > y0 ? 1 : y1 < y0 ? -1 : 0;
    body += fmt::format("<polygon points=\"{},{} {},{} {},{}\" fill=\"#333\"/>", x1, y1, x1 - 9 * ux - 5 * uy,
                        y1 - 9 * uy - 5 * ux, x1 - 9 * ux + 5 * uy, y1 - 9 * uy + 5 * ux);
  };
  const auto word = [&](double x, double y, std::string_view text) {
    body += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-size=\"12\">{}</text>", x, y, text);
  };
  // As wide as half a page: it is read on a narrow screen as well.
  constexpr double left = 28, wide = 248, right = left + wide, middle = left + wide / 2;
  box_at(left, 2, wide, {"Grain map and sheet", "stiffness and strength drawn"}, "#eef2f6");
  // Springs break when a load step is complete, not after its parts.
  box_at(left, 66, wide,
         {growth ? "One load step: grow marked grains," : "One load step: move all particles",
          growth ? "walls held; once springs are broken," : "affinely; once springs are broken,",
          "in parts, each brought to equilibrium"},
         "#fbf3dd");
  box_at(left, 147, wide, {"Relax to equilibrium", "springs and contacts"}, "#e4efe6");
  box_at(left, 211, wide, {"A spring over its strength?", "largest tension over threshold"}, "#eef2f6");
  box_at(left, 275, wide, {"Record stress, energy, breaks", "last load step?"}, "#eef2f6");
  box_at(300, 171, 98, {"Break that", "spring, keep", "its contact"}, "#f6dfd5");
  box_at(319, 284, 60, {"End"}, "#eef2f6");
  for (const auto& [from, to] : {std::pair{46, 65}, {127, 146}, {191, 210}, {255, 274}})
    arrow(middle, from, middle, to);
  word(middle + 17, 269, "no");
  arrow(right, 244, 349, 244, false);
  arrow(349, 244, 349, 233);
  word(295, 258, "yes");
  arrow(349, 171, 349, 160, false);
  arrow(349, 160, right + 1, 160);
  arrow(right, 297, 318, 297);
  word(295, 291, "yes");
  arrow(left, 297, 5, 297, false);
  arrow(5, 297, 5, 96, false);
  arrow(5, 96, left - 1, 96);
  word(13, 312, "no");
  content.panels.push_back(
      {.id = "",
       .caption = "The order of work.",
       .alt =
           "From the grain map to a load step, relaxation, a test of the springs, breaking of one spring and back to "
           "relaxation until none is over its strength; then the next step, or the end.",
       .content = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 400 322\" width=\"400\" height=\"322\" "
                  "font-family=\"DejaVu Sans\" font-size=\"12\">" +
                  body + "</svg>",
       .per_row = 2});
  if (r) {
    content.finding = fmt::format(
        "{}: {} load steps; {} relaxations, one after each part of a load step and each break; {} broken "
        "springs.",
        capital(label_of(*r, study)), count(r->value(quantity::load_steps)), count(r->value(quantity::relaxations)),
        count(r->value(quantity::cracks_intra_tension) + r->value(quantity::cracks_inter_tension)));
  }
  return content;
}

FigureContent elle_layer(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Elle nodes and their connections are the outlines of grains; particles inside an outline belong to that grain "
      "and have the same properties.";
  const dem::Record* r = main_record(study);
  if (!r) return content;
  const Layout l = layout_of(*r);
  const Particles p = particles_of(*r);
  // A window around the first inner node.
  const auto nodes = r->table("outlines").real("position");
  double cx = 0.5, cy = 0.5, best = 1e9;
  for (std::size_t k = 0; k + 1 < nodes.size(); k += 2) {
    const double off = std::hypot(nodes[k] - 0.5, nodes[k + 1] - 0.5 * l.height);
    if (off < best) best = off, cx = nodes[k], cy = nodes[k + 1];
  }
  const int n = std::min(22, l.columns - 2), m = std::min(18, l.rows - 2);
  const int c = std::clamp(static_cast<int>(cx * l.columns) - n / 2, 0, l.columns - n);
  const int row = std::clamp(static_cast<int>(cy / l.height * l.rows) - m / 2, 0, l.rows - m) / 2 * 2;
  const std::vector<std::string> fills = grain_fills(*r);
  Drawing d = draw_window(*r, {c, c + n, row, row + m}, render::column_width, true,
                          [&](std::size_t i) { return fills.at(static_cast<std::size_t>(p.grain[i])); });
  content.panels.push_back(
      {.id = "",
       .caption = "Part of the sheet: outlines of grains (nodes and segments) over the particles that they hold.",
       .alt = "Polygon edges with nodes cross a patch of discs that are coloured by grain.",
       .content = d.finish_with_key({{"#c03020", "outlines of grains, with their nodes", true}}),
       .per_row = 2});
  const double grains = r->value(quantity::grains);
  const std::string matrix = " and the matrix on both sides of it (" + count(grains) + " grains of the map)";
  const std::string holders = uniform_layer(*r) ? "The layer" + matrix
                              : layered(*r)     ? "The " + count(grains - 2) + " grains of the layer" + matrix
                                                : count(grains) + " grains";
  const long all = static_cast<long>(p.grain.size()), inside = inside_their_grain(*r);
  const long unsure = std::max(2L, all / 100);  // as many as a map may leave out
  content.agreement = inside >= all - unsure ? Agreement::agrees : Agreement::disagrees;
  content.finding =
      fmt::format("{} hold {} particles, {} inside the outline of its grain.", holders, count(static_cast<double>(all)),
                  inside == all ? "each" : count(static_cast<double>(inside)) + " of them");
  return content;
}

}  // namespace reports::sheet
