// Whether the specimen splits along its axis or shears: directions of cracks and the band that holds most of them, by
// confining pressure (Zhao et al. 2021, sections 3.3 and 6, put in numbers).
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/analysis/orientation.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/band.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

render::Chart angle_chart(const std::vector<SeriesCase>& cases) {
  render::Chart chart;
  chart.x.title = "Angle between crack and loading axis (°)";
  chart.left.low = 0;
  chart.x.low = 0;
  chart.x.high = 90;
  render::Series random{
      .label = "random", .x = {}, .y = {}, .colour = {0.5, 0.5, 0.5}, .line = render::Line::dot, .y_error = {}};
  for (const SeriesCase& item : cases) {
    const analysis::Orientation found = analysis::orientation_of(item.record->table("cracks"), 0);
    if (!(found.area > 0)) continue;
    render::Series series;
    series.label = item.label;
    series.colour = item.colour;
    series.line = item.line;
    const bool first = random.x.empty();
    for (std::size_t k = 0; k < found.share.size(); ++k) {
      const double from = found.width * static_cast<double>(k), to = from + found.width;
      chart.left.title = "Share of the crack area in " + number(found.width, 2) + "° (%)";
      series.x.push_back(0.5 * (from + to));
      series.y.push_back(100 * found.share[k]);
      if (!first) continue;
      random.x.push_back(0.5 * (from + to));
      random.y.push_back(100 * (std::sin(to * std::numbers::pi / 180) - std::sin(from * std::numbers::pi / 180)));
    }
    chart.series.push_back(series);
  }
  if (!random.x.empty()) chart.series.push_back(random);
  chart.legend = render::Chart::Legend::below;
  return chart;
}

}  // namespace

FigureContent crack_orientation(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "With confining pressure the failure mode turns from axial splitting to predominantly shear, by crack maps; no "
      "measure is given.";
  content.rows = {"trend_crack_angle_with_pressure"};
  const auto cases = swept(study, test_compression);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  if (cases.empty()) return content;
  const auto mean_angle = [](int mode) {
    return [mode](const dem::Record& r) { return analysis::orientation_of(r.table("cracks"), 0, mode).mean; };
  };
  const auto inclination = [](const dem::Record& r) { return band_of(r, 0).fit.inclination; };
  const dem::Parameter& axis = swept_axis(study);
  TextTable table{
      {"Case", "Mean angle, all (°)", "Tension cracks (°)", "Shear cracks (°)", "Within 30° of the axis (%)",
       "Shear, of the crack area (%)", "Band’s angle to the axis (°)", "Crack density in the band over the mean",
       "Cracks in the band beyond its volume (%)", "Largest of five random placings (%)"},
      {}};
  const auto shown = [](double value, int digits) {
    return std::isfinite(value) ? number(value, digits) : std::string("none");
  };
  render::Series angles{.label = "mean angle of cracks",
                        .x = {},
                        .y = {},
                        .colour = render::palette(0),
                        .marker = render::Marker::circle,
                        .y_error = {}};
  render::Series bands{.label = "band with most cracks",
                       .x = {},
                       .y = {},
                       .colour = render::palette(1),
                       .line = render::Line::dash,
                       .marker = render::Marker::square,
                       .y_error = {}};
  std::vector<std::string> said, standing;
  const bool has_room = is_wide_enough_for_a_band(*cases.front().record);
  if (!has_room) table.head.resize(6);
  for (const SeriesCase& item : cases) {
    const dem::Table& cracks = item.record->table("cracks");
    const analysis::Orientation all = analysis::orientation_of(cracks, 0),
                                tension = analysis::orientation_of(cracks, 0, 0),
                                shear = analysis::orientation_of(cracks, 0, 1);
    const auto [band, at_random] = band_of(*item.record, 5);
    table.rows.push_back({item.label, shown(all.mean, 3), shown(tension.mean, 3), shown(shear.mean, 3),
                          shown(100 * all.along, 3), shown(100 * shear.area / all.area, 2), shown(band.inclination, 2),
                          shown(band.concentration(), 2), shown(100 * band.excess(), 2), shown(100 * at_random, 2)});
    if (!has_room) table.rows.back().resize(6);
    if (has_room && band.excess() > at_random) standing.push_back(item.label);
    if (!(all.area > 0)) continue;
    angles.x.push_back(item.value);
    angles.y.push_back(all.mean);
    bands.x.push_back(item.value);
    bands.y.push_back(band.inclination);
    said.push_back(fmt::format("{}° and {}° at {}", number(all.mean, 3), number(band.inclination, 2), item.label));
  }
  content.panels.push_back(
      {.id = "angles",
       .caption = "Directions of all cracks at the end of loading, by area; 0° is splitting along the axis. Dotted: "
                  "directions at random.",
       .alt = "Mean angles of the cracks to the axis: " + by_case(cases, mean_angle(-1), 3, "°") + ".",
       .content = angle_chart(cases),
       .per_row = 2});
  if (!angles.x.empty()) {
    render::Chart chart;
    chart.x.title = axis_title(axis);
    chart.left.title = "Angle to the loading axis (°)";
    chart.left.low = 0;
    chart.left.high = 90;
    chart.series = {angles};
    if (has_room) chart.series.push_back(bands);
    chart.legend = render::Chart::Legend::below;
    content.panels.push_back(
        {.id = "band",
         .caption = has_room
                        ? fmt::format("Mean angle of the cracks, and angle of the band, {:g} mean particle diameters "
                                      "thick, with most cracks after the peak beyond its share of the volume.",
                                      band_diameters)
                        : "Mean angle of the cracks.",
         .alt = has_room ? "Mean angle of cracks and angle of the band: " + joined(said, "; ") + "."
                         : "Mean angle of cracks: " + by_case(cases, mean_angle(-1), 3, "°") + ".",
         .content = chart,
         .per_row = 2});
  }
  content.panels.push_back({.id = "table",
                            .caption = std::string("Directions of cracks") +
                                       (has_room ? " and the band with most of them." : ".") +
                                       " Directions at random have a mean of 32.7° and half of the area within 30°.",
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  if (has_room) {
    content.finding =
        "Mean angle of the cracks to the axis and angle of the band with most cracks: " + joined(said, "; ") + ".";
    content.finding += standing.empty()
                           ? " No band holds more cracks than chance would put there."
                           : " The band holds more cracks than chance would put there at " + listed(standing) + ".";
  } else {
    content.finding = "Mean angle of the cracks to the axis: " + by_case(cases, mean_angle(-1), 3, "°") +
                      ". No band is looked for: too few particles lie across the specimen.";
  }
  if (cases.size() > 2) {
    content.finding += " The mean angle " + trend_words(cases, mean_angle(-1), "°", axis);
    content.finding += has_room ? "; the band’s " + trend_words(cases, inclination, "°", axis) + "." : ".";
  }
  return content;
}

}  // namespace reports::texture
