// The granite under confining pressure: stress-strain curves (Zhao et al. 2021, Fig. 10), strengths and their envelopes
// (Fig. 11), and how the stress falls after the peak.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/analysis/ending.h"
#include "engine/analysis/envelopes.h"
#include "engine/analysis/softening.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

const render::Colour peak_colour = render::palette(0), damage_colour = render::palette(1),
                     initiation_colour = render::palette(2), strain_colour = render::palette(3);

double peak_stress(const dem::Record& record) { return record.value_or_nan(quantity::compressive_strength); }

std::vector<SeriesCase> confined(const StudyResult& study) {
  return series_of(of_mineral(study, ""), test_compression, parameter::confining_pressure);
}

std::vector<double> tensile_strengths(const StudyResult& study) {
  std::vector<double> values;
  for (const SeriesCase& item : series_of(of_mineral(study, ""), test_tension, parameter::confining_pressure)) {
    for (const dem::Record* record : item.repeats) {
      const double ts = record->value_or_nan(quantity::tensile_strength);
      if (std::isfinite(ts)) values.push_back(ts);
    }
  }
  return values;
}

// What Fig. 10 enlarges reaches a little past crack initiation (%).
double small_strain(const std::vector<SeriesCase>& cases) {
  double reach = 0.15;
  for (const SeriesCase& item : cases) {
    const double strain = 100 * item.record->value_or_nan(quantity::initiation_strain);
    if (std::isfinite(strain)) reach = std::max(reach, 1.1 * strain);
  }
  return reach;
}

struct Column {
  const char *name, *title;
  double factor;
};

// One column of every history against the axial strain, up to a strain (%) or to the end.
render::Chart against_strain(const std::vector<SeriesCase>& cases, const Column& column, double up_to) {
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.left.title = column.title;
  add_curves(chart, cases, {"axial_strain", column.name, 100, column.factor}, up_to);
  chart.legend = render::Chart::Legend::below;
  return chart;
}

void mark_initiation(render::Chart& chart, const std::vector<SeriesCase>& cases, const ValueOf& height) {
  render::Series marks{.label = "σ_{ci} by axial stiffness",
                       .x = {},
                       .y = {},
                       .colour = {0, 0, 0},
                       .line = render::Line::none,
                       .marker = render::Marker::diamond,
                       .y_error = {}};
  for (const SeriesCase& item : cases) {
    const double strain = 100 * item.record->value_or_nan(quantity::initiation_strain);
    const double y = height(*item.record);
    if (!std::isfinite(strain) || !std::isfinite(y)) continue;
    marks.x.push_back(strain);
    marks.y.push_back(y);
  }
  if (!marks.x.empty()) chart.series.push_back(marks);
}

// "the end of loading, where the stress has fallen to 80 % of its peak or the strain of the ends has come to 1.5 times that at the peak"
std::string end_of_loading_words(const dem::Scenario& scenario) {
  const double limit = scenario.real("compression.strain_limit");
  return "the end of loading, where the stress has fallen to " + percent(scenario.real("compression.stop"), 0) +
         " of its peak" +
         (limit > 0 ? fmt::format(" or the strain of the ends has come to {:g} times that at the peak", limit)
                    : std::string());
}

// Half the range of the axial stiffness over its mean where its plateau is read, between 10 and 25 % of the way to the peak:
// what the start of the platens leaves there.
double swing_of_plateau(const dem::Record& record) {
  const dem::Table& history = record.table("history");
  const auto stress = history.real("axial_stress"), stiffness = history.real("axial_stiffness");
  if (stress.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double base = 1e6 * record.number(parameter::confining_pressure.id), rise = std::ranges::max(stress) - base;
  double low = std::numeric_limits<double>::infinity(), high = 0, sum = 0, count = 0;
  for (std::size_t i = 0; i < stress.size() && stress[i] < base + 0.25 * rise; ++i) {
    if (stress[i] < base + 0.10 * rise || !std::isfinite(stiffness[i])) continue;
    low = std::min(low, stiffness[i]);
    high = std::max(high, stiffness[i]);
    sum += stiffness[i];
    ++count;
  }
  return 0.5 * (high - low) * count / sum;
}

// Largest departure of the confining pressure from its set value over all samples, those after the end of loading too (%).
double servo_error_of_all(const dem::Record& record) {
  const double set = 1e6 * record.number(parameter::confining_pressure.id);
  const dem::Table& history = record.table("history");
  if (!(set > 0) || !history.has("confining_pressure")) return std::numeric_limits<double>::quiet_NaN();
  double largest = 0;
  for (const double pressure : history.real("confining_pressure"))
    largest = std::max(largest, 100 * std::abs(pressure / set - 1));
  return largest;
}

double stiffness_at_initiation(const dem::Record& record) {
  const dem::Table& history = record.table("history");
  return 1e-9 * at_first(history.real("axial_strain"), history.real("axial_stiffness"),
                         record.value_or_nan(quantity::initiation_strain));
}

/// Crack initiation in laboratories, Eq. 12: between these shares of sigma_c plus these multiples of sigma_3.
struct InitiationRange {
  double share_low = 0.3, share_high = 0.5, slope_low = 1, slope_high = 1.5;
  [[nodiscard]] bool holds(double share, double slope) const {
    return share >= share_low && share <= share_high && slope >= slope_low && slope <= slope_high;
  }
};
constexpr InitiationRange laboratories;

/// An envelope of the paper whose formula it gives; NaN for another rock.
struct Published {
  double sigma_c, m, s;
  [[nodiscard]] double operator()(double sigma_3) const { return analysis::hoek_brown(sigma_3, sigma_c, m, s); }
};

render::Series points(const analysis::StrengthPoints& of, const std::string& label, const render::Colour& colour,
                      render::Marker marker) {
  return {.label = label,
          .x = of.sigma_3,
          .y = of.sigma_1,
          .colour = colour,
          .line = render::Line::none,
          .marker = marker,
          .y_error = {}};
}

// What the user's laboratory measured of the rock: strengths at their pressures, tension as a pressure below zero.
void add_laboratory_tests(render::Chart& chart, const StudyResult& study) {
  std::vector<LaboratoryPoint> peaks, damage, initiation, tension;
  for (const LaboratoryNumber& one : study.laboratory) {
    if (!one.mineral.empty()) continue;
    if (one.key == "ucs" || one.key == "peaks") peaks.push_back({one.pressure, &one});
    if (one.key == "crack_damage") damage.push_back({0, &one});
    if (one.key == "crack_initiation") initiation.push_back({0, &one});
    if (one.key == "tensile_strength" && one.value > 0) tension.push_back({-one.value, &one});
  }
  add_laboratory(chart, peaks, "laboratory peak", render::Marker::circle);
  add_laboratory(chart, damage, "laboratory σ_{cd}", render::Marker::square);
  add_laboratory(chart, initiation, "laboratory σ_{ci}", render::Marker::triangle);
  if (tension.empty()) return;
  add_laboratory(chart, tension, "laboratory tension", render::Marker::diamond);
  for (double& y : chart.series.back().y) y = 0;  // at no other stress
  chart.series.back().y_error.clear();
}

render::Chart envelope_chart(const StudyResult& study, const analysis::Envelopes& found,
                             const std::vector<double>& tension) {
  render::Chart chart;
  chart.x.title = axis_title(parameter::confining_pressure);
  chart.left.title = "Axial stress σ₁ (MPa)";
  chart.left.low = 0;
  double high = 10;
  for (const double x : found.peak.sigma_3) high = std::max(high, x);
  chart.series.push_back(points(found.peak, "peak", peak_colour, render::Marker::circle));
  chart.series.push_back(points(found.damage, "crack damage", damage_colour, render::Marker::square));
  // The two readings that the paper's text gives: where the stiffness leaves its plateau, and its number, the stress at 0.1 %.
  const analysis::Initiation &by_stiffness = found.initiation[0], &by_strain = found.initiation[1];
  chart.series.push_back(
      points(by_stiffness.points, "σ_{ci} by axial stiffness", initiation_colour, render::Marker::triangle));
  chart.series.push_back(
      points(by_strain.points, "σ_{ci} as stress at 0.1 % strain", strain_colour, render::Marker::cross));
  std::erase_if(chart.series, [](const render::Series& s) { return s.x.empty(); });
  if (!tension.empty()) {
    render::Series ts{.label = "direct tension",
                      .x = {},
                      .y = {},
                      .colour = {0, 0, 0},
                      .line = render::Line::none,
                      .marker = render::Marker::diamond,
                      .y_error = {}};
    for (const double t : tension) {
      ts.x.push_back(-t);
      ts.y.push_back(0);
    }
    chart.series.push_back(ts);
  }
  const auto line = [&](const std::string& label, const char* name, const render::Colour& colour, render::Line kind,
                        const auto& at) {
    render::Series series = line_of(0, high, at);
    series.label = label;
    series.name = name;
    series.colour = colour;
    series.line = kind;
    if (!series.x.empty()) chart.series.push_back(series);
  };
  if (found.peak_fit)
    line("our fits, each in the colour of its points", "peak, fit", peak_colour, render::Line::solid,
         [&](double x) { return found.peak_fit->at(x); });
  if (found.damage_fit)
    line("", "crack damage, fit", damage_colour, render::Line::solid,
         [&](double x) { return found.damage_fit->at(x); });
  if (by_stiffness.fit)
    line("", "σci by axial stiffness, fit", initiation_colour, render::Line::solid,
         [&](double x) { return by_stiffness.fit->at(x); });
  if (by_strain.fit)
    line("", "σci as stress at 0.1 % strain, fit", strain_colour, render::Line::solid,
         [&](double x) { return by_strain.fit->at(x); });
  // Eq. 11, and Martin's fit to laboratory tests as section 3.3 quotes it.
  const auto published = [&](const char* id) { return study.published_value(id); };
  const double sigma_c = published("envelope_peak_sigma_c"), intercept = published("initiation_intercept"),
               slope = published("initiation_slope");
  line("published fits, in the same colours", "published peak, fit", peak_colour, render::Line::dash,
       Published{sigma_c, published("envelope_peak_m"), 1});
  line("", "published crack damage, fit", damage_colour, render::Line::dash,
       Published{sigma_c, published("envelope_damage_m"), published("envelope_damage_s")});
  line("", "published σci, fit", strain_colour, render::Line::dash, [&](double x) { return intercept + slope * x; });
  line("Martin’s laboratory peak", "published: Martin’s laboratory peak", {0.4, 0.4, 0.4}, render::Line::dot,
       Published{published("martin_sigma_c"), published("martin_m"), 1});
  const render::Colour range_colour{0.5, 0.5, 0.5};
  line("range of Eq. 12 for σ_{ci}, with our UCS", "Eq. 12 for σci with our UCS, lower", range_colour,
       render::Line::dash_dot,
       [&](double x) { return laboratories.share_low * found.ucs + laboratories.slope_low * x; });
  line("", "Eq. 12 for σci with our UCS, upper", range_colour, render::Line::dash_dot,
       [&](double x) { return laboratories.share_high * found.ucs + laboratories.slope_high * x; });
  add_laboratory_tests(chart, study);
  chart.legend = render::Chart::Legend::below;
  chart.height = 350;
  return chart;
}

TextTable envelope_table(const StudyResult& study, const analysis::Envelopes& found) {
  TextTable table{{"Envelope", "Parameter", "Published", "Ours (95 % interval)", "Points"}, {}};
  const auto row = [&](const char* envelope, const char* parameter, const char* published, std::string_view name,
                       std::size_t n) {
    const auto estimate = found.find(name);
    const double value = study.published_value(published);
    table.rows.push_back({envelope, parameter, std::isfinite(value) ? shortest(value) : "–",
                          estimate ? estimate_text(*estimate, 3, true) : "no fit", std::to_string(n)});
  };
  if (const LaboratoryNumber* m = study.measured("hoek_brown_m")) {
    table.rows.push_back({"peak, laboratory", "m", "", fmt::format("measured {:.4g} to {:.4g}", m->low, m->high), ""});
  }
  row("peak, σc = UCS, s = 1", "m", "envelope_peak_m", "peak.m", found.peak.sigma_1.size());
  row("peak, s = 1", "σc (MPa)", "envelope_peak_sigma_c", "free.sigma_c", found.peak.sigma_1.size());
  row("", "m", "envelope_peak_m", "free.m", found.peak.sigma_1.size());
  row("crack damage, σc = UCS", "m", "envelope_damage_m", "damage.m", found.damage.sigma_1.size());
  row("", "s", "envelope_damage_s", "damage.s", found.damage.sigma_1.size());
  for (const analysis::Initiation& one : found.initiation) {
    const std::string name = "crack initiation: " + std::string(one.name), id = "initiation." + std::string(one.id);
    row(name.c_str(), "at σ₃ = 0 (MPa)", "initiation_intercept", id + ".intercept", one.points.sigma_1.size());
    row("", "slope", "initiation_slope", id + ".slope", one.points.sigma_1.size());
  }
  return table;
}

}  // namespace

FigureContent confinement_curves(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "The peak stress rises with the confining pressure. Crack initiation, where the axial stiffness fluctuates, "
      "stays below 0.1 % strain.";
  content.rows = {"trend_peak_with_pressure", "initiation_strain_confined"};
  const auto cases = confined(study);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  if (cases.empty()) return content;
  const std::string peaks = by_case(cases, peak_stress, 3, "MPa");
  const std::string strains = by_case(cases, quantity::initiation_strain, 2);
  render::Chart whole = against_strain(cases, {"axial_stress", "Axial stress σ₁ (MPa)", 1e-6}, 1e300);
  whole.left.low = 0;
  leave_room(whole);
  const bool followed =
      mark_end_of_loading(whole, cases, {"axial_strain", "axial_stress", 100, 1e-6}) && study.scenario;
  content.panels.push_back(
      {.id = "stress",
       .caption = followed
                      ? fmt::format("Axial stress against the axial strain of the gauge, from the isotropic state to "
                                    "{:g} times the strain of the ends at the peak. Crosses: {}; cracks, fragments, "
                                    "emission and energies are those "
                                    "of that moment.",
                                    study.scenario->real("compression.follow"), end_of_loading_words(*study.scenario))
                      : "Axial stress against axial strain, from the isotropic state to the end of loading.",
       .alt = "Stress-strain curves; peaks of " + peaks + ".",
       .content = whole});
  render::Chart start = against_strain(cases, {"axial_stress", "Axial stress σ₁ (MPa)", 1e-6}, small_strain(cases));
  start.left.low = 0;
  mark_initiation(start, cases, shown(quantity::initiation_by_stiffness));
  content.panels.push_back(
      {.id = "start",
       .caption = "Axial stress at small strains, and where the stiffness leaves its plateau.",
       .alt = "Stress at small strains; the stiffness leaves its plateau at strains of " + strains + ".",
       .content = start});
  render::Chart stiffness =
      against_strain(cases, {"axial_stiffness", "Axial stiffness (GPa)", 1e-9}, small_strain(cases));
  double highest = 0;
  for (const SeriesCase& item : cases) highest = std::max(highest, item.record->value_or_nan(quantity::young_modulus));
  stiffness.left.low = 0;
  if (highest > 0) stiffness.left.high = 1.4 * highest;
  mark_initiation(stiffness, cases, stiffness_at_initiation);
  content.panels.push_back(
      {.id = "stiffness",
       .caption = "Axial stiffness (Eq. 9) at small strains, and where it leaves its plateau.",
       .alt = "Axial stiffness; Young’s moduli of " + by_case(cases, quantity::young_modulus, 3) + ".",
       .content = stiffness});
  content.finding = "At " + listed(labels_of(cases)) + " the peaks are " + peaks +
                    ", and the axial stiffness leaves its plateau at strains of " + strains + ".";
  const double departure =
      study.scenario ? study.scenario->real("measure.stiffness_departure") : std::numeric_limits<double>::infinity();
  std::vector<std::string> uneven;
  for (const SeriesCase& item : cases) {
    const double swing = swing_of_plateau(*item.record);
    if (swing > departure) uneven.push_back(item.label + " (± " + percent(swing, 1) + ")");
  }
  if (!uneven.empty()) {
    content.finding += " At " + listed(uneven) +
                       " the stiffness still oscillates after the start of the platens by more "
                       "than the " +
                       percent(departure, 0) +
                       " that mark initiation, so that the reading there is not of cracks alone.";
  }
  return content;
}

FigureContent confinement_envelopes(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Hoek-Brown envelopes with σc 206 MPa, m 29 and s 1 for the peak, and m 16 and s 0.6 for crack damage; crack "
      "initiation at 71.1 MPa + 1.1 σ₃, within (0.3 to 0.5) σc + (1 to 1.5) σ₃ for brittle rocks (Eq. 12). The peaks "
      "are close to those of the "
      "laboratory.";
  content.rows = {"envelope_peak_m",      "envelope_damage_m", "envelope_damage_s",      "initiation_slope",
                  "initiation_intercept", "initiation_linear", "initiation_slope_range", "initiation_share_range",
                  "martin_peak_0",        "martin_peak_5",     "martin_peak_10",         "martin_peak_20",
                  "martin_peak_40",       "martin_peak_60"};
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  const analysis::Envelopes found = envelopes_of(study);
  if (found.peak.sigma_3.empty()) return content;
  const auto [lowest, highest] = std::ranges::minmax(found.peak.sigma_3);
  if (lowest == highest) return content;  // one pressure makes no envelope
  const auto tension = tensile_strengths(study);
  std::vector<std::string> said;
  if (found.peak_fit) {
    said.push_back("peak with σc = UCS, " + number(found.ucs, 3) + " MPa, and m " + told(found.peak_fit->m, 3));
  }
  if (found.damage_fit) {
    said.push_back("crack damage with m " + told(found.damage_fit->m, 3) + " and s " + told(found.damage_fit->s, 2));
  }
  const std::string fits = said.empty() ? "too few pressures for a fit" : joined(said, "; ");
  content.panels.push_back(
      {.id = "",
       .caption =
           "Strengths against confining pressure with fitted envelopes; the tensile strength is the point at σ₃ = −TS. "
           "Of the four readings of crack initiation, those by the number of cracks and by the crack volumetric strain "
           "are given in the table only.",
       .alt = "Peak stresses from " + number(std::ranges::min(found.peak.sigma_1), 3) + " to " +
              number(std::ranges::max(found.peak.sigma_1), 3) + " MPa. Fits: " + fits + ".",
       .content = envelope_chart(study, found, tension)});
  content.panels.push_back({.id = "parameters",
                            .caption = "Parameters of the envelopes, by least squares of σ₁.",
                            .alt = "",
                            .content = envelope_table(study, found),
                            .per_row = 1});
  content.finding = said.empty() ? "Too few pressures for a fit." : "Fitted: " + fits + ".";
  // Eq. 12: 0.3 to 0.5 of sigma_c, slope 1 to 1.5. Of the four readings only a stress at a set strain has a slope near 1 by itself:
  // it is sigma_3 and the elastic stress of that strain.
  const double ucs = found.ucs;
  std::vector<std::string> inside, outside;
  for (const analysis::Initiation& one : found.initiation) {
    if (!one.fit || !std::isfinite(ucs)) continue;
    const double share = one.fit->intercept.value / ucs, slope = one.fit->slope.value;
    (laboratories.holds(share, slope) ? inside : outside)
        .push_back(fmt::format("{} UCS {} {} σ₃ by {}", number(share, 2), slope < 0 ? "−" : "+",
                               number(std::abs(slope), 2), one.name));
  }
  if (!inside.empty()) content.finding += " Crack initiation inside the range of Eq. 12: " + listed(inside) + ".";
  if (!outside.empty()) content.finding += " Outside: " + listed(outside) + ".";
  return content;
}

FigureContent confinement_after_peak(const StudyResult& study) {
  FigureContent content;
  content.statement = "With confining pressure the response after the peak turns from brittle to ductile.";
  content.rows = {"trend_residual_with_pressure"};
  const auto cases = confined(study);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  const ValueOf residual = shown(quantity::residual_over_peak);
  render::Series series = means(cases, residual);
  if (series.x.empty()) {
    content.panels.push_back(
        note_panel("none", "After the peak.", "No test was followed past its peak (compression.follow)."));
    return content;
  }
  series.colour = peak_colour;
  render::Chart chart;
  chart.x.title = axis_title(parameter::confining_pressure);
  chart.left.title = axis_title(quantity::residual_over_peak);
  chart.left.low = 0;
  chart.left.high = 1.1;
  series.label = "end of the test";
  chart.series.push_back(series);
  const double reach = analysis::common_reach(points_of(cases));
  const ValueOf equal = analysis::stress_after_peak(reach);
  render::Series beside = means(cases, equal);
  const std::string same_strain = number(reach, 2) + " % of strain of the ends after the peak";
  beside.label = same_strain;
  beside.colour = damage_colour;
  beside.line = render::Line::dash;
  chart.series.push_back(beside);
  chart.legend = render::Chart::Legend::bottom_right;
  const std::string ratios = by_case(cases, residual, 2, "");
  content.panels.push_back(
      {.id = "residual",
       .caption =
           study.scenario
               ? fmt::format(
                     "Residual stress over the peak: the mean over the last 5 % of the strain of the ends that each "
                     "test "
                     "was followed to, {:g} times that at its peak; and the stress at one and the same strain of the "
                     "ends after the peak, as far as the shortest test goes.",
                     study.scenario->real("compression.follow"))
               : "Residual stress over the peak.",
       .alt = "Residual over peak " + ratios + "; at " + same_strain + " " + by_case(cases, equal, 2, "") + ".",
       .content = chart});
  TextTable servo{{"Confining pressure (MPa)", "To the end of loading (%)", "To the end of the test (%)"}, {}};
  double worst = 0;
  for (const SeriesCase& item : cases) {
    const double error = analysis::spread(item, shown(quantity::servo_error)).mean;
    if (!std::isfinite(error)) continue;
    const double whole = analysis::spread(item, servo_error_of_all).mean;
    const bool is_known = std::isfinite(whole);
    worst = std::max(worst, is_known ? whole : error);
    servo.rows.push_back({shortest(item.value), number(error, 2), is_known ? number(whole, 2) : "–"});
  }
  if (!servo.rows.empty()) {
    content.panels.push_back({.id = "servo",
                              .caption = "Largest departure of the wall’s pressure from its set value.",
                              .alt = "",
                              .content = servo,
                              .per_row = 1});
  }
  content.finding = "Residual over peak: " + ratios + ".";
  const std::string trend = trend_words(cases, residual, "", parameter::confining_pressure);
  if (!trend.empty()) content.finding += " It " + trend + ".";
  const std::string beside_trend = trend_words(cases, equal, "", parameter::confining_pressure);
  content.finding += " At " + same_strain + " the stress is " + by_case(cases, equal, 2, "") + " of the peak";
  content.finding += beside_trend.empty() ? "." : ": it " + beside_trend + ".";
  if (!servo.rows.empty())
    content.finding += " The confining pressure stays within " + number(worst, 2) + " % of its set value.";
  return content;
}

}  // namespace reports::texture
