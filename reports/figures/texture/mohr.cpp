// Peaks under pressure as rock mechanics plots them: in p and q, and as circles of Mohr with the envelopes that touch them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/analysis/mohr.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

const render::Colour peak_colour = render::palette(0), damage_colour = render::palette(1),
                     coulomb_colour = render::palette(3);

/// Mean peak at one pressure, MPa.
struct Peak {
  double sigma_3 = 0, sigma_1 = 0;
};

std::vector<Peak> peaks_of(const analysis::StrengthPoints& points) {
  std::vector<Peak> peaks;
  for (const double pressure : points.sigma_3) {
    if (std::ranges::find(peaks, pressure, &Peak::sigma_3) != peaks.end()) continue;
    double sum = 0, number = 0;
    for (std::size_t i = 0; i < points.sigma_3.size(); ++i)
      if (points.sigma_3[i] == pressure) sum += points.sigma_1[i], ++number;
    peaks.push_back({pressure, sum / number});
  }
  std::ranges::sort(peaks, {}, &Peak::sigma_3);
  return peaks;
}

double mean_tension(const StudyResult& study) {
  std::vector<double> values;
  for (const SeriesCase& item : series_of(of_mineral(study, ""), test_tension, parameter::confining_pressure))
    for (const dem::Record* record : item.repeats) values.push_back(record->value_or_nan(quantity::tensile_strength));
  return analysis::spread(values).mean;
}

render::Series line(std::string label, const render::Colour& colour, render::Line kind) {
  return {.label = std::move(label), .x = {}, .y = {}, .colour = colour, .line = kind, .y_error = {}};
}

render::Series in_invariants(const analysis::StrengthPoints& points, std::string label, const render::Colour& colour,
                             render::Marker marker) {
  render::Series series = line(std::move(label), colour, render::Line::none);
  series.marker = marker;
  for (std::size_t i = 0; i < points.sigma_3.size(); ++i) {
    const auto [p, q] = analysis::invariants(points.sigma_3[i], points.sigma_1[i]);
    series.x.push_back(p);
    series.y.push_back(q);
  }
  return series;
}

template <class Strength>
render::Series envelope_in_invariants(double high, const Strength& strength, const render::Colour& colour,
                                      render::Line kind, std::string label) {
  render::Series series = line(std::move(label), colour, kind);
  constexpr int steps = 60;
  for (int k = 0; k <= steps; ++k) {
    const double sigma_3 = high * k / steps;
    const auto [p, q] = analysis::invariants(sigma_3, strength(sigma_3));
    series.x.push_back(p);
    series.y.push_back(q);
  }
  return series;
}

render::Chart invariants_chart(const analysis::Envelopes& found, const std::optional<analysis::Coulomb>& coulomb,
                               double tension, double high) {
  render::Chart chart;
  chart.x.title = "Mean stress p = (axial + 2 lateral)/3 (MPa)";
  chart.left.title = "Deviator q, |axial − lateral| (MPa)";
  chart.left.low = 0;
  chart.series.push_back(in_invariants(found.peak, "peak", peak_colour, render::Marker::circle));
  if (!found.damage.sigma_3.empty())
    chart.series.push_back(in_invariants(found.damage, "crack damage", damage_colour, render::Marker::square));
  if (std::isfinite(tension)) {
    render::Series ts = line("direct tension", {0, 0, 0}, render::Line::none);
    ts.marker = render::Marker::diamond;
    ts.x = {-tension / 3};
    ts.y = {tension};
    chart.series.push_back(ts);
  }
  if (found.peak_fit)
    chart.series.push_back(envelope_in_invariants(
        high, [&](double x) { return found.peak_fit->at(x); }, peak_colour, render::Line::solid, "Hoek-Brown, peak"));
  if (found.damage_fit)
    chart.series.push_back(envelope_in_invariants(
        high, [&](double x) { return found.damage_fit->at(x); }, damage_colour, render::Line::dash,
        "Hoek-Brown, crack damage"));
  if (coulomb)
    chart.series.push_back(envelope_in_invariants(
        high, [&](double x) { return coulomb->line.at(x); }, coulomb_colour, render::Line::dash_dot, "Coulomb, peak"));
  chart.legend = render::Chart::Legend::below;
  return chart;
}

// Where the circles of an envelope are touched. Hoek-Brown: d sigma_1 / d sigma_3 = 1 + m sigma_c / (2 (sigma_1 - sigma_3)).
render::Series tangents(const analysis::EnvelopeFit& fit, double low, double high) {
  render::Series series = line("Hoek-Brown, peak", peak_colour, render::Line::solid);
  series.width = 2;
  constexpr int steps = 120;
  for (int k = 0; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps, sigma_3 = low + (high - low) * share * share;
    const double sigma_1 = fit.at(sigma_3);
    if (!(sigma_1 - sigma_3 > 1e-9 * fit.sigma_c.value)) continue;
    const double slope = 1 + fit.m.value * fit.sigma_c.value / (2 * (sigma_1 - sigma_3));
    const analysis::OnPlane at = analysis::touching(sigma_3, sigma_1, slope);
    series.x.push_back(at.normal);
    series.y.push_back(at.shear);
  }
  return series;
}

render::Chart circles_chart(const std::vector<Peak>& peaks, const analysis::Envelopes& found,
                            const std::optional<analysis::Coulomb>& coulomb, double tension) {
  render::Chart chart;
  chart.x.title = "Normal stress σ_{n} (MPa)";
  chart.left.title = "Shear stress τ (MPa)";
  double last = 0, radius = 0;
  const auto add = [&](double sigma_3, double sigma_1, std::string label, const render::Colour& colour) {
    render::Series circle = line(std::move(label), colour, render::Line::solid);
    circle.width = 1.1;
    for (const auto& [normal, shear] : analysis::mohr_circle(sigma_3, sigma_1)) {
      circle.x.push_back(normal);
      circle.y.push_back(shear);
    }
    chart.series.push_back(circle);
    last = std::max(last, sigma_1);
    radius = std::max(radius, 0.5 * (sigma_1 - sigma_3));
  };
  constexpr render::Colour grey{0.55, 0.55, 0.55}, dark{0.3, 0.3, 0.3};
  for (const Peak& peak : peaks) {
    add(peak.sigma_3, peak.sigma_1, &peak == peaks.data() ? "peaks" : "", grey);
    chart.marks.push_back({.kind = render::Mark::Kind::point,
                           .x = 0.5 * (peak.sigma_1 + peak.sigma_3),
                           .y = 0.5 * (peak.sigma_1 - peak.sigma_3),
                           .label = "σ_{3} " + shortest(peak.sigma_3) + " MPa",
                           .colour = dark});
  }
  if (std::isfinite(tension)) add(-tension, 0, "", grey);
  const double high = peaks.back().sigma_3;
  // From where the formula of the envelope begins, its tensile strength, -s sigma_c / m.
  if (found.peak_fit)
    chart.series.push_back(tangents(
        *found.peak_fit, -found.peak_fit->s.value * found.peak_fit->sigma_c.value / found.peak_fit->m.value, high));
  if (coulomb) {
    render::Series straight = line("Coulomb, peak", coulomb_colour, render::Line::dash_dot);
    const double slope = coulomb->line.slope.value;
    const double end = analysis::touching(high, coulomb->line.at(high), slope).normal;
    straight.x = {0, end};
    straight.y = {coulomb->shear_at(0), coulomb->shear_at(end)};
    chart.series.push_back(straight);
  }
  // One scale on both axes: circles are round. The frame of a chart of the page's width is some 88 px narrower than it, and
  // 92 px lower with a legend below.
  const double left = std::isfinite(tension) ? 1.3 * tension : 0;
  chart.x.low = -left;
  chart.x.high = 1.02 * last;
  chart.left.low = 0;
  chart.left.high = 1.12 * radius;
  const double px = (render::page_width - 88) / (1.02 * last + left);
  chart.height = static_cast<int>(std::lround(px * 1.12 * radius)) + 92;
  chart.legend = render::Chart::Legend::below;
  return chart;
}

TextTable parameters(const analysis::Envelopes& found, const std::optional<analysis::Coulomb>& coulomb,
                     double tension) {
  TextTable table{{"Envelope of the peaks", "Parameter", "Value (95 % interval)"}, {}};
  if (found.peak_fit) {
    const analysis::EnvelopeFit& fit = *found.peak_fit;
    table.rows.push_back({"Hoek-Brown, s = 1", "σc, the UCS (MPa)", number(fit.sigma_c.value, 3)});
    table.rows.push_back({"", "m", estimate_text(fit.m, 3, true)});
    table.rows.push_back(
        {"", "tensile strength of the envelope, σc/m (MPa)", number(fit.sigma_c.value / fit.m.value, 3)});
  }
  if (std::isfinite(tension)) table.rows.push_back({"", "direct tension, measured (MPa)", number(tension, 3)});
  if (coulomb) {
    table.rows.push_back({"Coulomb", "friction angle φ (°)", estimate_text(coulomb->friction_angle, 3, true)});
    table.rows.push_back({"", "cohesion c (MPa)", number(coulomb->cohesion, 3)});
  }
  return table;
}

}  // namespace

FigureContent confinement_mohr(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  const analysis::Envelopes found = envelopes_of(study);
  const std::vector<Peak> peaks = peaks_of(found.peak);
  if (peaks.size() < 2) return content;  // one pressure makes no envelope
  const double tension = mean_tension(study);
  const auto coulomb = analysis::fit_coulomb(found.peak.sigma_3, found.peak.sigma_1);
  std::vector<std::string> said, fits;
  for (const Peak& peak : peaks) {
    const auto [p, q] = analysis::invariants(peak.sigma_3, peak.sigma_1);
    said.push_back(fmt::format("p {} and q {} MPa at σ₃ {} MPa", number(p, 3), number(q, 3), shortest(peak.sigma_3)));
  }
  if (found.peak_fit) fits.push_back("Hoek-Brown with m " + told(found.peak_fit->m, 3));
  if (coulomb)
    fits.push_back(fmt::format("Coulomb with a friction angle of {} and a cohesion of {} MPa",
                               told(coulomb->friction_angle, 3, "°"), number(coulomb->cohesion, 3)));
  content.panels.push_back(
      {.id = "circles",
       .caption = "Peaks as Mohr circles on one scale, with envelopes of the fits, each the line that touches all "
                  "circles of its fit. The circle to the left of zero is direct tension.",
       .alt = "Fits: " + listed(fits) + ".",
       .content = circles_chart(peaks, found, coulomb, tension),
       .per_row = 1});
  content.panels.push_back({.id = "invariants",
                            .caption = "The same strengths by mean stress and deviator: peak and crack damage of each "
                                       "compression test, and direct tension.",
                            .alt = "Peaks: " + joined(said, "; ") + ".",
                            .content = invariants_chart(found, coulomb, tension, peaks.back().sigma_3),
                            .per_row = 1});
  content.panels.push_back({.id = "parameters",
                            .caption = "Parameters of the envelopes, by least squares of σ₁.",
                            .alt = "",
                            .content = parameters(found, coulomb, tension),
                            .per_row = 1});
  content.finding = "Fitted: " + listed(fits) + ". " + joined(said, "; ") + ".";
  if (found.peak_fit && std::isfinite(tension)) {
    content.finding +=
        fmt::format(" The Hoek-Brown envelope has a tensile strength of {} MPa; direct tension gives {} MPa.",
                    number(found.peak_fit->sigma_c.value / found.peak_fit->m.value, 3), number(tension, 3));
  }
  return content;
}

}  // namespace reports::texture
