// Where the energy went in the two tests of the granite.
#include "reports/figures/energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

const dem::Table* ledger_of(const dem::Record& record) {
  const dem::Table* history = record.find("history");
  return history && history->rows() > 0 && history->has("damping") ? history : nullptr;
}

double volume_of(const dem::Record& record) {
  const Size size = size_of(record);
  return std::numbers::pi / 4 * size.diameter * size.diameter * size.height;
}

// Largest dissipated energy of one kind by volume, kJ/m^3.
double most_dissipated(const dem::Record& record) {
  double most = 0;
  for (const Term& term : dissipated)
    most = std::max(most, 1e-3 * std::ranges::max(ledger_of(record)->real(term.column)) / volume_of(record));
  return most;
}

// What was dissipated, by volume, with the moments of the test: beside the work it is a thin band.
void add_dissipated(FigureContent& content, const SeriesCase& item, const std::string& id, double high) {
  const dem::Record& record = *item.record;
  const dem::Table* history = ledger_of(record);
  const double volume = volume_of(record);
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
  if (high > 0) chart.left.high = high;
  chart.legend = render::Chart::Legend::below;  // marks stand across the whole chart
  content.panels.push_back(
      {.id = id,
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

// Of every case where there are few, on one scale where that can be read, else of the first case alone.
void add_dissipated(FigureContent& content, std::vector<SeriesCase> cases) {
  constexpr std::size_t few = 4;
  std::erase_if(cases, [](const SeriesCase& item) { return !ledger_of(*item.record); });
  if (cases.empty()) return;
  if (cases.size() == 1 || cases.size() > few) {
    add_dissipated(content, cases.front(), "dissipated", 0);
    return;
  }
  double most = 0, least = std::numeric_limits<double>::infinity();
  for (const SeriesCase& item : cases) {
    most = std::max(most, most_dissipated(*item.record));
    least = std::min(least, most_dissipated(*item.record));
  }
  const double high = least > most / 3 ? 1.05 * most : 0;  // else the smallest would lie on the axis
  for (const SeriesCase& item : cases) add_dissipated(content, item, "dissipated_" + item.id, high);
}

// Who did the work on specimens under pressure. The history begins when the isotropic stage has ended. The work of the ends is
// the integral of their stress over their strain, by the trapezoid rule; that of the jacket is the rest.
void add_work(FigureContent& content, const std::vector<SeriesCase>& cases) {
  TextTable table{
      {"Case", "Isotropic stage (kJ/m³)", "Stored by then (kJ/m³)", "Ends (kJ/m³)", "Jacket (kJ/m³)", "All (kJ/m³)"},
      {}};
  for (const SeriesCase& item : cases) {
    const dem::Record& record = *item.record;
    const dem::Table* history = ledger_of(record);
    const double* pressure = std::get_if<double>(dem::find_value(record.parameters, parameter::confining_pressure.id));
    if (!history || !pressure || !(*pressure > 0)) continue;
    const auto work = history->real("work"), stress = history->real("axial_stress"),
               strain = history->real("platen_strain");
    const std::size_t end = analysis::end_of_loading(record);
    double ends = 0;
    for (std::size_t i = 1; i <= end; ++i) ends += 0.5e-3 * (stress[i] + stress[i - 1]) * (strain[i] - strain[i - 1]);
    const double unit = 1e-3 / volume_of(record), stage = unit * work[0], all = unit * work[end];
    table.rows.push_back({item.label, number(stage, 3), number(unit * history->real("elastic")[0], 3), number(ends, 3),
                          number(all - stage - ends, 3), number(all, 3)});
  }
  if (table.rows.empty()) return;
  content.panels.push_back(
      {.id = "work",
       .caption =
           "Work on specimens under pressure up to the end of loading, per volume: of ends and jacket together in "
           "the isotropic stage, and apart in the test. That of the ends is the integral of their stress over "
           "their strain between samples, that of the jacket what remains of all work; it is negative where the "
           "specimen widens against the pressure.",
       .alt = "",
       .content = std::move(table),
       .per_row = 1});
}

FigureContent energies(const StudyResult& study, std::string_view test) {
  const auto cases = swept_by_test(study, test);
  // Against the strain of the platens, which only grows: that of the gauge springs back where a band fails outside it.
  FigureContent content = energy_figure(study, test, cases, "platen_strain", "Strain of the ends (%)", 100);
  if (!content.panels.empty()) add_dissipated(content, cases);
  add_work(content, cases);
  return content;
}

}  // namespace

FigureContent energy_compression(const StudyResult& study) { return energies(study, test_compression); }

FigureContent energy_tension(const StudyResult& study) { return energies(study, test_tension); }

}  // namespace reports::texture
