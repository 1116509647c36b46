// Where the energy went in the two tests of the granite.
#include "reports/figures/energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/analysis/ending.h"
#include "reports/figures/energy_colours.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

struct Term {
  const char *column, *label;
};
constexpr std::array dissipated{Term{"bond_tension", "bonds broken in tension"},
                                Term{"bond_shear", "bonds broken in shear"}, Term{"friction", "friction"},
                                Term{"damping", "damping"}};

// Strain of the platens (%) in the first row at which a column has come to a value.
double strain_at(const dem::Table& history, const char* column, double value) {
  const auto values = history.real(column), strain = history.real("platen_strain");
  const auto found = std::ranges::find_if(values, [=](double x) { return x >= value; });
  return found == values.end() ? std::nan("") : 100 * strain[static_cast<std::size_t>(found - values.begin())];
}

// What was dissipated, by volume, with the moments of the test: beside the work it is a thin band.
void add_dissipated(FigureContent& content, const std::vector<SeriesCase>& cases) {
  if (cases.empty() || content.panels.empty()) return;
  const SeriesCase& item = cases.front();
  const dem::Record& record = *item.record;
  const dem::Table* history = record.find("history");
  if (!history || history->rows() == 0 || !history->has("damping")) return;
  const Size size = size_of(record);
  const double volume = std::numbers::pi / 4 * size.diameter * size.diameter * size.height;
  render::Chart chart;
  std::vector<std::string> ends;
  const std::size_t end = analysis::end_of_loading(record);
  for (std::size_t k = 0; k < dissipated.size(); ++k) {
    const auto energies = history->real(dissipated[k].column);
    if (std::ranges::all_of(energies, [](double value) { return value == 0; })) {
      ends.push_back(fmt::format("{} 0", dissipated[k].label));
      continue;  // no key for what is not there
    }
    render::Series series;
    for (const double strain : history->real("platen_strain")) series.x.push_back(100 * strain);
    for (const double energy : energies) series.y.push_back(1e-3 * energy / volume);
    series.label = dissipated[k].label;
    series.colour = colours_of(energy_of(dissipated[k].column)).line;
    series.line = render::line_style(k);
    ends.push_back(fmt::format("{} {}", dissipated[k].label, number(series.y[end], 3)));
    chart.series.push_back(std::move(series));
  }
  leave_room(chart);
  const auto stress = history->real("axial_stress");
  const auto mark = [&](double strain, const char* label) {
    if (std::isfinite(strain))
      chart.marks.push_back({.kind = render::Mark::Kind::vertical,
                             .x = strain,
                             .y = 0,
                             .label = label,
                             .colour = {0.35, 0.35, 0.35},
                             .line = render::Line::dot});
  };
  if (record.has(quantity::initiation_strain))
    mark(strain_at(*history, "axial_strain", record.value(quantity::initiation_strain)), "σ_{ci}");
  if (record.has(quantity::crack_damage_strain))
    mark(strain_at(*history, "axial_strain", record.value(quantity::crack_damage_strain)), "σ_{cd}");
  mark(strain_at(*history, "axial_stress", *std::ranges::max_element(stress)), "peak");
  if (analysis::is_followed(record)) mark(100 * history->real("platen_strain")[end], "end of loading");
  chart.x.title = "Strain of the ends (%)";
  chart.left.title = "Dissipated (kJ/m³)";
  chart.x.low = chart.left.low = 0;
  chart.legend = render::Chart::Legend::below;  // marks stand across the whole chart
  content.panels.push_back(
      {.id = "dissipated",
       .caption = capital(item.label) +
                  ": what was dissipated, per volume. For a broken bond: the strain energy it held; damping is "
                  "numerical, against the motion of the particles." +
                  (chart.marks.empty() ? ""
                   : record.has(quantity::initiation_strain)
                       ? " σ_ci, σ_cd and the peak stand at their strain of the ends, not of the gauge."
                       : " The peak stands at its strain of the ends, not of the gauge."),
       .alt = "Dissipated by the end of loading, in kJ/m³: " + listed(ends) + ".",
       .content = std::move(chart)});
}

FigureContent energies(const StudyResult& study, std::string_view test) {
  const auto cases = swept_by_test(study, test);
  // Against the strain of the platens, which only grows: that of the gauge springs back where a band fails outside it.
  FigureContent content = energy_figure(study, test, cases, "platen_strain", "Strain of the ends (%)", 100);
  add_dissipated(content, cases);
  return content;
}

}  // namespace

FigureContent energy_compression(const StudyResult& study) { return energies(study, test_compression); }

FigureContent energy_tension(const StudyResult& study) { return energies(study, test_tension); }

}  // namespace reports::texture
