#include "reports/published/verdict.h"

#include <fmt/format.h>

#include "reports/text.h"

namespace reports {

std::string_view verdict_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::met:
      return "met";
    case Verdict::missed:
      return "missed";
    case Verdict::undecided:
      return "undecided";
    case Verdict::not_judged:
      return "not judged";
    case Verdict::not_computed:
      break;
  }
  return "not computed";
}

std::string_view role_word(Role role) {
  switch (role) {
    case Role::fitted:
      return "fitted";
    case Role::theory:
      return "theory";
    case Role::stated:
      return "stated";
    case Role::derived:
      return "derived";
    case Role::follows:
      return "follows";
    case Role::sensitivity:
      return "sensitivity";
    case Role::number:
      break;
  }
  return "number";
}

Verdict judge_value(double ours, const std::optional<dem::analysis::Estimate>& interval, const Band& band) {
  if (!interval || !interval->has_interval()) {
    return ours >= band.low && ours <= band.high ? Verdict::met : Verdict::missed;
  }
  if (interval->low >= band.low && interval->high <= band.high) return Verdict::met;
  if (interval->high < band.low || interval->low > band.high) return Verdict::missed;
  return Verdict::undecided;
}

Verdict judge_sign(const dem::analysis::Estimate& ours, int sign, bool by_chance) {
  if (!ours.has_interval()) {
    if (by_chance) return Verdict::undecided;
    return sign * ours.value > 0 ? Verdict::met : Verdict::missed;
  }
  const double least = sign > 0 ? ours.low : -ours.high, most = sign > 0 ? ours.high : -ours.low;
  if (least > 0) return Verdict::met;
  return most <= 0 ? Verdict::missed : Verdict::undecided;
}

void Tally::add(Role role, Verdict verdict, bool is_trend) {
  if (role == Role::fitted) ++fitted;
  if (role == Role::theory) ++theory;
  if (role == Role::stated) {
    ++stated;
    stated_met += verdict == Verdict::met ? 1 : 0;
    stated_missed += verdict == Verdict::missed ? 1 : 0;
    stated_undecided += verdict == Verdict::undecided ? 1 : 0;
    stated_not_computed += verdict == Verdict::not_computed ? 1 : 0;
  }
  if (role == Role::derived) ++derived;
  if (role == Role::follows) ++follows;
  if (verdict == Verdict::not_computed) {
    fitted_not_computed += role == Role::fitted ? 1 : 0;
    theory_not_computed += role == Role::theory ? 1 : 0;
    derived_not_computed += role == Role::derived ? 1 : 0;
    follows_not_computed += role == Role::follows ? 1 : 0;
  }
  if (role != Role::number) return;
  trends += is_trend ? 1 : 0;
  switch (verdict) {
    case Verdict::met:
      ++met;
      break;
    case Verdict::missed:
      ++missed;
      break;
    case Verdict::undecided:
      ++undecided;
      break;
    case Verdict::not_judged:
      ++not_judged;
      break;
    case Verdict::not_computed:
      ++not_computed;
      break;
  }
}

namespace {

// "4 published in words, all met (the limits are ours)"
std::string stated_text(const Tally& counts) {
  std::vector<std::string> parts;
  if (counts.stated_met > 0 && counts.stated_met < counts.stated)
    parts.push_back(fmt::format("{} met", counts.stated_met));
  for (const auto& [number, word] : {std::pair{counts.stated_missed, "missed"},
                                     {counts.stated_undecided, "undecided"},
                                     {counts.stated_not_computed, "not computed"}}) {
    if (number > 0) parts.push_back(fmt::format("{} {}", number, word));
  }
  return fmt::format("{} published in words{} (the limits are ours{})", counts.stated,
                     counts.stated_met != counts.stated ? ""
                     : counts.stated == 1               ? ", met"
                                                        : ", all met",
                     parts.empty() ? "" : "; " + joined(parts, ", "));
}

}  // namespace

std::string tally_text(const Tally& counts, std::string_view scale) {
  const int all = counts.numbers();
  const std::string_view numbers = counts.trends > 0 ? "numbers and trends" : "numbers";
  std::string text;
  if (all > 0 && counts.not_judged == all) {
    text = all == 1 ? fmt::format("The one published number is not judged: it belongs to the scale “{}”.", scale)
                    : fmt::format("None of the {} published {} is judged: they belong to the scale “{}”.", all, numbers,
                                  scale);
  } else if (all > 1 && counts.not_computed == all) {
    text = fmt::format("None of the {} published {} can be computed from the cases of this run.", all, numbers);
  } else if (all > 0) {
    std::vector<std::string> parts;
    const auto say = [&](int number, std::string_view what, bool always = false) {
      if (number == 0 && !always) return;
      const std::string verb = !parts.empty() ? "" : number > 1 ? "are " : "is ";
      parts.push_back(fmt::format("{} {}{}", number == 0 ? "none" : std::to_string(number), verb, what));
    };
    say(counts.met, "met", counts.missed + counts.undecided > 0);
    say(counts.missed, "missed");
    say(counts.undecided, "undecided");
    say(counts.not_judged, fmt::format("not judged (published at {} scale)", scale));
    say(counts.not_computed, "not computed");
    text = all == 1 ? fmt::format("Of one published number, {}.", listed(parts))
                    : fmt::format("Of {} published {}, {}.", all, numbers, listed(parts));
  }
  std::vector<std::string> apart;
  if (counts.stated > 0) apart.push_back(stated_text(counts));
  const auto say_apart = [&](int number, int not_computed, std::string_view one, std::string_view many) {
    if (number == 0) return;
    apart.push_back(fmt::format("{} {}{}", number, number == 1 ? one : many,
                                not_computed > 0 ? fmt::format(" ({} not computed)", not_computed) : ""));
  };
  say_apart(counts.derived, counts.derived_not_computed, "derived from published numbers",
            "derived from published numbers");
  say_apart(counts.follows, counts.follows_not_computed, "that follows from another", "that follow from others");
  say_apart(counts.fitted, counts.fitted_not_computed, "to which a choice was fitted", "to which a choice was fitted");
  say_apart(counts.theory, counts.theory_not_computed, "that checks a formula", "that check a formula");
  if (!apart.empty()) text += (text.empty() ? "Counted separately: " : " Counted separately: ") + listed(apart) + ".";
  return text;
}

}  // namespace reports
