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

constexpr std::string_view base_case = "base case";

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
    if (label.empty()) label = base_case;
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
  std::string_view said = {};  ///< in the finding
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

double mean_of(const Reading& reading, const dem::Quantity& of) {
  return analysis::spread(values(reading.compression, of)).mean;
}

// The first reading and those whose UCS or σcd is the least or the largest: more curves over each other cannot be told apart.
std::vector<Reading> outermost(const std::vector<Reading>& readings) {
  std::vector<bool> kept(readings.size(), false);
  kept[0] = true;
  for (const dem::Quantity& of : {quantity::compressive_strength, quantity::crack_damage}) {
    std::optional<std::size_t> least, most;
    for (std::size_t k = 0; k < readings.size(); ++k) {
      const double value = mean_of(readings[k], of);
      if (!std::isfinite(value)) continue;
      if (!least || value < mean_of(readings[*least], of)) least = k;
      if (!most || value > mean_of(readings[*most], of)) most = k;
    }
    if (least) kept[*least] = kept[*most] = true;
  }
  std::vector<Reading> found;
  for (std::size_t k = 0; k < readings.size(); ++k)
    if (kept[k]) found.push_back(readings[k]);
  return found;
}

// "148 to 186 MPa": the least and the largest of all readings.
std::string range_text(const std::vector<Reading>& readings, const Compared& of) {
  std::vector<double> all;
  for (const Reading& reading : readings) {
    const double mean = analysis::spread(values(of.tension ? reading.tension : reading.compression, *of.of)).mean;
    if (std::isfinite(mean)) all.push_back(mean);
  }
  if (all.empty()) return {};
  const auto [low, high] = std::ranges::minmax(all);
  const std::string_view unit = of.of->shown_unit();
  return fixed(low, of.places) + " to " + fixed(high, of.places) + (unit.empty() ? "" : " " + std::string(unit));
}

render::Chart curves(const StudyResult& study, const std::vector<Reading>& readings) {
  render::Chart chart;
  chart.x.title = "Axial strain (%)";
  chart.left.title = "Axial stress (MPa)";
  for (std::size_t k = 0; k < readings.size(); ++k) {
    if (readings[k].compression.empty()) continue;
    render::Series series =
        curve(readings[k].compression.front()->table("history"), {"axial_strain", "axial_stress", 100, 1e-6});
    series.label = readings[k].label;
    series.colour = render::palette(k);
    series.line = render::line_style(k);
    chart.series.push_back(std::move(series));
  }
  leave_room(chart);
  add_published(
      chart,
      {{study.published_value("crack_initiation_strain"), study.published_value("stress_at_0_1_percent_ar_1")},
       {study.published_value("crack_damage_strain"), study.published_value("crack_damage")}},
      "published σ_{ci} and σ_{cd}");
  add_published(chart, render::Mark::Kind::horizontal, study.published_value("ucs_ar_1"), "published peak");
  chart.legend = render::Chart::Legend::below;
  chart.width = 640;
  chart.height = 420;
  return chart;
}

// A strength depends on the rate as well: the other scenarios have theirs.
std::string rate_note(const StudyResult& study) {
  const auto rate = [&](const char* key) { return number(study.scenario->real(key), 3); };
  return "Loaded at " + rate("compression.rate") + " of strain a step in compression and " +
         rate("direct_tension.rate") + " in tension.";
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
      {"UCS (MPa)", &quantity::compressive_strength, false, "ucs_ar_1", 0, "UCS"},
      {"TS (MPa)", &quantity::tensile_strength, true, "tensile_strength_ar_1", 1, "TS"},
      {"σcd (MPa)", &quantity::crack_damage, false, "crack_damage", 0, "σcd"},
      {"strain at σcd (%)", &quantity::crack_damage_strain, false, "crack_damage_strain", 3},
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
       .caption = "Readings of what the text leaves open: the diameters of the grains (× 1: those of Table 4), which "
                  "grain takes a particle that touches several, whether the coefficients act between different grains "
                  "or only between different minerals, and the packing pressure. Each row names what differs from the "
                  "base case, that of the other scenarios; mean and standard deviation where there are several random "
                  "seeds. UCS/TS in the first row is the quotient of the published strengths. " +
                  rate_note(study),
       .alt = "",
       .content = table,
       .per_row = 1});
  content.panels.push_back(
      {.id = "stress_strain",
       .caption = "Stress and strain in uniaxial compression: the base case and the readings with the least and the "
                  "largest UCS and σcd, first seed.",
       .alt = "Stress-strain curves of each reading; their peaks are in the table.",
       .content = curves(study, outermost(found)),
       .per_row = 1});
  std::vector<std::string> said;
  for (const Compared& one : compared) {
    const std::string range = range_text(found, one);
    if (found.size() < 2 || range.empty() || one.said.empty()) continue;
    const std::string stated = published(one.published);
    said.push_back(std::string(one.said) + " " + range + (stated == "–" ? "" : " (published: " + stated + ")"));
  }
  if (!said.empty()) content.finding = fmt::format("Across the {} readings: {}.", found.size(), joined(said, "; "));
  content.headline = content.finding;
  return content;
}

}  // namespace reports::texture
