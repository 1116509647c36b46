#include "reports/figure.h"

#include <algorithm>
#include <cmath>

namespace reports {

const dem::Record* StudyResult::find(std::string_view id) const {
  const auto found = std::ranges::find(cases, id, &CaseResult::id);
  return found == cases.end() ? nullptr : found->record;
}

double StudyResult::published_value(std::string_view id) const {
  const auto found = std::ranges::find(published, id, &PublishedNumber::id);
  return found == published.end() ? std::nan("") : found->low;
}

const LaboratoryNumber* StudyResult::measured(std::string_view key, std::string_view mineral) const {
  const auto found = std::ranges::find_if(
      laboratory, [&](const LaboratoryNumber& one) { return one.key == key && one.mineral == mineral; });
  return found == laboratory.end() ? nullptr : &*found;
}

namespace {

// Charts beside each other: one height, and frames of one height in it, whatever the legends below them take.
void match(render::Chart& a, render::Chart& b) {
  a.height = b.height = std::max(a.height, b.height);
  const double more = render::plot_height(a) - render::plot_height(b);
  render::Chart& lower = more > 0 ? b : a;
  render::Chart& other = more > 0 ? a : b;
  other.foot = static_cast<int>(std::lround(std::abs(more)));
  lower.height += other.foot;
  other.height = lower.height;
  // With more room a legend may stand in the frame of its data, not below it.
  constexpr double alike = 2;  // px
  if (render::plot_height(lower) > render::plot_height(other) + alike) other.foot = 0;
}

}  // namespace

void lay_out(std::vector<Panel>& panels) {
  const auto half = [](const Panel& panel) {
    const bool drawn =
        std::holds_alternative<render::Chart>(panel.content) || std::holds_alternative<std::string>(panel.content);
    return drawn && (panel.per_row == 2 || panel.per_row == 0);
  };
  const auto whole = [](Panel& panel) {
    if (auto* chart = std::get_if<render::Chart>(&panel.content)) chart->width = render::page_width;
    panel.per_row = 1;
    panel.whole_width = true;
  };
  for (std::size_t i = 0; i < panels.size();) {
    auto* first = std::get_if<render::Chart>(&panels[i].content);
    if (!half(panels[i])) {
      if (first) whole(panels[i]);
      ++i;
      continue;
    }
    if (i + 1 == panels.size() || !half(panels[i + 1])) {
      if (first) whole(panels[i]);
      ++i;
      continue;
    }
    auto* second = std::get_if<render::Chart>(&panels[i + 1].content);
    for (Panel* panel : {&panels[i], &panels[i + 1]}) {
      if (auto* chart = std::get_if<render::Chart>(&panel->content)) chart->width = render::column_width;
      panel->per_row = 2;
    }
    if (first && second) match(*first, *second);
    i += 2;
  }
}

}  // namespace reports
