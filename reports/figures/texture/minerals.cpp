// The four minerals alone: moduli and strengths (Zhao et al. 2021, Table 3) and their envelopes (Fig. 6).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/analysis/envelopes.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

/// The calibrated values of a mineral (Table 3); NaN for one that the paper has not.
struct Published {
  double young_modulus, tensile_strength, ucs, m;  ///< GPa, MPa, MPa, -
};

Published published_of(const StudyResult& study, std::string mineral) {
  std::ranges::replace(mineral, ' ', '_');
  const auto value = [&](const char* quantity) { return study.published_value(mineral + "_" + quantity); };
  return {value("young_modulus"), value("tensile_strength"), value("ucs"), value("m")};
}

Spread of_first(const std::vector<SeriesCase>& cases, const ValueOf& value) {
  return cases.empty() ? Spread{.mean = std::nan("")} : analysis::spread(cases.front(), value);
}

/// One property of all minerals, ours and published.
struct PropertyBars {
  std::string id, title, caption;
  std::vector<double> ours{}, errors{}, published{};
  std::vector<const LaboratoryNumber*> measured{};
};

render::Chart property_chart(PropertyBars of, const std::vector<std::string>& minerals) {
  render::Chart chart;
  render::Bars bars;
  bars.categories = minerals;
  bars.labels = {"this study"};
  bars.colours = {render::palette(0)};
  double highest = 0;
  for (const auto* values : {&of.ours, &of.published})
    for (const double v : *values)
      if (std::isfinite(v)) highest = std::max(highest, v);
  for (const LaboratoryNumber* one : of.measured)
    if (one) highest = std::max(highest, one->high);
  if (std::ranges::any_of(of.errors, [](double v) { return std::isfinite(v); })) bars.errors = {of.errors};
  bars.values = {of.ours};
  add_published(bars, of.published, "published (Table 3)");
  add_laboratory(bars, of.measured);
  bars.print_values = bars.errors.empty();
  bars.value_format = "{:.3g}";
  chart.bars = bars;
  chart.left.title = of.title;
  chart.left.low = 0;
  chart.left.high = 1.25 * highest;  // an interval from few points may be many times as long
  chart.legend = render::Chart::Legend::below;
  return chart;
}

std::string beside(const Spread& ours, double theirs, int digits) {
  if (ours.count == 0) return std::isfinite(theirs) ? "– / " + shortest(theirs) : "–";
  return number(ours.mean, digits) + (ours.count > 1 ? " ± " + number(ours.deviation, 2) : "") +
         (std::isfinite(theirs) ? " / " + shortest(theirs) : "");
}

}  // namespace

FigureContent mineral_properties(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Each mineral alone, in a specimen of about 2000 particles, was calibrated to the modulus, tensile strength "
      "(TS), UCS and Hoek-Brown m of Table 3.";
  content.rows = {
      "plagioclase_young_modulus",     "plagioclase_tensile_strength",     "plagioclase_ucs",     "plagioclase_m",
      "alkali_feldspar_young_modulus", "alkali_feldspar_tensile_strength", "alkali_feldspar_ucs", "alkali_feldspar_m",
      "quartz_young_modulus",          "quartz_tensile_strength",          "quartz_ucs",          "quartz_m",
      "biotite_young_modulus",         "biotite_tensile_strength",         "biotite_ucs",         "biotite_m"};
  add_missing(content, study, {test_compression, test_tension});
  TextTable table{{"Mineral", "E (GPa)", "TS (MPa)", "UCS (MPa)", "m"}, {}};
  bool intervals = false;  // of m
  std::vector<std::string> said;
  std::array bars{
      PropertyBars{.id = "modulus", .title = "Young’s modulus (GPa)", .caption = "Young’s modulus of the minerals."},
      PropertyBars{.id = "tensile_strength", .title = "TS (MPa)", .caption = "Tensile strength of the minerals."},
      PropertyBars{.id = "ucs", .title = "UCS (MPa)", .caption = "Compressive strength of the minerals."},
      PropertyBars{.id = "m", .title = "Hoek-Brown m", .caption = "Hoek-Brown m of the minerals"}};
  for (const std::string& mineral : minerals_tested(study)) {
    const StudyResult part = of_mineral(study, mineral);
    const auto pressed = series_of(part, test_compression, parameter::confining_pressure);
    const auto pulled = series_of(part, test_tension, parameter::confining_pressure);
    const Published theirs = published_of(study, mineral);
    const Spread modulus = of_first(pressed, shown(quantity::young_modulus)),
                 ucs = of_first(pressed, shown(quantity::compressive_strength));
    const Spread ts = of_first(pulled, shown(quantity::tensile_strength));
    const auto m = envelopes_of(study, mineral).find("peak.m");
    intervals = intervals || (m && m->has_interval());
    table.rows.push_back(
        {mineral, beside(modulus, theirs.young_modulus, 3), beside(ts, theirs.tensile_strength, 3),
         beside(ucs, theirs.ucs, 3),
         (m ? estimate_text(*m, 3, true) : "–") + (std::isfinite(theirs.m) ? " / " + shortest(theirs.m) : "")});
    const auto plotted = [&](std::size_t k, double ours, double error, double published) {
      bars[k].ours.push_back(ours);
      bars[k].errors.push_back(error);
      bars[k].published.push_back(published);
    };
    const auto of = [](const Spread& spread) { return spread.count > 0 ? spread.mean : std::nan(""); };
    const auto error = [](const Spread& spread) { return spread.count > 1 ? spread.deviation : std::nan(""); };
    plotted(0, of(modulus), error(modulus), theirs.young_modulus);
    plotted(1, of(ts), error(ts), theirs.tensile_strength);
    plotted(2, of(ucs), error(ucs), theirs.ucs);
    bars[0].measured.push_back(study.measured("young_modulus", mineral));
    bars[1].measured.push_back(study.measured("tensile_strength", mineral));
    bars[2].measured.push_back(study.measured("ucs", mineral));
    bars[3].measured.push_back(study.measured("hoek_brown_m", mineral));
    plotted(3, m ? m->value : std::nan(""), m && m->has_interval() ? 0.5 * (m->high - m->low) : std::nan(""), theirs.m);
    std::vector<std::string> parts;
    const auto share = [&](const char* name, double ours, double published_value) {
      if (std::isfinite(ours) && std::isfinite(published_value)) {
        parts.push_back(fmt::format("{} {}", name, percent(ours / published_value, 0)));
      }
    };
    share("E", modulus.mean, theirs.young_modulus);
    share("TS", ts.mean, theirs.tensile_strength);
    share("UCS", ucs.mean, theirs.ucs);
    if (m) share("m", m->value, theirs.m);
    if (!parts.empty()) said.push_back(mineral + ": " + joined(parts, ", "));
  }
  if (table.rows.empty()) return content;
  if (intervals) table.head.back() += " (95 % interval)";
  bars.back().caption += intervals ? "; whiskers: 95 % intervals, where enough pressures were run." : ".";
  content.panels.push_back({.id = "",
                            .caption = "Ours / published (the calibrated values of Table 3).",
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  for (PropertyBars& one : bars) {
    if (std::ranges::none_of(one.ours, [](double v) { return std::isfinite(v); })) continue;
    content.panels.push_back({.id = one.id,
                              .caption = one.caption,
                              .alt = one.caption + " The numbers are in the table.",
                              .content = property_chart(std::move(one), minerals_tested(study))});
  }
  if (!said.empty()) content.finding = "Ours over the published values: " + joined(said, "; ") + ".";
  return content;
}

FigureContent mineral_envelopes(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Hoek-Brown envelopes fitted to the peak stresses of the four minerals, with the UCS and m of Table 3.";
  content.rows = {"plagioclase_ucs", "plagioclase_m", "alkali_feldspar_ucs", "alkali_feldspar_m",
                  "quartz_ucs",      "quartz_m",      "biotite_ucs",         "biotite_m"};
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  render::Chart chart;
  chart.x.title = axis_title(parameter::confining_pressure);
  chart.left.title = "Peak axial stress σ₁ (MPa)";
  chart.left.low = 0;
  std::vector<std::string> said;
  bool fitted = false, published = false;  // one key for the lines of each kind of all minerals, of no one's colour
  std::size_t index = 0;
  for (const std::string& mineral : minerals_tested(study)) {
    const analysis::Envelopes found = envelopes_of(study, mineral);
    if (found.peak.sigma_3.empty()) continue;
    const render::Colour colour = render::palette(index);
    chart.series.push_back({.label = mineral,
                            .x = found.peak.sigma_3,
                            .y = found.peak.sigma_1,
                            .colour = colour,
                            .line = render::Line::none,
                            .marker = render::marker_style(index++)});
    const double high = std::ranges::max(found.peak.sigma_3);
    const auto line = [&](render::Line kind, const auto& at) {
      render::Series series = line_of(0, high, at);
      series.colour = colour;
      series.line = kind;
      series.name = mineral + ", fit";
      if (!series.x.empty()) chart.series.push_back(series);
    };
    if (found.peak_fit) {
      fitted = true;
      line(render::Line::solid, [&](double x) { return found.peak_fit->at(x); });
      said.push_back(fmt::format("{} m {}", mineral, told(found.peak_fit->m, 3)));
    }
    std::vector<LaboratoryPoint> measured;
    for (const LaboratoryNumber& one : study.laboratory) {
      if (one.mineral == mineral && (one.key == "ucs" || one.key == "peaks")) measured.push_back({one.pressure, &one});
    }
    add_laboratory(chart, measured, "laboratory, " + mineral, render::marker_style(index - 1));
    const Published theirs = published_of(study, mineral);
    if (high > 0) {
      const std::size_t before = chart.series.size();
      line(render::Line::dash, [&](double x) { return analysis::hoek_brown(x, theirs.ucs, theirs.m, 1); });
      published = published || chart.series.size() > before;
    }
  }
  if (chart.series.empty()) return content;
  const auto key = [&](const char* label, render::Line kind) {
    const render::Series& first = chart.series.front();
    chart.series.push_back({.label = label,
                            .x = {first.x.front(), first.x.front()},
                            .y = {first.y.front(), first.y.front()},
                            .colour = {0.35, 0.35, 0.35},
                            .line = kind,
                            .y_error = {}});
  };
  if (fitted) key("our fits", render::Line::solid);
  if (published) key("published (Table 3)", render::Line::dash);
  chart.legend = render::Chart::Legend::below;
  const std::string fits =
      said.empty() ? "Too few pressures for a fit." : "Fitted with σc = UCS: " + joined(said, "; ") + ".";
  content.panels.push_back({.id = "",
                            .caption = "Peak stresses of the minerals; solid: our fits with σc = UCS and s = 1; "
                                       "dashed: envelopes with UCS and m of Table 3.",
                            .alt = fits,
                            .content = chart});
  content.finding = fits;
  return content;
}

}  // namespace reports::texture
