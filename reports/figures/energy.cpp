#include "reports/figures/energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/analysis/ending.h"
#include "engine/analysis/ledger.h"
#include "reports/figures/energy_colours.h"
#include "reports/text.h"

namespace reports {
namespace {

double largest(std::span<const double> values) {
  double most = 0;
  for (const double v : values) {
    if (std::isfinite(v)) most = std::max(most, std::abs(v));
  }
  return most;
}

std::vector<double> scaled(std::span<const double> values, double factor) {
  std::vector<double> out;
  for (const double v : values) out.push_back(factor * v);
  return out;
}

// The work that came in: the sum of all columns that are work.
std::vector<double> work_of(const dem::Table& history, const std::vector<analysis::LedgerTerm>& terms) {
  std::vector<double> work(history.rows(), 0.0);
  for (const analysis::LedgerTerm& term : terms) {
    if (term.role != analysis::LedgerTerm::Role::work) continue;
    const auto values = history.real(term.column);
    for (std::size_t i = 0; i < work.size(); ++i) work[i] += values[i];
  }
  return work;
}

/// Ends of the axes that panels share.
struct Reach {
  double x = 0, energy = 0;  ///< x in its unit; J
};

// Cases whose energies are of one size share their axes, in the order of the figure: on those of the largest, small ones
// could not be read. The reach of each case.
std::vector<Reach> shared_reaches(const std::vector<Reach>& own) {
  constexpr double alike = 3;
  std::vector<Reach> shared(own.size());
  for (std::size_t begin = 0, end = 0; begin < own.size(); begin = end) {
    Reach reach;
    double least = own[begin].energy;
    for (; end < own.size(); ++end) {
      least = std::min(least, own[end].energy);
      if (std::max(reach.energy, own[end].energy) > alike * least) break;
      reach = {std::max(reach.x, own[end].x), std::max(reach.energy, own[end].energy)};
    }
    std::fill(shared.begin() + static_cast<std::ptrdiff_t>(begin), shared.begin() + static_cast<std::ptrdiff_t>(end),
              reach);
  }
  return shared;
}

render::Chart ledger_chart(const dem::Table& history, const std::string& x_column, const std::string& x_title,
                           double x_factor, const Reach& reach, const std::pair<double, std::string>& unit) {
  const auto terms = analysis::ledger_terms(history);
  const auto x = scaled(history.real(x_column), x_factor);
  const auto work = work_of(history, terms);
  render::Chart chart;
  std::vector<double> base(x.size(), 0.0);
  for (const analysis::LedgerTerm& term : terms) {
    if (term.role != analysis::LedgerTerm::Role::share) continue;
    render::Band band{.label = term.label,
                      .x = x,
                      .low = base,
                      .high = base,
                      .colour = colours_of(energy_of(term.column)).area,
                      .opacity = 1,
                      .outlined = true,
                      .inside = true};
    const auto values = history.real(term.column);
    if (std::ranges::all_of(values, [](double value) { return value == 0; })) continue;  // no key for what is not there
    for (std::size_t i = 0; i < x.size(); ++i) band.high[i] += unit.first * values[i];
    base = band.high;
    chart.bands.push_back(std::move(band));
  }
  chart.series.push_back({.label = "Work of the boundary",
                          .x = x,
                          .y = scaled(work, unit.first),
                          .colour = colours_of(Energy::work).line,
                          .width = 1.8});
  chart.x.title = x_title;
  chart.left.title = "Energy (" + unit.second + ")";
  chart.x.low = chart.left.low = 0;
  chart.x.high = reach.x;
  chart.left.high = 1.06 * unit.first * reach.energy;
  chart.legend = render::Chart::Legend::top_left;
  return chart;
}

// |residual| over max(W, 1e-2 W_peak), the measure of the check.
render::Series relative_residual(const dem::Table& history, const std::string& x_column, double x_factor) {
  const auto terms = analysis::ledger_terms(history);
  const auto work = work_of(history, terms);
  const double peak = largest(work);
  const auto x = history.real(x_column);
  const auto residual = history.real("residual");
  render::Series series;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double floor = std::max(std::abs(work[i]), 1e-2 * peak);
    if (!(floor > 0) || !std::isfinite(residual[i])) continue;
    const double ratio = std::abs(residual[i]) / floor;
    if (ratio <= 0) continue;  // a logarithmic axis
    series.x.push_back(x_factor * x[i]);
    series.y.push_back(ratio);
  }
  return series;
}

double limit_of(const dem::Record& record) {
  const auto found = std::ranges::find(record.checks, "energy_residual", &dem::Check::id);
  return found == record.checks.end() ? std::nan("") : found->limit;
}

std::string shares_alt(const dem::Record& record) {
  const dem::Table& history = record.table("history");
  const auto terms = analysis::ledger_terms(history);
  const auto work = work_of(history, terms);
  const std::size_t end = analysis::end_of_loading(record);
  if (work.empty() || !(work[end] != 0)) return {};
  std::vector<std::string> parts;
  for (const analysis::LedgerTerm& term : terms) {
    if (term.role != analysis::LedgerTerm::Role::share) continue;
    std::string label = term.label;
    label[0] = static_cast<char>(std::tolower(label[0]));
    const double share = history.real(term.column)[end] / work[end];
    parts.push_back(label + " " + (share == 0 ? "0 %" : percent(share, 1)));
  }
  return std::string("shares of the work at the end of ") +
         (analysis::has_end_of_loading(record) ? "loading: " : "the test: ") + listed(parts) + ".";
}

}  // namespace

FigureContent energy_figure(const StudyResult& study, std::string_view test, const std::vector<SeriesCase>& cases,
                            const std::string& x_column, const std::string& x_title, double x_factor) {
  FigureContent content;
  if (auto missing = missing_cases(study, test)) content.panels.push_back(*missing);
  std::vector<Reach> own;
  std::vector<const SeriesCase*> kept;
  for (const SeriesCase& item : cases) {
    const dem::Table* history = item.record->find("history");
    if (!history || analysis::ledger_terms(*history).empty()) {
      content.panels.push_back(note_panel("none_" + item.id, item.label, "This record keeps no energies."));
      continue;
    }
    kept.push_back(&item);
    constexpr double room = 1.05;  // what falls at the end of a test does not lie on the frame
    own.push_back({room * x_factor * largest(history->real(x_column)),
                   largest(work_of(*history, analysis::ledger_terms(*history)))});
  }
  const std::vector<Reach> reaches = shared_reaches(own);
  const auto unit = energy_unit(own.empty() ? 0 : std::ranges::max_element(own, {}, &Reach::energy)->energy);
  render::Chart residuals;
  double limit = std::nan("");
  double worst = 0;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const SeriesCase* item = kept[k];
    const dem::Table& history = item->record->table("history");
    render::Chart chart = ledger_chart(history, x_column, x_title, x_factor, reaches[k], unit);
    if (analysis::is_followed(*item->record)) {
      chart.marks.push_back({.kind = render::Mark::Kind::vertical,
                             .x = x_factor * history.real(x_column)[analysis::end_of_loading(*item->record)],
                             .y = 0,
                             .label = "end of loading",
                             .colour = {0, 0, 0},
                             .line = render::Line::dot});
    }
    const double first = reaches.front().energy, times = first > 0 ? reaches[k].energy / first : 1;
    content.panels.push_back({.id = item->id,
                              .caption = capital(item->label) + "." +
                                         (times == 1 ? ""
                                                     : fmt::format(" The energy axis is {} times that at {}.",
                                                                   number(times, 2), kept.front()->label)),
                              .alt = item->label + ", " + shares_alt(*item->record),
                              .content = std::move(chart)});
    render::Series series = relative_residual(history, x_column, x_factor);
    series.label = item->label;
    series.colour = item->colour;
    series.line = item->line;
    worst = std::max(worst, largest(series.y));
    if (!series.x.empty()) residuals.series.push_back(series);
    limit = limit_of(*item->record);
  }
  if (kept.empty()) return content;
  if (!residuals.series.empty()) {
    if (std::isfinite(limit)) {
      residuals.marks.push_back(
          {.kind = render::Mark::Kind::horizontal, .x = 0, .y = limit, .label = "limit", .colour = {0.64, 0.15, 0.1}});
    }
    residuals.x.title = x_title;
    residuals.left.title = "|Residual| / work";
    residuals.left.logarithmic = true;
    if (std::isfinite(limit)) {
      residuals.left.high = 10 * std::max(limit, worst);
      residuals.left.low = std::min(1e-6 * limit, 0.1 * worst);
    }
    residuals.legend = render::Chart::Legend::bottom_right;
    content.panels.push_back(
        {.id = "residual",
         .caption = "Residual of the ledger against its limit; work is taken as at least 1 % of its largest value.",
         .alt = "Largest residual " + number(worst, 2) + " of the work, limit " + number(limit, 2) + ".",
         .content = residuals});
  }
  const std::string shares = shares_alt(*kept.front()->record);
  content.finding = fmt::format("{}The largest residual {}is {} of the work{}.",
                                shares.empty()    ? ""
                                : kept.size() > 1 ? "At " + kept.front()->label + ", " + shares + " "
                                                  : capital(shares) + " ",
                                kept.size() > 1 ? "of any case " : "", scientific(worst, 2),
                                std::isfinite(limit) ? " (limit " + scientific(limit, 2) + ")" : "");
  return content;
}

}  // namespace reports
