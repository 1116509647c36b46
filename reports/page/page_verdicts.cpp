// Ours beside what is published, and beside what the user's laboratory measured.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/page/page_cases.h"
#include "reports/page/page_parts.h"
#include "reports/page/page_tables.h"
#include "reports/published/laboratory.h"
#include "reports/text.h"

namespace reports {
namespace {

/// "46.794 × 10⁶ N/m", "206.8 MPa".
std::string with_unit(const std::string& amount, const std::string& unit) {
  if (unit.empty()) return amount;
  std::string whole(unit);  // not broken behind a stroke
  for (std::size_t at = 0; (at = whole.find('/', at)) != std::string::npos; at += 4) whole.insert(at + 1, "\u2060");
  return amount + (unit.starts_with("10") ? " × " : " ") + whole;
}

// The limits of what is published in words are small print: they are ours.
std::string amount_of(const Comparison& row) {
  if (const auto* text = std::get_if<std::string>(&row.published)) return *text;
  if (const auto* range = std::get_if<std::pair<double, double>>(&row.published)) {
    const std::string low = range->first == 0 ? "at most " : shortest(range->first) + " to ";
    return with_unit(low + shortest(range->second), row.unit);
  }
  return with_unit(shortest(std::get<double>(row.published)), row.unit);
}

std::string published_text(const Comparison& row) {
  return row.stated.empty() ? amount_of(row) : "“" + row.stated + "”";
}

std::string published_detail(const Comparison& row) {
  if (!row.stated.empty()) return "read as " + amount_of(row);
  if (row.derived.empty()) return row.published_detail;
  return joined_notes({row.published_detail, "derived: " + row.derived});
}

// Three significant digits, or as many as the published number has.
std::string computed_text(const Comparison& row) {
  if (!row.computed) return "–";
  if (const auto* text = std::get_if<std::string>(&*row.computed)) return *text;
  const double ours = std::get<double>(*row.computed);
  std::size_t digits = 3;
  if (const auto* published = std::get_if<double>(&row.published)) {
    const bool whole = std::floor(*published) == *published && std::floor(ours) == ours;
    if (whole && row.unit.empty()) return count(ours);
    const std::string text = shortest(*published);
    const std::string significant = text.substr(std::min(text.find_first_of("123456789"), text.size()));
    const auto figures =
        static_cast<std::size_t>(std::ranges::count_if(significant, [](char c) { return c >= '0' && c <= '9'; }));
    digits = std::max(digits, figures);
    // Of a count, ours is a mean of seeds: no more than one decimal.
    if (row.unit.empty() && std::floor(*published) == *published && std::abs(*published) >= 100 && std::abs(ours) >= 1)
      digits = std::min(digits, static_cast<std::size_t>(std::floor(std::log10(std::abs(ours)))) + 2);
  }
  return with_unit(number(ours, static_cast<int>(digits)), row.unit);
}

// Of a share of something, "%" becomes points.
std::string difference_unit(const std::string& unit, double amount) {
  return unit != "%" ? unit : std::abs(amount) == 1 ? "point" : "points";
}

std::string tolerance_text(const Comparison& row) {
  if (!row.tolerance) return row.estimate && row.estimate->has_interval() ? "by interval" : "–";
  constexpr double rounding = 1e-6;  // a tolerance that lets only rounding pass
  if (*row.tolerance <= rounding) return "none";
  if (row.relative) return "± " + shortest(100 * *row.tolerance) + " %";
  return with_unit("± " + shortest(*row.tolerance), difference_unit(row.unit, *row.tolerance));
}

// What a row is, where it does not count as met or missed.
std::string role_text(const Comparison& row, const std::vector<Comparison>& rows) {
  switch (row.role) {
    case Role::fitted:
      return "Fitted: " + row.why;
    case Role::theory:
      return "Theory: " + row.why;
    case Role::follows: {
      std::vector<std::string> names;
      for (const std::string& id : row.of) {
        const auto other = std::ranges::find(rows, id, &Comparison::id);
        if (other != rows.end()) names.push_back("“" + other->quantity + "”");
      }
      return "Follows from " + (names.empty() ? "others" : listed(names)) + ".";
    }
    case Role::stated:
    case Role::derived:
    case Role::sensitivity:
    case Role::number:
      break;
  }
  return {};
}

std::string verdict_class(const Comparison& row) {
  const std::string state = row.verdict == Verdict::met         ? "met"
                            : row.verdict == Verdict::missed    ? "missed"
                            : row.verdict == Verdict::undecided ? "undecided"
                                                                : "open";
  return row.role == Role::number ? state : state + " apart " + std::string(role_word(row.role));
}

}  // namespace

std::string deviation_text(const Comparison& row) {
  if (!row.deviation) return "–";
  if (*row.deviation == 0 && std::holds_alternative<std::pair<double, double>>(row.published)) return "within";
  // As fine as the tolerance: 0.017 % of 0.05 % is not 0.
  const int decimals = row.tolerance && *row.tolerance > 1e-6 && *row.tolerance < 1e-3 ? 3 : 1;
  if (row.relative) return with_sign(fixed(100 * *row.deviation, decimals)) + " %";
  constexpr double tens = 10;  // 99.9 points are not 100
  const int digits = std::abs(*row.deviation) < tens ? 2 : 3;
  std::string shown = number(*row.deviation, digits);
  // No finer than ours is printed: 50.1 % is 0.1 points from 50 %, not 0.068.
  const std::string ours = computed_text(row);
  const std::string_view amount = std::string_view(ours).substr(0, ours.find_first_not_of("−0123456789.\u2212"));
  if (const std::size_t point = amount.find('.');
      point != std::string_view::npos && ours.find("×") == std::string::npos) {
    const auto most = static_cast<int>(amount.size() - point - 1);
    const std::size_t own = shown.find('.');
    if (own != std::string::npos && shown.find("×") == std::string::npos &&
        static_cast<int>(shown.size() - own - 1) > most)
      shown = fixed(*row.deviation, most);
  }
  return with_unit(with_sign(shown), difference_unit(row.unit, *row.deviation));
}

PageData comparisons_data(const Comparisons& comparisons) {
  if (comparisons.rows.empty()) return PageData{PageData::type::list};
  PageData rows = new_list();
  for (const Comparison& row : comparisons.rows) {
    const bool reading = row.role == Role::sensitivity;
    const std::string role = role_text(row, comparisons.rows);
    PageData item;
    item.set("quantity", reading ? "— " + row.reading : row.quantity);
    item.set("source", reading ? "" : row.source);
    item.set("statement", joined_notes({row.statement, role}));
    item.set("has_statement", !row.statement.empty() || !role.empty());
    item.set("published_value", reading ? "" : published_text(row));
    const std::string small = published_detail(row);
    item.set("published_detail", small);
    item.set("has_published_detail", !reading && !small.empty());
    // One against the other: both numbers say more than the word.
    const std::size_t both =
        row.kind == "greater" && row.computed ? std::min(row.detail.find("; "), row.detail.size()) : 0;
    const std::string detail = row.detail.substr(both == 0 ? 0 : std::min(both + 2, row.detail.size()));
    item.set("computed_value", both == 0 ? computed_text(row) : row.detail.substr(0, both));
    item.set("detail", detail);
    item.set("has_detail", !detail.empty());
    const std::string deviation = deviation_text(row), tolerance = reading ? "" : tolerance_text(row);
    item.set("deviation", deviation);
    item.set("tolerance", tolerance);
    // Words where there is neither have the room of all three.
    const bool number = row.computed && std::holds_alternative<double>(*row.computed);
    item.set("across", !row.computed || (deviation == "–" && (reading || tolerance == "–") && !number));
    // Another reading has no verdict of its own.
    item.set("verdict", reading ? "" : std::string(verdict_word(row.verdict)));
    item.set("has_verdict", !reading);
    item.set("role", row.role == Role::number || reading ? "" : std::string(role_word(row.role)));
    item.set("has_role", row.role != Role::number && !reading);
    item.set("verdict_class", verdict_class(row));
    rows.push_back(item);
  }
  PageData block;
  block.set("paper", comparisons.paper);
  block.set("published_scale", comparisons.scale);
  block.set("counts", tally_text(comparisons.tally(), comparisons.scale));
  // What the rows need to be read, and no more.
  const auto any = [&](auto is) { return std::ranges::any_of(comparisons.rows, is); };
  block.set("has_intervals", any([](const Comparison& row) { return row.estimate && row.estimate->has_interval(); }));
  block.set("has_trends", any([](const Comparison& row) { return row.kind == "trend"; }));
  block.set("has_fits", any([](const Comparison& row) { return row.detail.find(" of the fit") != std::string::npos; }));
  block.set("has_readings", any([](const Comparison& row) { return row.role == Role::sensitivity; }));
  block.set("rows", rows);
  PageData list = new_list();
  list.push_back(block);
  return list;
}

namespace {

// As from what is published: of a range, from its nearer end.
std::string laboratory_deviation(const LaboratoryRow& row) {
  const LaboratoryNumber& number = row.number;
  const double ours = row.ours->value;
  const double near = number.is_range ? std::clamp(ours, number.low, number.high) : number.value;
  if (number.is_range && near == ours) return "within";
  return near != 0 ? with_sign(percent(ours / near - 1)) : "";
}

}  // namespace

PageData laboratory_data(const StudyResult& study) {
  PageData list = new_list();
  const std::vector<LaboratoryRow> found = beside_laboratory(study);
  if (found.empty()) return list;
  const bool small = is_small(*study.scenario);  // neutral badges
  PageData rows = new_list();
  for (const LaboratoryRow& row : found) {
    PageData item;
    item.set("quantity", laboratory_name(row.number));
    item.set("measured", laboratory_text(row.number));
    item.set("ours", row.ours ? with_unit(number(row.ours->value, 3), std::string(row.number.unit)) : "–");
    std::string detail;
    if (row.ours && row.seeds > 0) detail = row.seeds == 1 ? "one seed" : fmt::format("mean of {} seeds", row.seeds);
    if (row.ours && row.ours->has_interval()) {
      detail += (detail.empty() ? "" : "; ") +
                fmt::format("95 % interval {} to {}", number(row.ours->low, 3), number(row.ours->high, 3));
    }
    item.set("detail", detail);
    item.set("has_detail", !detail.empty());
    item.set("deviation", row.ours ? laboratory_deviation(row) : std::string());
    item.set("verdict", std::string(laboratory_word(row.verdict)));
    item.set("verdict_class", small                               ? "open"
                              : row.verdict == Verdict::met       ? "met"
                              : row.verdict == Verdict::missed    ? "missed"
                              : row.verdict == Verdict::undecided ? "undecided"
                                                                  : "open");
    rows.push_back(item);
  }
  PageData block;
  block.set("has_deviations", std::ranges::any_of(found, [](const LaboratoryRow& row) {
              return laboratory_text(row.number).find("±") != std::string::npos;
            }));
  block.set("counts", laboratory_tally(found, small ? study.scenario->scale() : ""));
  block.set("source", laboratory_source(*study.scenario));
  block.set("rows", rows);
  list.push_back(block);
  return list;
}

}  // namespace reports
