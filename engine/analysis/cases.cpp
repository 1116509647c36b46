#include "engine/analysis/cases.h"

#include <algorithm>
#include <array>

namespace dem::analysis {
namespace {

constexpr std::string_view seed = "seed";

bool same(const Parameters& parameters, std::string_view id, const ParameterValue& value) {
  const ParameterValue* own = find_value(parameters, id);
  return own && *own == value;
}

bool all_in(const Parameters& a, const Parameters& b, std::span<const std::string_view> but) {
  return std::ranges::all_of(
      a, [&](const auto& p) { return std::ranges::find(but, p.first) != but.end() || same(b, p.first, p.second); });
}

}  // namespace

std::string_view CaseResult::test() const {
  const ParameterValue* value = find_value(parameters, "test");
  const auto* name = value ? std::get_if<std::string>(value) : nullptr;
  return name ? std::string_view(*name) : std::string_view();
}

bool alike(const Parameters& a, const Parameters& b, std::span<const std::string_view> but) {
  return all_in(a, b, but) && all_in(b, a, but);
}

std::vector<Repeats> repeats_of(std::span<const CaseResult* const> cases) {
  constexpr std::array but{seed};
  std::vector<Repeats> groups;
  for (const CaseResult* one : cases) {
    const auto group = std::ranges::find_if(
        groups, [&](const Repeats& g) { return alike(g.front()->parameters, one->parameters, but); });
    if (group == groups.end()) {
      groups.push_back({one});
    } else {
      group->push_back(one);
    }
  }
  return groups;
}

std::vector<const CaseResult*> select(std::span<const CaseResult> cases, const Selector& selector, const Usual& usual) {
  std::vector<const CaseResult*> chosen;
  for (const CaseResult& one : cases) {
    const bool named =
        std::ranges::all_of(selector.named, [&](const auto& p) { return same(one.parameters, p.first, p.second); });
    const bool others = std::ranges::all_of(usual.values, [&](const auto& p) {
      const bool asked = p.first == seed || find_value(selector.named, p.first);
      return asked || !find_value(one.parameters, p.first) || same(one.parameters, p.first, p.second);
    });
    if (named && others) chosen.push_back(&one);
  }
  return chosen;
}

}  // namespace dem::analysis
