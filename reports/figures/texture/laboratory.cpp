// What the user's laboratory measured beside ours, all on one axis: over the measured value.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/analysis/fits.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {

namespace {

struct Row {
  LaboratoryNumber number;
  analysis::Estimate ours;
};

// Means over seeds of what the cases of its mineral and pressure give, or the fit over pressures.
std::optional<analysis::Estimate> ours_of(const StudyResult& study, const LaboratoryNumber& number) {
  if (!number.fit.empty()) return envelopes_of(study, number.mineral).find(number.fit);
  const dem::Parameter& pressure = parameter::confining_pressure;
  for (const SeriesCase& item : series_of(of_mineral(study, number.mineral), number.test, pressure)) {
    if (item.value != number.pressure) continue;
    std::vector<double> values;
    for (const dem::Record* record : item.repeats)
      if (const double* value = record->find_result(number.result)) values.push_back(*value);
    if (!values.empty()) return analysis::mean_of(values);
  }
  return std::nullopt;
}

std::string name_of(const LaboratoryNumber& number) {
  std::string name(number.symbol);
  if (number.pressure > 0) name += " at " + shortest(number.pressure) + " MPa";
  return number.mineral.empty() ? name : name + ", " + number.mineral;
}

}  // namespace

FigureContent laboratory_comparison(const StudyResult& study) {
  FigureContent content;
  std::vector<Row> rows;
  for (const LaboratoryNumber& number : study.laboratory) {
    if (!(number.value > 0)) continue;
    if (const auto ours = ours_of(study, number); ours && std::isfinite(ours->value)) rows.push_back({number, *ours});
  }
  if (rows.empty()) {
    content.panels.push_back(note_panel("none", "The laboratory and the model.",
                                        "Nothing that these tests give is in the table [measured] of the rock."));
    return content;
  }
  // Measured to the left, ours to the right of the middle of each quantity.
  constexpr double aside = 0.13;
  render::Series measured{.label = "laboratory, with its uncertainty",
                          .x = {},
                          .y = {},
                          .colour = laboratory_colour,
                          .line = render::Line::none,
                          .marker = render::Marker::square,
                          .hollow = true,
                          .y_error = {}};
  render::Series ours{.label = "this study",
                      .x = {},
                      .y = {},
                      .colour = render::palette(0),
                      .line = render::Line::none,
                      .marker = render::Marker::circle,
                      .y_error = {}};
  render::Chart chart;
  chart.left.title = "Over the measured value (%)";
  chart.x.low = 0.5;
  chart.x.high = static_cast<double>(rows.size()) + 0.5;
  bool intervals = false;
  std::vector<std::string> said;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& row = rows[k];
    const double at = static_cast<double>(k) + 1, percent_of = 100 / row.number.value;
    const std::string name = name_of(row.number);
    chart.x.ticks.emplace_back(at, name);
    measured.x.push_back(at - aside);
    measured.y.push_back(100);
    measured.y_error.push_back(0.5 * percent_of * (row.number.high - row.number.low));
    ours.x.push_back(at + aside);
    ours.y.push_back(percent_of * row.ours.value);
    const bool has = row.ours.has_interval();
    intervals = intervals || has;
    ours.y_error.push_back(has ? 0.5 * percent_of * (row.ours.high - row.ours.low) : 0);
    said.push_back(fmt::format("{} {} %", name, number(ours.y.back(), 3)));
  }
  if (intervals)
    ours.label += ", with its 95 % interval";
  else
    ours.y_error.clear();
  chart.series = {measured, ours};
  chart.marks.push_back({.kind = render::Mark::Kind::horizontal, .y = 100, .label = "", .colour = {0.6, 0.6, 0.6}});
  leave_room(chart);
  chart.legend = render::Chart::Legend::below;
  content.panels.push_back({.id = "values",
                            .caption = "What the laboratory measured and what this study gives, each over the measured "
                                       "value (the middle of a range).",
                            .alt = joined(said, "; ") + ".",
                            .content = std::move(chart),
                            .per_row = 1});
  content.finding = "Over the measured values: " + joined(said, "; ") + ".";
  return content;
}

}  // namespace reports::texture
