#include "reports/figures/emission.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "engine/analysis/goodness.h"
#include "reports/text.h"

namespace reports {
namespace {

struct SourceKind {
  analysis::Source source;
  std::string_view name;
  render::Colour colour;
};
constexpr std::array<SourceKind, 3> sources{{{analysis::Source::opens, "opens", {0.882, 0.431, 0.106}},
                                             {analysis::Source::shears, "shears", {0.0, 0.412, 0.725}},
                                             {analysis::Source::closes, "closes", {0.0, 0.0, 0.0}}}};
constexpr double magnitude_bin = 0.1;

// The magnitude that all events of a fit have at least, where the points and the line of the figure stand: the lower edge of
// its first bin.
double begin_of(const analysis::GutenbergRichter& law) { return law.complete_from - 0.5 * magnitude_bin; }
std::string begin_text(const analysis::GutenbergRichter& law) { return "M " + fixed(begin_of(law), 2); }
std::string b_text(const analysis::GutenbergRichter& law) { return fixed(law.b, 2) + " ± " + fixed(law.error, 2); }
constexpr render::Colour unknown_source{0.35, 0.35, 0.35};

double heat_at(const dem::Table& history, const std::vector<std::string>& columns, double time) {
  const auto at = history.real("time");
  std::size_t row = 0;
  while (row + 1 < at.size() && at[row] < time) ++row;
  double heat = 0;
  for (const std::string& column : columns) heat += history.real(column)[row];
  return heat;
}

// The value of a column of the history at a time.
double at_time(const dem::Table& history, std::string_view column, double time) {
  const auto at = history.real("time"), values = history.real(column);
  const auto after = static_cast<std::size_t>(std::ranges::lower_bound(at, time) - at.begin());
  if (after == 0) return values.front();
  if (after == at.size()) return values.back();
  const double part = (time - at[after - 1]) / (at[after] - at[after - 1]);
  return values[after - 1] + part * (values[after] - values[after - 1]);
}

render::Chart activity_chart(const Emission& e) {
  const dem::Table& history = e.looks.record->table("history");
  render::Chart chart;
  chart.x.title = e.strain_title;
  chart.left.title = "Number so far";
  chart.left.low = 0;
  // The peak of the stress, on the same axis: the stress itself has a scale of its own.
  const render::Series stress = curve(history, {e.strain, "axial_stress", 100, 1e-6});
  if (!stress.y.empty()) {
    const auto peak = static_cast<std::size_t>(std::ranges::max_element(stress.y) - stress.y.begin());
    chart.marks.push_back(
        {.kind = render::Mark::Kind::vertical, .x = stress.x[peak], .label = "peak", .colour = {0.3, 0.3, 0.3}});
  }
  const auto so_far = [&](std::string label, std::size_t colour, auto begin, auto end, auto time) {
    render::Series series{.label = std::move(label),
                          .x = {},
                          .y = {},
                          .colour = render::palette(colour),
                          .line = render::line_style(colour),
                          .y_error = {}};
    double number = 0;
    for (auto at = begin; at != end; ++at) {
      series.x.push_back(100 * at_time(history, e.strain, time(*at)));
      series.y.push_back(++number);
    }
    return series;
  };
  chart.series = {
      so_far("cracks", 0, e.hits.all.begin(), e.hits.all.end(), [](const analysis::Hit& h) { return h.time; }),
      so_far("events", 1, e.events.begin(), e.events.end(), [](const analysis::Event& v) { return v.time; })};
  constexpr double few = 20;  // cracks per event from which on events lie on zero
  const auto cracks = static_cast<double>(e.hits.all.size()), events = static_cast<double>(e.events.size());
  if (events > 0 && cracks > few * events) {
    chart.left.logarithmic = true;
    chart.left.low = 1;
  }
  chart.legend = render::Chart::Legend::below;
  return chart;
}

// Cracks per strain while the stress rises, in steps of a twentieth of the peak. Tests in tension and compression share the
// axis as shares of their peaks.
render::Chart rate_chart(const std::vector<Emission>& all) {
  constexpr int steps = 20;
  render::Chart chart;
  chart.x.title = "Stress over its peak (%)";
  chart.left.title = "Cracks per 0.01 % of strain";
  chart.left.logarithmic = true;
  chart.x.low = 0;
  chart.x.high = 100;
  double low = 1, high = 10;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Emission& e = all[c];
    const dem::Table& history = e.looks.record->table("history");
    const auto stress = history.real("axial_stress"), strain = history.real(e.strain), time = history.real("time");
    const auto peak = static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin());
    render::Series series{.label = e.looks.label,
                          .x = {},
                          .y = {},
                          .colour = e.looks.colour,
                          .line = e.looks.line,
                          .marker = render::marker_style(c),
                          .y_error = {}};
    std::size_t row = 0, hit = 0;
    for (int k = 1; k <= steps; ++k) {
      const std::size_t from = row, first = hit;
      while (row < peak && stress[row] < stress[peak] * k / steps) ++row;
      if (k == steps) row = peak;
      while (hit < e.hits.all.size() && e.hits.all[hit].time <= time[row]) ++hit;
      const double grown = 1e4 * (strain[row] - strain[from]);  // in 0.01 %
      const double rate = grown > 0 ? static_cast<double>(hit - first) / grown : 0;
      if (!(rate > 0)) {  // no line across steps without cracks
        if (!series.x.empty()) {
          series.x.push_back(100 * (k - 0.5) / steps);
          series.y.push_back(std::nan(""));
        }
        continue;
      }
      series.x.push_back(100 * (k - 0.5) / steps);
      series.y.push_back(rate);
      low = std::min(low, rate);
      high = std::max(high, rate);
    }
    if (!series.x.empty()) chart.series.push_back(series);
  }
  chart.left.low = std::pow(10, std::floor(std::log10(low)));
  chart.left.high = std::pow(10, std::max(2.0, std::ceil(std::log10(high))));
  chart.legend = render::Chart::Legend::below;
  return chart;
}

render::Chart magnitude_chart(const std::vector<Emission>& all) {
  render::Chart chart;
  chart.x.title = "Magnitude M of the released energy";
  chart.left.title = "Events of M or more";
  chart.left.logarithmic = true;
  double most = 100;
  // Single cracks that released next to nothing lie orders below all others: the chart begins at the lowest fiftieth.
  double low = 1e9;
  for (const Emission& e : all) {
    std::vector<double> magnitudes;
    for (const analysis::Event& event : e.events) magnitudes.push_back(event.magnitude());
    std::ranges::sort(magnitudes);
    if (!magnitudes.empty()) low = std::min(low, std::floor(10 * magnitudes[magnitudes.size() / 50]) / 10 - 0.1);
  }
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Emission& e = all[c];
    std::vector<double> magnitudes;
    for (const analysis::Event& event : e.events) magnitudes.push_back(event.magnitude());
    const analysis::MagnitudeBins bins = analysis::bins_of(magnitudes);
    render::Series series{.label = e.looks.label,
                          .x = {},
                          .y = {},
                          .colour = e.looks.colour,
                          .line = render::Line::none,
                          .marker = render::marker_style(c),
                          .y_error = {}};
    auto left = static_cast<double>(e.events.size());
    most = std::max(most, left);
    for (std::size_t k = 0; k < bins.events.size(); ++k) {
      if (bins.events[k] > 0 && bins.centre(k) > low) {
        series.x.push_back(bins.centre(k) - 0.5 * bins.width);
        series.y.push_back(left);
      }
      left -= static_cast<double>(bins.events[k]);
    }
    chart.series.push_back(series);
    if (!e.law || !e.law->holds()) continue;
    render::Series line = line_of(
        begin_of(*e.law), bins.centre(bins.events.size() - 1), [&](double m) { return e.law->at_least(m); }, 1);
    line.name = e.looks.label + ", fit";
    line.colour = e.looks.colour;
    line.line = e.looks.line;
    chart.series.push_back(line);
  }
  chart.left.low = 0.7;
  chart.left.high = std::pow(10, std::ceil(std::log10(most)));
  chart.legend = render::Chart::Legend::below;
  return chart;
}

/// Shares of the sources of a case, by number of events and by energy.
struct Sources {
  std::array<double, sources.size()> number{}, energy{};
};
Sources sources_of(const Emission& e) {
  Sources found;
  double events = 0, energy = 0;
  for (const analysis::Event& event : e.events) {
    const auto type = analysis::source_of(event.moment);
    if (!type) continue;
    const auto k = static_cast<std::size_t>(type->kind());
    found.number[k] += 1;
    found.energy[k] += event.energy;
    events += 1;
    energy += event.energy;
  }
  for (std::size_t k = 0; k < sources.size(); ++k) {
    found.number[k] *= events > 0 ? 100 / events : 0;
    found.energy[k] *= energy > 0 ? 100 / energy : 0;
  }
  return found;
}

render::Chart source_chart(const Emission& e) {
  const Sources found = sources_of(e);
  render::Bars bars;
  for (const SourceKind& kind : sources) bars.categories.emplace_back(kind.name);
  bars.labels = {"events", "their energy"};
  bars.colours = {render::ordered(1, 4), render::ordered(2, 4)};
  bars.values = {{found.number.begin(), found.number.end()}, {found.energy.begin(), found.energy.end()}};
  bars.print_values = true;
  render::Chart chart;
  chart.x.title = "Mechanism of the source";
  chart.left.title = "Share (%)";
  chart.left.low = 0;
  chart.left.high = 110;
  chart.bars = bars;
  chart.legend = render::Chart::Legend::below;
  return chart;
}

// Events as spheres with their energy as their volume, the largest of all cases as wide as two particles, none smaller than half
// a one.
Picture map_of(const Emission& e, double largest) {
  const double smallest = 0.25 * e.diameter;
  render::Spheres spheres;
  std::array<std::size_t, sources.size()> numbers{};
  for (const analysis::Event& event : e.events) {
    const auto type = analysis::source_of(event.moment);
    if (type) ++numbers[static_cast<std::size_t>(type->kind())];
    spheres.centre.push_back(event.centre);
    spheres.radius.push_back(std::max(smallest, e.diameter * std::cbrt(event.energy / largest)));
    spheres.colour.push_back(type ? sources[static_cast<std::size_t>(type->kind())].colour : unknown_source);
  }
  Picture picture;
  picture.label = e.looks.label;
  picture.scene.spheres.push_back(std::move(spheres));
  picture.scene.outline = e.outline;
  picture.scene.camera.frame = std::array{e.outline.low, e.outline.high};
  picture.scene.axes = true;
  picture.scene.width = 480;
  const double tall = (e.outline.high[2] - e.outline.low[2]) / (e.outline.high[0] - e.outline.low[0]);
  picture.scene.height = static_cast<int>(std::lround(480 * std::clamp(tall, 0.5, 3.0)));
  if (!e.hits.forces) {
    picture.legend.push_back({unknown_source, "events", count(static_cast<double>(e.events.size()))});
    return picture;
  }
  for (std::size_t k = 0; k < sources.size(); ++k)
    picture.legend.push_back({sources[k].colour, std::string(sources[k].name), count(static_cast<double>(numbers[k]))});
  return picture;
}

std::optional<analysis::GutenbergRichter> law_of(const Emission& e, double from = -1e9) {
  std::vector<double> magnitudes;
  for (const analysis::Event& event : e.events) magnitudes.push_back(event.magnitude());
  return analysis::fit_magnitudes(magnitudes, magnitude_bin, 30, from);
}

TextTable table_of(const std::vector<Emission>& all) {
  TextTable table{{"Case", "Cracks", "Events", "Cracks of the largest event", "Energy of all events (mJ)",
                   "Energy of all events over that of broken bonds in the ledger", "Window in space (mm)",
                   "Window in time (µs)", "Largest magnitude", "Fitted from M", "Events of that magnitude or more",
                   "b ± standard error (Shi & Bolt 1982)", "p"},
                  {}};
  for (const Emission& e : all) {
    std::size_t most = 0;
    double largest = -1e9;
    for (const analysis::Event& event : e.events) {
      most = std::max(most, event.hits);
      largest = std::max(largest, event.magnitude());
    }
    table.rows.push_back({e.looks.label, count(static_cast<double>(e.hits.all.size())),
                          count(static_cast<double>(e.events.size())), count(static_cast<double>(most)),
                          number(1e3 * e.energy(), 4), fixed(e.energy() / e.heat, 5), number(1e3 * e.window.length, 3),
                          number(1e6 * e.window.time, 3), number(largest, 3), e.law ? fixed(begin_of(*e.law), 2) : "–",
                          e.law ? count(static_cast<double>(e.law->events)) : "–",
                          !e.law           ? "too few events"
                          : e.law->holds() ? b_text(*e.law)
                                           : "no straight line",
                          e.law ? p_cell(e.law->p, analysis::law_samples) : "–"});
  }
  return table;
}

// A sentence for all that have a law, and one each for those that follow none and for those with too few events. Where the
// cases begin at a common magnitude, it says so, and what b is from the own magnitude of a case: of a catalogue that bends
// the two differ.
std::string laws_words(const std::vector<Emission>& all) {
  std::vector<std::string> laws, own, bent, without;
  const bool common = std::ranges::any_of(all, [](const Emission& e) { return e.own.has_value(); });
  std::set<long> from;  // in bins
  for (const Emission& e : all) {
    if (!e.law) {
      without.push_back(e.looks.label);
    } else if (!e.law->holds()) {
      bent.push_back(e.looks.label);
    } else {
      from.insert(std::lround(e.law->complete_from / magnitude_bin));
      const std::string events = count(static_cast<double>(e.law->events)) + " events",
                        p = p_text(e.law->p, analysis::law_samples);
      laws.push_back(common ? fmt::format("{} at {} ({}, {})", b_text(*e.law), e.looks.label, events, p)
                            : fmt::format("{}: b {} from {} of {} or more, {}", e.looks.label, b_text(*e.law), events,
                                          begin_text(*e.law), p));
      if (e.own)
        own.push_back(fmt::format("{} at {} (from {}, {})", b_text(*e.own), e.looks.label, begin_text(*e.own),
                                  p_text(e.own->p, analysis::law_samples)));
    }
  }
  std::vector<std::string> said;
  if (!laws.empty() && common) {
    const auto one = std::ranges::find_if(all, [](const Emission& e) { return e.own.has_value(); });
    said.push_back("From " + begin_text(*one->law) + ", the magnitude common to all cases with a fit, b is " +
                   joined(laws, "; ") + ". From the lowest magnitude of a case alone it is " + joined(own, "; ") + ".");
  } else if (!laws.empty()) {
    said.push_back(capital(joined(laws, "; ")) + ".");
  }
  if (from.size() > 1)
    said.emplace_back("The lines begin at different magnitudes, so that these b-values cannot be compared closely.");
  if (!bent.empty()) said.push_back("No b-value, as magnitudes follow no straight line: " + joined(bent, "; ") + ".");
  if (without.size() == all.size() && all.size() > 1)
    said.emplace_back("No case has enough events for a b-value.");
  else if (!without.empty())
    said.push_back("Too few events for a b-value: " + joined(without, "; ") + ".");
  return joined(said, " ");
}

// Whether a line of the rates is broken: by a step without cracks between others with some.
bool has_gap(const render::Chart& rates) {
  return std::ranges::any_of(rates.series, [](const render::Series& s) {
    const auto gap = std::ranges::find_if(s.y, [](double rate) { return !std::isfinite(rate); });
    return std::any_of(gap, s.y.end(), [](double rate) { return std::isfinite(rate); });
  });
}

// b-values are compared from one magnitude on, the highest of those that the cases are complete from, where all have a law
// from there.
void fit_alike(std::vector<Emission>& all) {
  double from = -1e9;
  for (const Emission& e : all)
    if (e.law && e.law->holds()) from = std::max(from, e.law->complete_from);
  std::vector<std::optional<analysis::GutenbergRichter>> alike;
  for (const Emission& e : all) {
    alike.push_back(e.law);
    if (!e.law || !e.law->holds() || e.law->complete_from > from - 0.5 * magnitude_bin) continue;
    alike.back() = law_of(e, from);
    if (!alike.back() || !alike.back()->holds() || alike.back()->complete_from > from + 0.5 * magnitude_bin) return;
  }
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (alike[c] && alike[c]->complete_from > all[c].law->complete_from + 0.5 * magnitude_bin) all[c].own = all[c].law;
    all[c].law = alike[c];
  }
}

}  // namespace

double Emission::energy() const {
  return std::accumulate(events.begin(), events.end(), 0.0,
                         [](double sum, const analysis::Event& e) { return sum + e.energy; });
}

std::optional<Emission> emission_of(const SeriesCase& item, const Emitter& of) {
  Emission found{.looks = item,
                 .hits = analysis::hits_of(*item.record),
                 .window = {},
                 .events = {},
                 .law = {},
                 .own = {},
                 .diameter = of.diameter,
                 .strain = of.strain,
                 .strain_title = of.strain_title,
                 .outline = of.outline};
  if (found.hits.all.empty()) return std::nullopt;
  found.window.length = of.window * of.diameter;
  found.window.time = of.duration * found.window.length / of.shear_wave;
  if (!(found.window.time > 0)) return std::nullopt;
  found.events = analysis::events_of(found.hits.all, found.window);
  std::erase_if(found.events, [](const analysis::Event& e) { return !(e.energy > 0); });
  found.law = law_of(found);
  found.heat = heat_at(item.record->table("history"), of.heat, found.hits.all.back().time);
  return found;
}

void add_emission(FigureContent& content, std::vector<Emission> all) {
  if (all.empty()) return;
  fit_alike(all);
  const Emission& base = all.front();
  const bool of_ends = base.strain_title == Emitter{}.strain_title;
  const std::string against = !of_ends                         ? "the displacement of the load"
                              : base.strain == "platen_strain" ? "the strain of the ends, not of the gauge"
                                                               : "the strain of the ends";
  content.panels.push_back({.id = "activity",
                            .caption = "Cracks and events against " + against + ": " + base.looks.label + ".",
                            .alt = fmt::format("{} cracks are {} events.", base.hits.all.size(), base.events.size()),
                            .content = activity_chart(base),
                            .per_row = 2});
  const render::Chart rates = rate_chart(all);
  content.panels.push_back(
      {.id = "rate",
       .caption = std::string("Cracks per strain while the stress rises to its peak") +
                  (has_gap(rates) ? "; intervals without cracks are left out and break the line." : "."),
       .alt = "Cracks per strain against stress, up to the peak.",
       .content = rates,
       .per_row = 2});
  const bool tried = std::ranges::any_of(all, [](const Emission& e) { return e.law.has_value(); });
  const bool fitted = std::ranges::any_of(all, [](const Emission& e) { return e.law && e.law->holds(); });
  content.panels.push_back(
      {.id = "magnitudes",
       .caption = std::string("Events by magnitude, M = 2/3 (log₁₀ E − 4.8) with all released "
                              "energy E in J") +
                  (fitted ? "; maximum-likelihood lines, from the magnitude that the table gives." : "."),
       .alt = laws_words(all),
       .content = magnitude_chart(all),
       .per_row = 2});
  if (base.hits.forces) {
    const Sources found = sources_of(base);
    content.panels.push_back(
        {.id = "sources",
         .caption = "Mechanism of the sources, by the moment tensor of the forces released: " + base.looks.label + ".",
         .alt = fmt::format("{} % of the events open, {} % shear, {} % close.", number(found.number[0], 2),
                            number(found.number[1], 2), number(found.number[2], 2)),
         .content = source_chart(base),
         .per_row = 2});
  }
  // Before the maps: it can go on over the page, where they cannot.
  content.panels.push_back(
      {.id = "table",
       .caption = "Events up to the end of loading, their energy over that of bonds broken in tension and shear in "
                  "the ledger at that time, and the law of their magnitudes, " +
                  (tried ? "fitted to at least 30 events. p: share of catalogues drawn from the straight line that lie "
                           "at least as far from it; below " +
                               percent(analysis::least_p, 0) +
                               " no b is given. A low p means that the magnitudes depart from a straight line."
                         : std::string("which needs at least 30 events.")),
       .alt = "",
       .content = table_of(all),
       .per_row = 1});
  const bool wide = std::ranges::any_of(all, [](const Emission& e) {
    return e.outline.high[0] - e.outline.low[0] > 1.5 * (e.outline.high[2] - e.outline.low[2]);
  });
  const int per_row = wide ? 2 : all.size() <= 3 ? 3 : 4;
  double largest = 0;
  for (const Emission& e : all)
    for (const analysis::Event& event : e.events) largest = std::max(largest, event.energy);
  const auto [factor, unit] = energy_unit(largest);
  for (const Emission& e : all)
    content.panels.push_back(
        {.id = "map_" + e.looks.id,
         .caption = fmt::format("Events as spheres whose volume is their energy{}; the largest has "
                                "{} {}. None is drawn smaller than half a particle’s diameter.",
                                all.size() > 1 ? ", on one scale for all" : "", number(factor * largest, 3), unit),
         .alt = fmt::format("{} events at {}.", e.events.size(), e.looks.label),
         .content = map_of(e, largest),
         .per_row = per_row});
  content.finding = laws_words(all);
  double off = 0;
  for (const Emission& e : all) off = std::max(off, std::abs(e.energy() / e.heat - 1));
  if (std::ranges::all_of(all, [](const Emission& e) { return e.hits.own_energies; })) {
    constexpr double rounding = 1e-6;
    content.finding += " The energies of all events add up to the energy of broken bonds in the ledger";
    content.finding += off < rounding ? "." : fmt::format(" within {} %.", number(100 * off, 2));
  } else {
    content.finding +=
        " These records were made before cracks kept what they released: the heat between two samples is shared by the "
        "area of their cracks, and there are no source types. A run with --force keeps them.";
  }
}

}  // namespace reports
