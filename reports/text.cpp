#include "reports/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace reports {
namespace {

constexpr std::string_view minus_sign = "\u2212";
constexpr std::string_view thin_space = "\u202f";

// "-12345.6" -> "−12 345.6"
std::string dressed(const std::string& plain) {
  std::string text;
  std::size_t start = 0;
  if (!plain.empty() && plain[0] == '-') {
    start = 1;
    if (plain.find_first_not_of("0.", 1) != std::string::npos) text += minus_sign;
  }
  const std::size_t end = std::min(plain.find('.', start), plain.size());
  const bool grouped = end - start > 4;
  for (std::size_t i = start; i < end; ++i) {
    text += plain[i];
    if (grouped && i + 1 < end && (end - i - 1) % 3 == 0) text += thin_space;
  }
  return text + plain.substr(end);
}

}  // namespace

std::string power_of_ten(int exponent) {
  constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

bool needs_powers(double value) {
  const double size = std::abs(value);
  return std::isfinite(value) && value != 0 && !(size >= 1e-4 && size < 1e7);
}

namespace {

// Halves are rounded away from zero, as a reader checks them, though binary fractions lie to either side of them.
double halves_away(double value) { return value * (1 + 1e-12); }

}  // namespace

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "not a number";
  if (value == 0) return "0";
  if (needs_powers(value)) return scientific(value, digits);
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  return dressed(fmt::format("{:.{}f}", halves_away(value), std::max(0, digits - before)));
}

std::string scientific(double value, int digits) {
  if (!std::isfinite(value)) return "not a number";
  if (value == 0) return "0";
  const std::string text = fmt::format("{:.{}e}", halves_away(value), std::max(0, digits - 1));
  const std::size_t e = text.find('e');
  return dressed(text.substr(0, e)) + " × " + power_of_ten(std::stoi(text.substr(e + 1)));
}

std::string fixed(double value, int places) {
  return std::isfinite(value) ? dressed(fmt::format("{:.{}f}", halves_away(value), places)) : "not a number";
}

std::string percent(double fraction, int places) { return fixed(100 * fraction, places) + " %"; }

std::string with_sign(std::string text) {
  const bool nothing = text.substr(0, text.find(' ')).find_first_not_of("0.") == std::string::npos;
  return nothing || text.starts_with(minus_sign) ? text : "+" + text;
}

std::string shortest(double value) { return dressed(fmt::format("{:.9g}", value)); }

std::string p_cell(double p, int draws) {
  const double least = 1.0 / draws;
  return p < least ? "< " + number(least, 1) : number(p, 2);
}

std::string p_text(double p, int draws) {
  const std::string cell = p_cell(p, draws);
  return cell.starts_with('<') ? "p " + cell : "p = " + cell;
}

std::string count(double value) { return fixed(value, 0); }

std::string seeds_text(std::size_t seeds) { return seeds == 1 ? "one seed" : fmt::format("{} seeds", seeds); }

std::string no_trend_text(std::size_t seeds) { return seeds_text(seeds) + " cannot show a trend"; }

std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

std::string joined(const std::vector<std::string>& items, std::string_view between) {
  return fmt::format("{}", fmt::join(items, between));
}

std::string words(std::string_view id) {
  std::string text(id);
  std::ranges::replace(text, '_', ' ');
  return text;
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string parameter_text(const std::variant<double, std::string>& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return words(*text);
  return fmt::format("{:.6g}", std::get<double>(value));
}

std::string axis_title(const dem::Parameter& parameter) {
  return std::string(parameter.name) + (parameter.unit.empty() ? "" : " (" + std::string(parameter.unit) + ")");
}

std::string axis_title(const dem::Quantity& quantity, std::string_view name) {
  const std::string_view unit = quantity.shown_unit();
  return std::string(name.empty() ? quantity.name : name) + (unit.empty() ? "" : " (" + std::string(unit) + ")");
}

std::string parameter_words(const dem::Parameter& parameter, const dem::ParameterValue& value) {
  const std::string text = parameter_text(value);
  if (text.empty()) return {};
  if (!parameter.at_zero.empty() && text == "0") return std::string(parameter.at_zero);
  const std::string unit(parameter.unit);
  return (parameter.symbol.empty() ? "" : std::string(parameter.symbol) + " ") + text +
         (unit.empty() || unit == "°" ? unit : " " + unit) +
         (parameter.behind.empty() ? "" : " " + std::string(parameter.behind));
}

std::pair<double, std::string> energy_unit(double largest) {
  const double size = std::abs(largest);
  if (size >= 1e3) return {1e-3, "kJ"};
  if (size >= 1) return {1, "J"};
  if (size >= 1e-3) return {1e3, "mJ"};
  return {1e6, "µJ"};
}

}  // namespace reports
