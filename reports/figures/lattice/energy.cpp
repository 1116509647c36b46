// Stress-strain curve and its marks, energy and heat of the strength tests (Liu et al. 2017, Figs. 5, 6a-d).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/analysis/breaking.h"
#include "reports/figures/energy_colours.h"
#include "reports/figures/lattice/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::lattice {
namespace {

constexpr int inset_height = 300;  // of a chart with another one in it

// Time of the sample of largest stress.
double peak_time(const dem::Table& h) {
  const auto stress = h.real("axial_stress");
  return h.real("time")[static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin())];
}

double value_at(const dem::Table& h, const std::vector<std::string>& columns, double time) {
  const auto t = h.real("time");
  const auto at = static_cast<std::size_t>(std::min<std::ptrdiff_t>(std::ranges::lower_bound(t, time) - t.begin(),
                                                                    static_cast<std::ptrdiff_t>(t.size()) - 1));
  double sum = 0;
  for (const std::string& c : columns) sum += h.real(c)[at];
  return sum;
}

struct Unit {
  double factor;
  std::string name;
};
Unit unit_of(const dem::Table& h, const std::vector<std::string>& columns) {
  double most = 0;
  const render::Series s = whole(h, "time", 1, columns, 1);
  for (const double y : s.y) most = std::max(most, std::abs(y));
  const auto [factor, name] = energy_unit(most);
  return {factor, name};
}

struct CompressionMarks {
  double a1, a2, a3, c1, c2;
  bool still_falls;  // at A3: the run ends there
};
CompressionMarks marks_of(const dem::Record& r) {
  const dem::Table& h = r.table("history");
  CompressionMarks m{};
  m.a1 = analysis::fall_at(r, r.value_or_nan(quantity::a1_time)).time;
  m.a2 = peak_time(h);
  m.a3 = time_of_least(h, elastic_columns(), m.a2);
  constexpr double rounding = 1e-9;
  m.still_falls = m.a3 >= (1 - rounding) * h.real("time").back();
  m.c1 = r.value_or_nan(quantity::sliding_start);
  m.c2 = m.c1 + r.value_or_nan(quantity::sliding_duration);
  return m;
}

struct TensionMarks {
  double d1, d2, b2;
};
TensionMarks tension_marks(const dem::Record& r) {
  const dem::Table& h = r.table("history");
  TensionMarks m{};
  m.d1 = r.value_or_nan(quantity::failure_time);
  m.d2 = m.d1 + r.value_or_nan(quantity::crack_duration);
  const render::Series kinetic = window(h, "kinetic", m.d1, 1e9, 0, 1);
  const double most = kinetic.y.empty() ? 0 : *std::ranges::max_element(kinetic.y);
  m.b2 = m.d2;
  for (std::size_t i = kinetic.y.size(); i-- > 0;) {
    if (kinetic.y[i] > 0.01 * most) {
      m.b2 = 1e-6 * kinetic.x[i];
      break;
    }
  }
  return m;
}

render::Series of(Energy energy, render::Series series, const std::string& label,
                  render::Line line = render::Line::solid, double width = 1.8) {
  series = styled(std::move(series), label, 0, line, width);
  series.colour = colours_of(energy).line;
  return series;
}

// Elastic energy, kinetic energy, heat and work in a window of time, in microseconds since its zero.
std::vector<render::Series> energies(const dem::Table& h, double from, double to, double zero, double factor) {
  return {of(Energy::elastic, window_sum(h, elastic_columns(), from, to, zero, factor), "elastic"),
          of(Energy::kinetic, window(h, "kinetic", from, to, zero, factor), "kinetic", render::Line::dash_dot),
          of(Energy::heat, window_sum(h, heat_columns(), from, to, zero, factor), "heat", render::Line::dot),
          of(Energy::work, window(h, "work", from, to, zero, factor), "work", render::Line::dash)};
}

render::Chart heats(const dem::Record& r, double from, double to, double zero,
                    const std::vector<std::pair<double, std::string>>& marks, double published_end) {
  const dem::Table& h = r.table("history");
  const Unit unit = unit_of(h, heat_columns());
  render::Chart chart;
  chart.x.title = "Time since " + marks.front().second + " (µs)";
  chart.left.title = "Heat (" + unit.name + ")";
  chart.series = {
      of(Energy::heat, window_sum(h, heat_columns(), from, to, zero, unit.factor), "total", render::Line::solid, 2.4),
      of(Energy::damping, window(h, "viscous_heat", from, to, zero, unit.factor), "viscous", render::Line::dash),
      of(Energy::breaking, window_sum(h, {"breaking_heat_normal", "breaking_heat_shear"}, from, to, zero, unit.factor),
         "breaking"),
      of(Energy::tension, window(h, "breaking_heat_normal", from, to, zero, unit.factor), "breaking, normal",
         render::Line::dash_dot),
      of(Energy::shear, window(h, "breaking_heat_shear", from, to, zero, unit.factor), "breaking, shear",
         render::Line::dot, 3.0),  // on the sum where normal springs give nothing
      of(Energy::friction, window(h, "frictional_heat", from, to, zero, unit.factor), "frictional",
         render::Line::dash_dot)};
  for (const auto& [time, label] : marks) chart.marks.push_back(upright(1e6 * (time - zero), label));
  const double last = 1e6 * (to - zero);
  if (published_end < 4 * last) {
    add_published(chart, render::Mark::Kind::vertical, published_end, "published " + marks.back().second);
    chart.x.high = 1.05 * std::max(last, published_end);
  }
  chart.legend = render::Chart::Legend::below;
  chart.height = 240;
  return chart;
}

// What a plot of heat that ends at a time (s, and since `zero`) does not show; "" where it is little.
std::string heat_beyond(const dem::Record& r, double to, double zero) {
  const dem::Table& h = r.table("history");
  const Unit unit = unit_of(h, heat_columns());
  const double all = value_at(h, heat_columns(), 1e9), rest = all - value_at(h, heat_columns(), to);
  if (rest < 0.02 * all) return {};
  const double viscous = value_at(h, {"viscous_heat"}, 1e9) - value_at(h, {"viscous_heat"}, to);
  return fmt::format(
      " The plot ends {} µs after {}; until the end of the test {} {} of heat follow, {} of them viscous.",
      number(1e6 * (to - zero), 2), r.text("test") == "tension" ? "D₁" : "C₁", number(unit.factor * rest, 3), unit.name,
      number(unit.factor * viscous, 3));
}

// From before the first opening to beyond A1.
render::Chart opening_chart(const dem::Record& r, const render::Series& curve) {
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.left.title = "Axial stress (MPa)";
  const analysis::Fall fall = analysis::fall_at(r, r.value_or_nan(quantity::a1_time));
  const double a1 = 100 * fall.strain, stress = 1e-6 * fall.stress, low = 1e-6 * fall.low_stress,
               first = r.value_or_nan(quantity::first_opening);
  const auto at_first = std::ranges::find_if(curve.y, [=](double y) { return y >= first; });
  if (at_first == curve.y.end()) return chart;
  const double begin = curve.x[static_cast<std::size_t>(at_first - curve.y.begin())];
  chart.x.low = 0.9 * std::min(begin, a1), chart.x.high = 1.4 * a1;
  chart.left.low = 0.9 * std::min(first, low);
  chart.left.high = stress + 0.25 * (stress - *chart.left.low);
  render::Series part = curve;
  part.x.clear();
  part.y.clear();
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (curve.x[i] < *chart.x.low || curve.x[i] > *chart.x.high) continue;
    if (curve.y[i] < *chart.left.low || curve.y[i] > *chart.left.high) continue;
    part.x.push_back(curve.x[i]);
    part.y.push_back(curve.y[i]);
  }
  chart.series = {part};
  chart.marks = {dot(a1, stress, "A₁"), dot(begin, first, "first")};
  chart.legend = render::Chart::Legend::none;
  return chart;
}

}  // namespace

FigureContent stress_strain(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Stress rises linearly to A₁, where opening cracks form and stress falls; it rises again to the strength A₂, "
      "where the block fails in sliding mode. Some bonds at the boundary fail before C_open is reached, and stress "
      "falls a "
      "little before A₁ and before A₂.";
  content.rows = {"linear_to_a1",           "a1_at_theory",         "drop_at_a1",
                  "opening_before_sliding", "opening_below_theory", "opened_below_theory",
                  "fall_before_a1",         "fall_before_a2",       "compression_from_boundary"};
  if (auto missing = missing_cases(study, "compression")) content.panels.push_back(*missing);
  const dem::Record* r = main_record(study, "compression");
  if (!r) return content;
  if (!has_failure(*r)) {
    content.finding = sentence({no_failure_words(*r)});
    return content;
  }
  const dem::Table& h = r->table("history");
  const CompressionMarks m = marks_of(*r);
  const analysis::Fall fall = analysis::fall_at(*r, r->value_or_nan(quantity::a1_time));
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.left.title = "Axial stress (MPa)";
  chart.left.low = 0;
  render::Series curve = styled(whole(h, "axial_strain", 100, {"axial_stress"}, 1e-6), "", 5);
  chart.series = {curve};
  const auto mark = [&](double time, const std::string& label) {
    chart.marks.push_back(
        dot(100 * value_at(h, {"axial_strain"}, time), 1e-6 * value_at(h, {"axial_stress"}, time), label));
  };
  mark(m.a1, "A₁");
  mark(m.a2, "A₂");
  chart.marks.push_back({.kind = render::Mark::Kind::horizontal,
                         .x = 0,
                         .y = r->value(quantity::opening_stress_theory),
                         .label = "C_{open} (Eq. 8)",
                         .colour = {0.4, 0.4, 0.4}});
  chart.legend = render::Chart::Legend::none;
  content.panels.push_back({.id = "whole",
                            .caption = count(r->value(quantity::particles)) + " elements in compression.",
                            .alt = fmt::format("A1 at {} MPa falls to {}; the peak A2 is {} MPa at a strain of {} %.",
                                               number(1e-6 * fall.stress, 3), number(1e-6 * fall.low_stress, 3),
                                               number(r->value_or_nan(quantity::compressive_strength), 3),
                                               number(100 * r->value(quantity::peak_strain), 3)),
                            .content = chart});
  content.panels.push_back(
      {.id = "opening",
       .caption = "The first opening of a bond (first) and A₁, enlarged.",
       .alt = fmt::format("The first bond opens at {} MPa, most open after {} MPa.",
                          number(r->value_or_nan(quantity::first_opening), 3), number(1e-6 * fall.stress, 3)),
       .content = opening_chart(*r, curve)});
  const double first = r->value_or_nan(quantity::first_opening), a1 = 1e-6 * fall.stress;
  const std::string drop = number(1e-6 * fall.low_stress, 3);
  content.finding = fmt::format("The first bonds open at {} MPa, at the boundary", number(first, 3));
  content.finding += first < a1
                         ? fmt::format(
                               ". Most open after A₁ ({} MPa), from {} MPa on; the stress then drops to "
                               "{} MPa. ",
                               number(a1, 3), number(r->value_or_nan(quantity::a1_stress), 3), drop)
                         : fmt::format(": this is A₁, after which most open and the stress drops to {} MPa. ", drop);
  content.finding += fmt::format("The first bonds slide at {} MPa; the strength A₂ is {} MPa, at a strain of {} %.",
                                 number(r->value_or_nan(quantity::first_sliding), 3),
                                 number(r->value_or_nan(quantity::compressive_strength), 3),
                                 number(100 * r->value(quantity::peak_strain), 3));
  return content;
}

FigureContent energy_compression(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Elastic energy follows the stress, falls a little at A₁ and almost to zero between A₂ and A₃; mechanical energy "
      "and heat together always equal the work. Failure takes about 10⁻⁴ s, with much less kinetic than elastic energy "
      "(inset).";
  content.rows = {"elastic_as_stress",   "elastic_loss_at_a1", "elastic_left",
                  "balance_compression", "failure_duration",   "kinetic_share_compression"};
  const dem::Record* r = main_record(study, "compression");
  if (!r) return content;
  if (!has_failure(*r)) {
    content.finding = sentence({no_failure_words(*r)});
    return content;
  }
  const dem::Table& h = r->table("history");
  const CompressionMarks m = marks_of(*r);
  const Unit unit = unit_of(h, {"work"});
  render::Chart chart;
  chart.x.title = "Time (µs)";
  chart.left.title = "Energy (" + unit.name + ")";
  chart.series = energies(h, 0, 1e9, 0, unit.factor);
  chart.x.low = 0, chart.x.high = 1.05e6 * h.real("time").back();
  for (const auto& [time, label] : {std::pair{m.a1, "A₁"}, {m.a2, "A₂"}, {m.a3, "A₃"}}) {
    chart.marks.push_back(dot(1e6 * time, unit.factor * value_at(h, elastic_columns(), time), label));
  }
  render::Chart inset;
  const double from = m.c1 - 1e-5, to = m.a3 + 2e-5;
  const Unit small = unit_of(h, {"kinetic"});
  inset.x.title = "Time since C₁ (µs)";
  inset.left.title = "Kinetic (" + small.name + ")";
  inset.series = {of(Energy::kinetic, window(h, "kinetic", from, to, m.c1, small.factor), "")};
  inset.legend = render::Chart::Legend::none;
  chart.insets.push_back({{inset}, {0.12, 0.34, 0.42, 0.52}});
  chart.legend = render::Chart::Legend::below;
  chart.height = inset_height;
  content.panels.push_back(
      {.id = "",
       .caption = std::string("Compression: energy against time; the inset shows the kinetic energy at failure.") +
                  (m.still_falls ? " A₃ is the end of the run." : ""),
       .alt = fmt::format("Elastic energy falls from {} to {} {} between A2 and A3.",
                          number(unit.factor * value_at(h, elastic_columns(), m.a2), 3),
                          number(unit.factor * value_at(h, elastic_columns(), m.a3), 2), unit.name),
       .content = chart,
       .per_row = 1});
  content.finding = fmt::format(
      "After A₂ the elastic energy falls to {} % of its value there{} µs {} C₁; kinetic energy never exceeds {} "
      "% of the elastic energy at A₂. "
      "The ledger closes to {} of the work.",
      number(100 * r->value_or_nan(quantity::elastic_left_share), 2),
      (m.still_falls ? " by the end of the run, " : ", in ") + number(1e6 * (m.a3 - m.c1), 3),
      m.still_falls ? "after" : "from", number(100 * r->value_or_nan(quantity::kinetic_share), 2),
      number(r->value(quantity::energy_residual), 2));
  return content;
}

FigureContent energy_tension(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "The block breaks in two at 1.072 × 10⁻² s (B₁): elastic energy becomes breaking heat and kinetic energy. The "
      "kinetic energy, at most 16.2 % of the total energy, has become viscous heat by B₂.";
  content.rows = {"failure_time",        "pieces",        "elastic_left_tension",
                  "breaking_at_parting", "kinetic_share", "kinetic_left_tension"};
  if (auto missing = missing_cases(study, "tension")) content.panels.push_back(*missing);
  std::vector<std::string> said;
  for (const dem::Record* r : records_of(study, "tension")) {
    if (!has_failure(*r)) {
      said.push_back(no_failure_words(*r));
      continue;
    }
    const dem::Table& h = r->table("history");
    const TensionMarks m = tension_marks(*r);
    const Unit unit = unit_of(h, {"work"});
    render::Chart chart;
    chart.x.title = "Time (µs)";
    chart.left.title = "Energy (" + unit.name + ")";
    chart.series = energies(h, 0, 1e9, 0, unit.factor);
    chart.x.low = 0, chart.x.high = 1.05e6 * h.real("time").back();
    chart.left.low = 0;
    render::Chart inset;
    inset.left.low = 0;
    inset.x.title = "Time since B₁ (µs)";
    inset.left.title = unit.name;
    const double after = std::max(2.5 * (m.b2 - m.d1), 4e-6);
    inset.series = energies(h, m.d1 - 0.3 * after, m.d1 + after, m.d1, unit.factor);
    double top = 0;
    for (const render::Series& one : inset.series) top = std::max(top, std::ranges::max(one.y));
    inset.left.high = 1.5 * top;  // the names of the marks stand above the work
    inset.marks = {upright(0, "B₁"), upright(1e6 * (m.b2 - m.d1), "B₂")};
    const double published_time = 1e4 * study.published_value("failure_time");  // µs, of 10⁻² s
    // A block of another size parts at another time: far off, the published one would press ours to the edge.
    if (published_time < 1.5e6 * h.real("time").back())
      add_published(chart, render::Mark::Kind::vertical, published_time, "published B₁");
    const double share = study.published_value("kinetic_share");
    add_published(chart, render::Mark::Kind::horizontal, 0.01 * share * unit.factor * value_at(h, {"work"}, m.d1),
                  fmt::format("published largest kinetic, {} %", number(share, 3)));
    inset.legend = render::Chart::Legend::none;
    chart.insets.push_back({{inset}, {0.09, 0.38, 0.42, 0.54}});
    chart.legend = render::Chart::Legend::below;
    chart.height = inset_height;
    const std::string planes = planes_of(*r);
    content.panels.push_back(
        {.id = planes,
         .caption = fmt::format("Tension, {} planes. The inset shows the failure.", planes),
         .alt = fmt::format("The main crack opens at {} µs; kinetic energy reaches {} % of the work.",
                            count(std::round(1e6 * m.d1)), number(100 * r->value_or_nan(quantity::kinetic_share), 3)),
         .content = chart,
         .per_row = 1});
    const bool parts = analysis::pieces_of(*r) > 1;
    said.push_back(fmt::format("with {} planes {} {} µs, with a kinetic share of {} %{}", planes,
                               parts ? "it breaks at" : "a crack opens at", count(std::round(1e6 * m.d1)),
                               number(100 * r->value_or_nan(quantity::kinetic_share), 3),
                               parts ? "" : ", but the block stays in one part"));
  }
  if (!said.empty()) content.finding = sentence(said);
  return content;
}

FigureContent heat_compression(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "At failure in compression (C₁ to C₂) the breaking heat of the normal springs does not change, while that of the "
      "shear springs rises step by step. After C₂ breaking heat is constant; frictional heat still rises.";
  content.rows = {"normal_heat_while_sliding", "shear_heat_while_sliding", "breaking_while_sliding",
                  "breaking_heat_after_c2", "frictional_heat_after_c2"};
  const dem::Record* r = main_record(study, "compression");
  if (!r) return content;
  if (!has_failure(*r)) {
    content.finding = sentence({no_failure_words(*r)});
    return content;
  }
  const CompressionMarks m = marks_of(*r);
  const double span = std::max(m.c2 - m.c1, 5e-6);
  const double to = std::min(m.c2 + 1.5 * span, r->table("history").real("time").back());
  content.panels.push_back(
      {.id = "",
       .caption = "Compression: heat at failure." + heat_beyond(*r, to, m.c1),
       .alt = fmt::format("From C1 to C2 {} µs pass; {} % of the breaking heat in between is of normal springs.",
                          number(1e6 * (m.c2 - m.c1), 3),
                          number(100 * r->value_or_nan(quantity::normal_share_of_sliding_heat), 2)),
       .content = heats(*r, m.c1 - 0.3 * span, to, m.c1, {{m.c1, "C₁"}, {m.c2, "C₂"}},
                        study.published_value("failure_duration")),
       .per_row = 1});
  content.finding = fmt::format(
      "C₂ comes {} µs after C₁. Normal springs contribute {} % of the breaking heat in between. {} % of all frictional "
      "heat comes after C₂; "
      "{} % of the heat from C₁ to the end is viscous.",
      number(1e6 * (m.c2 - m.c1), 3), number(100 * r->value_or_nan(quantity::normal_share_of_sliding_heat), 2),
      number(100 * r->value_or_nan(quantity::frictional_share_after_sliding), 3),
      number(100 * r->value_or_nan(quantity::viscous_share_of_heat), 3));
  return content;
}

FigureContent heat_tension(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Breaking heat rises from D₁ to D₂, 2.83 × 10⁻⁶ s later; viscous heat still rises after D₂, and its share of the "
      "heat is greater than in compression. Frictional heat is always zero.";
  content.rows = {"crack_duration", "viscous_heat_after", "viscous_tension_over_compression", "frictional_heat"};
  std::vector<std::string> said, durations, later, friction, without;
  for (const dem::Record* r : records_of(study, "tension")) {
    if (!has_failure(*r)) {
      said.push_back(no_failure_words(*r));
      continue;
    }
    const TensionMarks m = tension_marks(*r);
    const double span = std::max(m.d2 - m.d1, 1e-6);
    const std::string planes = planes_of(*r);
    const double to = m.d2 + 2.5 * span;
    const bool frictionless = r->value(quantity::frictional_share) == 0;
    content.panels.push_back(
        {.id = planes,
         .caption = fmt::format("Tension, {} planes: heat at failure.{}{}", planes,
                                frictionless ? " Frictional heat is zero." : "", heat_beyond(*r, to, m.d1)),
         .alt = fmt::format("Breaking heat rises for {} µs.", number(1e6 * (m.d2 - m.d1), 3)),
         .content = heats(*r, m.d1 - 0.3 * span, to, m.d1, {{m.d1, "D₁"}, {m.d2, "D₂"}},
                          study.published_value("crack_duration"))});
    const std::string where = " (" + planes + " planes)";
    durations.push_back(number(1e6 * (m.d2 - m.d1), 3) + " µs" + where);
    later.push_back(number(100 * r->value_or_nan(quantity::viscous_share_after_parting), 3) + " %" + where);
    if (r->has(quantity::friction_after_last_opening)) {
      const double after = r->value(quantity::friction_after_last_opening);
      friction.push_back(
          fmt::format("with {} planes frictional heat passes 10⁻⁶ of the work {} µs {} the last opening, and reaches "
                      "{} % of it",
                      planes, number(1e6 * std::abs(after), 3), after < 0 ? "before" : "after",
                      number(100 * r->value(quantity::frictional_share), 2)));
    } else {
      without.push_back(planes);
    }
  }
  if (!durations.empty()) {
    said.push_back("D₁ to D₂ takes " + listed(durations) + "; " + listed(later) + " of the viscous heat comes later");
    if (friction.empty()) {
      said.push_back("there is no frictional heat at any time");
    } else {
      said.push_back(joined(friction, "; "));
      if (!without.empty()) said.push_back("with " + listed(without) + " planes there is none");
    }
  }
  std::vector<std::string> sentences;
  for (const std::string& one : said) sentences.push_back(sentence({one}));
  content.finding = joined(sentences, " ");
  return content;
}

FigureContent ledger(const StudyResult& study) {
  FigureContent content;
  std::set<double> sizes;
  for (const CaseResult& c : study.cases) {
    if (c.record) sizes.insert(c.record->value(quantity::particles));
  }
  content.statement = "The sum of mechanical energy and heat is always equal to the work of the external forces.";
  content.rows = {"balance_compression", "balance_tension"};
  render::Chart chart;
  chart.x.title = "Share of the test’s time (%)";
  chart.left.title = "|Residual| / work";
  chart.left.logarithmic = true;
  double worst = 0;
  std::size_t colour = 0;
  for (const std::string_view test : {"compression", "tension"}) {
    const auto records = records_of(study, test);
    for (const dem::Record* r : records) {
      worst = std::max(worst, r->value(quantity::energy_residual));
      if (colour >= 7) continue;
      const dem::Table& h = r->table("history");
      const auto time = h.real("time"), work = h.real("work"), residual = h.real("residual");
      double most = 0;  // so far, as in the check of the runs (engine/lattice/loading.cpp)
      render::Series s;
      for (std::size_t i = 0; i < time.size(); ++i) {
        most = std::max(most, work[i]);
        const double ratio = std::abs(residual[i]) / std::max(work[i], 1e-3 * most);
        if (!(ratio > 0)) continue;
        s.x.push_back(100 * time[i] / time.back());
        s.y.push_back(ratio);
      }
      if (s.x.empty()) continue;
      const std::string choice = choice_words(*r, *records.front());
      const bool several = std::ranges::any_of(
          records, [&](const dem::Record* other) { return planes_of(*other) != planes_of(*records.front()); });
      const std::string label =
          std::string(test) + (sizes.size() > 1 ? ", " + count(r->value(quantity::particles)) + " elements" : "") +
          (choice == "as the series" ? (several ? ", " + planes_of(*r) + " planes" : "") : ", " + choice);
      chart.series.push_back(styled(s, label, colour, render::line_style(colour), 1.8));
      ++colour;
    }
  }
  if (chart.series.empty()) return content;
  chart.marks.push_back(
      {.kind = render::Mark::Kind::horizontal, .x = 0, .y = 1e-3, .label = "limit", .colour = {0.35, 0.35, 0.35}});
  chart.left.low = 1e-12;
  chart.left.high = 1e-2;
  chart.legend = render::Chart::Legend::below;
  content.panels.push_back(
      {.id = "",
       .caption = "Residual over the work; where the work is below a thousandth of its largest value so far, over that "
                  "thousandth.",
       .alt = "The largest residual of all cases is " + number(worst, 2) + ", the limit 0.001.",
       .content = chart,
       .per_row = 1});
  content.agreement = worst < 1e-3 ? Agreement::agrees : Agreement::disagrees;
  content.finding = "The largest residual of all cases is " + number(worst, 2) + " of the work; the limit is 10⁻³.";
  return content;
}

}  // namespace reports::lattice
