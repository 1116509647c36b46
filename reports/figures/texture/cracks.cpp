// Crack maps and counts against the swept parameter (Zhao et al. 2021, Figs. 12, 15, 17) and stages of cracking (Fig. 9).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "engine/analysis/cracking.h"
#include "engine/analysis/orientation.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/failed.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

enum class When { peak, end };

ValueOf number_of(const CrackClass& one, When when = When::end) {
  if (when == When::end) return shown(one.number);
  return [id = "cracks_at_peak." + std::string(one.id)](const dem::Record& record) {
    const double* number = record.find_result(id);
    return number ? *number : std::nan("");
  };
}

ValueOf all_at(When when) {
  return [when](const dem::Record& record) {
    double total = 0;
    for (const CrackClass& one : crack_classes()) total += number_of(one, when)(record);
    return total;
  };
}

ValueOf share_of(const CrackClass& one, When when = When::end) {
  return [&one, when](const dem::Record& record) {
    const double total = all_at(when)(record);
    return total > 0 ? 100 * number_of(one, when)(record) / total : std::nan("");
  };
}

// Bars grouped by class: a bar a case.
render::Chart bars_by_class(const std::vector<SeriesCase>& cases, When when) {
  render::Bars bars;
  bool repeated = false;
  for (const CrackClass& one : crack_classes()) bars.categories.emplace_back(one.name);
  bars.categories.emplace_back("all");
  for (const SeriesCase& item : cases) {
    bars.labels.push_back(item.label);
    bars.colours.push_back(render::ordered(bars.colours.size(), cases.size()));
    std::vector<double> values, errors;
    for (std::size_t k = 0; k <= crack_classes().size(); ++k) {
      const Spread spread =
          analysis::spread(item, k < crack_classes().size() ? number_of(crack_classes()[k], when) : all_at(when));
      values.push_back(spread.mean);
      errors.push_back(spread.deviation);
      repeated = repeated || spread.count > 1;
    }
    bars.values.push_back(values);
    bars.errors.push_back(errors);
  }
  if (!repeated) bars.errors.clear();
  bars.print_values = !repeated;
  render::Chart chart;
  chart.x.title = "Class of crack";
  chart.left.title = "Number of cracks";
  chart.bars = bars;
  chart.legend = render::Chart::Legend::top_left;
  return chart;
}

// Lines along the swept parameter: a line a class, and one for all cracks.
render::Chart lines_by_class(const std::vector<SeriesCase>& cases, const dem::Parameter& axis, bool shares, When when) {
  render::Chart chart;
  chart.x.title = axis_title(axis);
  chart.left.title = shares ? "Share of cracks (%)" : "Number of cracks";
  chart.left.low = 0;
  for (std::size_t k = 0; k < crack_classes().size(); ++k) {
    const CrackClass& one = crack_classes()[k];
    render::Series series = means(cases, shares ? share_of(one, when) : number_of(one, when));
    series.label = one.name;
    series.colour = one.colour;
    series.line = render::line_style(k);
    series.marker = render::marker_style(k);
    if (!series.x.empty()) chart.series.push_back(series);
  }
  if (!shares) {
    render::Series total = means(cases, all_at(when));
    total.label = "all";
    total.colour = {0.45, 0.45, 0.45};
    total.marker = render::Marker::cross;
    if (!total.x.empty()) chart.series.push_back(total);
  }
  chart.legend = render::Chart::Legend::below;
  return chart;
}

std::string with_its(const std::vector<SeriesCase>& cases) {
  return std::ranges::any_of(cases, [](const SeriesCase& c) { return c.repeats.size() > 1; })
             ? " Means of seeds; whiskers are one standard deviation."
             : "";
}

std::string crack_alt(const dem::Record& record, std::size_t count, const std::string& what) {
  return what + " " + crack_words(crack_numbers(record, count)) + ".";
}

// The measure of a mode of failure: splitting along the axis has small angles.
double mean_angle(const dem::Record& record) { return analysis::orientation_of(record.table("cracks"), 0).mean; }

struct Stage {
  std::string_view moment, name, said;
};
constexpr std::array stages{Stage{"crack_initiation", "Crack initiation", "initiation"},
                            Stage{"stable_growth", "Stable crack growth", "stable growth"},
                            Stage{"damage", "Crack damage", "damage"},
                            Stage{"unstable_growth", "Unstable crack growth", "unstable growth"},
                            Stage{"post_peak", "After the peak", "after the peak"},
                            Stage{"end", "End of loading", "end"}};

const dem::Table* snapshot(const dem::Record& record, std::string_view moment) {
  for (const dem::Table& table : record.tables) {
    if (table.name.starts_with("snapshots/") && table.attribute("moment") == moment) return &table;
  }
  return nullptr;
}

std::size_t cracks_so_far(const dem::Table& moment) {
  const std::string text = moment.attribute("cracks");
  return text.empty() ? 0 : static_cast<std::size_t>(std::stoull(text));
}

std::string at_strain(const dem::Table& moment) {
  const std::string strain = moment.attribute("strain");
  const std::string stress = moment.attribute("stress");
  if (strain.empty() || stress.empty()) return {};
  return fmt::format(", {} % strain, {} MPa", number(100 * std::stod(strain), 3), number(1e-6 * std::stod(stress), 3));
}

// Which pairs of minerals share most of the inter-grain tension cracks among the first `count`.
std::string weakest_boundary(const dem::Record& record, std::size_t count, const std::string& until) {
  const dem::Table& cracks = record.table("cracks");
  const auto a = cracks.integer("mineral_a");
  const auto b = cracks.integer("mineral_b");
  const auto place = cracks.integer("place");
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> pairs;
  std::size_t all = 0;
  for (std::size_t i = 0; i < std::min(count, cracks.rows()); ++i) {
    if (place[i] != 1) continue;
    ++pairs[std::minmax(a[i], b[i])];
    ++all;
  }
  if (all == 0) return {};
  const auto most = std::ranges::max_element(pairs, {}, [](const auto& item) { return item.second; });
  const auto names = minerals_of(record);
  const std::string& one = names.at(static_cast<std::size_t>(most->first.first));
  const std::string& other = names.at(static_cast<std::size_t>(most->first.second));
  std::string words = fmt::format("{} of the inter-grain cracks lie between {} and {}",
                                  percent(static_cast<double>(most->second) / static_cast<double>(all), 0), one, other);
  // A pair of minerals with many contacts has many cracks without being weak.
  const auto exposure = [&](const std::vector<std::string>& pair) {
    return dem::analysis::cracks_of(record, {.place = 1, .pair = pair, .until = until},
                                    dem::analysis::CrackMeasure::exposure);
  };
  if (!record.find("contacts")) return words;
  const double of_pair = exposure({one, other}), of_all = exposure({});
  if (of_pair > 0 && of_all > 0)
    words += fmt::format(", where {} of the contacts have a crack, {} times the share among all inter-grain contacts",
                         percent(of_pair, 1), number(of_pair / of_all, 2));
  return words;
}

// Cracks so far at each stage by the minerals at their ends, "tension / shear".
TextTable cracks_by_minerals(const dem::Record& record) {
  const dem::Table& cracks = record.table("cracks");
  const auto a = cracks.integer("mineral_a"), b = cracks.integer("mineral_b");
  const auto place = cracks.integer("place"), mode = cracks.integer("mode");
  const auto names = minerals_of(record);
  using Ends = std::array<std::int32_t, 3>;  // place, minerals in order
  std::map<Ends, std::vector<std::array<std::size_t, 2>>> numbers;
  TextTable table{{"Cracks so far, tension / shear"}, {}};
  std::vector<std::size_t> until;
  for (const Stage& stage : stages) {
    const dem::Table* moment = snapshot(record, stage.moment);
    if (!moment) continue;
    table.head.emplace_back(stage.name);
    until.push_back(std::min(cracks_so_far(*moment), cracks.rows()));
  }
  for (std::size_t k = 0; k < until.size(); ++k) {
    for (std::size_t i = 0; i < until[k]; ++i) {
      auto& counts = numbers[{place[i], std::min(a[i], b[i]), std::max(a[i], b[i])}];
      counts.resize(until.size());
      ++counts[k][mode[i] != 0];
    }
  }
  for (const auto& [ends, counts] : numbers) {
    const auto name = [&](std::size_t i) { return names.at(static_cast<std::size_t>(ends[i])); };
    std::vector<std::string> row{ends[0] == 0 ? "within " + name(1) : "between " + name(1) + " and " + name(2)};
    for (const auto& [tension, shear] : counts) {
      row.push_back(count(static_cast<double>(tension)) + " / " + count(static_cast<double>(shear)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

constexpr const char* density_caption =
    "Crack density, as area per volume (mm²/mm³), on the longitudinal section, smoothed over one grain diameter; one "
    "scale for all panels of this figure.";

std::string density_alt(const std::string& what, const CrackDensity& density) {
  double mean = 0;
  for (const double v : density.value) mean += v / static_cast<double>(density.value.size());
  return fmt::format("{}: crack area per volume on the section, {} mm² per mm³ in the mean, {} at most.", what,
                     number(mean, 2), number(density.largest(), 2));
}

std::string discs_note(double scale) {
  return (scale < 1 ? fmt::format(", drawn at {:.1g} of their diameter", scale) : std::string()) + ".";
}

// The state that a picture shows: a snapshot of the record, or the end of loading.
struct Moment {
  std::string_view snapshot, id, words, label;
};
constexpr Moment at_end{"end", "", "at the end of loading", ""};
constexpr Moment at_peak{"peak", "peak_", "at the peak", ", at the peak"};
constexpr Moment after_peak{"post_peak", "", "where the stress has fallen to 90 % of the peak", ", after it"};

// Of a picture: two moments may share a row.
std::string label_at(const SeriesCase& item, const Moment& moment) { return item.label + std::string(moment.label); }

std::size_t cracks_until(const dem::Record& record, const Moment& moment) {
  const dem::Table* table = snapshot(record, moment.snapshot);
  return moment.snapshot == at_end.snapshot || !table ? all_cracks : cracks_so_far(*table);
}

// Cases whose stress did not fall that far show the end of loading.
std::string moment_words(const std::vector<SeriesCase>& cases, const Moment& moment) {
  std::vector<std::string> without;
  for (const SeriesCase& item : cases)
    if (!snapshot(*item.record, moment.snapshot)) without.push_back(item.label);
  return std::string(moment.words) + (without.empty() || moment.snapshot == at_end.snapshot
                                          ? ""
                                          : " (at " + listed(without) + " at the end of loading)");
}

// Discs of one scale, so that pictures can be compared.
void add_clouds(FigureContent& content, const std::vector<SeriesCase>& cases, const Moment& moment = at_end) {
  double scale = 1;
  for (const SeriesCase& item : cases) scale = std::min(scale, legible_disc_scale(*item.record));
  for (const SeriesCase& item : cases) {
    content.panels.push_back({.id = std::string(moment.id) + "discs_" + item.id,
                              .caption = "All cracks " + moment_words(cases, moment) +
                                         " as discs in the transparent specimen" + discs_note(scale),
                              .alt = crack_alt(*item.record, cracks_until(*item.record, moment),
                                               capital(item.label) + ", " + std::string(moment.words) + ":"),
                              .content = transparent_cracks(*item.record, cracks_until(*item.record, moment),
                                                            label_at(item, moment), 480, scale),
                              .per_row = pictures_per_row(cases)});
  }
}

// With one scale of colours. Returns the largest density of each case, 1/mm.
std::vector<double> add_densities(FigureContent& content, const std::vector<SeriesCase>& cases,
                                  const Moment& moment = at_end) {
  std::vector<CrackDensity> densities;
  std::vector<double> largest;
  for (const SeriesCase& item : cases) {
    densities.push_back(crack_density(*item.record, cracks_until(*item.record, moment)));
    largest.push_back(densities.back().largest());
  }
  const double densest = largest.empty() ? 0 : end_of_bar(std::ranges::max(largest));
  for (std::size_t i = 0; i < cases.size() && densest > 0; ++i) {
    content.panels.push_back(
        {.id = "density_" + cases[i].id,
         .caption = density_caption + (" Cracks " + moment_words(cases, moment) + "."),
         .alt = density_alt(cases[i].label, densities[i]),
         .content = density_picture(*cases[i].record, densities[i], densest, label_at(cases[i], moment), 480),
         .per_row = pictures_per_row(cases)});
  }
  return largest;
}

}  // namespace

FigureContent crack_maps(const StudyResult& study) {
  FigureContent content;
  content.statement = "The failure modes at aspect ratios 1, 2 and 3 are similar.";
  content.rows = {"failure_mode_with_ar"};
  const auto cases = swept(study, test_compression);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  add_clouds(content, cases, at_peak);
  add_clouds(content, cases, after_peak);
  const int per_row = cases.size() <= 3 ? 3 : 4;
  for (const SeriesCase& item : cases) {
    content.panels.push_back(
        {.id = "section_" + item.id,
         .caption = "Cracks " + moment_words(cases, after_peak) +
                    ", within half a mean particle diameter of the longitudinal section, over the minerals.",
         .alt = "Section at " + item.label + " with the traces of the cracks near it over the minerals.",
         .content = section_cracks(study, *item.record, cracks_until(*item.record, after_peak),
                                   label_at(item, after_peak), 480),
         .per_row = per_row});
  }
  (void)add_densities(content, cases, after_peak);
  for (const Moment& moment : {at_peak, after_peak, at_end}) {
    std::vector<std::string> totals;
    for (const SeriesCase& item : cases) {
      std::size_t total = 0;
      for (const std::size_t n : crack_numbers(*item.record, cracks_until(*item.record, moment))) total += n;
      totals.push_back(count(static_cast<double>(total)) + " at " + item.label);
    }
    if (totals.empty()) continue;
    content.finding +=
        (content.finding.empty() ? "" : " ") + ("Cracks " + moment_words(cases, moment)) + ": " + listed(totals) + ".";
  }
  if (!cases.empty())
    content.finding +=
        " The mean angle of those at the end of loading to the axis is " + by_case(cases, mean_angle, 3, "°") + ".";
  return content;
}

FigureContent crack_concentration(const StudyResult& study) {
  FigureContent content;
  add_missing_failed(content, study);
  std::vector<SeriesCase> cases = failed(study);
  std::erase_if(cases, [](const SeriesCase& item) { return item.record->table("cracks").rows() == 0; });
  add_clouds(content, cases);
  const std::vector<double> largest = add_densities(content, cases);
  std::vector<std::string> said;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const dem::Record& record = *cases[i].record;
    const auto area = record.table("cracks").real("area"), radius = record.table("particles").real("radius");
    double sum = 0, solid = 0;
    for (const double one : area) sum += 1e6 * one;
    for (const double r : radius) solid += 1e9 * 4.0 / 3 * std::numbers::pi * r * r * r;
    const double mean = sum * (1 - record.value_or_nan(quantity::porosity)) / solid;
    if (!(mean > 0) || !(largest[i] > 0)) continue;
    said.push_back(fmt::format("{}: {} mm²/mm³ at the densest place of the section, {} times the mean of the specimen",
                               cases[i].label, number(largest[i], 2), number(largest[i] / mean, 2)));
  }
  if (!said.empty()) content.finding = capital(joined(said, "; ")) + ".";
  return content;
}

FigureContent crack_counts(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "The number of cracks rises with the aspect ratio in all classes, above all that of tension cracks. Intra-grain "
      "shear cracks change only slightly, inter-grain shear cracks more.";
  content.rows = {"trend_cracks_inter_tension", "trend_cracks_inter_shear", "trend_cracks_intra_tension",
                  "trend_cracks_intra_shear",   "tension_cracks_rise_most", "intra_shear_steady",
                  "inter_shear_sensitive"};
  const auto cases = swept(study, test_compression);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  if (cases.empty()) return content;
  const dem::Parameter& axis = swept_axis(study);
  std::vector<std::string> labels;
  for (const SeriesCase& item : cases) labels.push_back(item.label);
  for (const auto& [when, id, words] :
       {std::tuple{When::peak, "peak_", "at the peak"}, {When::end, "", "at the end of loading"}}) {
    std::vector<std::string> parts, shares;
    for (const CrackClass& one : crack_classes()) {
      parts.push_back(std::string(one.name) + " " + by_case(cases, number_of(one, when), 0, ""));
      shares.push_back(std::string(one.name) + " " + by_case(cases, share_of(one, when), 3, "%"));
    }
    parts.push_back("total " + by_case(cases, all_at(when), 0, ""));
    const std::string found = "Cracks " + std::string(words) + ", " + listed(labels) + ": " + joined(parts, "; ") + ".";
    const std::string name = id;
    if (axis.id == "aspect_ratio") {
      content.panels.push_back(
          {.id = name + "numbers",
           .caption = "Cracks " + std::string(words) + ", by class and aspect ratio." + with_its(cases),
           .alt = found,
           .content = bars_by_class(cases, when),
           .per_row = 1});
    } else {
      content.panels.push_back({.id = name + "numbers",
                                .caption = "Cracks " + std::string(words) + ", by class." + with_its(cases),
                                .alt = found,
                                .content = lines_by_class(cases, axis, false, when),
                                .per_row = 2});
      content.panels.push_back({.id = name + "shares",
                                .caption = "Their shares of all cracks " + std::string(words) + "." + with_its(cases),
                                .alt = joined(shares, "; ") + ".",
                                .content = lines_by_class(cases, axis, true, when),
                                .per_row = 2});
    }
    content.finding += (content.finding.empty() ? "" : " ") + found;
  }
  if (cases.size() > 2 || !with_its(cases).empty()) {
    std::vector<Trend> trends;
    for (const CrackClass& one : crack_classes())
      trends.push_back({std::string(one.name), trend_of(cases, number_of(one))});
    add_trends(content, trends, axis);
  }
  return content;
}

FigureContent dip_crack_maps(const StudyResult& study) {
  FigureContent content = crack_maps(study);
  content.statement = "The dip of the long axes has little influence on the failure mode.";
  content.rows = {"failure_mode_with_dip"};
  return content;
}

FigureContent dip_crack_counts(const StudyResult& study) {
  FigureContent content = crack_counts(study);
  content.statement =
      "From dip 0° to 90° intra-grain cracks tend to become fewer, while inter-grain tension cracks keep rising.";
  content.rows = {"trend_intra_with_dip", "trend_inter_tension_with_dip"};
  return content;
}

FigureContent confinement_crack_maps(const StudyResult& study) {
  FigureContent content = crack_maps(study);
  content.statement =
      "With confining pressure the number of cracks rises, above all that of intra-grain shear cracks; the failure "
      "mode turns from axial splitting to predominantly shear.";
  content.rows = {"trend_cracks_with_pressure", "trend_intra_shear_with_pressure", "intra_shear_rises_most",
                  "trend_crack_angle_with_pressure"};
  return content;
}

FigureContent confinement_crack_counts(const StudyResult& study) {
  FigureContent content = crack_counts(study);
  content.statement =
      "The number of tension cracks stays about constant over the confining pressures; number and share of shear "
      "cracks rise.";
  content.rows = {"tension_cracks_with_pressure", "trend_shear_with_pressure", "trend_shear_share_with_pressure"};
  return content;
}

FigureContent crack_stages(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "At first tension cracks lie mainly on the boundaries of alkali feldspar. They grow within grains and at "
      "boundaries until crack damage; then intra-grain shear cracks increase and cross whole grains. Inter-grain shear "
      "cracks begin to propagate after the peak.";
  content.rows = {"stage_boundaries_first", "stage_boundaries_alkali",
                  "stage_growth_to_damage", "stage_alkali_quartz",
                  "stage_intra_alkali",     "stage_shear_grows",
                  "stage_shear_feldspars",  "stage_shear_fewer_quartz",
                  "stage_inter_shear_late", "stage_inter_shear_quartz_biotite",
                  "stage_shear_at_end"};
  const auto cases = swept(study, test_compression);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  if (cases.empty()) return content;
  const SeriesCase& base = cases.front();
  const double scale = legible_disc_scale(*base.record);
  std::vector<Panel> discs, sections;
  std::vector<std::pair<Stage, CrackDensity>> densities;
  double densest = 0;
  std::vector<std::string> said;
  for (const Stage& stage : stages) {
    const dem::Table* moment = snapshot(*base.record, stage.moment);
    if (!moment) continue;
    const std::size_t so_far = cracks_so_far(*moment);
    said.push_back(count(static_cast<double>(so_far)) + " (" + std::string(stage.said) + ")");
    discs.push_back(
        {.id = std::string(stage.moment) + "_discs",
         .caption = "All cracks so far as discs in the transparent specimen" + discs_note(scale) +
                    " Stable growth is shown at the stress midway between σci and σcd, unstable growth midway between "
                    "σcd and the peak, after the peak at 90 % of it.",
         .alt = crack_alt(*base.record, so_far, std::string(stage.name) + ":"),
         .content = transparent_cracks(*base.record, so_far, std::string(stage.name) + at_strain(*moment), 340, scale),
         .per_row = 3});
    sections.push_back(
        {.id = std::string(stage.moment) + "_section",
         .caption = "Cracks within half a mean particle diameter of the longitudinal section, over the minerals.",
         .alt = std::string(stage.name) + ": traces of the cracks near the section, over the minerals.",
         .content = section_cracks(study, *base.record, so_far, std::string(stage.name), 340),
         .per_row = 3});
    densities.emplace_back(stage, crack_density(*base.record, so_far));
    densest = std::max(densest, densities.back().second.largest());
  }
  if (discs.empty()) {
    content.panels.push_back(
        note_panel("none", "Stages of cracking.", "The record of " + base.record->case_id + " keeps no snapshots."));
    return content;
  }
  densest = end_of_bar(densest);
  content.panels.insert(content.panels.end(), discs.begin(), discs.end());
  content.panels.insert(content.panels.end(), sections.begin(), sections.end());
  for (const auto& [stage, density] : densities) {
    if (!(densest > 0)) break;
    content.panels.push_back({.id = std::string(stage.moment) + "_density",
                              .caption = density_caption,
                              .alt = density_alt(std::string(stage.name), density),
                              .content = density_picture(*base.record, density, densest, std::string(stage.name), 340),
                              .per_row = 3});
  }
  content.panels.push_back({.id = "by_minerals",
                            .caption = "Number of cracks in each stage by the minerals of the two particles.",
                            .alt = "",
                            .content = cracks_by_minerals(*base.record),
                            .per_row = 1});
  content.finding = "At " + base.label + ", cracks so far: " + listed(said) + ".";
  if (const dem::Table* growth = snapshot(*base.record, "stable_growth")) {
    const std::string boundary = weakest_boundary(*base.record, cracks_so_far(*growth), "stable_growth");
    content.finding += " In stable growth: " + crack_words(crack_numbers(*base.record, cracks_so_far(*growth))) +
                       (boundary.empty() ? "." : "; " + boundary + ".");
  }
  return content;
}

}  // namespace reports::texture
