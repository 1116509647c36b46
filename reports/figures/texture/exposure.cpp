// Cracks by number, by contact and by area, and which groups of contacts crack more often than their number says.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/analysis/cracking.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

using analysis::Cracking;
using Group = Cracking::Group;

struct Measure {
  std::string_view label;
  double Cracking::Class::*of;
};
constexpr std::array measures{Measure{"by number of cracks", &Cracking::Class::number},
                              Measure{"by contacts cracked", &Cracking::Class::contacts},
                              Measure{"by crack area", &Cracking::Class::area}};

// Groups with fewer contacts have a quotient that a few cracks decide.
constexpr double least_share = 0.01;

struct Moment {
  std::string id, title, said;
  Cracking cracking;
};

// The peak, where the record says which cracks there were by then, and the end of loading.
std::vector<Moment> moments_of(const dem::Record& record) {
  std::vector<Moment> moments;
  const bool has_peak = std::ranges::any_of(record.tables, [](const dem::Table& table) {
    return table.name.starts_with("snapshots/") && table.attribute("moment") == "peak";
  });
  if (has_peak) moments.push_back({"peak", "At the peak", "at the peak", analysis::cracking_until(record, "peak")});
  moments.push_back({"end", "At the end of loading", "at the end of loading", analysis::cracking_until(record, "")});
  std::erase_if(moments, [](const Moment& moment) { return !(moment.cracking.all().number > 0); });
  return moments;
}

const Cracking::Class& class_of(const Cracking& cracking, const CrackClass& one) {
  return cracking.classes.at(static_cast<std::size_t>(one.place)).at(static_cast<std::size_t>(one.mode));
}

double share_of(const Cracking& cracking, const CrackClass& one, const Measure& measure) {
  return 100 * class_of(cracking, one).*measure.of / (cracking.all().*measure.of);
}

// Of inter-grain cracks, %.
double inter_share(const Cracking& cracking, const Measure& measure) {
  double sum = 0;
  for (const CrackClass& one : crack_classes())
    if (one.place == 1) sum += share_of(cracking, one, measure);
  return sum;
}

double inter_share_of_contacts(const Cracking& cracking) {
  double sum = 0;
  for (const Group& group : cracking.groups)
    if (group.place == 1) sum += group.contacts;
  return 100 * sum / cracking.contacts();
}

render::Chart chart_of(const Cracking& cracking) {
  render::Bars bars;
  for (const CrackClass& one : crack_classes()) bars.categories.emplace_back(one.name);
  for (const Measure& measure : measures) {
    bars.labels.emplace_back(measure.label);
    bars.colours.push_back(render::ordered(bars.colours.size(), measures.size()));
    std::vector<double> values;
    for (const CrackClass& one : crack_classes()) values.push_back(share_of(cracking, one, measure));
    bars.values.push_back(std::move(values));
  }
  bars.print_values = true;
  render::Chart chart;
  chart.x.title = "Class of crack";
  chart.left.title = "Share (%)";
  chart.bars = std::move(bars);
  chart.legend = render::Chart::Legend::below;
  return chart;
}

TextTable class_table(const std::vector<Moment>& moments) {
  TextTable table{{"Class"}, {}};
  for (const Moment& moment : moments)
    for (const Measure& measure : measures)
      table.head.push_back(fmt::format("{}, {} (%)", moment.title, measure.label));
  const auto add = [&](std::string name, const auto& value) {
    std::vector<std::string> row{std::move(name)};
    for (const Moment& moment : moments)
      for (const Measure& measure : measures) row.push_back(fixed(value(moment.cracking, measure), 1));
    table.rows.push_back(std::move(row));
  };
  for (const CrackClass& one : crack_classes())
    add(std::string(one.name),
        [&](const Cracking& cracking, const Measure& measure) { return share_of(cracking, one, measure); });
  add("inter-grain, both modes", inter_share);
  std::vector<std::string> all{"cracks, contacts, mm²"};
  for (const Moment& moment : moments) {
    const Cracking::Class sum = moment.cracking.all();
    all.push_back(count(sum.number));
    all.push_back(count(sum.contacts));
    all.push_back(number(1e6 * sum.area, 3));
  }
  table.rows.push_back(std::move(all));
  return table;
}

std::string name_of(const Group& group, const std::vector<std::string>& minerals) {
  const auto name = [&](std::int32_t mineral) { return minerals.at(static_cast<std::size_t>(mineral)); };
  if (group.place == 0) return "inside " + name(group.first);
  return group.first == group.second ? "two grains of " + name(group.first)
                                     : name(group.first) + " – " + name(group.second);
}

TextTable group_table(const std::vector<Moment>& moments, const std::vector<std::string>& minerals) {
  TextTable table{{"Contacts", "Of all contacts (%)"}, {}};
  for (const Moment& moment : moments) {
    table.head.push_back(moment.title + ", of all cracked contacts (%)");
    table.head.push_back(moment.title + ", quotient");
    table.head.push_back(moment.title + ", cracked (%)");
  }
  const Cracking& last = moments.back().cracking;
  for (std::size_t k = 0; k < last.groups.size(); ++k) {
    const Group& group = last.groups[k];
    std::vector<std::string> row{name_of(group, minerals), fixed(100 * group.contacts / last.contacts(), 1)};
    for (const Moment& moment : moments) {
      const Group& then = moment.cracking.groups[k];  // all contacts are there from the beginning
      row.push_back(fixed(100 * then.cracked / moment.cracking.all().contacts, 1));
      row.push_back(fixed(moment.cracking.exposure(then), 2));
      row.push_back(fixed(100 * then.cracked / then.contacts, 1));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Inter-grain shares by each measure, a row a case.
TextTable case_table(const std::vector<SeriesCase>& cases) {
  TextTable table{{"Case", "Inter-grain contacts, of all (%)"}, {}};
  std::vector<std::string> titles;
  for (const SeriesCase& item : cases) {
    for (const Moment& moment : moments_of(*item.record))
      if (std::ranges::find(titles, moment.title) == titles.end()) titles.push_back(moment.title);
  }
  std::ranges::sort(titles, std::ranges::greater());  // the peak before the end
  for (const std::string& title : titles)
    for (const Measure& measure : measures) table.head.push_back(fmt::format("{}, {} (%)", title, measure.label));
  for (const SeriesCase& item : cases) {
    const auto moments = moments_of(*item.record);
    if (moments.empty()) continue;
    std::vector<std::string> row{item.label, fixed(inter_share_of_contacts(moments.back().cracking), 1)};
    for (const std::string& title : titles) {
      const auto found = std::ranges::find(moments, title, &Moment::title);
      for (const Measure& measure : measures)
        row.push_back(found == moments.end() ? "–" : fixed(inter_share(found->cracking, measure), 1));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Which groups crack most and least often for their number.
std::string extremes(const Cracking& cracking, const std::vector<std::string>& minerals) {
  std::vector<Group> groups = cracking.groups;
  std::erase_if(groups, [&](const Group& one) { return one.contacts < least_share * cracking.contacts(); });
  if (groups.size() < 2) return {};
  const auto [least, most] =
      std::ranges::minmax_element(groups, {}, [&](const Group& g) { return cracking.exposure(g); });
  return fmt::format(
      " Among the groups with at least {} of the contacts, “{}” cracks most often for its number "
      "(quotient {}) and “{}” least often ({}).",
      percent(least_share, 0), name_of(*most, minerals), number(cracking.exposure(*most), 3), name_of(*least, minerals),
      number(cracking.exposure(*least), 3));
}

}  // namespace

FigureContent crack_exposure(const StudyResult& study) {
  FigureContent content;
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  std::vector<SeriesCase> cases = swept(study, test_compression);
  std::erase_if(cases, [](const SeriesCase& item) { return moments_of(*item.record).empty(); });
  if (cases.empty()) {
    if (content.panels.empty()) content.panels.push_back(note_panel("none", "Cracks.", "There are no cracks."));
    return content;
  }
  const SeriesCase& base = cases.front();
  const auto moments = moments_of(*base.record);
  const auto minerals = minerals_of(*base.record);
  const std::string of = cases.size() > 1 ? capital(base.label) + first_seed(cases) + ": " : "";
  const std::string how =
      " A joint inside a grain has three elements that crack one by one, a boundary one bond. A contact counts once, "
      "in "
      "the class of its first crack.";
  for (const Moment& moment : moments) {
    std::vector<std::string> said;
    for (const Measure& measure : measures)
      said.push_back(fmt::format("{} % {}", number(inter_share(moment.cracking, measure), 3), measure.label));
    content.panels.push_back({.id = moment.id,
                              .caption = capital(of + "shares of the classes " + moment.said + ".") + how,
                              .alt = "Inter-grain cracks: " + listed(said) + ".",
                              .content = chart_of(moment.cracking),
                              .per_row = 2});
  }
  content.panels.push_back(
      {.id = "classes",
       .caption = capital(of + "shares of the classes of cracks, each measure adding up to 100 %; in the last row "
                               "what they are shares of."),
       .alt = "",
       .content = class_table(moments),
       .per_row = 1});
  content.panels.push_back(
      {.id = "groups",
       .caption = capital(of + "exposure of the groups of contacts. The quotient is the share of all cracked "
                               "contacts over the share of all contacts: above 1, the group cracks more often than "
                               "contacts do in the mean."),
       .alt = "",
       .content = group_table(moments, minerals),
       .per_row = 1});
  if (cases.size() > 1) {
    content.panels.push_back({.id = "between_grains",
                              .caption = "Inter-grain cracks, of all cracks" + first_seed(cases) + ".",
                              .alt = "",
                              .content = case_table(cases),
                              .per_row = 1});
  }
  const Moment& last = moments.back();
  content.finding = fmt::format(
      "{}, {}, inter-grain cracks are {} % of all by number, {} % by contact and {} % by area; inter-grain contacts "
      "are {} % of "
      "all.{}",
      capital(at_case(base)), last.said, number(inter_share(last.cracking, measures[0]), 3),
      number(inter_share(last.cracking, measures[1]), 3), number(inter_share(last.cracking, measures[2]), 3),
      number(inter_share_of_contacts(last.cracking), 3), extremes(last.cracking, minerals));
  return content;
}

}  // namespace reports::texture
