// Whether the checks of the runs held, and what limits the runs note.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "reports/page/page_parts.h"
#include "reports/page/page_tables.h"
#include "reports/text.h"

namespace reports {
namespace {

// In the middle of a sentence.
std::string check_name(std::string_view id) { return id == "quasi_static" ? "quasi-static loading" : words(id); }

/// A note in the words of today: records are kept when a sentence is mended.
std::string in_present_words(std::string note) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> mended{
      {{" or more leave an inside that the ends and the surface do not reach.",
        " are needed for an interior free of end and surface effects."},
       {" or more show its shape, and what is inside and between grains.", " are needed to resolve their shape."},
       {"A grain has ", "Grains average "},
       {" particles in the mean; ", " particles; at least "}}};
  const auto old = [&](std::string_view part) { return note.find(part) != std::string::npos; };
  const bool across = old(mended[0].first);
  if (!across && !old(mended[1].first)) return note;
  for (const auto& [before, now] : mended) {
    if (const std::size_t at = note.find(before); at != std::string::npos) note.replace(at, before.size(), now);
  }
  if (const std::size_t at = note.find("specimen; "); across && at != std::string::npos)
    note.insert(at + std::string_view("specimen; ").size(), "at least ");
  return note;
}

}  // namespace

bool checks_held(const StudyResult& study) {
  return std::ranges::all_of(study.cases, [](const CaseResult& result) {
    return !result.record || std::ranges::all_of(result.record->checks, &dem::Check::held);
  });
}

std::string checks_summary(const StudyResult& study) {
  std::size_t checks = 0, broken_checks = 0;
  std::vector<std::pair<std::string, std::vector<std::string>>> broken;  // by check
  for (const CaseResult& result : study.cases) {
    if (!result.record) continue;
    for (const dem::Check& check : result.record->checks) {
      ++checks;
      if (check.held) continue;
      ++broken_checks;
      auto group = std::ranges::find(broken, check.id, [](const auto& g) { return g.first; });
      if (group == broken.end()) group = broken.insert(broken.end(), {check.id, {}});
      group->second.push_back(result.id);
    }
  }
  if (checks == 0) return {};
  if (broken.empty()) {
    return checks == 1   ? "The check of the run held."
           : checks == 2 ? "Both checks of the runs held."
                         : fmt::format("All {} checks of the runs held.", checks);
  }
  std::vector<std::string> parts;
  for (const auto& [check, cases] : broken) parts.push_back(check_name(check) + " (" + joined(cases, ", ") + ")");
  return fmt::format("{} of {} checks did not hold: {}.", broken_checks, checks, joined(parts, "; "));
}

PageData checks_data(const StudyResult& study) {
  // By check, so that its name and its meaning are said once.
  std::vector<std::pair<const CaseResult*, const dem::Check*>> all;
  for (const CaseResult& result : study.cases) {
    if (!result.record) continue;
    for (const dem::Check& check : result.record->checks) all.emplace_back(&result, &check);
  }
  std::ranges::stable_sort(all, {}, [](const auto& entry) { return entry.second->id; });
  PageData list = new_list();
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    const dem::Check& first = *all[begin].second;
    while (end < all.size() && all[end].second->id == first.id) ++end;
    const std::span members(all.data() + begin, end - begin);
    const bool powers = std::ranges::any_of(
        members, [](const auto& one) { return needs_powers(one.second->value) || needs_powers(one.second->limit); });
    const auto text = [&](double value, int digits) {
      return powers ? scientific(value, digits) : number(value, digits);
    };
    int digits = 2;  // as many as tell a value from its limit
    for (const auto& [result, check] : members) {
      while (digits < 5 && check->value != check->limit && text(check->value, digits) == text(check->limit, digits))
        ++digits;
    }
    const auto amount = [&](double value) { return text(value, digits); };
    PageData rows = new_list();
    for (const auto& [result, check] : members) {
      PageData item;
      item.set("case", result->id);
      item.set("value", amount(check->value));
      item.set("limit", amount(check->limit));
      item.set("verdict", check->held ? "held" : "broken");
      item.set("verdict_class", check->held ? "met" : "missed");
      rows.push_back(item);
    }
    PageData group;
    group.set("check", capital(check_name(first.id)));
    group.set("meaning", first.meaning);
    group.set("short", is_short(members.size()));
    group.set("rows", rows);
    list.push_back(group);
  }
  return list;
}

PageData notes_data(const StudyResult& study) {
  std::vector<std::pair<std::string, std::vector<std::string>>> said;  // each note, with the cases that have it
  for (const CaseResult& result : study.cases) {
    if (!result.record) continue;
    for (const std::string& kept : result.record->notes) {
      const std::string note = in_present_words(kept);
      auto same = std::ranges::find(said, note, [](const auto& one) { return one.first; });
      if (same == said.end()) same = said.insert(said.end(), {note, {}});
      same->second.push_back(result.id);
    }
  }
  PageData list = new_list();
  for (const auto& [note, cases] : said) {
    PageData item;
    item.set("case", cases.size() > 1 && cases.size() == study.cases.size() ? "all cases" : joined(cases, ", "));
    item.set("note", note);
    list.push_back(item);
  }
  return list;
}

}  // namespace reports
