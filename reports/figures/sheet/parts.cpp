#include "reports/figures/sheet/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "reports/text.h"

namespace reports::sheet {
namespace {

// A grain over the box's edge is drawn at both sides: as it is, and moved by a cell.
std::vector<std::array<double, 2>> moved(std::vector<std::array<double, 2>> points, double dx, double dy) {
  for (auto& p : points) p[0] += dx, p[1] += dy;
  return points;
}

bool marked(const dem::Record& record, std::size_t grain) {
  const dem::Table& grains = record.table("grains");
  if (grains.real("growth")[grain] > 0) return true;
  const auto k = grains.real("stiffness");
  double softest = 1e300;
  for (const double v : k) {
    if (std::isfinite(v)) softest = std::min(softest, v);
  }
  return std::isfinite(k[grain]) && k[grain] > 20 * softest;
}

std::string_view colour_of(CrackPlace place) {
  switch (place) {
    case CrackPlace::boundary:
      return inter_colour;
    case CrackPlace::edge:
      return edge_colour;
    case CrackPlace::matrix:
      return matrix_colour;
    case CrackPlace::inside:
      break;
  }
  return intra_colour;
}

// "at grain boundaries", "in the matrix"
std::string place_words(const dem::Record& record, CrackPlace place) {
  switch (place) {
    case CrackPlace::boundary:
      return layered(record) ? "at grain boundaries" : "at boundaries";
    case CrackPlace::edge:
      return "at the layer’s edges";
    case CrackPlace::matrix:
      return "in the matrix";
    case CrackPlace::inside:
      break;
  }
  return uniform_layer(record) ? "in the layer" : "inside grains";
}

// Those of its key: where springs can break, and in the matrix where any does by the end.
std::vector<CrackPlace> places_shown(const dem::Record& record) {
  if (!layered(record)) return {CrackPlace::inside, CrackPlace::boundary};
  std::vector<CrackPlace> shown{CrackPlace::inside};
  if (!uniform_layer(record)) shown.push_back(CrackPlace::boundary);
  shown.push_back(CrackPlace::edge);
  const std::vector<CrackPlace> of = places_of(record);
  if (std::ranges::find(of, CrackPlace::matrix) != of.end()) shown.push_back(CrackPlace::matrix);
  return shown;
}

std::vector<analysis::Repeats> repeats_of(const StudyResult& study) {
  std::vector<const CaseResult*> cases;
  for (const CaseResult& one : study.cases) {
    if (one.record) cases.push_back(&one);
  }
  return analysis::repeats_of(cases);
}

}  // namespace

std::vector<const dem::Record*> records_of(const StudyResult& study) {
  std::vector<const dem::Record*> all;
  for (const analysis::Repeats& one : repeats_of(study)) all.push_back(one.front()->record);
  return all;
}

std::vector<const dem::Record*> seeds_of(const StudyResult& study, const dem::Record& record) {
  std::vector<const dem::Record*> all{&record};
  for (const analysis::Repeats& kind : repeats_of(study)) {
    const auto is_it = [&](const CaseResult* one) { return one->record == &record; };
    if (std::ranges::none_of(kind, is_it)) continue;
    for (const CaseResult* one : kind) {
      if (!is_it(one)) all.push_back(one->record);
    }
  }
  return all;
}

analysis::Estimate over_seeds(const StudyResult& study, const dem::Record& record, const ValueOf& value) {
  std::vector<double> values;
  for (const dem::Record* one : seeds_of(study, record)) {
    if (const double its = value(*one); std::isfinite(its)) values.push_back(its);
  }
  return analysis::mean_of(values);
}

std::string over_seeds_said(const StudyResult& study, const std::vector<const dem::Record*>& runs, const ValueOf& value,
                            std::string_view what, std::string_view unit) {
  std::vector<std::string> said;
  std::size_t seeds = 0;
  for (const dem::Record* run : runs) {
    const std::size_t its = seeds_of(study, *run).size();
    analysis::Estimate mean = over_seeds(study, *run, value);
    if (unit == "%") mean.low = std::max(mean.low, 0.0), mean.high = std::min(mean.high, 100.0);  // a share
    if (its < 2 || !std::isfinite(mean.value)) continue;
    seeds = std::max(seeds, its);
    const std::string kind = kind_of(*run, study);
    said.push_back(told(mean, 2, unit) + (kind.empty() ? "" : " (" + kind + ")"));
  }
  return said.empty() ? "" : fmt::format(" Over {} seeds {} {}.", seeds, what, listed(said));
}

const dem::Record* main_record(const StudyResult& study) {
  const auto all = records_of(study);
  return all.empty() ? nullptr : all.front();
}

std::string kind_of(const dem::Record& record, const StudyResult& study) {
  const auto all = records_of(study);
  const auto differs = [&](auto of) {
    return std::ranges::any_of(all, [&](const dem::Record* other) { return of(*other) != of(record); });
  };
  const double spread = record.number("spread");
  std::vector<std::string> parts;
  if (differs([](const dem::Record& r) { return r.number("spread"); }))
    parts.push_back(fmt::format("spread {:g}", spread));
  // The converged solver is named beside the other one alone: of the same sheet.
  const bool both = std::ranges::any_of(all, [&](const dem::Record* other) {
    return other->number("spread") == spread && other->text("solver") != record.text("solver");
  });
  if (both || record.text("solver") == "historical") parts.push_back(record.text("solver"));
  return joined(parts, ", ");
}

std::string label_of(const dem::Record& record, const StudyResult& study) {
  const std::string kind = kind_of(record, study);
  const bool repeated = std::ranges::any_of(
      study.cases, [&](const CaseResult& one) { return one.record && one.record->seed != record.seed; });
  if (!repeated) return kind.empty() ? "this run" : kind;
  return (kind.empty() ? "" : kind + ", ") + fmt::format("seed {}", record.seed);
}

// From the counts, which records made before the result had its present name hold as well.
double between_share(const dem::Record& record) {
  const double between = record.value(quantity::cracks_inter_tension);
  return between / (between + record.value(quantity::cracks_intra_tension));
}

Layout layout_of(const dem::Record& record) {
  const dem::Table& t = record.table("particles");
  Layout l;
  l.columns = std::stoi(t.attribute("columns"));
  l.rows = std::stoi(t.attribute("rows"));
  l.radius = std::stod(t.attribute("radius"));
  l.height = 2 * l.radius + std::sqrt(3.0) * l.radius * (l.rows - 1);
  return l;
}

Drawing::Drawing(double x0, double y0, double x1, double y1, double width)
    : x0_(x0), y1_(y1), scale_(width / (x1 - x0)), width_(width), height_((y1 - y0) * width / (x1 - x0)) {}

void Drawing::polygon(const std::vector<std::array<double, 2>>& points, std::string_view fill, std::string_view stroke,
                      double stroke_width) {
  body_ += "<polygon points=\"";
  for (const auto& p : points) body_ += fmt::format("{:.2f},{:.2f} ", px(p[0]), py(p[1]));
  body_ += fmt::format("\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>", fill, stroke, stroke_width);
}
void Drawing::line(double x0, double y0, double x1, double y1, std::string_view colour, double width) {
  body_ +=
      fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" stroke-width=\"{}\"/>",
                  px(x0), py(y0), px(x1), py(y1), colour, width);
}
void Drawing::circle(double x, double y, double radius, std::string_view fill, std::string_view stroke,
                     double stroke_width) {
  body_ +=
      fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>",
                  px(x), py(y), radius * scale_, fill, stroke, stroke_width);
}
void Drawing::text(double x, double y, std::string_view words, double size, std::string_view anchor) {
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\">{}</text>", px(x), py(y),
                       size, anchor, words);
}
std::string Drawing::finish(double extra_below) const {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" "
             "height=\"{:.0f}\" "
             "font-family=\"DejaVu Sans\">",
             width_, height_ + extra_below, width_, height_ + extra_below) +
         body_ + "</svg>";
}

std::string Drawing::finish_with_key(const std::vector<KeyItem>& key) {
  constexpr double size = 12, row = 20, sample = 20;
  double x = 2, y = height_ + 18;
  // Grains reach over the edge of the box.
  body_ += fmt::format("<rect x=\"0\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" fill=\"#ffffff\"/>", height_ + 0.5,
                       width_, 4 * row);
  for (const KeyItem& item : key) {
    const double wide = sample + 6 + 0.58 * size * static_cast<double>(item.text.size()) + 18;
    if (x > 2 && x + wide > width_ + 18) x = 2, y += row;
    if (item.line)
      body_ += fmt::format(
          "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"2.5\"/>", x,
          y - 4, x + sample, y - 4, item.colour);
    else
      body_ +=
          fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"10\" fill=\"{}\" stroke=\"#444\"/>",
                      x + 2, y - 9, sample - 4, item.colour);
    body_ +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\">{}</text>", x + sample + 6, y, size, item.text);
    x += wide;
  }
  return finish(y - height_ + 6);
}

std::vector<std::string> grain_fills(const dem::Record& record) {
  static constexpr std::array<std::string_view, 8> fills{"#a9c8e8", "#f4cf9a", "#b3d9a6", "#dcb8dc",
                                                         "#f2e58a", "#9ad6d0", "#eda9a0", "#c9c9c9"};
  const Layout l = layout_of(record);
  const auto grain = record.table("particles").integer("grain");
  std::vector<std::set<std::size_t>> beside(record.table("grains").rows());
  const auto touch = [&](int i, int j) {
    const auto a = static_cast<std::size_t>(grain[static_cast<std::size_t>(i)]),
               b = static_cast<std::size_t>(grain[static_cast<std::size_t>(j)]);
    if (a != b) beside[a].insert(b), beside[b].insert(a);
  };
  for (int row = 0; row < l.rows; ++row) {
    for (int column = 0; column < l.columns; ++column) {
      const int at = row * l.columns + column;
      if (column + 1 < l.columns) touch(at, at + 1);
      if (row + 1 == l.rows) continue;
      for (const int above : {column + row % 2 - 1, column + row % 2}) {
        if (above >= 0 && above < l.columns) touch(at, at + l.columns - column + above);
      }
    }
  }
  const bool in_matrix = layered(record);
  std::vector<std::size_t> colour(beside.size(), fills.size());
  std::vector<std::string> result;
  for (std::size_t g = 0; g < beside.size(); ++g) {
    if (in_matrix && !marked(record, g)) {
      result.emplace_back("#eeeeee");
      continue;
    }
    std::size_t free = 0;
    while (free + 1 < fills.size() &&
           std::ranges::any_of(beside[g], [&](std::size_t other) { return colour[other] == free; }))
      ++free;
    colour[g] = free;
    result.emplace_back(fills.at(free));
  }
  return result;
}

std::vector<std::vector<std::array<double, 2>>> outlines_of(const dem::Record& record) {
  const dem::Table& t = record.table("outlines");
  const auto grain = t.integer("grain");
  const auto place = t.real("position");
  const double aside = 0.5 * layout_of(record).radius;  // as the cell lies under the rows, which alternate by a radius
  std::vector<std::vector<std::array<double, 2>>> result(record.table("grains").rows());
  for (std::size_t i = 0; i < grain.size(); ++i) {
    result[static_cast<std::size_t>(grain[i])].push_back({place[2 * i] + aside, place[2 * i + 1]});
  }
  return result;
}

bool layered(const dem::Record& record) { return record.table("history").has("crossing_fractures"); }

std::array<double, 2> heights_shown(const dem::Record& record, double beside) {
  const Layout l = layout_of(record);
  if (!layered(record)) return {0, l.height};
  const auto outlines = outlines_of(record);
  double low = l.height, high = 0;
  for (std::size_t g = 0; g < outlines.size(); ++g) {
    if (!marked(record, g)) continue;
    for (const auto& p : outlines[g]) low = std::min(low, p[1]), high = std::max(high, p[1]);
  }
  const double margin = std::min(high - low, beside);
  return {std::max(0.0, low - margin), std::min(l.height, high + margin)};
}

std::string fracture_map(const dem::Record& record, double strain, double width) {
  const Layout l = layout_of(record);
  const auto outlines = outlines_of(record);
  const auto [low, high] = heights_shown(record);
  Drawing d(0, low, 1 + l.radius, high, width);
  const bool strip = layered(record);
  const double aside = 0.5 * l.radius;  // of outlines_of()
  for (std::size_t g = 0; g < outlines.size(); ++g) {
    const std::string_view fill = marked(record, g) ? marked_fill : std::string_view("#ffffff");
    if (strip) {  // its map ends with the box: its sides are no outlines, and lie out of sight
      auto cell = outlines[g];
      for (auto& p : cell) {
        if (std::abs(p[0] - aside) < 1e-6) p[0] = -0.1;
        if (std::abs(p[0] - aside - 1) < 1e-6) p[0] = 1.1;
      }
      d.polygon(cell, fill, "#b5b5b5", 0.7);
      continue;
    }
    for (const double dx : {-1.0, 0.0, 1.0}) {
      for (const double dy : {-l.height, 0.0, l.height}) {
        const auto image = moved(outlines[g], dx, dy);
        const bool seen = std::any_of(image.begin(), image.end(), [&](const auto& p) {
          return p[0] > -0.001 && p[0] < 1.001 + l.radius && p[1] > -0.001 && p[1] < l.height + 0.001;
        });
        if (seen) d.polygon(image, fill, "#b5b5b5", 0.7);
      }
    }
  }
  const dem::Table& cracks = record.table("cracks");
  const auto at = cracks.real("strain"), place = cracks.real("position"), angle = cracks.real("angle");
  const std::vector<CrackPlace> of = places_of(record);
  // The crack across a spring is as long as the side of the cell that two particles share.
  const double half = 0.75 * l.radius, thick = std::clamp(1.4 * l.radius * d.scale(), 0.7, 2.5);
  for (const CrackPlace wanted : {CrackPlace::matrix, CrackPlace::edge, CrackPlace::boundary, CrackPlace::inside}) {
    std::string path;
    for (std::size_t c = 0; c < at.size(); ++c) {
      if (at[c] > strain * (1 + 1e-9) || of[c] != wanted) continue;
      const double ux = half * std::cos(angle[c]), uy = half * std::sin(angle[c]);
      path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", d.px(place[2 * c] - ux), d.py(place[2 * c + 1] - uy),
                          d.px(place[2 * c] + ux), d.py(place[2 * c + 1] + uy));
    }
    if (path.empty()) continue;
    d.raw(fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linecap=\"round\" fill=\"none\"/>",
                      path, colour_of(wanted), thick));
  }
  d.raw(fmt::format("<rect x=\"0.5\" y=\"0.5\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#555\"/>",
                    width - 1, (high - low) * d.scale() - 1));
  const auto n = crack_counts(record, strain);
  std::vector<KeyItem> key;
  for (const CrackPlace one : places_shown(record))
    key.push_back(
        {std::string(colour_of(one)), place_words(record, one) + ": " + count(n[static_cast<std::size_t>(one)]), true});
  bool any = false;
  for (std::size_t g = 0; g < outlines.size(); ++g) any = any || marked(record, g);
  if (any) key.push_back({std::string(marked_fill), layered(record) ? "layer" : "growing grains", false});
  return d.finish_with_key(key);
}

std::vector<CrackPlace> places_of(const dem::Record& record) {
  const dem::Table& cracks = record.table("cracks");
  const auto between = cracks.integer("place");
  std::vector<CrackPlace> places;
  for (const std::int32_t one : between) places.push_back(one == 0 ? CrackPlace::inside : CrackPlace::boundary);
  if (!layered(record)) return places;
  std::vector<bool> in_layer;
  for (std::size_t g = 0; g < record.table("grains").rows(); ++g) in_layer.push_back(marked(record, g));
  // A spring of the sheet at rest has its particles a radius from its middle, all others are further away.
  const Layout l = layout_of(record);
  const auto grain = record.table("particles").integer("grain");
  const auto at = record.table("particles").real("position"), middle = cracks.real("position");
  for (std::size_t c = 0; c < places.size(); ++c) {
    const double x = middle[2 * c], y = middle[2 * c + 1];
    const int below = static_cast<int>(std::floor((y - at[1]) / (std::sqrt(3.0) * l.radius) + 1e-6));
    int ends = 0, of_layer = 0;
    for (int row = std::max(0, below); row <= std::min(below + 1, l.rows - 1); ++row) {
      const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(l.columns);
      const int left = static_cast<int>(std::floor((x - at[2 * first]) / (2 * l.radius)));
      for (int column = std::max(0, left - 1); column <= std::min(left + 2, l.columns - 1); ++column) {
        const std::size_t i = first + static_cast<std::size_t>(column);
        if (std::hypot(at[2 * i] - x, at[2 * i + 1] - y) > 1.2 * l.radius) continue;
        ++ends;
        of_layer += in_layer[static_cast<std::size_t>(grain[i])] ? 1 : 0;
      }
    }
    if (of_layer < ends) places[c] = of_layer == 0 ? CrackPlace::matrix : CrackPlace::edge;
  }
  return places;
}

std::array<int, crack_places> crack_counts(const dem::Record& record, double strain) {
  const auto at = record.table("cracks").real("strain");
  const std::vector<CrackPlace> of = places_of(record);
  std::array<int, crack_places> n{};
  for (std::size_t c = 0; c < at.size(); ++c) {
    if (at[c] <= strain * (1 + 1e-9)) ++n[static_cast<std::size_t>(of[c])];
  }
  return n;
}

int sum_of(const std::array<int, crack_places>& counts) { return std::accumulate(counts.begin(), counts.end(), 0); }

double between_by_chance(const dem::Record& record) {
  const Layout l = layout_of(record);
  const auto grain = record.table("particles").integer("grain");
  const auto at = record.table("particles").real("position");
  double springs = 0, between = 0;
  const auto add = [&](std::size_t i, std::size_t j) {
    if (std::hypot(at[2 * i] - at[2 * j], at[2 * i + 1] - at[2 * j + 1]) > 2.2 * l.radius) return;
    ++springs;
    between += grain[i] == grain[j] ? 0 : 1;
  };
  const auto columns = static_cast<std::size_t>(l.columns), rows = static_cast<std::size_t>(l.rows);
  for (std::size_t i = 0; i < columns * rows; ++i) {
    const std::size_t column = i % columns;
    if (column + 1 < columns) add(i, i + 1);
    if (i / columns + 1 == rows) continue;
    for (std::size_t above = i + columns - (column > 0 ? 1 : 0); above <= i + columns + (column + 1 < columns ? 1 : 0);
         ++above)
      add(i, above);
  }
  return springs > 0 ? between / springs : 0;
}

bool uniform_layer(const dem::Record& record) {
  constexpr double alone = 3;  // the layer and the matrix on both sides of it
  return layered(record) && record.value(quantity::grains) <= alone;
}

std::string crack_words(const dem::Record& record, double strain) {
  const auto n = crack_counts(record, strain);
  std::vector<std::string> said;
  for (const CrackPlace one : places_shown(record)) {
    const int number = n[static_cast<std::size_t>(one)];
    const std::string what = said.empty() ? (number == 1 ? " broken spring " : " broken springs ") : " ";
    said.push_back(count(number) + what + place_words(record, one));
  }
  return joined(said, ", ");
}

std::string at_strain(const dem::Record& record, double strain) {
  return (record.text("test") == "growth" ? "a growth of " : "a strain of ") + number(100 * strain, 3) + " %";
}

Agreement together(std::span<const Agreement> verdicts) {
  const bool alike = std::ranges::all_of(verdicts, [&](Agreement one) { return one == verdicts.front(); });
  return alike ? verdicts.front() : Agreement::undecided;
}

Agreement mainly(const analysis::Estimate& share, double chance) {
  constexpr double most = 0.5;
  const double least = share.has_interval() ? share.low : share.value,
               largest = share.has_interval() ? share.high : share.value;
  return least >= most ? Agreement::agrees : largest <= chance ? Agreement::disagrees : Agreement::undecided;
}

std::vector<std::pair<std::string, double>> snapshots_of(const dem::Record& record) {
  std::vector<std::pair<std::string, double>> all;
  for (const dem::Table& t : record.tables) {
    if (t.name.rfind("snapshots/", 0) == 0) all.emplace_back(t.name, std::stod(t.attribute("strain")));
  }
  return all;
}

}  // namespace reports::sheet
