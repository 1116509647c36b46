// Strengths of blocks against their size (Liu et al. 2017, Figs. 4c, d), and what the open choices do to them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/lattice/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::lattice {
namespace {

struct Test {
  std::string_view name;
  dem::Quantity result, error;
  std::string_view title, axis;
  std::string_view published_single, published_mean;  // errors (%), by id
};
constexpr Test tension{
    "tension",     quantity::tensile_strength, quantity::tensile_strength_error, "Tensile strength Tᵤ",
    "T_{u} (MPa)", "unit_tensile_strength",    "mean_tensile_strength"};
constexpr Test compression{
    "compression", quantity::compressive_strength, quantity::compressive_strength_error, "Compressive strength Cᵤ",
    "C_{u} (MPa)", "unit_compressive_strength",    "mean_compressive_strength"};

double theory(const StudyResult& study, const Test& test) {
  return 1e-6 * study.scenario->real(test.name == "tension" ? "rock.tensile_strength" : "rock.compressive_strength");
}

render::Chart against_size(const StudyResult& study, const Test& test) {
  render::Chart chart;
  chart.x.title = "Number of elements";
  chart.x.logarithmic = true;
  chart.x.ticks = {{4, "4"}, {10, "10"}, {100, "100"}, {1000, "1000"}, {10000, "10 000"}, {100000, "100 000"}};
  chart.x.low = 3;
  chart.x.high = 60000;
  chart.left.title = std::string(test.axis);
  const auto records = by_size(study, test.name);
  const double rock = theory(study, test);
  render::Series line;
  const double mean = rock * (1 + study.published_value(test.published_mean) / 100);
  double low = std::isfinite(mean) ? mean : rock, high = rock;
  for (const dem::Record* r : records) {
    if (!std::isfinite(r->value_or_nan(test.result))) continue;
    line.x.push_back(r->value(quantity::particles));
    line.y.push_back(r->value_or_nan(test.result));
  }
  line = styled(line, "this study", 0);
  line.marker = render::Marker::circle;
  // First: its white marker would hide ours.
  add_published(chart, {{4, rock * (1 + study.published_value(test.published_single) / 100)}},
                "published, single unit");
  const dem::Record* main = main_record(study, test.name);
  std::size_t colour = 1;
  for (const std::string_view planes : {"elastic", "plate", "rigid"}) {
    if (!main || planes_of(*main) == planes) continue;
    render::Series other;
    for (const dem::Record* r : records_of(study, test.name)) {
      if (planes_of(*r) != planes || r->text("direction") != main->text("direction")) continue;
      if (!std::isfinite(r->value_or_nan(test.result))) continue;
      other.x.push_back(r->value(quantity::particles));
      other.y.push_back(r->value_or_nan(test.result));
    }
    if (other.x.empty()) continue;
    other = styled(other, fmt::format("{} planes", planes), colour++, render::Line::none);
    other.marker = colour == 2 ? render::Marker::cross : render::Marker::triangle;
    chart.series.push_back(other);
  }
  // Where they lie on each other, a cross shows on our points, and these show on triangles.
  const bool crossed = !chart.series.empty() && chart.series.back().marker == render::Marker::cross;
  chart.series.insert(chart.series.end() - (crossed ? 1 : 0), line);
  for (const render::Series& s : chart.series) {
    for (const double y : s.y) {
      low = std::min(low, y);
      high = std::max(high, y);
    }
  }
  chart.left.low = low - 0.15 * (high - low);
  chart.left.high = high + 0.15 * (high - low);
  chart.marks.push_back(
      {.kind = render::Mark::Kind::horizontal, .x = 0, .y = rock, .label = "theory", .colour = {0, 0, 0}});
  if (std::isfinite(mean)) {
    chart.marks.push_back({.kind = render::Mark::Kind::horizontal,
                           .x = 0,
                           .y = mean,
                           .label = "published mean of blocks",
                           .colour = published_colour,
                           .line = render::Line::dash_dot});
  }
  chart.legend = render::Chart::Legend::below;
  return chart;
}

// " (published −8.89 %, over nine)"; nothing when it is not known.
std::string published_words(double percent, const char* more = "") {
  return std::isfinite(percent) ? fmt::format(" (published {} %{})", shortest(percent), more) : "";
}

double mean_of_blocks(const StudyResult& study, const Test& test, int& n) {
  double sum = 0;
  n = 0;
  for (const dem::Record* r : by_size(study, test.name)) {
    if (r->number("elements_y") < 3 || !std::isfinite(r->value_or_nan(test.error))) continue;
    sum += r->value_or_nan(test.error);
    ++n;
  }
  return n > 0 ? sum / n : std::nan("");
}

// Stress (Pa) from which the block first falls by a twentieth: the first opening that runs through it, or its failure.
double first_drop(const dem::Table& history) {
  const auto stress = history.real("axial_stress"), opening = history.real("opening"),
             sliding = history.real("sliding");
  double largest = 0;
  for (std::size_t i = 0; i < stress.size(); ++i) {
    largest = std::max(largest, stress[i]);
    if (opening[i] + sliding[i] > 0 && stress[i] < 0.95 * largest) return largest;
  }
  return std::nan("");
}

// Loaded along its rows a block loses the rows, or all bonds between them, and what is left goes on carrying.
std::string unfailed(const dem::Record& r, const Test& test, double drop) {
  const auto& h = r.table("history");
  if (!std::isfinite(drop)) {
    return fmt::format("In {} along {} the block of {} elements does not fall up to a strain of {} %. ", test.name,
                       r.text("direction"), count(r.value(quantity::particles)),
                       number(100 * h.real("axial_strain").back(), 2));
  }
  return fmt::format(
      "In {} along {} the block of {} elements falls first at {} MPa and then does not fail: at a strain of {} % it "
      "carries {} "
      "MPa. ",
      test.name, r.text("direction"), count(r.value(quantity::particles)), number(1e-6 * drop, 3),
      number(100 * h.real("axial_strain").back(), 2), number(1e-6 * std::ranges::max(h.real("axial_stress")), 3));
}

}  // namespace

FigureContent block_strengths(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Tᵤ and Cᵤ of the single unit are 0.011 % and 1.73 % lower than those of quartzite. Blocks are weaker, on "
      "average by 8.89 % in tension and 18.51 % in compression, because cracks form first around the boundaries.";
  content.rows = {"unit_tensile_strength",     "unit_compressive_strength", "mean_tensile_strength",
                  "mean_compressive_strength", "tension_below_theory",      "compression_below_theory"};
  for (const Test& test : {tension, compression}) {
    add_missing(content, study, {test.name});
    const auto all = by_size(study, test.name);
    std::vector<const dem::Record*> records;  // those that failed
    for (const dem::Record* r : all) {
      if (r->has(test.result)) {
        records.push_back(r);
      } else {
        content.finding += unfailed(*r, test, first_drop(r->table("history")));
      }
    }
    if (records.empty()) continue;
    int n = 0;
    const double mean = mean_of_blocks(study, test, n);
    content.panels.push_back({.id = std::string(test.name),
                              .caption = std::string(test.title) + " by number of elements.",
                              .alt = fmt::format("From {} MPa for {} elements to {} MPa for {}.",
                                                 number(records.front()->value_or_nan(test.result), 3),
                                                 count(records.front()->value(quantity::particles)),
                                                 number(records.back()->value_or_nan(test.result), 3),
                                                 count(records.back()->value(quantity::particles))),
                              .content = against_size(study, test)});
    if (records.front()->value(quantity::particles) == 4) {
      content.finding += fmt::format("Single unit in {}: {} %{}. ", test.name,
                                     with_sign(number(records.front()->value_or_nan(test.error), 3)),
                                     published_words(study.published_value(test.published_single)));
    }
    std::vector<std::string> larger;
    for (const dem::Record* r : records) {
      const double factor = r->number("factor") / records.front()->number("factor");
      if (factor != 1)
        larger.push_back(fmt::format("{} (× {})", count(r->value(quantity::particles)), number(factor, 3)));
    }
    if (!larger.empty())
      content.finding += fmt::format("With larger loading steps in {}: {}. ", test.name, joined(larger, ", "));
    if (n > 0) {
      content.finding +=
          fmt::format("{} in {}: {} %{}. ", n == 1 ? std::string("One block") : fmt::format("Mean of {} blocks", n),
                      test.name, with_sign(number(mean, 3)),
                      published_words(study.published_value(test.published_mean), ", the mean of nine"));
    }
  }
  return content;
}

FigureContent strength_choices(const StudyResult& study) {
  FigureContent content;
  content.statement = "The tensile strength is a bit lower along other directions.";
  content.rows = {"tension_lower_along_x", "tension_lower_along_y"};
  TextTable table{
      {"Test", "Elements", "Choice", "Strength (MPa)", "Against theory", "First fall by 5 % (MPa)", "Ledger residual"},
      {}};
  std::vector<std::string> nearest;  // choice, by test
  std::string closest;               // that of the test before
  for (const Test& test : {tension, compression}) {
    const dem::Record* main = main_record(study, test.name);
    if (!main) continue;
    std::vector<double> sizes;
    const dem::Record* best = nullptr;
    const double published = study.published_value(test.published_mean);
    const auto away = [&](const dem::Record& r) { return std::abs(r.value_or_nan(test.error) - published); };
    for (const dem::Record* r : records_of(study, test.name)) {
      if (choice_words(*r, *main) != "as the series") sizes.push_back(r->number("elements_y"));
    }
    for (const dem::Record* r : records_of(study, test.name)) {
      if (std::ranges::find(sizes, r->number("elements_y")) == sizes.end()) continue;
      const bool failed = std::isfinite(r->value_or_nan(test.result));
      const double drop = first_drop(r->table("history"));
      if (!failed) content.finding += unfailed(*r, test, drop);
      const bool same_load = r->text("direction") == main->text("direction");
      if (failed && same_load && (!best || away(*r) < away(*best))) best = r;
      table.rows.push_back({std::string(test.name), count(r->value(quantity::particles)), choice_words(*r, *main),
                            failed ? number(r->value_or_nan(test.result), 3) : "not reached",
                            failed ? with_sign(number(r->value_or_nan(test.error), 3)) + " %" : "–",
                            std::isfinite(drop) ? number(1e-6 * drop, 3) : "–",
                            number(r->value(quantity::energy_residual), 2)});
    }
    if (best && std::isfinite(published)) {
      const std::string choice = choice_words(*best, *main);
      const std::string kind = fmt::format("{} ({} elements)", choice == "as the series" ? "the series itself" : choice,
                                           count(best->value(quantity::particles)));
      const std::string verb = nearest.empty() ? "comes closest to the published mean of nine blocks" : "does";
      nearest.push_back(fmt::format("in {} {}: {} % against {} %", test.name,
                                    kind == closest ? "as well" : kind + " " + verb,
                                    with_sign(number(best->value_or_nan(test.error), 3)), shortest(published)));
      closest = kind;
    }
  }
  std::ranges::stable_sort(table.rows, [](const auto& a, const auto& b) { return a[0] > b[0]; });
  if (table.rows.empty()) return content;
  content.panels.push_back(
      {.id = "", .caption = "Strengths under other choices.", .alt = "", .content = table, .per_row = 1});
  if (std::ranges::none_of(records_of(study, tension.name), [&](const dem::Record* r) {
        return r->text("direction") != main_record(study, tension.name)->text("direction");
      })) {
    content.finding += "No other direction of tension was run at this scale. ";
  }
  content.finding += sentence(nearest);
  return content;
}

}  // namespace reports::lattice
