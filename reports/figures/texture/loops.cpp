// Compression with loops: the curve, and damage as loss of modulus from loop to loop.
#include <fmt/format.h>

#include <cmath>

#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

render::Series of_loops(const dem::Record& record, const std::string& y, double factor, std::size_t look) {
  render::Series series = curve(record.table("loops"), {"strain", y, 100, factor});
  series.colour = render::palette(look);
  series.marker = render::marker_style(look);
  return series;
}

/// Stress on the way down against the strain that is still to go, a line a loop: its slope is the modulus of unloading.
render::Chart unloadings(const dem::Record& record) {
  render::Chart chart;
  chart.x.title = "Axial strain above its value after unloading (%)";
  chart.left.title = "Axial stress (MPa)";
  chart.left.low = 0;
  const dem::Table& history = record.table("history");
  const dem::Table& loops = record.table("loops");
  const auto strain = history.real("axial_strain"), stress = history.real("axial_stress");
  const auto top = loops.real("strain"), bottom = loops.real("low_strain");
  std::size_t from = 0;
  for (std::size_t k = 0; k < loops.rows(); ++k) {
    render::Series line;
    line.label = "loop " + std::to_string(k + 1);
    line.colour = render::palette(k);
    line.line = render::line_style(k);
    while (from < strain.size() && strain[from] != top[k]) ++from;
    for (; from < strain.size(); ++from) {
      line.x.push_back(100 * (strain[from] - bottom[k]));
      line.y.push_back(1e-6 * stress[from]);
      if (strain[from] == bottom[k]) break;
    }
    chart.series.push_back(std::move(line));
  }
  leave_room(chart);
  chart.legend = render::Chart::Legend::below;
  return chart;
}

}  // namespace

FigureContent unloading_loops_test(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_loops)) content.panels.push_back(*missing);
  const auto cases = series_of(of_mineral(study, ""), test_loops, parameter::aspect_ratio);
  if (cases.empty()) return content;
  const dem::Record& first = *cases.front().record;
  render::Chart stress;
  stress.x.title = "Axial strain (%)";
  stress.left.title = "Axial stress (MPa)";
  stress.left.low = 0;
  render::Series line = curve(first.table("history"), {"axial_strain", "axial_stress", 100, 1e-6});
  line.colour = render::palette(0);
  stress.series.push_back(line);
  leave_room(stress);
  stress.legend = render::Chart::Legend::none;
  const double strength = first.value_or_nan(quantity::compressive_strength);
  content.panels.push_back({.id = "curve",
                            .caption = "Axial stress against the axial strain of the gauge, seed " +
                                       shortest(first.number(parameter::seed.id)) + ".",
                            .alt = fmt::format("A stress-strain curve with {} loops and a peak of {} MPa.",
                                               first.table("loops").rows(), number(strength, 3)),
                            .content = stress,
                            .per_row = 1});
  if (first.table("loops").rows() > 0) {
    content.panels.push_back(
        {.id = "unloading",
         .caption = "Each unloading, set to end at the same strain, seed " +
                    shortest(first.number(parameter::seed.id)) + ": the flatter the line, the lower its modulus.",
         .alt = fmt::format("{} lines of unloading, each flatter than the one before.", first.table("loops").rows()),
         .content = unloadings(first)});
  }
  render::Chart damage;
  damage.x.title = "Axial strain at which unloading begins (%)";
  damage.left.title = "Damage 1 − E/E₁";
  TextTable table{{"Seed", "Loop", "Gauge strain (%)", "Stress (MPa)", "Gauge strain after unloading (%)",
                   "Modulus E (GPa)", "Damage"},
                  {}};
  double last = 0;
  std::size_t k = 0;
  for (const dem::Record* record : cases.front().repeats) {
    const dem::Table& loops = record->table("loops");
    const std::string seed = shortest(record->number(parameter::seed.id));
    render::Series lost = of_loops(*record, "damage", 1, k);
    lost.label = "seed " + seed;
    if (!lost.x.empty()) damage.series.push_back(lost);
    const auto strain = loops.real("strain"), top = loops.real("stress"), left = loops.real("low_strain"),
               modulus = loops.real("modulus"), d = loops.real("damage");
    for (std::size_t i = 0; i < loops.rows(); ++i) {
      table.rows.push_back({seed, std::to_string(i + 1), number(100 * strain[i], 3), number(1e-6 * top[i], 3),
                            number(100 * left[i], 3), number(1e-9 * modulus[i], 3), number(d[i], 2)});
      if (record == &first) last = d[i];
    }
    ++k;
  }
  damage.legend = damage.series.size() > 1 ? render::Chart::Legend::below : render::Chart::Legend::none;
  if (!damage.series.empty()) {
    content.panels.push_back({.id = "damage",
                              .caption = "Damage by loop: the loss of the secant modulus of unloading.",
                              .alt = fmt::format("Damage rises to {} at the last loop.", number(last, 2)),
                              .content = damage});
  }
  content.panels.push_back(
      {.id = "table",
       .caption =
           "Loops: strain of the gauge and stress at which unloading begins, and the secant modulus of unloading.",
       .alt = "",
       .content = table,
       .per_row = 1});
  content.finding =
      fmt::format("The first unloading has a modulus of {}; at the last of {} loops {} of that modulus is lost.",
                  by_case(cases, quantity::unloading_modulus, 3), first.table("loops").rows(), percent(last, 0));
  return content;
}

}  // namespace reports::texture
