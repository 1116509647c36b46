// Compression with loops: the curve, and damage as loss of modulus from loop to loop.
#include <fmt/format.h>

#include <algorithm>
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
  chart.x.title = "Axial strain less that after unloading (%)";
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

struct Peak {
  double strain = 0, stress = 0;
  std::size_t row = 0;
};

Peak peak_of(const dem::Table& history) {
  const auto strain = history.real("axial_strain"), stress = history.real("axial_stress");
  const auto row = static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin());
  return {strain[row], stress[row], row};
}

/// Loops turned down after the peak, by their numbers.
std::vector<std::string> beyond_peak(const dem::Record& record) {
  const auto strain = record.table("history").real("axial_strain"), top = record.table("loops").real("strain");
  const std::size_t peak = peak_of(record.table("history")).row;
  std::vector<std::string> numbers;
  std::size_t at = 0;
  for (std::size_t k = 0; k < top.size(); ++k) {
    while (at < strain.size() && strain[at] != top[k]) ++at;
    if (at > peak) numbers.push_back(std::to_string(k + 1));
  }
  return numbers;
}

/// The curve with its loops by number, and its peak.
render::Chart curve_chart(const dem::Record& record) {
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.left.title = "Axial stress (MPa)";
  chart.left.low = 0;
  render::Series line = curve(record.table("history"), {"axial_strain", "axial_stress", 100, 1e-6});
  line.colour = render::palette(0);
  chart.series.push_back(line);
  leave_room(chart);
  const auto mark = [&](double strain, double stress, const std::string& label) {
    chart.marks.push_back({.kind = render::Mark::Kind::point,
                           .x = 100 * strain,
                           .y = 1e-6 * stress,
                           .label = label,
                           .colour = {0, 0, 0}});
  };
  const dem::Table& loops = record.table("loops");
  const auto strain = loops.real("strain"), stress = loops.real("stress");
  for (std::size_t k = 0; k < loops.rows(); ++k) mark(strain[k], stress[k], std::to_string(k + 1));
  if (std::isfinite(record.value_or_nan(quantity::compressive_strength))) {
    const Peak peak = peak_of(record.table("history"));
    chart.marks.push_back({.kind = render::Mark::Kind::vertical,
                           .x = 100 * peak.strain,
                           .label = "peak",
                           .colour = {0.35, 0.35, 0.35},
                           .line = render::Line::dot});
  }
  chart.legend = render::Chart::Legend::none;
  return chart;
}

/// What the loops say: "Damage reaches 0.5 at the last of 6 loops: ...".
std::string damage_words(const dem::Record& record, const std::string& whose) {
  const dem::Table& loops = record.table("loops");
  const auto modulus = loops.real("modulus"), damage = loops.real("damage");
  return fmt::format("Damage reaches {} at the last of {} loops{}: the modulus of unloading falls from {} to {} GPa.",
                     fixed(damage.back(), 2), loops.rows(), whose, number(1e-9 * modulus.front(), 3),
                     number(1e-9 * modulus.back(), 3));
}

std::string peak_words(const dem::Record& record) {
  const double strength = record.value_or_nan(quantity::compressive_strength);
  if (!std::isfinite(strength)) return {};
  const std::vector<std::string> beyond = beyond_peak(record);
  return fmt::format(" The peak is {} MPa at {} %", number(strength, 3),
                     number(100 * peak_of(record.table("history")).strain, 3)) +
         (beyond.empty()       ? "."
          : beyond.size() == 1 ? "; loop " + beyond.front() + " follows it."
                               : "; loops " + listed(beyond) + " follow it.");
}

}  // namespace

FigureContent unloading_loops_test(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_loops)) content.panels.push_back(*missing);
  const auto cases = series_of(of_mineral(study, ""), test_loops, parameter::aspect_ratio);
  if (cases.empty()) return content;
  const dem::Record& first = *cases.front().record;
  const double strength = first.value_or_nan(quantity::compressive_strength);
  content.panels.push_back(
      {.id = "curve",
       .caption = "Axial stress against the axial strain of the gauge, with the loops by number, seed " +
                  shortest(first.number(parameter::seed.id)) + ".",
       .alt = fmt::format("A stress-strain curve with {} loops and a peak of {} MPa.", first.table("loops").rows(),
                          number(strength, 3)),
       .content = curve_chart(first),
       .per_row = 1});
  if (first.table("loops").rows() > 0) {
    content.panels.push_back(
        {.id = "unloading",
         .caption = "Each unloading, shifted to end at zero strain, seed " +
                    shortest(first.number(parameter::seed.id)) + ": the flatter the line, the lower its modulus.",
         .alt = fmt::format("{} lines of unloading, each flatter than the one before.", first.table("loops").rows()),
         .content = unloadings(first)});
  }
  render::Chart damage;
  damage.x.title = "Axial strain at which unloading begins (%)";
  damage.left.title = "Damage 1 − E/E₁";
  const bool repeated = cases.front().repeats.size() > 1;
  TextTable table{
      {"Loop", "Gauge strain (%)", "Stress (MPa)", "Gauge strain after unloading (%)", "Modulus E (GPa)", "Damage"},
      {}};
  if (repeated) table.head.insert(table.head.begin(), "Seed");
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
      std::vector<std::string> row{std::to_string(i + 1),    number(100 * strain[i], 3),   number(1e-6 * top[i], 3),
                                   number(100 * left[i], 3), number(1e-9 * modulus[i], 3), fixed(d[i], 2)};
      if (repeated) row.insert(row.begin(), seed);
      table.rows.push_back(std::move(row));
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
  if (first.table("loops").rows() > 0) {
    content.headline = damage_words(first, first_seed(cases));
    content.finding = content.headline + peak_words(first);
  }
  return content;
}

}  // namespace reports::texture
