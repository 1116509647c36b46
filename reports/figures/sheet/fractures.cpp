// Fractures: maps at chosen strains, which way they run, how those that cross a layer are spaced.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "reports/figures/sheet/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::sheet {
namespace {

constexpr double third = 1.0 / 3;  // of all directions lie within 30° of one

// Strains to show: the snapshots of the record.
std::vector<double> strains_of(const dem::Record& r) {
  std::vector<double> strains;
  for (const auto& [name, strain] : snapshots_of(r)) strains.push_back(strain);
  return strains;
}

std::string part(double value) {
  std::string text = fmt::format("{:g}", value);
  std::replace(text.begin(), text.end(), '.', '_');
  return text;
}

Panel map_panel(const StudyResult& study, const dem::Record& r, double strain, int per_row) {
  const auto n = crack_counts(r, strain);
  const std::string label = label_of(r, study);
  const bool off =
      n[static_cast<std::size_t>(CrackPlace::matrix)] > 0;  // beside the layer: some seem to be on its edge
  return {.id = r.case_id + "_" + part(strain),
          .caption = fmt::format(
              "{} at {}: {}{}.",
              label == "this run" ? (layered(r) ? "Fractures of the layer" : "Fractures") : "Fractures, " + label + ",",
              at_strain(r, strain), crack_words(r, strain), off ? "; a mark lies at the middle of its spring" : ""),
          .alt = fmt::format("Map of {} broken springs over the outlines of grains.", count(sum_of(n))),
          .content = fracture_map(r, strain, render::page_width / per_row),
          .per_row = per_row,
          .whole_width = per_row == 1};
}

constexpr int bins = 18;  // of a rose, over half a circle
std::array<int, bins> binned(const std::vector<double>& angles) {
  std::array<int, bins> n{};
  for (const double a : angles) ++n[static_cast<std::size_t>(a / std::numbers::pi * bins) % bins];
  return n;
}

// Angles (radians, 0 ... pi) as a rose over the whole circle, weights equal.
std::string rose(const std::vector<double>& angles, double reference, std::string_view reference_words, int width) {
  const std::array<int, bins> n = binned(angles);
  const int most = std::max(1, *std::ranges::max_element(n));
  // Beside its caption, alone, it takes less than a third of a page.
  const double outside = std::min(0.48 * width, 150.0), r = outside - 14;
  const double cx = 0.5 * width, cy = outside + 7;
  std::string body;
  for (const double share : {0.5, 1.0}) {
    body += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"none\" stroke=\"#8a8a8a\"/>", cx, cy, share * r);
  }
  for (int turn = 0; turn < 2; ++turn) {
    for (int b = 0; b < bins; ++b) {
      const double from = std::numbers::pi * b / bins + turn * std::numbers::pi, to = from + std::numbers::pi / bins;
      const double length = r * std::sqrt(static_cast<double>(n[static_cast<std::size_t>(b)]) / most);
      body += fmt::format(
          "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}A{:.1f} {:.1f} 0 0 0 {:.1f} {:.1f}Z\" fill=\"#6f9fc0\" "
          "stroke=\"#0b3c5d\"/>",
          cx, cy, cx + length * std::cos(from), cy - length * std::sin(from), length, length,
          cx + length * std::cos(to), cy - length * std::sin(to));
    }
  }
  const double ux = std::cos(reference), uy = std::sin(reference);
  constexpr std::string_view dashed = "stroke=\"#bd4300\" stroke-width=\"2\" stroke-dasharray=\"7 4\"";
  body += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>", cx - outside * ux,
                      cy + outside * uy, cx + outside * ux, cy - outside * uy, dashed);
  // What the dashed line is, beside a piece of it.
  const double below = cy + outside + 18, sample = 22,
               wide = sample + 6 + 6.6 * static_cast<double>(reference_words.size());
  const double start = std::max(0.0, cx - wide / 2);
  body += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{1:.1f}\" {3}/>", start, below - 4,
                      start + sample, dashed);
  body += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12\" fill=\"#a04000\">{}</text>", start + sample + 6,
                      below, reference_words);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" height=\"{1:.0f}\" "
             "font-family=\"DejaVu Sans\">",
             width, below + 8) +
         body + "</svg>";
}

std::vector<double> known(std::span<const double> values) {
  std::vector<double> kept;
  for (const double v : values) {
    if (std::isfinite(v)) kept.push_back(v);
  }
  return kept;
}

// Direction of each trend against the line to the nearest growing grain's centre, 0 ... 90 degrees.
std::vector<double> off_radial(const dem::Record& r) {
  const auto grain = r.table("particles").integer("grain");
  const auto place = r.table("particles").real("position");
  const auto growth = r.table("grains").real("growth");
  std::vector<std::array<double, 3>> centre(growth.size(), {0, 0, 0});
  for (std::size_t i = 0; i < grain.size(); ++i) {
    auto& c = centre[static_cast<std::size_t>(grain[i])];
    c[0] += place[2 * i], c[1] += place[2 * i + 1], c[2] += 1;
  }
  const auto trend = r.table("cracks").real("trend");
  const auto at = r.table("cracks").real("position");
  std::vector<double> angles;
  for (std::size_t k = 0; k < trend.size(); ++k) {
    if (!std::isfinite(trend[k])) continue;
    double nearest = 1e9, direction = 0;
    for (std::size_t g = 0; g < growth.size(); ++g) {
      if (growth[g] <= 0 || centre[g][2] == 0) continue;
      const double dx = at[2 * k] - centre[g][0] / centre[g][2], dy = at[2 * k + 1] - centre[g][1] / centre[g][2];
      if (std::hypot(dx, dy) < nearest) nearest = std::hypot(dx, dy), direction = std::atan2(dy, dx);
    }
    angles.push_back(std::acos(std::min(1.0, std::fabs(std::cos(trend[k] - direction)))) * 180 / std::numbers::pi);
  }
  return angles;
}

}  // namespace

namespace {

double between_percent(const dem::Record& record) { return 100 * between_share(record); }

/// Whether the breaks of all that converged lie at boundaries mainly, and a sentence on those whose do not.
void judge_boundaries(FigureContent& content, const std::vector<const dem::Record*>& runs, const StudyResult& study) {
  std::vector<Agreement> verdicts;
  for (const dem::Record* r : runs) {
    const double chance = between_by_chance(*r);
    const analysis::Estimate share = over_seeds(study, *r, between_share);
    const Agreement one = mainly(share, chance);
    verdicts.push_back(one);
    if (one == Agreement::agrees) continue;
    const std::string kind = kind_of(*r, study);
    const std::string label = seeds_of(study, *r).size() == 1 ? label_of(*r, study) : kind.empty() ? "all seeds" : kind;
    content.finding += fmt::format(" {}: the share of {} is {}.", capital(label), percent(share.value, 0),
                                   one == Agreement::disagrees ? "no more than by chance"
                                   : share.value < 0.5         ? "above chance but below half"
                                                               : "above half, with an interval that is not");
  }
  if (!verdicts.empty()) content.agreement = together(verdicts);
}

/// How many springs broke in each, and how many of them at boundaries.
std::string shares_said(const std::vector<const dem::Record*>& runs, const StudyResult& study) {
  std::vector<std::string> shares;
  for (const dem::Record* r : runs) {
    const std::string label = label_of(*r, study);
    shares.push_back(percent(between_share(*r), 0) + " of " + (shares.empty() ? "the " : "") +
                     count(static_cast<double>(r->table("cracks").rows())) + (shares.empty() ? " broken springs" : "") +
                     (label == "this run" ? "" : " (" + label + ")"));
  }
  return fmt::format("{} lie at grain boundaries; by chance {} would.", listed(shares),
                     percent(between_by_chance(*runs.front()), 0));
}

/// "29 of 30 trends (97 %)": of a share of them.
std::string part_of_trends(double share, std::size_t all, const std::string& label = "this run") {
  const auto number = static_cast<double>(all);
  return fmt::format("{} of {} {} ({}{})", count(std::round(share * number)), count(number),
                     all == 1 ? "trend" : "trends", percent(share, 0), label == "this run" ? "" : "; " + label);
}

/// "30 trends": of the broken springs whose fracture is long enough to have one.
std::string trends_of(const dem::Record& r) {
  const auto n = known(r.table("cracks").real("trend")).size();
  return fmt::format("{} {}", count(static_cast<double>(n)), n == 1 ? "trend" : "trends");
}

}  // namespace

FigureContent fracture_maps(const StudyResult& study) {
  FigureContent content;
  const dem::Record* r = main_record(study);
  if (!r) return content;
  const std::string test = r->text("test");
  content.expected = true;  // which way fractures run has figures of its own
  if (test == "pure_shear")
    content.statement = "Boundaries are half as strong as grains: under pure shear fractures run mainly along them.";
  if (test == "extension") content.statement = "The stiff layer breaks by tension fractures that cross it.";
  std::vector<std::pair<const dem::Record*, double>> maps;
  for (const double strain : strains_of(*r)) maps.emplace_back(r, strain);
  for (const dem::Record* other : seeds_of(study, *r)) {
    const std::vector<double> strains = strains_of(*other);
    if (other != r && !strains.empty()) maps.emplace_back(other, strains.back());
  }
  for (const dem::Record* other : records_of(study)) {  // how the others end; the historical sweep has its own figure
    const std::vector<double> strains = strains_of(*other);
    if (other == r || other->text("solver") != "converged" || strains.empty()) continue;
    maps.emplace_back(other, strains.back());
  }
  const int per_row = layered(*r) ? 1 : maps.size() % 3 == 0 ? 3 : 2;
  for (const auto& [record, strain] : maps) content.panels.push_back(map_panel(study, *record, strain, per_row));
  if (test == "pure_shear") {
    std::vector<const dem::Record*> runs;
    bool historical = false;
    for (const dem::Record* one : records_of(study)) {
      historical = historical || one->text("solver") == "historical";
      if (one->text("solver") == "converged" && one->has(quantity::onset_strain)) runs.push_back(one);
    }
    content.finding = runs.empty() ? "No spring broke."
                                   : shares_said(runs, study) + over_seeds_said(study, runs, between_percent,
                                                                                "the share at grain boundaries is");
    if (!runs.empty()) judge_boundaries(content, runs, study);
    if (historical) content.finding += " The historical run is in “Converged and historical solvers”.";
    return content;
  }
  if (!r->has(quantity::onset_strain)) {
    content.finding = "No spring broke.";
    return content;
  }
  const auto broken = static_cast<double>(r->table("cracks").rows());
  const std::string broke = count(broken) + (broken == 1 ? " spring broke" : " springs broke");
  const std::string first = "the first at " + at_strain(*r, r->value_or_nan(quantity::onset_strain));
  if (layered(*r)) {
    content.finding = fmt::format("{}, {}: {}", broke, first, crack_words(*r, r->value(quantity::final_strain)));
  } else {
    content.finding =
        fmt::format("{}, {} of them at grain boundaries; {}", broke, percent(between_share(*r), 0), first);
  }
  const double through = r->value_or_nan(quantity::crossing_fractures);
  if (test == "extension" && std::isfinite(through))
    content.agreement = through > 0 ? Agreement::agrees : Agreement::undecided;
  if (std::isfinite(through)) {
    content.finding +=
        fmt::format("; {} the layer{}",
                    through == 0   ? "no fracture crosses"
                    : through == 1 ? "one fracture crosses"
                                   : count(through) + " fractures cross",
                    through > 0 ? ": connected broken springs over four fifths of its rows or more" : "");
  }
  content.finding += ".";
  content.finding += over_seeds_said(
      study, {r}, [](const dem::Record& one) { return static_cast<double>(one.table("cracks").rows()); },
      "the number of broken springs is", "");
  if (layered(*r) && !uniform_layer(*r))
    content.finding += " In tables, springs at the layer’s edges count as inter-grain ones.";
  return content;
}

FigureContent rose_of_fractures(const StudyResult& study) {
  FigureContent content;
  std::vector<std::string> said;
  std::vector<Agreement> verdicts;
  std::vector<const dem::Record*> shown;
  const ValueOf shown_share = [](const dem::Record& one) {
    return one.value_or_nan(quantity::along_compression_share);
  };
  for (const dem::Record* r : records_of(study)) {
    if (r->has(quantity::along_compression_share) && !known(r->table("cracks").real("trend")).empty())
      shown.push_back(r);
  }
  if (shown.empty()) return content;
  content.expected = true;
  content.statement =
      "Springs break only in tension, so that fractures run parallel to the compression and open across it.";
  const int per_row = std::clamp(static_cast<int>(shown.size()), 2, 4);  // beside each other, so that none stands alone
  for (const dem::Record* r : shown) {
    const auto angles = known(r->table("cracks").real("trend"));
    const double share = r->value_or_nan(quantity::along_compression_share);
    const std::string label = label_of(*r, study);
    const bool alone = label == "this run";
    content.panels.push_back(
        {.id = r->case_id,
         .caption = fmt::format("{}{}; outer circle: {} springs.", alone ? "" : capital(label) + ": ", trends_of(*r),
                                std::ranges::max(binned(angles))),
         .alt = fmt::format("{} of the trends lie within 30° of the compression.", percent(share, 0)),
         .content = rose(angles, r->text("test") == "compression" ? 0.0 : std::numbers::pi / 2,
                         "direction of compression", render::page_width / per_row),
         .per_row = per_row});
    said.push_back(part_of_trends(share, angles.size(), label));
    verdicts.push_back(mainly(over_seeds(study, *r, shown_share), third));
  }
  content.finding = fmt::format(
      "{} lie within 30° of the compression (by chance a third). The area of a sector is the number of its broken "
      "springs; the outer circle is that of the fullest sector, the inner one that of a quarter as many.",
      listed(said));
  content.finding += over_seeds_said(
      study, shown, [&](const dem::Record& one) { return 100 * shown_share(one); }, "the share is");
  content.agreement = together(verdicts);
  if (content.agreement == Agreement::undecided)
    content.finding += " Agreement takes half of them or more in every run, disagreement a third or less.";
  return content;
}

FigureContent radial_fractures(const StudyResult& study) {
  FigureContent content;
  content.expected = true;
  content.statement = "Fractures run radially from grains that increase in volume.";
  const dem::Record* r = main_record(study);
  if (!r) return content;
  if (r->text("test") != "growth") {
    content.panels.push_back(note_panel("", "Angle to the radial direction.", "No grain grows in this run."));
    return content;
  }
  const auto angles = off_radial(*r);
  if (angles.empty()) {
    content.panels.push_back(
        note_panel("", "Angle to the radial direction.", "Too few springs broke to tell a trend."));
    return content;
  }
  std::vector<double> n(9, 0);
  for (const double a : angles) ++n[std::min<std::size_t>(8, static_cast<std::size_t>(a / 10))];
  for (double& v : n) v *= 100.0 / static_cast<double>(angles.size());
  render::Chart chart;
  render::Bars bars;
  bars.categories = {"0–10", "10–20", "20–30", "30–40", "40–50", "50–60", "60–70", "70–80", "80–90"};
  bars.labels = {"share of broken springs"};
  bars.colours = {render::palette(5)};
  bars.values = {n};
  chart.bars = bars;
  chart.x.title = "Angle between fracture and radius (°)";
  chart.left.title = "Share (%)";
  chart.marks.push_back(
      {.kind = render::Mark::Kind::horizontal, .x = 0, .y = 100.0 / 9, .label = "chance", .colour = {0.3, 0.3, 0.3}});
  chart.legend = render::Chart::Legend::none;
  const double share = r->value_or_nan(quantity::radial_share);
  content.panels.push_back(
      {.id = "",
       .caption = "Trend of fractures against the line to the centre of the nearest growing grain.",
       .alt = fmt::format("{} of the trends lie within 30° of the radius.", percent(share, 0)),
       .content = chart,
       .per_row = 1});
  content.finding =
      fmt::format("{} lie within 30° of the radius (by chance a third).", part_of_trends(share, angles.size()));
  const ValueOf radial = [](const dem::Record& one) { return one.value_or_nan(quantity::radial_share); };
  content.finding += over_seeds_said(
      study, {r}, [&](const dem::Record& one) { return 100 * radial(one); }, "the share is");
  content.agreement = mainly(over_seeds(study, *r, radial), third);
  if (content.agreement == Agreement::undecided)
    content.finding += " Agreement takes half of them or more, disagreement a third or less.";
  return content;
}

FigureContent spacing(const StudyResult& study) {
  FigureContent content;
  const dem::Record* r = main_record(study);
  if (!r || !r->table("history").has("crossing_fractures")) return content;
  if (r->text("test") == "compression" && r->value_or_nan(quantity::crossing_fractures) < 1) {
    content.panels.push_back(
        note_panel("", "Spacing of fractures through the layer.", "No fracture crosses the layer in this run."));
    return content;
  }
  content.expected = true;
  content.statement =
      "After Bai et al. 2000, the spacing of fractures through a stiff layer falls with strain until it saturates at "
      "about the thickness of the layer.";
  const dem::Table& h = r->table("history");
  const double last = r->value_or_nan(quantity::crossing_fractures);
  const auto panel = [&](const char* id, const char* column, const char* title, const std::string& caption) {
    render::Chart chart;
    chart.x.title = "Strain (%)";
    chart.left.title = title;
    chart.left.low = 0;
    render::Series series = curve(h, {"strain", column, 100, 1});
    series.colour = render::palette(0);
    series.marker = render::Marker::circle;
    chart.series = {series};
    chart.legend = render::Chart::Legend::none;
    content.panels.push_back({.id = id,
                              .caption = caption,
                              .alt = fmt::format("At the end {} fractures cross the layer.", count(last)),
                              .content = chart,
                              .per_row = 2});
  };
  panel("number", "crossing_fractures", "Fractures through the layer", "Fractures that cross the layer.");
  panel("spacing", "spacing_over_thickness", "Mean spacing over layer thickness", "Their mean spacing.");
  content.finding =
      fmt::format("{} the layer at {}", last == 1 ? "One fracture crosses" : count(last) + " fractures cross",
                  at_strain(*r, r->value(quantity::final_strain)));
  if (r->has(quantity::spacing_over_thickness)) {
    content.finding += fmt::format("; their mean spacing is {} layer thicknesses",
                                   number(r->value(quantity::spacing_over_thickness), 3));
  }
  if (r->has(quantity::spacing_scatter)) {
    content.finding += fmt::format(
        ", with a standard deviation of {} of the mean ({} would be expected for the same "
        "number placed at random)",
        percent(r->value(quantity::spacing_scatter), 0), percent(r->value(quantity::spacing_scatter_chance), 0));
  }
  content.finding += ".";
  content.finding +=
      over_seeds_said(study, {r}, shown(quantity::crossing_fractures), "the number of these fractures is", "") +
      over_seeds_said(study, {r}, shown(quantity::spacing_over_thickness), "their mean spacing is", "thicknesses");
  std::vector<Agreement> verdicts;
  for (const dem::Record* one : seeds_of(study, *r)) {
    const auto spacing = known(one->table("history").real("spacing_over_thickness"));
    if (spacing.size() < 2) continue;
    constexpr double about = 2;  // thicknesses
    verdicts.push_back(spacing.back() >= spacing.front() ? Agreement::disagrees
                       : spacing.back() <= about         ? Agreement::agrees
                                                         : Agreement::undecided);
  }
  if (verdicts.empty()) return content;
  content.agreement = together(verdicts);
  if (std::ranges::count(verdicts, Agreement::undecided) == std::ssize(verdicts))
    content.finding += " The spacing falls, but not to one thickness.";
  return content;
}

}  // namespace reports::sheet
