// The model itself: block and springs (Liu et al. 2017, Fig. 1), the tetrahedral unit (Fig. 2), the sliding distance
// (Fig. 3) and the parameters (Table 1).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/paper/text.h"
#include "reports/figures/lattice/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::lattice {
namespace {

const dem::Record* any_record(const StudyResult& study) {
  for (const CaseResult& c : study.cases) {
    if (c.record && c.record->find("particles")) return c.record;
  }
  return nullptr;
}

const dem::Record* largest_record(const StudyResult& study, double most) {
  const dem::Record* found = nullptr;
  for (const CaseResult& c : study.cases) {
    if (!c.record || c.record->value(quantity::particles) > most) continue;
    if (!found || c.record->value(quantity::particles) > found->value(quantity::particles)) found = c.record;
  }
  return found;
}

Picture block_picture(const dem::Record& record) {
  const auto position = record.table("particles").real("position");
  const auto radius = record.table("particles").real("radius");
  render::Spheres spheres;
  const double layer = std::sqrt(2.0 / 3) * 2 * radius[0];
  double top = 0;
  for (std::size_t i = 0; i < radius.size(); ++i) top = std::max(top, position[3 * i + 2]);
  for (std::size_t i = 0; i < radius.size(); ++i) {
    spheres.centre.push_back({position[3 * i], position[3 * i + 1], position[3 * i + 2]});
    spheres.radius.push_back(radius[i]);
    const bool end = position[3 * i + 2] < 0.5 * layer || position[3 * i + 2] > top - 0.5 * layer;
    const bool b = std::lround(position[3 * i + 2] / layer) % 2 == 1;
    spheres.colour.push_back(end ? render::Colour{0.80, 0.36, 0.20}
                             : b ? render::Colour{0.93, 0.86, 0.62}
                                 : render::Colour{0.55, 0.66, 0.75});
  }
  Picture picture;
  picture.scene.spheres = {spheres};
  picture.scene.camera.direction = {-0.75, 0.55, -0.30};
  picture.scene.axes = true;
  picture.scene.width = 700;
  picture.scene.height = 700;
  picture.label = count(record.value(quantity::particles)) + " elements";
  picture.legend = {{{0.55, 0.66, 0.75}, "layers A"},
                    {{0.93, 0.86, 0.62}, "layers B"},
                    {{0.80, 0.36, 0.20}, "end layers (also A), at the planes"}};
  return picture;
}

constexpr double text_size = 12.5;  // px, of a drawing as it is shown

// The middle of the drawing lies at `middle`.
std::string head(int width, int height, int middle) {
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="{0} 0 {1} {2}" width="{1}" height="{2}" font-family="DejaVu Sans">)",
      middle - width / 2, width, height);
}

// A drawing's words, _{...} for indices. Each piece has a place of its own: renderers disagree about where pieces of one
// centred text go.
std::string words_at(double size, double x, double y, const std::string& words, std::string_view anchor = "middle") {
  const auto pieces = render::pieces_of(words);
  double width = 0;
  for (const render::Piece& piece : pieces) width += render::run_width(piece.text, piece.scale * size, false);
  double at = anchor == "middle" ? x - width / 2 : anchor == "end" ? x - width : x;
  std::string body;
  for (const render::Piece& piece : pieces) {
    std::string shown;
    for (const char c : piece.text) shown += c == '>' ? std::string("&gt;") : std::string(1, c);
    body +=
        fmt::format(R"(<text{} x="{:.1f}" y="{:.1f}" font-size="{:.4g}" xml:space="preserve">{}</text>)",
                    piece.scale < 1 ? R"( class="index")" : "", at, y - piece.shift * size, piece.scale * size, shown);
    at += render::run_width(piece.text, piece.scale * size, false);
  }
  return body;
}
std::string circle(double x, double y, double r, std::string_view fill, bool dashed = false) {
  return fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:.1f}" fill="{}" stroke="#333" stroke-width="1.5"{}/>)", x,
                     y, r, fill, dashed ? R"( stroke-dasharray="6 4")" : "");
}
std::string line(double x0, double y0, double x1, double y1, std::string_view colour = "#333", double width = 1.5) {
  return fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}" stroke-width="{}"/>)", x0, y0,
                     x1, y1, colour, width);
}
// An arrow without markers, which some renderers of SVG draw wrong.
std::string arrow(double x0, double y0, double x1, double y1, std::string_view colour) {
  const double dx = x1 - x0, dy = y1 - y0, length = std::hypot(dx, dy), ux = dx / length, uy = dy / length;
  return line(x0, y0, x1 - 8 * ux, y1 - 8 * uy, colour, 2) +
         fmt::format(R"(<polygon points="{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}" fill="{}"/>)", x1, y1,
                     x1 - 10 * ux - 5 * uy, y1 - 10 * uy + 5 * ux, x1 - 10 * ux + 5 * uy, y1 - 10 * uy - 5 * ux,
                     colour);
}
// A zigzag spring from one point to another.
std::string spring(double x0, double y0, double x1, double y1, std::string_view colour) {
  const double dx = x1 - x0, dy = y1 - y0, length = std::hypot(dx, dy), nx = -dy / length, ny = dx / length;
  std::string points = fmt::format("{:.1f},{:.1f} ", x0, y0);
  constexpr int turns = 8;
  for (int i = 0; i <= turns; ++i) {
    const double part = 0.2 + 0.6 * i / turns;
    const double aside = i == 0 || i == turns ? 0 : (i % 2 ? 8 : -8);
    points += fmt::format("{:.1f},{:.1f} ", x0 + part * dx + aside * nx, y0 + part * dy + aside * ny);
  }
  points += fmt::format("{:.1f},{:.1f}", x1, y1);
  return fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="2"/>)", points, colour);
}

std::string springs_drawing() {
  // As high as the picture of the block beside it: the normal spring above, the shear spring below.
  constexpr int width = 600, below = 270;  // shown in a column
  const auto text = [](double x, double y, const std::string& words) {
    return words_at(text_size * width / render::column_width, x, y, words);
  };
  std::string s = head(width, 530, 300);
  s += circle(225, 120, 55, "#c9d5de") + circle(375, 120, 55, "#c9d5de") + spring(225, 120, 375, 120, "#0072b2");
  s += text(300, 45, "F_{n} = K_{n} X_{n}") + text(300, 98, "K_{n}") + text(300, 215, "breaks when X_{n} > X_{b}");
  s += circle(245, below + 120, 55, "#c9d5de") + circle(355, below + 120, 55, "#c9d5de") +
       spring(300, below + 65, 300, below + 175, "#d55e00");
  s += text(300, below + 40, "F_{s} = K_{s} X_{s}") + text(330, below + 124, "K_{s}") +
       arrow(245, below + 195, 245, below + 160, "#333") + arrow(355, below + 45, 355, below + 80, "#333");
  s += text(300, below + 230, "slides when |F_{s}| > F_{s0} − μ_{p} F_{n}");
  return s + "</svg>";
}

std::string unit_drawing() {
  const auto text = [](double x, double y, const std::string& words, std::string_view anchor = "middle") {
    return words_at(text_size, x, y, words, anchor);
  };
  // The unit seen from the side: element 1 on the three at the plane; bond 1 inclined, bond 2 along the plane.
  std::string s = head(render::page_width, 316, 320);
  for (const double x0 : {160.0, 480.0}) {
    const bool tension = x0 < 300;
    s += line(x0 - 130, 238, x0 + 130, 238, "#555", 3);
    s += circle(x0 - 52, 190, 48, "#c9d5de") + circle(x0 + 52, 190, 48, "#c9d5de") + circle(x0, 108, 48, "#edd9a3");
    s += line(x0, 108, x0 + 52, 190, "#0072b2", 3) + line(x0 - 52, 190, x0 + 52, 190, "#d55e00", 3);
    s += text(x0, 103, "1") + text(x0 - 60, 186, "2") + text(x0 + 72, 186, "3, 4") +
         text(x0 + 60, 136, "bond 1", "start") + line(x0, 194, x0, 244, "#d55e00", 1) + text(x0, 258, "bond 2");
    s += tension ? arrow(x0, 60, x0, 18, "#333") + text(x0 + 12, 30, "F_{z}", "start")
                 : arrow(x0, 12, x0, 56, "#333") + text(x0 + 12, 30, "F_{z}", "start");
    const double from = tension ? 126 : 104,
                 to = tension ? 104 : 126;  // what is pulled gets thinner, what is pressed wider
    s += arrow(x0 - from, 190, x0 - to, 190, "#333") + arrow(x0 + from, 190, x0 + to, 190, "#333") +
         text(x0 - 115, 180, "u_{x}") + text(x0 + 115, 180, "u_{x}");
    s += text(x0, 284, tension ? "tension: bond 1 opens" : "compression: bond 2 opens,");
    s += text(x0, 304, tension ? "at T_{u} (Eqs. 2, 7)" : "then bond 1 slides (Eqs. 8–14)");
  }
  return s + "</svg>";
}

std::string sliding_drawing() {
  const auto text = [](double x, double y, const std::string& words, std::string_view anchor = "middle") {
    return words_at(text_size, x, y, words, anchor);
  };
  std::string s = head(render::page_width, 206, 320);
  s += line(20, 136, 290, 136, "#555", 3) + circle(110, 86, 50, "none", true) + circle(150, 86, 50, "#c9d5de");
  s += circle(110, 86, 3, "#333") + circle(150, 86, 3, "#333") + circle(110, 136, 4, "#d55e00") +
       spring(110, 136, 150, 86, "#d55e00");
  s += text(93, 82, "O′", "end") + text(158, 81, "O", "start") + text(110, 158, "P") + arrow(205, 86, 250, 86, "#333") +
       text(228, 76, "f");
  s += text(155, 196, "(a) locked: no sliding, no heat");
  s += line(340, 136, 620, 136, "#555", 3) + circle(410, 86, 50, "none", true) + circle(520, 86, 50, "#c9d5de");
  s += circle(410, 86, 3, "#333") + circle(520, 86, 3, "#333") + spring(385, 136, 410, 86, "#d55e00") +
       spring(480, 136, 520, 86, "#d55e00");
  s += text(410, 74, "O_{1}") + text(520, 74, "O_{2}") + text(385, 162, "P_{1}") + text(480, 162, "P_{2}") +
       arrow(385, 146, 480, 146, "#d55e00") + arrow(410, 25, 520, 25, "#333");
  s += text(465, 17, "dS′") + text(432, 164, "dS");
  s += text(480, 196, "(b) dS = dS′ − (F_{s2} − F_{s1})/K_{s}");
  return s + "</svg>";
}

}  // namespace

FigureContent block(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Identical elements in hexagonal close packing stand between two smooth planes; bonded elements are joined by a "
      "normal and a shear spring, which can break. Blocks of 2 to 30 elements along y have 4 to 37 681 elements.";
  content.rows = {"block_elements_2",  "block_elements_4",  "block_elements_6",  "block_elements_8",
                  "block_elements_10", "block_elements_12", "block_elements_16", "block_elements_20",
                  "block_elements_24", "block_elements_30"};
  const dem::Record* record = largest_record(study, 2500);
  if (!record) record = any_record(study);
  if (!record) return content;
  content.panels.push_back(
      {.id = "block",
       .caption = "The block, layers A and B in turn.",
       .alt = count(record->value(quantity::particles)) + " spheres in a nearly cubic block of close-packed layers.",
       .content = block_picture(*record),
       .per_row = 2});
  content.panels.push_back(
      {.id = "springs",
       .caption = "The two springs of a bond. Elements do not rotate; the shear force acts at the centres.",
       .alt = "Two pairs of spheres, one joined by a normal spring, one by a shear spring.",
       .content = springs_drawing(),
       .per_row = 2});
  content.finding = fmt::format("The block shown has {} elements and {} bonds.",
                                count(record->value(quantity::particles)), count(record->value(quantity::contacts)));
  return content;
}

FigureContent unit(const StudyResult&) {
  FigureContent content;
  content.statement =
      "Four bonded elements are the unit from which the conversion formulas are derived: under tension its inclined "
      "bonds break in opening mode; under compression its horizontal bonds open first, and its inclined bonds slide "
      "later.";
  content.panels.push_back(
      {.id = "",
       .caption = "The tetrahedral unit seen from the side, under tension and under compression (schematic). "
                  "The arrows u_x show how the elements at the plane move.",
       .alt = "One sphere on three that stand on a plane, pulled on the left, pressed on the right.",
       .content = unit_drawing(),
       .per_row = 1,
       .whole_width = true});
  return content;
}

FigureContent sliding_distance(const StudyResult&) {
  FigureContent content;
  content.statement =
      "Frictional heat is the mean sliding friction times the effective sliding distance: the tangential displacement "
      "of the pair less the change in length of the shear spring (Eqs. 22 and 23).";
  content.panels.push_back(
      {.id = "",
       .caption = "(a) A contact locked by static friction. (b) A contact that slides.",
       .alt = "A sphere on a surface: held at point P while its centre moves; then sliding from P1 to P2.",
       .content = sliding_drawing(),
       .per_row = 1,
       .whole_width = true});
  return content;
}

FigureContent parameters(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "The parameters of the elements follow from the properties of quartzite by the conversion formulas of Appendix "
      "B.";
  content.rows = {"elastic_kn",   "elastic_ks", "strength_kn", "strength_ks", "strength_xb", "strength_fs0",
                  "strength_mup", "energy_kn",  "energy_ks",   "energy_xb",   "energy_fs0",  "energy_mup"};
  const dem::Record* r = any_record(study);
  if (!r || !study.scenario) return content;
  const dem::Scenario& s = *study.scenario;
  // Of each parameter: how it is shown, and the published number.
  struct Made {
    std::string_view name, sentence;
    dem::Quantity of;
    std::string_view published;  // its id
    double unit;                 // of that number
  };
  constexpr std::array made{
      Made{"Normal stiffness Kₙ", "normal stiffness", quantity::normal_stiffness, "strength_kn", 1e6},
      Made{"Shear stiffness Kₛ", "shear stiffness", quantity::shear_stiffness, "strength_ks", 1e6},
      Made{"Breaking displacement X_b", "breaking displacement", quantity::breaking_displacement, "strength_xb", 1e-7},
      Made{"Initial shear resistance Fₛ₀", "initial shear resistance", quantity::initial_shear_resistance,
           "strength_fs0", 1.0},
      Made{"Friction of a contact μₚ", "friction of a contact", quantity::contact_friction, "strength_mup", 1.0},
      Made{"Mass of an element m", "mass of an element", quantity::element_mass, "element_mass", 1e-6}};
  const std::array<std::pair<std::string, std::string>, 7> rock{
      {{"Young’s modulus E", number(1e-9 * s.real("rock.young_modulus"), 4) + " GPa"},
       {"Poisson’s ratio ν", number(s.real("rock.poisson_ratio"), 4)},
       {"Tensile strength Tᵤ", number(1e-6 * s.real("rock.tensile_strength"), 4) + " MPa"},
       {"Compressive strength Cᵤ", number(1e-6 * s.real("rock.compressive_strength"), 4) + " MPa"},
       {"Internal friction μᵢ", number(s.real("rock.internal_friction"), 4)},
       {"Density ρ", number(s.real("rock.density"), 4) + " kg/m³"},
       {"Element diameter d", number(1e3 * s.real("block.element_diameter"), 4) + " mm"}}};
  TextTable table{{"Rock and block", "Value", "Parameter of elements", "Ours", "Published"}, {}};
  double worst = 0;
  std::string_view of_which;
  bool known = true;
  for (std::size_t i = 0; i < made.size(); ++i) {
    const Made& one = made[i];
    const double published = one.unit * study.published_value(one.published), ours = r->value(one.of);
    const std::string_view unit = one.of.shown_unit();
    const std::string behind = unit.empty() ? "" : (unit.starts_with("10") ? " × " : " ") + std::string(unit);
    table.rows.push_back({rock[i].first, rock[i].second, std::string(one.name),
                          number(one.of.factor * ours, one.of.digits) + behind,
                          std::isfinite(published) ? shortest(one.of.factor * published) + behind : "–"});
    known = known && std::isfinite(published);
    if (const double off = std::abs(ours / published - 1); off >= worst) worst = off, of_which = one.sentence;
  }
  table.rows.push_back({rock.back().first, rock.back().second, "First opening in compression C_open (Eq. 8)",
                        number(r->value(quantity::opening_stress_theory), 4) + " MPa", "–"});
  content.panels.push_back({.id = "",
                            .caption = "Properties of the rock, and the parameters made of them.",
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  constexpr double near = 5e-4;  // the digits of Table 1
  if (known) content.agreement = worst < near ? Agreement::agrees : Agreement::disagrees;
  if (known) {
    content.finding =
        fmt::format("The largest deviation from the six published parameters is {} ({}).", percent(worst, 3), of_which);
  }
  return content;
}

}  // namespace reports::lattice
