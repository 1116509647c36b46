// What the user's laboratory measured beside ours, all on one axis: over the measured value.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/published/laboratory.h"
#include "reports/text.h"

namespace reports::texture {

FigureContent laboratory_comparison(const StudyResult& study) {
  FigureContent content;
  std::vector<LaboratoryRow> rows = beside_laboratory(study);
  std::erase_if(rows, [](const LaboratoryRow& row) { return !row.ours || !(row.number.value > 0); });
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
    const LaboratoryRow& row = rows[k];
    const double at = static_cast<double>(k) + 1, percent_of = 100 / row.number.value;
    std::string symbol(row.number.symbol);
    if (row.number.pressure > 0) symbol += " at " + shortest(row.number.pressure) + " MPa";
    if (!row.number.mineral.empty()) symbol += ", " + row.number.mineral;
    chart.x.ticks.emplace_back(at, symbol);
    measured.x.push_back(at - aside);
    measured.y.push_back(100);
    measured.y_error.push_back(0.5 * percent_of * (row.number.high - row.number.low));
    ours.x.push_back(at + aside);
    ours.y.push_back(percent_of * row.ours->value);
    const bool has = row.ours->has_interval();
    intervals = intervals || has;
    ours.y_error.push_back(has ? 0.5 * percent_of * (row.ours->high - row.ours->low) : 0);
    said.push_back(fmt::format("{} {} %", laboratory_name(row.number), number(ours.y.back(), 3)));
  }
  if (intervals)
    ours.label += ", with its 95 % interval";
  else
    ours.y_error.clear();
  chart.series = {measured, ours};
  chart.marks.push_back({.kind = render::Mark::Kind::horizontal, .y = 100, .label = "", .colour = {0.6, 0.6, 0.6}});
  leave_room(chart);
  chart.legend = render::Chart::Legend::below;
  content.panels.push_back(
      {.id = "values",
       .caption = "What the laboratory measured and what this study gives, each over the measured value (the middle of a range).",
       .alt = joined(said, "; ") + ".",
       .content = std::move(chart),
       .per_row = 1});
  content.finding = laboratory_tally(rows, is_small(*study.scenario) ? study.scenario->scale() : "");
  return content;
}

}  // namespace reports::texture
