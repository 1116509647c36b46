// The Brazilian test: how the disc is loaded and what it bears, its strength beside that of direct tension, and where it
// cracks first.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/analysis/fits.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/failed.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

constexpr int picture_width = 700;

// Direct over Brazilian tensile strength (Perras & Diederichs 2014): igneous rock, and the range over kinds of rock.
constexpr double igneous = 0.8, lowest = 0.7, highest = 0.9;

// The platens or jaws as lines in the plane of the section.
void add_platens(render::Scene& scene, const SeriesCase& item) {
  const double height = size_of(*item.record).height, radius = height / 2;
  for (const double side : {-1.0, 1.0}) {
    render::Polyline line{{}, steel, 3, render::Line::solid, false};
    const double jaw = item.value * radius;
    for (int i = -20; i <= 20; ++i) {
      const double x = 0.5 * radius * i / 20;
      const double rise = jaw > 0 ? jaw - std::sqrt(jaw * jaw - x * x) : 0;
      line.points.push_back({x, 0, radius + side * (radius - rise)});
    }
    scene.lines.push_back(line);
  }
}

Panel disc_panel(const StudyResult& study, const SeriesCase& item) {
  render::Scene scene = section_scene(study, *item.record, picture_width);
  add_platens(scene, item);
  const auto particles = static_cast<double>(item.record->table("particles").rows());
  return {
      .id = "disc_" + item.id,
      .caption = "The disc, cut at half its thickness" + (item.value > 0 ? "; R is its radius." : std::string(".")),
      .alt = "A disc of " + count(particles) + " particles between " + item.label + ".",
      .content = Picture{.scene = std::move(scene), .label = item.label, .legend = mineral_legend(study, *item.record)},
      .per_row = 4};
}

/// How far a disc has turned about its axis up to the peak, degrees; NaN where no state of the peak was kept.
double turn_at_peak(const dem::Record& record) {
  const auto peak = std::ranges::find_if(record.tables, [](const dem::Table& table) {
    return table.name.starts_with("snapshots/") && table.has("displacement") && table.attribute("moment") == "peak";
  });
  if (peak == record.tables.end()) return std::nan("");
  const auto at = record.table("particles").real("position"), moved = peak->real("displacement");
  const auto particles = static_cast<double>(at.size() / 3);
  std::array<double, 3> middle{}, mean{};
  for (std::size_t i = 0; i < at.size(); ++i) {
    middle[i % 3] += at[i] / particles;
    mean[i % 3] += moved[i] / particles;
  }
  double moment = 0, inertia = 0;
  for (std::size_t i = 0; i < at.size(); i += 3) {
    const double x = at[i] - middle[0], z = at[i + 2] - middle[2];
    moment += z * (moved[i] - mean[0]) - x * (moved[i + 2] - mean[2]);
    inertia += x * x + z * z;
  }
  return moment / inertia * 180 / std::numbers::pi;
}

/// "between flat platens", "in jaws of 1.5 R".
std::string where(const SeriesCase& item) { return (item.value > 0 ? "in " : "between ") + item.label; }

/// What makes a curve flat for a while before any bond breaks.
std::string turning_words(const std::vector<SeriesCase>& cases) {
  constexpr double felt = 0.5;  // degrees: the rim has moved by more than a hundredth of its radius
  std::vector<std::string> turns;
  for (const SeriesCase& item : cases) {
    const double turn = std::abs(turn_at_peak(*item.record));
    if (turn > felt) turns.push_back(fmt::format("{}° {}", number(turn, 2), where(item)));
  }
  if (turns.empty()) return "";
  return " By its peak the disc has rotated by " + listed(turns) +
         ", because only a few particles of its rim bear, and the platens are without friction; on the flat parts of "
         "the curve it "
         "rolls on to the next ones.";
}

/// What the gauge reads of a disc that only rotates: it is fixed in space, and its particles come closer along it.
std::string gauge_words(const std::vector<SeriesCase>& cases) {
  constexpr double told = 0.005;  // %: what a curve shows
  std::vector<std::string> shares;
  for (const SeriesCase& item : cases) {
    const double turn = turn_at_peak(*item.record) * std::numbers::pi / 180, share = -50 * turn * turn;
    if (share < -told) shares.push_back(fmt::format("{} % {}", number(share, 1), where(item)));
  }
  return " The gauge does not rotate with the disc: a rotation by θ enters its strain as −θ²/2" +
         (shares.empty() ? std::string() : " (" + listed(shares) + " at the peak)") +
         "; a strain below zero can come from rotation alone.";
}

constexpr const char* splitting_stress = "2P/(πDt) (MPa)";

std::vector<double> strengths(const std::vector<const dem::Record*>& records, const dem::Quantity& of) {
  std::vector<double> values;
  for (const dem::Record* record : records) {
    const double value = record->value_or_nan(of);
    if (std::isfinite(value)) values.push_back(value);
  }
  return values;
}

struct Sample {
  std::string label;
  std::vector<double> values;  ///< MPa
};

std::vector<double> tension_of(const StudyResult& study) {
  std::vector<double> values;
  for (const SeriesCase& item : series_of(of_mineral(study, ""), test_tension, parameter::confining_pressure)) {
    const std::vector<double> more = strengths(item.repeats, quantity::tensile_strength);
    values.insert(values.end(), more.begin(), more.end());
  }
  return values;
}

render::Chart strengths_chart(const std::vector<Sample>& samples) {
  render::Chart chart;
  chart.left.title = "Tensile strength (MPa)";
  chart.left.low = 0;
  chart.x.low = 0.5;
  chart.x.high = static_cast<double>(samples.size()) + 0.5;
  render::Series seeds{.label = "one specimen each",
                       .x = {},
                       .y = {},
                       .colour = {0.45, 0.45, 0.45},
                       .line = render::Line::none,
                       .marker = render::Marker::cross,
                       .y_error = {}};
  render::Series mean{.label = "mean and its 95 % interval",
                      .x = {},
                      .y = {},
                      .colour = render::palette(0),
                      .line = render::Line::none,
                      .marker = render::Marker::circle,
                      .y_error = {}};
  const bool several = std::ranges::any_of(samples, [](const Sample& s) { return s.values.size() > 1; });
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double at = static_cast<double>(k) + 1;
    chart.x.ticks.emplace_back(at, samples[k].label);
    for (const double value : samples[k].values) {
      seeds.x.push_back(several ? at - 0.12 : at);
      seeds.y.push_back(value);
    }
    const analysis::Estimate estimate = analysis::mean_of(samples[k].values);
    if (!std::isfinite(estimate.value)) continue;
    mean.x.push_back(at + 0.12);
    mean.y.push_back(estimate.value);
    mean.y_error.push_back(estimate.has_interval() ? estimate.high - estimate.value : 0);
  }
  if (std::ranges::all_of(mean.y_error, [](double e) { return e == 0; })) {
    mean.y_error.clear();
    mean.label = "mean";
  }
  chart.series = {seeds};
  if (several) chart.series.push_back(mean);
  chart.legend = render::Chart::Legend::below;
  return chart;
}

// A bar a kind of loading, with its interval, and the published ratios as lines.
render::Chart ratios_chart(const StudyResult& study, const std::vector<SeriesCase>& cases,
                           const std::vector<analysis::Estimate>& ratios) {
  render::Chart chart;
  chart.left.title = "Direct over Brazilian";
  chart.left.low = 0;
  render::Bars bars;
  bars.labels = {"this study"};
  bars.colours = {render::palette(0)};
  bars.values.resize(1);
  bars.errors.resize(1);
  double high = 1;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const double half = ratios[k].has_interval() ? ratios[k].high - ratios[k].value : std::nan("");
    // The value with the name: above its bar the lines would strike it.
    const std::string value = std::isfinite(ratios[k].value) ? ": " + fixed(ratios[k].value, 2) : "";
    bars.categories.push_back(cases[k].label + value);
    bars.values[0].push_back(ratios[k].value);
    bars.errors[0].push_back(half);
    if (std::isfinite(ratios[k].value)) high = std::max(high, ratios[k].value + (std::isfinite(half) ? half : 0));
  }
  chart.bars = bars;
  chart.left.high = 1.2 * high;
  const double nothing = std::nan("");  // the paper is not about a rock of one's own
  for (const auto& [value, rock] :
       {std::pair{highest, "metamorphic"}, std::pair{igneous, "igneous"}, std::pair{lowest, "sedimentary"}})
    add_published(chart, render::Mark::Kind::horizontal, study.of_a_paper ? value : nothing,
                  fmt::format("published, {}: {:g}", rock, value));
  chart.legend = render::Chart::Legend::none;
  return chart;
}

Agreement of_all(const std::vector<Agreement>& verdicts) {
  const auto any = [&](Agreement verdict) { return std::ranges::find(verdicts, verdict) != verdicts.end(); };
  if (any(Agreement::disagrees)) return Agreement::disagrees;
  return any(Agreement::undecided) ? Agreement::undecided : Agreement::agrees;
}

// Shares (%) of a disc within half a radius of its axis, and within a quarter of a radius of its diameter.
constexpr double even_middle = 25, even_band = 31.5;

// Whether a share (%) of so many cracks is more than that of evenly spread ones, by twice the scatter of their number.
Agreement beside_even(double share, double even, std::size_t cracks) {
  const double scatter = std::sqrt(even * (100 - even) / static_cast<double>(std::max<std::size_t>(cracks, 1)));
  if (share > even + 2 * scatter) return Agreement::agrees;
  return share < even - 2 * scatter ? Agreement::disagrees : Agreement::undecided;
}

/// Half a radius from the axis, and a quarter from the loaded diameter.
void add_limits(render::Scene& scene, double radius) {
  constexpr render::Colour thin{0.1, 0.1, 0.1};
  render::Polyline circle{{}, thin, 1, render::Line::dash, false};
  for (int i = 0; i <= 60; ++i) {
    const double angle = 2 * std::numbers::pi * i / 60;
    circle.points.push_back({0.5 * radius * std::cos(angle), 0, radius + 0.5 * radius * std::sin(angle)});
  }
  scene.lines.push_back(circle);
  const double reach = radius * std::sqrt(1 - 1.0 / 16);  // to the rim
  for (const double side : {-1.0, 1.0}) {
    const double x = 0.25 * side * radius;
    scene.lines.push_back({{{x, 0, radius - reach}, {x, 0, radius + reach}}, thin, 1, render::Line::dash, false});
  }
}

std::size_t first_cracks(const dem::Record& record) {
  double at_peak = 0;
  for (const dem::Quantity& one : quantity::cracks_at_peak) at_peak += record.value_or_nan(one);
  const auto first = static_cast<std::size_t>(std::max(0.01 * at_peak, 10.0));
  return std::min(first, record.table("cracks").rows());
}

}  // namespace

FigureContent brazilian_test(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_brazilian)) content.panels.push_back(*missing);
  const auto cases = discs_of(study);
  if (cases.empty()) return content;
  for (const SeriesCase& item : cases) content.panels.push_back(disc_panel(study, item));
  const std::string peaks = by_case(cases, quantity::brazilian_strength, 3);
  content.panels.push_back(
      {.id = "load",
       .caption = "Splitting stress of the load P, on a disc of diameter D and thickness t, against the "
                  "approach of the platens" +
                  first_seed(cases) + "." + turning_words(cases),
       .alt = "Curves of load; largest values of " + peaks + ".",
       .content = load_curves(cases, {"platen_strain", "axial_stress", 100, 1e-6}, "Approach of the platens (% of D)",
                              splitting_stress)});
  content.panels.push_back(
      {.id = "strain",
       .caption = "Splitting stress against the strain across the loaded diameter, of a round gauge in the middle" +
                  first_seed(cases) + "." + gauge_words(cases),
       .alt = "Curves of load against the tensile strain in the middle; largest loads of " + peaks + ".",
       .content = load_curves(cases, {"axial_strain", "axial_stress", 100, 1e-6}, "Tensile strain in the middle (%)",
                              splitting_stress)});
  const Size size = size_of(*cases.front().record);
  std::vector<std::string> said;
  for (const SeriesCase& item : cases) {
    const Spread strength = analysis::spread(item, shown(quantity::brazilian_strength));
    if (strength.count > 0) said.push_back(number(strength.mean, 3) + " MPa " + where(item));
  }
  const std::size_t seeds = cases.front().repeats.size();
  if (!said.empty())
    content.finding =
        fmt::format("The splitting strength of discs of {:g} mm is {}{}.", 1e3 * size.height, listed(said),
                    seeds > 1 ? fmt::format(" (means of {}; pictures and curves: the first)", seeds_text(seeds)) : "");
  return content;
}

FigureContent brazilian_strengths(const StudyResult& study) {
  FigureContent content;
  content.statement = fmt::format(
      "Direct tension gives about {:g} of the Brazilian strength in igneous rock, {:g} in metamorphic and {:g} in "
      "sedimentary rock.",
      igneous, highest, lowest);
  add_missing(content, study, {test_brazilian, test_tension});
  const auto cases = discs_of(study);
  if (cases.empty()) return content;
  std::vector<Sample> samples;
  const std::vector<double> tension = tension_of(study);
  if (!tension.empty()) samples.push_back({"direct tension", tension});
  TextTable table{{"Test", "Specimens", "Strength (MPa)", "Direct over Brazilian"}, {}};
  if (!tension.empty()) {
    table.rows.push_back(
        {"direct tension", std::to_string(tension.size()), estimate_text(analysis::mean_of(tension), 3, true), ""});
  }
  std::vector<std::string> said;
  std::vector<Agreement> verdicts;
  std::vector<analysis::Estimate> ratios;
  for (const SeriesCase& item : cases) {
    const std::vector<double> values = strengths(item.repeats, quantity::brazilian_strength);
    samples.push_back({item.label, values});
    const analysis::Estimate ratio = analysis::ratio_of_means(tension, values);
    table.rows.push_back({"Brazilian, " + item.label, std::to_string(values.size()),
                          estimate_text(analysis::mean_of(values), 3, true),
                          std::isfinite(ratio.value) ? estimate_text(ratio, 2, true) : "–"});
    ratios.push_back(ratio);
    if (!std::isfinite(ratio.value)) continue;
    verdicts.push_back(agreement_within(ratio, lowest, highest));
    said.push_back((ratio.has_interval() ? estimate_text(ratio, 2) : number(ratio.value, 2)) + " with " + item.label);
  }
  render::Chart chart = strengths_chart(samples);
  std::vector<LaboratoryPoint> measured;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool direct = k == 0 && !tension.empty();
    measured.push_back(
        {static_cast<double>(k) + 1.24, study.measured(direct ? "tensile_strength" : "brazilian_strength")});
  }
  add_laboratory(chart, measured);
  content.panels.push_back({.id = "strengths",
                            .caption = "Tensile strengths by test.",
                            .alt = "Brazilian strengths of " + by_case(cases, quantity::brazilian_strength, 3) + ".",
                            .content = std::move(chart)});
  if (!verdicts.empty()) {
    content.panels.push_back({.id = "ratios",
                              .caption = std::string("Direct over Brazilian strength") +
                                         (study.of_a_paper ? "; dashed: published for three kinds of rock." : "."),
                              .alt = "Direct over Brazilian strength: " + listed(said) + ".",
                              .content = ratios_chart(study, cases, ratios)});
  }
  const auto enough = [](const Sample& one) { return one.values.size() > 2; };
  content.panels.push_back(
      {.id = "table",
       .caption = std::string("Mean strengths") + (verdicts.empty() ? "" : " and their ratio") +
                  (std::ranges::any_of(samples, enough)
                       ? "; 95 % confidence intervals in brackets, where there are three specimens or more."
                       : "."),
       .alt = "",
       .content = table,
       .per_row = 1});
  if (!verdicts.empty()) {
    content.agreement = of_all(verdicts);
    content.finding = "Direct over Brazilian strength is " + listed(said) + ".";
    std::size_t most = 0;
    for (const Sample& one : samples) most = std::max(most, one.values.size());
    if (most < 3)
      content.finding += most == 1 ? " One specimen of each is too few for an interval."
                                   : " Two specimens are too few for an interval.";
  } else {
    content.finding = "Brazilian strengths: " + by_case(cases, quantity::brazilian_strength, 3) + ".";
  }
  return content;
}

FigureContent brazilian_cracks(const StudyResult& study) {
  FigureContent content;
  content.statement = "A disc splits along its loaded diameter, and fails first in the middle.";
  content.expected = true;
  if (auto missing = missing_cases(study, test_brazilian)) content.panels.push_back(*missing);
  const auto cases = discs_of(study);
  if (cases.empty()) return content;
  for (const SeriesCase& item : cases) {
    const dem::Record& record = *item.record;
    const std::size_t first = first_cracks(record);
    render::Scene scene = section_scene(study, record, picture_width);
    add_platens(scene, item);
    add_limits(scene, size_of(record).height / 2);
    for (render::Discs& discs : crack_discs(record, first, 0.7)) {  // smaller, so that they can be counted
      discs.over = true;
      scene.discs.push_back(std::move(discs));
    }
    std::vector<LegendEntry> key = crack_legend(crack_numbers(record, first));
    for (LegendEntry& mineral : mineral_legend(study, record)) key.push_back(std::move(mineral));
    content.panels.push_back(
        {.id = "first_" + item.id,
         .caption = fmt::format("The first {} cracks, through the whole thickness{}.", first, first_seed({item})),
         .alt = fmt::format("The first {} cracks: {}.", first, crack_words(crack_numbers(record, first))),
         .content = Picture{.scene = std::move(scene), .label = item.label + ", first cracks", .legend = key},
         .per_row = 4});
    SeriesCase later = item;
    later.label += ", at the end";
    Panel end = cracks_at_end(study, later, "Cracks near the section at the end of loading" + first_seed({item}) + ".",
                              picture_width, [&](render::Scene& loaded) { add_platens(loaded, item); });
    end.id = "end_" + item.id;
    end.per_row = 4;
    content.panels.push_back(std::move(end));
  }
  std::vector<std::string> said;
  std::vector<Agreement> verdicts;
  for (const SeriesCase& item : cases) {
    const Spread middle = analysis::spread(item, shown(quantity::first_cracks_middle)),
                 band = analysis::spread(item, shown(quantity::first_cracks_band));
    if (middle.count == 0 || band.count == 0) continue;
    said.push_back(fmt::format("{} % and {} % with {}", number(middle.mean, 2), number(band.mean, 2), item.label));
    std::size_t all = 0;
    for (const dem::Record* record : item.repeats) all += first_cracks(*record);
    verdicts.push_back(beside_even(middle.mean, even_middle, all));
    verdicts.push_back(beside_even(band.mean, even_band, all));
  }
  if (said.empty()) return content;
  content.agreement = of_all(verdicts);
  content.finding =
      "Of the first cracks, those within half a radius of the axis of the disc and those within a quarter of a "
      "radius of the loaded diameter (dashed) are " +
      listed(said) +
      fmt::format(
          ". Evenly spread cracks would give {:g} % in the middle and {:.3g} % along the diameter; "
          "a share that exceeds this by two standard deviations counts as expected.",
          even_middle, even_band);
  return content;
}

}  // namespace reports::texture
