// Elastic constants of blocks against strain (Liu et al. 2017, Figs. 4a, b), and what the open choices do to them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/lattice/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::lattice {
namespace {

render::Chart against_strain(const std::vector<const dem::Record*>& records, const std::string& column, double factor,
                             const std::string& title, double published) {
  render::Chart chart;
  chart.x.title = "Compressive strain";
  chart.x.logarithmic = true;
  chart.left.title = title;
  double least = 1, most = 0;  // strain
  double low = published, high = published;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const dem::Table& t = records[i]->table("elastic");
    render::Series s = whole(t, "axial_strain", 1, {column}, factor);
    for (const double y : s.y) {
      low = std::min(low, y);
      high = std::max(high, y);
    }
    for (const double x : s.x) {
      least = std::min(least, x);
      most = std::max(most, x);
    }
    s = styled(s, count(records[i]->value(quantity::particles)) + " elements", i, render::line_style(i), 1.4);
    s.marker = render::marker_style(i);
    chart.series.push_back(s);
  }
  if (least < most) chart.x.low = least / 1.3, chart.x.high = most * 1.3;  // markers whole
  const double room = 0.25 * (high - low) + 0.002 * published;
  chart.left.low = low - room;
  chart.left.high = high + room;
  chart.marks.push_back(
      {.kind = render::Mark::Kind::horizontal, .x = 0, .y = published, .label = "quartzite", .colour = {0, 0, 0}});
  chart.legend = render::Chart::Legend::outside_right;
  return chart;
}

struct MeanError {
  double e = 0, nu = 0;
  int n = 0;
};
MeanError mean_error(const std::vector<const dem::Record*>& records) {
  MeanError m;
  for (const dem::Record* r : records) {
    if (r->number("elements_y") < 3) continue;
    m.e += r->value(quantity::young_modulus_error);
    m.nu += r->value_or_nan(quantity::poisson_ratio_error);
    ++m.n;
  }
  if (m.n > 0) {
    m.e /= m.n;
    m.nu /= m.n;
  }
  return m;
}

// "5 compressive strains from 10⁻⁶ to 10⁻³", "two compressive strains (10⁻⁶ and 10⁻³)": those that were run.
std::string strains_words(const dem::Record& record) {
  const auto strains = record.table("elastic").real("axial_strain");
  const auto at = [](double strain) {
    const std::string text = scientific(std::abs(strain), 1);
    return text.starts_with("1 × ") ? text.substr(std::string_view("1 × ").size()) : text;
  };
  if (strains.size() == 1) return "one compressive strain of " + at(strains.front());
  if (strains.size() == 2)
    return fmt::format("two compressive strains ({} and {})", at(strains.front()), at(strains.back()));
  return fmt::format("{} compressive strains from {} to {}", strains.size(), at(strains.front()), at(strains.back()));
}

}  // namespace

FigureContent elastic_constants(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "At a compressive strain of 10⁻⁶, E and ν of the single unit are those of quartzite; errors grow with strain. "
      "For "
      "blocks of several units they average about 0.6 % over strains from 10⁻⁶ to 10⁻³.";
  content.rows = {"unit_young_modulus",       "unit_poisson_ratio",       "unit_modulus_error_grows",
                  "unit_poisson_error_grows", "mean_error_young_modulus", "mean_error_poisson_ratio"};
  if (auto missing = missing_cases(study, "elastic")) content.panels.push_back(*missing);
  const auto records = by_size(study, "elastic");
  if (records.empty()) return content;
  const dem::Scenario& s = *study.scenario;
  const double e = 1e-9 * s.real("rock.young_modulus"), nu = s.real("rock.poisson_ratio");
  const dem::Record& small = *records.front();
  const dem::Record& large = *records.back();
  content.panels.push_back(
      {.id = "young_modulus",
       .caption = "Young’s modulus against compressive strain, by number of elements.",
       .alt = fmt::format("At the smallest strain {} GPa for {} elements and {} GPa for {}.",
                          number(small.value(quantity::young_modulus), 4), count(small.value(quantity::particles)),
                          number(large.value(quantity::young_modulus), 4), count(large.value(quantity::particles))),
       .content = against_strain(records, "young_modulus", 1e-9, "Young’s modulus (GPa)", e),
       .per_row = 1});
  content.panels.push_back(
      {.id = "poisson_ratio",
       .caption =
           "Poisson’s ratio, mean of the two lateral directions, against compressive strain, by number of elements.",
       .alt = fmt::format("At the smallest strain {} for {} elements and {} for {}.",
                          number(small.value(quantity::poisson_ratio), 4), count(small.value(quantity::particles)),
                          number(large.value(quantity::poisson_ratio), 4), count(large.value(quantity::particles))),
       .content = against_strain(records, "poisson_ratio", 1, "Poisson’s ratio", nu),
       .per_row = 1});
  const MeanError error = mean_error(records);
  if (error.n > 0) {
    content.finding = fmt::format("For {} of several units, over {}, the mean error of E is {} % and that of ν {} %.",
                                  error.n == 1 ? "the one block" : fmt::format("the {} blocks", error.n),
                                  strains_words(large), fixed(error.e, 1), fixed(error.nu, 1));
  }
  if (small.value(quantity::particles) == 4) {
    content.finding += fmt::format(
        " For the single unit E = {} GPa and ν = {} at the smallest strain, and {} GPa and {} at the largest.",
        number(small.value(quantity::young_modulus), 6), number(small.value(quantity::poisson_ratio), 6),
        number(small.value(quantity::young_modulus_at_largest_strain), 6),
        number(small.value(quantity::poisson_ratio_at_largest_strain), 6));
  }
  return content;
}

FigureContent elastic_choices(const StudyResult& study) {
  FigureContent content;
  content.statement = "The modulus is a bit lower along other directions.";
  content.rows = {"modulus_lower_along_x", "modulus_lower_along_y"};
  const dem::Record* main = main_record(study, "elastic");
  if (!main) return content;
  const dem::Scenario& s = *study.scenario;
  const double e = 1e-9 * s.real("rock.young_modulus"), nu = s.real("rock.poisson_ratio"),
               d = s.real("block.element_diameter");
  double least = 0, most = 0;  // what other sections and gauges make of E, beside theory
  TextTable table{{"Elements", "Choice", "E (GPa)", "E against theory", "ν (two directions)", "ν against theory"}, {}};
  const auto add = [&](const dem::Record& r, const std::string& choice, double area_factor, double strain_factor) {
    const dem::Table& t = r.table("elastic");
    const double modulus = 1e-9 * t.real("young_modulus").front() * area_factor * strain_factor;
    if (area_factor != 1 || strain_factor != 1) {
      const double off = modulus / e - 1;
      least = least == 0 ? off : std::min(least, off), most = most == 0 ? off : std::max(most, off);
    }
    const double n1 = t.real("poisson_ratio_1").front() * strain_factor,
                 n2 = t.real("poisson_ratio_2").front() * strain_factor;
    table.rows.push_back({count(r.value(quantity::particles)), choice, number(modulus, 3),
                          with_sign(percent(modulus / e - 1, 1)),
                          number(0.5 * (n1 + n2), 3) + " (" + number(n1, 3) + ", " + number(n2, 3) + ")",
                          with_sign(percent(0.5 * (n1 + n2) / nu - 1, 1))});
  };
  std::vector<double> sizes;
  for (const dem::Record* r : records_of(study, "elastic")) {
    if (choice_words(*r, *main) != "as the series") sizes.push_back(r->number("elements_y"));
  }
  std::ranges::sort(sizes);
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  for (const double size : sizes) {
    for (const dem::Record* r : records_of(study, "elastic")) {
      if (r->number("elements_y") == size) add(*r, choice_words(*r, *main), 1, 1);
    }
    for (const dem::Record* r : by_size(study, "elastic")) {
      if (r->number("elements_y") != size) continue;
      const auto x = r->table("particles").real("position");
      double wide_x = 0, wide_y = 0, high = 0;
      for (std::size_t i = 0; i + 2 < x.size(); i += 3) {
        wide_x = std::max(wide_x, x[i]);
        wide_y = std::max(wide_y, x[i + 1]);
        high = std::max(high, x[i + 2]);
      }
      long ends = 0;
      for (std::size_t i = 0; i + 2 < x.size(); i += 3) ends += x[i + 2] > high - 0.1 * d;
      const double centres = wide_x * wide_y;
      add(*r, "section: outline of the spheres", centres / ((wide_x + d) * (wide_y + d)), 1);
      add(*r, "section: end elements × their share", centres / (static_cast<double>(ends) * std::sqrt(3.0) / 2 * d * d),
          1);
      const dem::Table& t = r->table("elastic");
      add(*r, "gauge: the planes", 1, t.real("axial_strain").front() / t.real("strain_between_planes").front());
    }
  }
  if (table.rows.empty()) return content;
  content.panels.push_back({.id = "",
                            .caption = "E and ν at the smallest strain under other choices. The series takes the box "
                                       "of element centres and the end layers.",
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  content.finding =
      "Springs Kₙ at the planes, the box of element centres and the distance of the end layers were chosen because "
      "at paper scale they give the published mean errors of about 0.6 %.";
  for (const dem::Record* one : by_size(study, "elastic")) {
    for (const dem::Record* r : records_of(study, "elastic")) {
      const bool turned = r->text("direction") != main->text("direction");
      if (!turned || r->number("elements_y") != one->number("elements_y")) continue;
      const double lower = one->value(quantity::young_modulus) - r->value(quantity::young_modulus);
      content.finding += fmt::format(" Along {} E is {} GPa {} than along {} ({} elements).", r->text("direction"),
                                     number(std::abs(lower), 2), lower < 0 ? "higher" : "lower", one->text("direction"),
                                     count(r->value(quantity::particles)));
    }
  }
  if (least != 0) {
    content.finding +=
        fmt::format(" With other sections and gauges E is off by {} to {}{}.", with_sign(percent(most, 0)),
                    with_sign(percent(least, 0)), sizes.size() > 1 ? ", and more the smaller the block" : "");
  }
  return content;
}

}  // namespace reports::lattice
