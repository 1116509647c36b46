// Where a specimen comes apart: how far the two sides of the band with most cracks have moved against each other.
#include <fmt/format.h>

#include <cmath>

#include "engine/analysis/jump.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/band.h"
#include "reports/figures/texture/failed.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

/// The band of a case, and what its sides did.
struct Across {
  SeriesCase looks;
  analysis::BandFit fit;
  analysis::BandFrame band;
  analysis::JumpProfile profile;
  std::optional<analysis::Jump> jump;
  double strain = 0;  // of the displacements
};

const dem::Table* last_displacements(const dem::Record& record) {
  const dem::Table* last = nullptr;
  for (const dem::Table& table : record.tables)
    if (table.name.starts_with("snapshots/") && table.has("displacement")) last = &table;
  return last;
}

std::optional<Across> across_of(const SeriesCase& item) {
  const dem::Record& record = *item.record;
  const dem::Table* end = last_displacements(record);
  if (!end) return std::nullopt;
  Across found{.looks = item, .fit = band_of(record, 0).fit, .band = {}, .profile = {}, .jump = {}};
  if (!std::isfinite(found.fit.offset)) return std::nullopt;
  const double diameter = mean_diameter(record);
  const auto points = from_middle(record, record.table("particles").real("position"));
  const auto moved = end->real("displacement");
  found.band = analysis::band_frame(found.fit.normal, found.fit.offset, band_diameters * diameter);
  found.jump = analysis::jump_across(points, moved, found.band);
  found.profile = analysis::profile_across(points, moved, found.band, diameter, 2.5 * found.band.thickness);
  const std::string strain = end->attribute("displacement_at_strain");
  found.strain = strain.empty() ? std::nan("") : std::stod(strain);
  return found;
}

render::Chart profile_chart(const Across& across) {
  render::Chart chart;
  chart.x.title = "Distance from the middle of the band (mm)";
  chart.left.title = "Mean displacement (µm)";
  const auto add = [&](std::string label, std::size_t colour, const std::vector<double>& values) {
    render::Series series{.label = std::move(label),
                          .x = {},
                          .y = {},
                          .colour = render::palette(colour),
                          .line = render::line_style(colour),
                          .marker = render::marker_style(colour),
                          .y_error = {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
      series.x.push_back(1e3 * across.profile.distance[i]);
      series.y.push_back(1e6 * values[i]);
    }
    chart.series.push_back(series);
  };
  add("across the band", 0, across.profile.across);
  add("along it, towards the upper end", 1, across.profile.along);
  for (const double side : {-0.5, 0.5})
    chart.marks.push_back({.kind = render::Mark::Kind::vertical,
                           .x = 1e3 * side * across.band.thickness,
                           .label = side < 0 ? "band" : "",
                           .colour = {0.4, 0.4, 0.4}});
  chart.legend = render::Chart::Legend::below;
  return chart;
}

std::string micro(double metres) { return number(1e6 * metres, 3); }

// In the plane of the band, beyond what the strain of the sides gives.
double slip_of(const analysis::Jump& jump) { return std::hypot(jump.slip.beyond(), jump.sideways.beyond()); }

constexpr const char* at_an_end = "the band reaches an end, so that there is nothing beyond it to compare";

std::string jump_words(const Across& across) {
  if (!across.jump) return across.looks.label + ": " + at_an_end;
  const double opening = across.jump->opening.beyond();
  return fmt::format(
      "{}: beyond the strain of its sides, the band at {}° to the axis has {} by {} µm and slipped by {} µm",
      across.looks.label, number(across.fit.inclination, 2), opening > 0 ? "opened" : "closed",
      micro(std::abs(opening)), micro(slip_of(*across.jump)));
}

}  // namespace

FigureContent displacement_jump(const StudyResult& study) {
  FigureContent content;
  add_missing_failed(content, study);
  std::vector<Across> all;
  for (const SeriesCase& item : failed(study)) {
    if (!is_of_cylinder(*item.record)) continue;
    if (auto found = across_of(item)) all.push_back(std::move(*found));
  }
  if (all.empty()) return content;
  // The band and a layer beyond each of its faces, all across the specimen.
  const dem::Record& base = *all.front().looks.record;
  if (!is_wide_enough_for_a_band(base)) {
    content.panels.push_back(note_panel(
        "too_small", "Displacement across the band with most cracks.",
        fmt::format("Not read at this scale: a band with a layer on each side takes {:g} particles, and fewer "
                    "lie across the specimen.",
                    2 * band_diameters)));
    return content;
  }
  TextTable table{{"Case", "Angle of the band to the axis (°)", "Excess of cracks in the band (points)",
                   "Strain of the gauge at that time (%)", "Sides apart (µm)", "by their strain (µm)",
                   "rest: opening (µm)", "Upper side up along the band (µm)", "by the strain of the sides (µm)",
                   "rest: slip up (µm)", "rest: slip sideways (µm)", "whole slip in the plane of the band (µm)"},
                  {}};
  std::vector<std::string> said, without;
  std::vector<const Across*> shown;
  for (const Across& one : all) {
    std::vector<std::string> row{one.looks.label, number(one.fit.inclination, 2), number(100 * one.fit.excess(), 2),
                                 number(100 * one.strain, 3)};
    const auto length = [&](auto of) { row.push_back(one.jump ? micro(of(*one.jump)) : "–"); };
    length([](const analysis::Jump& jump) { return jump.opening.moved; });
    length([](const analysis::Jump& jump) { return jump.opening.even; });
    length([](const analysis::Jump& jump) { return jump.opening.beyond(); });
    length([](const analysis::Jump& jump) { return jump.slip.moved; });
    length([](const analysis::Jump& jump) { return jump.slip.even; });
    length([](const analysis::Jump& jump) { return jump.slip.beyond(); });
    length([](const analysis::Jump& jump) { return jump.sideways.beyond(); });
    length(slip_of);
    table.rows.push_back(std::move(row));
    if (one.jump) {
      said.push_back(jump_words(one));
      shown.push_back(&one);
    } else {
      without.push_back(one.looks.label);
    }
  }
  if (shown.size() > 2) shown = {shown.front(), shown.back()};
  for (const Across* one : shown)
    content.panels.push_back(
        {.id = "profile_" + one->looks.id,
         .caption = fmt::format("Displacement by distance from the middle of the band with most cracks, {:g} mean "
                                "particle diameters thick: {}.",
                                band_diameters, one->looks.label),
         .alt = jump_words(*one) + ".",
         .content = profile_chart(*one),
         .per_row = 2});
  content.panels.push_back(
      {.id = "table",
       .caption =
           "Displacement of the layer beyond one face of the band, half as thick as the band, less that of the "
           "layer beyond the other face; what the strain of the two sides gives over the same distance; and the "
           "rest. Places are those of the last state that was kept. The excess is the share of the cracks in the "
           "band less its share of the volume.",
       .alt = "",
       .content = table,
       .per_row = 1});
  if (!without.empty()) said.push_back(listed(without) + ": " + at_an_end);
  content.finding = capital(joined(said, "; ")) + ".";
  return content;
}

}  // namespace reports::texture
