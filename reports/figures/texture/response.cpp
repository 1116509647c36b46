// The base case from first load to failure (Zhao et al. 2021, Fig. 8), stress-strain curves and strengths against the
// aspect ratio (Fig. 14), shares of minerals and contact groups (Fig. 18, left half).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>

#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

const render::Colour grey{0.35, 0.35, 0.35};
// Of values of all cases, beside charts where each case has a colour of its own.
const render::Colour study_colour{0.45, 0.52, 0.58};

render::Mark moment(double strain_percent, const std::string& label) {
  return {.kind = render::Mark::Kind::vertical,
          .x = strain_percent,
          .y = 0,
          .label = label,
          .colour = grey,
          .line = render::Line::dot};
}

// Strain (%) where the axial stress first reaches a level (MPa).
double strain_at(const dem::Table& history, double stress_MPa) {
  return 100 * at_first(history.real("axial_stress"), history.real("axial_strain"), 1e6 * stress_MPa);
}

struct Level {
  std::string symbol;
  double stress = 0, strain = 0;  ///< MPa, %
};

// "σ_{ci}" of a chart as "σci".
std::string in_prose(std::string symbol) {
  std::erase_if(symbol, [](char c) { return c == '_' || c == '{' || c == '}'; });
  return symbol;
}

std::vector<Level> levels_of(const dem::Record& record) {
  const dem::Table& history = record.table("history");
  std::vector<Level> levels;
  const auto add = [&](const std::string& symbol, const dem::Quantity& level) {
    const double stress = record.value_or_nan(level);
    const double strain = std::isfinite(stress) ? strain_at(history, stress) : stress;
    if (std::isfinite(strain)) levels.push_back({symbol, stress, strain});
  };
  add("σ_{ci}", quantity::initiation_by_stiffness);
  add("σ_{cd}", quantity::crack_damage);
  const double ucs = record.value_or_nan(quantity::compressive_strength);
  if (std::isfinite(ucs)) levels.push_back({"peak", ucs, 100 * record.value_or_nan(quantity::peak_strain)});
  if (!levels.empty() && !std::isfinite(levels.back().strain)) levels.pop_back();
  return levels;
}

render::Chart stress_and_strains(const StudyResult& study, const dem::Record& record) {
  const dem::Table& history = record.table("history");
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.left.title = "Axial stress (MPa)";
  chart.right.title = "Volumetric, lateral strain (%)";
  render::Series stress = curve(history, {"axial_strain", "axial_stress", 100, 1e-6});
  stress.label = "axial stress (left)";
  stress.colour = render::palette(0);
  render::Series volume = curve(history, {"axial_strain", "volumetric_strain", 100, 100});
  volume.label = "volumetric strain (right)";
  volume.colour = render::palette(1);
  volume.line = render::Line::dash;
  volume.side = render::Side::right;
  render::Series lateral = curve(history, {"axial_strain", "lateral_strain", 100, 100});
  lateral.label = "lateral strain (right)";
  lateral.colour = render::palette(2);
  lateral.line = render::Line::dash_dot;
  lateral.side = render::Side::right;
  chart.series = {stress, volume, lateral};
  leave_room(chart);
  std::vector<PublishedPoint> published;
  for (const auto& [stress_id, strain_id] :
       {std::pair{"stress_at_0_1_percent_ar_1", "crack_initiation_strain"}, {"crack_damage", "crack_damage_strain"}})
    published.push_back({study.published_value(strain_id), study.published_value(stress_id)});
  add_published(chart, published, "published σ_{ci} and σ_{cd}");
  add_published(chart, render::Mark::Kind::horizontal, study.published_value("ucs_ar_1"), "published peak");
  // The laboratory's stresses, each at the strain where ours has that stage.
  for (const LaboratoryNumber& one : study.laboratory) {
    const double* ours = one.pressure > 0 || !one.mineral.empty() || one.test != test_compression
                             ? nullptr
                             : record.find_result(one.result);
    if (!ours || one.unit != "MPa") continue;
    std::string name(one.name);
    name.front() = static_cast<char>(std::tolower(name.front()));
    add_laboratory(chart, {{strain_at(history, *ours), &one}}, "laboratory, " + name + " (left)",
                   one.key == "ucs" ? render::Marker::square : render::Marker::triangle);
  }
  for (const Level& one : levels_of(record)) {
    chart.marks.push_back({.kind = render::Mark::Kind::point,
                           .x = one.strain,
                           .y = one.stress,
                           .label = one.symbol,
                           .colour = {0, 0, 0}});
    chart.marks.push_back(moment(one.strain, ""));
  }
  chart.legend = render::Chart::Legend::below;
  return chart;
}

render::Chart stiffness_chart(const StudyResult& study, const dem::Record& record) {
  const dem::Table& history = record.table("history");
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.left.title = "Axial stiffness (GPa)";
  chart.left.low = 0;
  // At first load the strain is near zero and the ratio senseless: the axis is made for what comes after.
  const double modulus = record.value_or_nan(quantity::young_modulus);
  if (modulus > 0) chart.left.high = 1.5 * modulus;
  render::Series stiffness = curve(history, {"axial_strain", "axial_stiffness", 100, 1e-9});
  stiffness.colour = render::palette(0);
  chart.series.push_back(stiffness);
  leave_room(chart);
  for (const Level& one : levels_of(record)) chart.marks.push_back(moment(one.strain, one.symbol));
  add_published(chart, render::Mark::Kind::horizontal, study.published_value("axial_stiffness"),
                "published, about 70 GPa");
  chart.legend = render::Chart::Legend::none;
  return chart;
}

render::Chart cracks_chart(const dem::Record& record) {
  const dem::Table& history = record.table("history");
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.x.low = 0;
  chart.left.title = "Cracks so far";
  chart.left.logarithmic = true;
  for (std::size_t k = 0; k < crack_classes().size(); ++k) {
    const CrackClass& one = crack_classes()[k];
    render::Series cracks = curve(history, {"axial_strain", "cracks_" + std::string(one.id), 100, 1});
    // A logarithmic axis begins at the first crack.
    render::Series shown = cracks;
    shown.x.clear();
    shown.y.clear();
    for (std::size_t i = 0; i < cracks.x.size(); ++i) {
      if (cracks.y[i] < 1) continue;
      shown.x.push_back(cracks.x[i]);
      shown.y.push_back(cracks.y[i]);
    }
    if (shown.x.empty()) continue;
    shown.label = one.name;
    shown.colour = one.colour;
    shown.line = render::line_style(k);
    chart.series.push_back(shown);
  }
  leave_room(chart);
  for (const Level& one : levels_of(record)) chart.marks.push_back(moment(one.strain, one.symbol));
  chart.legend = render::Chart::Legend::below;
  return chart;
}

// Lateral strains are negative: both kinds stand in one chart, a line style a case.
render::Chart compression_curves(const std::vector<SeriesCase>& cases) {
  render::Chart chart;
  chart.x.title = "Strain (%): lateral < 0 < axial";
  chart.left.title = "Axial stress (MPa)";
  chart.left.low = 0;
  for (const char* kind : {"axial_strain", "lateral_strain"}) {
    for (const SeriesCase& item : cases) {
      render::Series series = curve(item.record->table("history"), {kind, "axial_stress", 100, 1e-6});
      const bool axial = std::string_view(kind) == "axial_strain";
      (axial ? series.label : series.name) = item.label + (axial ? "" : ", lateral");
      series.colour = item.colour;
      series.line = item.line;
      chart.series.push_back(series);
    }
  }
  leave_room(chart);
  chart.legend = render::Chart::Legend::below;
  return chart;
}

render::Chart volume_curves(const std::vector<SeriesCase>& cases) {
  render::Chart chart;
  chart.x.title = "Volumetric strain (%), contraction positive";
  chart.left.title = "Axial stress (MPa)";
  chart.left.low = 0;
  add_curves(chart, cases, {"volumetric_strain", "axial_stress", 100, 1e-6});
  leave_room(chart);
  chart.legend = render::Chart::Legend::below;
  return chart;
}

render::Chart tension_curves(const std::vector<SeriesCase>& cases) {
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.left.title = "Axial tension (MPa)";
  chart.left.low = 0;
  add_curves(chart, cases, {"axial_strain", "axial_stress", 100, 1e-6});
  leave_room(chart);
  chart.legend = render::Chart::Legend::below;
  return chart;
}

struct Strength {
  std::string label;
  double at = 0;  ///< place on the swept axis
  Spread ucs, ts;
  double ratio = 0, ratio_deviation = 0;
};

std::vector<Strength> strengths(const std::vector<SeriesCase>& compression, const std::vector<SeriesCase>& tension) {
  std::vector<Strength> found;
  for (const SeriesCase& item : compression) {
    const auto pulled = std::ranges::find(tension, item.value, &SeriesCase::value);
    if (pulled == tension.end()) continue;
    const Spread ucs = analysis::spread(item, shown(quantity::compressive_strength));
    const Spread ts = analysis::spread(*pulled, shown(quantity::tensile_strength));
    if (!std::isfinite(ucs.mean) || !(ts.mean > 0)) continue;
    const double ratio = ucs.mean / ts.mean;
    found.push_back(
        {item.label, item.value, ucs, ts, ratio, ratio * std::hypot(ucs.deviation / ucs.mean, ts.deviation / ts.mean)});
  }
  return found;
}

// What the paper states of a strength at a place of the swept axis; NaN where it states nothing.
double published_at(const StudyResult& study, const dem::Parameter& axis, std::string_view strength, double at) {
  return study.published_value(fmt::format("{}_{}_{:g}", strength, axis.id == "dip" ? "dip" : "ar", at));
}

render::Chart strength_bars(const StudyResult& study, const std::vector<Strength>& found, Spread Strength::*value,
                            const std::string& title, std::string_view published_id, std::string_view laboratory_key,
                            int digits) {
  render::Chart chart;
  render::Bars bars;
  bars.value_format = fmt::format("{{:.{}f}}", digits);
  bars.labels = {"this study"};
  bars.colours = {study_colour};
  bars.values.emplace_back();
  bars.errors.emplace_back();
  std::vector<double> published;
  std::vector<const LaboratoryNumber*> measured;
  bool repeated = false;
  const dem::Parameter& axis = swept_axis(study);
  const bool angle = axis.unit == "°";
  const double usual = study.scenario->real(axis.key) * (angle ? 180 / std::numbers::pi : 1);
  for (const Strength& one : found) {
    measured.push_back(std::abs(one.at - usual) < 1e-6 ? study.measured(laboratory_key) : nullptr);
    const Spread& spread = one.*value;
    bars.categories.push_back(one.label);
    bars.values[0].push_back(spread.mean);
    bars.errors[0].push_back(spread.deviation);
    repeated = repeated || spread.count > 1;
    published.push_back(published_at(study, axis, published_id, one.at));
  }
  if (!repeated) bars.errors.clear();
  add_published(bars, published);
  add_laboratory(bars, measured);
  bars.print_values = true;
  chart.bars = bars;
  chart.left.title = title + " (MPa)";
  chart.left.low = 0;
  chart.legend = render::Chart::Legend::below;
  return chart;
}

render::Chart ratio_chart(const StudyResult& study, const std::vector<Strength>& found) {
  const dem::Parameter& axis = swept_axis(study);
  render::Chart chart;
  chart.x.title = axis_title(axis);
  chart.left.title = "UCS/TS";
  render::Series ours{
      .label = "this study", .x = {}, .y = {}, .colour = study_colour, .marker = render::Marker::circle};
  std::vector<PublishedPoint> published, derived;
  bool repeated = false;
  for (const Strength& one : found) {
    ours.x.push_back(one.at);
    ours.y.push_back(one.ratio);
    ours.y_error.push_back(one.ratio_deviation);
    repeated = repeated || one.ucs.count > 1 || one.ts.count > 1;
    const double stated = published_at(study, axis, "ucs_ts_ratio", one.at);
    const double quotient =
        published_at(study, axis, "ucs", one.at) / published_at(study, axis, "tensile_strength", one.at);
    if (std::isfinite(stated))
      published.push_back({one.at, stated});
    else
      derived.push_back({one.at, quotient});
  }
  if (!repeated) ours.y_error.clear();
  chart.series.push_back(ours);
  add_published(chart, published, "published");
  add_published(chart, derived, "published (UCS over TS)");
  // A ratio has no bars from zero; a few percent of it should not look like a cliff either.
  double low = 1e300, high = 0;
  for (const render::Series& s : chart.series)
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      const double error = i < s.y_error.size() ? s.y_error[i] : 0;
      low = std::min(low, s.y[i] - error);
      high = std::max(high, s.y[i] + error);
    }
  const double margin = found.empty() ? 1 : std::max(0.06 * (found.back().at - found.front().at), 1e-6);
  if (found.size() > 1) {
    chart.x.low = found.front().at - margin;
    chart.x.high = found.back().at + margin;
  }
  const double room = std::max(0.25 * (high - low), 0.06 * high);
  chart.left.low = std::floor(low - room);
  chart.left.high = std::ceil(high + room);
  chart.legend = render::Chart::Legend::below;
  return chart;
}

std::string strengths_alt(const std::vector<Strength>& found) {
  std::vector<std::string> parts;
  for (const Strength& one : found) {
    parts.push_back(fmt::format("{}: UCS {} MPa, TS {} MPa, ratio {}", one.label, number(one.ucs.mean, 3),
                                number(one.ts.mean, 3), number(one.ratio, 3)));
  }
  return joined(parts, "; ") + ".";
}

std::string spread_note(const std::vector<Strength>& found) {
  return std::ranges::any_of(found, [](const Strength& one) { return one.ucs.count > 1 || one.ts.count > 1; })
             ? " Means of repeats; bars are one standard deviation."
             : "";
}

void add_strengths(FigureContent& content, const StudyResult& study, const std::vector<Strength>& found) {
  if (found.empty()) return;
  content.panels.push_back({.id = "strength",
                            .caption = "Uniaxial compressive strength." + spread_note(found),
                            .alt = strengths_alt(found),
                            .content = strength_bars(study, found, &Strength::ucs, "UCS", "ucs", "ucs", 0)});
  content.panels.push_back(
      {.id = "tensile_strength",
       .caption = "Tensile strength." + spread_note(found),
       .alt = strengths_alt(found),
       .content = strength_bars(study, found, &Strength::ts, "TS", "tensile_strength", "tensile_strength", 1)});
  content.panels.push_back({.id = "strength_ratio",
                            .caption = "Ratio of the two." + spread_note(found),
                            .alt = strengths_alt(found),
                            .content = ratio_chart(study, found)});
}

std::string strengths_found(const std::vector<SeriesCase>& compression, const std::vector<SeriesCase>& tension,
                            const std::vector<Strength>& found, const dem::Parameter& axis) {
  std::string text = "UCS " + by_case(compression, quantity::compressive_strength, 3) + "; TS " +
                     by_case(tension, quantity::tensile_strength, 3);
  std::vector<std::string> ratios;
  for (const Strength& one : found) ratios.push_back(number(one.ratio, 3));
  text += ratios.empty() ? "." : "; UCS/TS " + listed(ratios) + ".";
  const std::string ucs = trend_words(compression, quantity::compressive_strength, axis);
  const std::string ts = trend_words(tension, quantity::tensile_strength, axis);
  if (!ucs.empty()) text += " UCS " + ucs + ".";
  if (!ts.empty()) text += " TS " + ts + ".";
  return text;
}

// The members of a family in the results of any case, in order of first appearance.
std::vector<std::string> members_of(const std::vector<SeriesCase>& cases, const dem::Quantity& family) {
  std::vector<std::string> names;
  for (const SeriesCase& item : cases) {
    for (const auto& [id, value] : item.record->results) {
      if (!family.covers(id)) continue;
      std::string name = id.substr(family.id.size() - 1);
      if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
    }
  }
  return names;
}

double share(const dem::Record& record, const dem::Quantity& family, const std::string& member) {
  const double value = family.factor * record.value_or_nan(family, member);
  return std::isfinite(value) ? value : 0;
}

render::Chart share_chart(const std::string& title, const std::vector<SeriesCase>& cases) {
  render::Chart chart;
  render::Bars bars;
  bars.stacked = true;
  for (const SeriesCase& item : cases) bars.categories.push_back(item.label);
  chart.bars = bars;
  chart.left.title = title;
  chart.left.low = 0;
  chart.left.high = 100;
  chart.legend = render::Chart::Legend::below;
  return chart;
}

void add_stack(render::Chart& chart, const std::string& label, const render::Colour& colour,
               std::vector<double> values) {
  chart.bars->labels.push_back(label);
  chart.bars->colours.push_back(colour);
  chart.bars->values.push_back(std::move(values));
}

std::vector<double> over_cases(const std::vector<SeriesCase>& cases, const dem::Quantity& family,
                               const std::string& member) {
  std::vector<double> values;
  for (const SeriesCase& item : cases) values.push_back(share(*item.record, family, member));
  return values;
}

render::Chart mineral_chart(const StudyResult& study, const std::vector<SeriesCase>& cases) {
  render::Chart chart = share_chart("Share of the volume (%)", cases);
  for (const std::string& name : members_of(cases, quantity::mineral_share)) {
    auto values = over_cases(cases, quantity::mineral_share, name);
    const double published = study.published_value("share_" + name);
    if (std::isfinite(published)) values.push_back(published);
    add_stack(chart, words(name), mineral_colour(study, words(name)), std::move(values));
  }
  // Table 4, in a bar of its own, where it has every mineral.
  const auto full = [&](const std::vector<double>& of) { return of.size() == cases.size() + 1; };
  if (std::ranges::all_of(chart.bars->values, full))
    chart.bars->categories.emplace_back("published");
  else
    for (std::vector<double>& of : chart.bars->values) of.resize(cases.size());
  return chart;
}

// Between grains all together, from below, where the published share can be read: the pairs are in the table; within grains
// by mineral.
render::Chart contact_chart(const StudyResult& study, const std::vector<SeriesCase>& cases) {
  render::Chart chart = share_chart("Share of contacts (%)", cases);
  std::vector<double> between(cases.size(), 0.0);
  const auto names = members_of(cases, quantity::contact_share);
  for (const std::string& name : names) {
    if (name.starts_with("intra_")) continue;
    const auto values = over_cases(cases, quantity::contact_share, name);
    for (std::size_t i = 0; i < values.size(); ++i) between[i] += values[i];
  }
  add_stack(chart, "inter-grain", render::palette(0), between);
  for (const std::string& name : names) {
    if (!name.starts_with("intra_")) continue;
    const std::string mineral = words(name.substr(6));
    add_stack(chart, "in " + mineral, mineral_colour(study, mineral), over_cases(cases, quantity::contact_share, name));
  }
  std::vector<PublishedPoint> published;
  if (swept_axis(study).id == "aspect_ratio") {
    for (std::size_t i = 0; i < cases.size(); ++i)
      published.push_back(
          {static_cast<double>(i), study.published_value(fmt::format("inter_grain_share_ar_{:g}", cases[i].value))});
  }
  add_published(chart, published, "published, inter-grain");
  return chart;
}

// "inter_quartz_alkali_feldspar" -> "between quartz and alkali feldspar", as in the tables of cracks.
std::string contact_group(const std::vector<std::string>& minerals, const std::string& id) {
  for (const std::string& a : minerals) {
    if (words(id) == "intra " + a) return "within " + a;
    for (const std::string& b : minerals) {
      if (words(id) == "inter " + a + " " + b) return "between " + a + " and " + b;
    }
  }
  return words(id);
}

TextTable contact_table(const std::vector<SeriesCase>& cases) {
  TextTable table;
  table.head = {"Contact group"};
  for (const SeriesCase& item : cases) table.head.push_back(item.label + " (%)");
  for (const std::string& name : members_of(cases, quantity::contact_share)) {
    std::vector<std::string> row{contact_group(minerals_of(*cases.front().record), name)};
    for (const SeriesCase& item : cases)
      row.push_back(fmt::format("{:.1f}", share(*item.record, quantity::contact_share, name)));
    table.rows.push_back(row);
  }
  return table;
}

// A logarithmic axis has no place for a class without a crack.
std::string classes_without_cracks(const dem::Record& record) {
  const auto numbers = crack_numbers(record, all_cracks);
  std::vector<std::string> none;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (numbers[k] == 0) none.emplace_back(crack_classes()[k].name);
  return none.empty() ? "" : " None is " + joined(none, " or ") + ".";
}

}  // namespace

FigureContent progressive_failure(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Crack initiation, where the axial stiffness begins to fluctuate, is at 71.1 MPa (34 % of the peak) and about "
      "0.1 % strain; crack damage, where the volumetric strain peaks, at 164 MPa (80 %) and 0.25 %; the peak is 206.8 "
      "MPa.";
  content.rows = {"stress_at_0_1_percent_ar_1",
                  "crack_initiation_share",
                  "crack_initiation_strain",
                  "crack_damage",
                  "crack_damage_share",
                  "crack_damage_strain",
                  "ucs_ar_1"};
  const auto cases = swept(study, test_compression);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  if (cases.empty()) return content;
  const dem::Record& base = *cases.front().record;
  std::vector<std::string> said;
  for (const Level& one : levels_of(base)) {
    said.push_back(
        fmt::format("{} {} MPa at {} % strain", in_prose(one.symbol), number(one.stress, 3), number(one.strain, 3)));
  }
  const std::string found = said.empty() ? "no characteristic stress was found" : joined(said, ", ");
  content.panels.push_back(
      {.id = "stress",
       .caption = std::string("Axial stress, volumetric and lateral strain (contraction positive), with our ") +
                  (study.of_a_paper ? "and the published levels." : "levels.") +
                  (study.laboratory.empty()
                       ? ""
                       : " Laboratory values stand at the strain of our own stage; bars are their uncertainty."),
       .alt = "Stress, volumetric and lateral strain against axial strain: " + found + ".",
       .content = stress_and_strains(study, base),
       .per_row = 1});
  content.panels.push_back({.id = "stiffness",
                            .caption = "Axial stiffness (Eq. 9).",
                            .alt = "Axial stiffness against axial strain, from " +
                                   number(base.value_or_nan(quantity::young_modulus), 3) + " GPa on.",
                            .content = stiffness_chart(study, base)});
  content.panels.push_back({.id = "cracks",
                            .caption = "Cracks so far, by class." + classes_without_cracks(base),
                            .alt = "Numbers of cracks against axial strain; " +
                                   crack_words(crack_numbers(base, all_cracks)) + " at the end of loading.",
                            .content = cracks_chart(base)});
  content.finding = "At " + cases.front().label + ": " + found + ".";
  const double at_published = base.value_or_nan(quantity::stress_at_strain);
  if (study.of_a_paper && std::isfinite(at_published))
    content.finding += fmt::format(
        " σci is read where the axial stiffness has left its plateau by {}; at the 0.1 % strain of the published σci "
        "the "
        "stress is {} MPa.",
        percent(study.scenario->real("measure.stiffness_departure"), 0), number(at_published, 3));
  const double ucs = base.value_or_nan(quantity::compressive_strength);
  const double ci = base.value_or_nan(quantity::initiation_by_stiffness);
  const double cd = base.value_or_nan(quantity::crack_damage);
  if (std::isfinite(ci) && std::isfinite(cd) && ucs > 0) {
    content.finding +=
        fmt::format(" Initiation is {} and damage {} of the peak.", percent(ci / ucs, 0), percent(cd / ucs, 0));
  }
  return content;
}

FigureContent stress_strain(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Curves agree up to crack initiation; after it the lateral strains diverge. From aspect ratio 1 to 3 the UCS "
      "falls "
      "from 206.8 to 201.3 and 198.4 MPa, the tensile strength (TS) from 9.8 to 9.4 and 9.1 MPa; UCS/TS rises "
      "slightly.";
  content.rows = {"trend_ucs",
                  "trend_tensile_strength",
                  "trend_ucs_ts_ratio",
                  "ucs_ar_1",
                  "ucs_ar_2",
                  "ucs_ar_3",
                  "tensile_strength_ar_1",
                  "tensile_strength_ar_2",
                  "tensile_strength_ar_3",
                  "elastic_alike",
                  "lateral_parts"};
  const auto compression = swept(study, test_compression);
  const auto tension = swept(study, test_tension);
  add_missing(content, study, {test_compression, test_tension});
  const std::string ucs = by_case(compression, quantity::compressive_strength, 3);
  const std::string ts = by_case(tension, quantity::tensile_strength, 3);
  if (!compression.empty()) {
    content.panels.push_back({.id = "compression",
                              .caption = "Uniaxial compression: axial stress against axial and lateral strain.",
                              .alt = "Stress-strain curves in compression; peaks of " + ucs + ".",
                              .content = compression_curves(compression)});
    content.panels.push_back({.id = "volume",
                              .caption = "Uniaxial compression: axial stress against volumetric strain.",
                              .alt = "Stress against volumetric strain in compression; peaks of " + ucs + ".",
                              .content = volume_curves(compression)});
  }
  if (!tension.empty()) {
    content.panels.push_back({.id = "tension",
                              .caption = "Direct tension.",
                              .alt = "Stress-strain curves in direct tension; peaks of " + ts + ".",
                              .content = tension_curves(tension)});
  }
  const auto found = strengths(compression, tension);
  add_strengths(content, study, found);
  content.finding = strengths_found(compression, tension, found, swept_axis(study));
  return content;
}

FigureContent dip_strengths(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "From dip 0° to 90° of the long axes the tensile strength (TS) rises dramatically and the UCS rises, weakest at "
      "0°; UCS/TS falls from 21 to 17.";
  content.rows = {"trend_ucs_with_dip", "ucs_dip_0_weakest",   "trend_tensile_strength_with_dip",
                  "ucs_ts_ratio_dip_0", "ucs_ts_ratio_dip_90", "trend_ucs_ts_ratio_with_dip"};
  const auto compression = swept(study, test_compression);
  const auto tension = swept(study, test_tension);
  add_missing(content, study, {test_compression, test_tension});
  const auto found = strengths(compression, tension);
  add_strengths(content, study, found);
  content.finding = strengths_found(compression, tension, found, swept_axis(study));
  return content;
}

FigureContent dip_group_shares(const StudyResult& study) {
  FigureContent content = group_shares(study);
  content.statement = "The dip changes neither the shares of the minerals nor those of the contact groups.";
  content.rows = {"minerals_steady_with_dip", "groups_steady_with_dip", "inter_grain_share_change_with_dip"};
  return content;
}

FigureContent group_shares(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "The aspect ratio has little influence on the shares of the minerals. The share of inter-grain contacts rises "
      "from 55 % at aspect ratio 1 to 60 % at 3, because an ellipsoid of the same volume has more surface (Eq. 14).";
  content.rows = {"minerals_steady_with_ar", "inter_grain_share_ar_1", "inter_grain_share_ar_3",
                  "trend_inter_grain_share"};
  const auto cases = swept(study, test_compression);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  if (cases.empty()) return content;
  const std::string inter = by_case(cases, quantity::inter_grain_share, 3);
  if (!members_of(cases, quantity::mineral_share).empty()) {
    content.panels.push_back({.id = "minerals",
                              .caption = "Volume of the minerals.",
                              .alt = "Stacked bars of the mineral shares, nearly the same in every case.",
                              .content = mineral_chart(study, cases)});
  }
  if (!members_of(cases, quantity::contact_share).empty()) {
    content.panels.push_back({.id = "contacts",
                              .caption = "Inter-grain contacts, and those inside grains by mineral.",
                              .alt = "Stacked bars of the contact groups; inter-grain " + inter + ".",
                              .content = contact_chart(study, cases)});
    content.panels.push_back(
        {.id = "groups", .caption = "Every contact group.", .alt = "", .content = contact_table(cases)});
  }
  content.finding = "Inter-grain contacts are " + inter + " of all.";
  const std::string trend = trend_words(cases, quantity::inter_grain_share, swept_axis(study));
  if (!trend.empty()) content.finding += " Their share " + trend + ".";
  const auto most = [&](const dem::Quantity& family, const auto& name_of) -> std::string {
    double largest = -1;
    std::string name;
    for (const std::string& member : members_of(cases, family)) {
      const auto shares = over_cases(cases, family, member);
      const auto [low, high] = std::ranges::minmax(shares);
      if (high - low > largest) largest = high - low, name = name_of(member);
    }
    return largest < 0 ? "" : name + ", by " + number(largest, 2) + " points";
  };
  const std::string mineral = most(quantity::mineral_share, [](const std::string&m) { return words(m); }),
                    group = most(quantity::contact_share, [&](const std::string&m) {
                      return "that " + contact_group(minerals_of(*cases.front().record), m);
                    });
  if (cases.size() > 1 && !mineral.empty() && !group.empty())
    content.finding += " Between the cases the mineral whose share differs most is " + mineral +
                       "; the contact group is " + group + ".";
  return content;
}

}  // namespace reports::texture
