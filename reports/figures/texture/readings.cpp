// The open readings of the paper beside each other: what each does to the round-grained granite (Zhao et al. 2021, sections
// 2.3, 2.4 and 3.3).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

/// The records of one reading, in both tests, over its seeds.
struct Reading {
  std::string label;
  std::vector<const dem::Record*> compression, tension;
};

std::vector<Reading> readings_of(const StudyResult& study) {
  std::vector<Reading> readings;
  for (const CaseResult& one : study.cases) {
    if (!one.record) continue;
    std::string label = reading_of(*one.record, study);
    if (label.empty()) label = "as the scenarios have it";
    auto found = std::ranges::find(readings, label, &Reading::label);
    if (found == readings.end()) found = readings.insert(readings.end(), {label, {}, {}});
    (one.test() == test_tension ? found->tension : found->compression).push_back(one.record);
  }
  return readings;
}

/// What the table compares: a quantity of one of the two tests, and its published number.
struct Compared {
  std::string head;
  const dem::Quantity* of = nullptr;
  bool tension = false;
  std::string_view published;
  int places = 1;
};

std::vector<double> values(const std::vector<const dem::Record*>& records, const dem::Quantity& of) {
  std::vector<double> found;
  for (const dem::Record* record : records) {
    if (const double value = of.factor * record->value_or_nan(of); std::isfinite(value)) found.push_back(value);
  }
  return found;
}

std::string cell(const std::vector<double>& of, int places) {
  if (of.empty()) return "–";
  const Spread spread = analysis::spread(of);
  return fixed(spread.mean, places) + (spread.count > 1 ? " ± " + fixed(spread.deviation, places) : "");
}

// UCS over TS, seed by seed: each has its own packing.
std::vector<double> ratios(const Reading& reading) {
  std::vector<double> found;
  for (const dem::Record* pressed : reading.compression) {
    for (const dem::Record* pulled : reading.tension) {
      if (pressed->number("seed") != pulled->number("seed")) continue;
      const double ratio =
          pressed->value_or_nan(quantity::compressive_strength) / pulled->value_or_nan(quantity::tensile_strength);
      if (std::isfinite(ratio)) found.push_back(ratio);
    }
  }
  return found;
}

constexpr std::size_t most_curves = 4;  // that can be told apart where they lie over each other

render::Chart curves(const StudyResult& study, const std::vector<Reading>& readings) {
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.left.title = "Axial stress (MPa)";
  for (std::size_t k = 0; k < std::min(most_curves, readings.size()); ++k) {
    if (readings[k].compression.empty()) continue;
    render::Series series =
        curve(readings[k].compression.front()->table("history"), {"axial_strain", "axial_stress", 100, 1e-6});
    series.label = readings[k].label;
    series.colour = render::palette(k);
    series.line = render::line_style(k);
    chart.series.push_back(std::move(series));
  }
  leave_room(chart);
  add_published(chart, {{study.published_value("crack_damage_strain"), study.published_value("crack_damage")}},
                "published σ_{cd}");
  add_published(chart, render::Mark::Kind::horizontal, study.published_value("ucs_ar_1"), "published peak");
  chart.legend = render::Chart::Legend::below;
  chart.width = 640;
  chart.height = 420;
  return chart;
}

}  // namespace

FigureContent open_readings(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "At aspect ratio 1: E 69.8 GPa, ν 0.18, UCS 206.8 MPa, tensile strength (TS) 9.8 MPa, crack damage at 164 MPa "
      "and "
      "0.25 % strain, 71.1 MPa at 0.1 % strain.";
  content.rows = {"young_modulus",
                  "poisson_ratio",
                  "ucs_ar_1",
                  "tensile_strength_ar_1",
                  "crack_damage",
                  "crack_damage_strain",
                  "stress_at_0_1_percent_ar_1"};
  add_missing(content, study, {test_compression, test_tension});
  const std::vector<Reading> found = readings_of(study);
  if (found.empty()) return content;
  const std::vector<Compared> compared = {
      {"E (GPa)", &quantity::young_modulus, false, "young_modulus", 1},
      {"ν", &quantity::poisson_ratio, false, "poisson_ratio", 3},
      {"UCS (MPa)", &quantity::compressive_strength, false, "ucs_ar_1", 0},
      {"TS (MPa)", &quantity::tensile_strength, true, "tensile_strength_ar_1", 1},
      {"σcd (MPa)", &quantity::crack_damage, false, "crack_damage", 0},
      {"strain there (%)", &quantity::crack_damage_strain, false, "crack_damage_strain", 3},
      {"stress at 0.1 % strain (MPa)", &quantity::stress_at_strain, false, "stress_at_0_1_percent_ar_1", 1},
      {"inter-grain contacts (%)", &quantity::inter_grain_share, false, "inter_grain_share_ar_1", 1}};
  TextTable table{{"Reading", "Seeds", "Grains"}, {}};
  for (const Compared& one : compared) {
    table.head.push_back(one.head);
    if (one.tension) table.head.emplace_back("UCS/TS");
  }
  const auto add_row = [&](std::vector<std::string> first, const auto& value, const std::string& ratio) {
    for (const Compared& one : compared) {
      first.push_back(value(one));
      if (one.tension) first.push_back(ratio);
    }
    table.rows.push_back(std::move(first));
  };
  const auto published = [&](std::string_view id) {
    const double value = study.published_value(id);
    return std::isfinite(value) ? shortest(value) : "–";
  };
  const double quotient = study.published_value("ucs_ar_1") / study.published_value("tensile_strength_ar_1");
  add_row(
      {"published", "", "≥ 3770"}, [&](const Compared& one) { return published(one.published); },
      std::isfinite(quotient) ? fixed(quotient, 1) : "–");
  for (const Reading& reading : found) {
    const auto grains = values(reading.compression, quantity::grains);
    add_row(
        {reading.label, std::to_string(std::max(reading.compression.size(), reading.tension.size())), cell(grains, 0)},
        [&](const Compared& one) {
          return cell(values(one.tension ? reading.tension : reading.compression, *one.of), one.places);
        },
        cell(ratios(reading), 1));
  }
  content.panels.push_back(
      {.id = "table",
       .caption = "What the text leaves open: the size of the grain seeds, whose grain a particle takes in growth, and "
                  "whether grains of one mineral meet with its own values. A row names what differs from the "
                  "scenarios; with several seeds, mean and standard deviation. UCS/TS in the first row is the quotient "
                  "of the published strengths.",
       .alt = "",
       .content = table,
       .per_row = 1});
  content.panels.push_back(
      {.id = "stress_strain",
       .caption = "Stress and strain in uniaxial compression: the first four readings of ours, their first seed.",
       .alt = "Stress-strain curves of each reading; their peaks are in the table.",
       .content = curves(study, found),
       .per_row = 1});
  std::vector<double> least_and_most;
  for (const Reading& reading : found) {
    for (const double value : values(reading.compression, quantity::compressive_strength))
      least_and_most.push_back(value);
  }
  if (!least_and_most.empty()) {
    const auto [low, high] = std::ranges::minmax(least_and_most);
    content.finding = fmt::format("Over all readings UCS lies between {} and {} MPa; published is {} MPa.",
                                  fixed(low, 0), fixed(high, 0), published("ucs_ar_1"));
  }
  return content;
}

}  // namespace reports::texture
