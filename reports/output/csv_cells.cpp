#include "reports/output/csv_cells.h"

#include <algorithm>
#include <array>
#include <utility>

namespace reports {
namespace {

constexpr std::array<std::string_view, 4> blanks{" ", "\u00a0", "\u2009", "\u202f"};

bool take(std::string_view& text, std::string_view part) {
  if (!text.starts_with(part)) return false;
  text.remove_prefix(part.size());
  return true;
}

bool take_any(std::string_view& text, std::initializer_list<std::string_view> parts) {
  return std::ranges::any_of(parts, [&](std::string_view part) { return take(text, part); });
}

void skip_blanks(std::string_view& text) {
  while (std::ranges::any_of(blanks, [&](std::string_view blank) { return take(text, blank); })) {
  }
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Digits with blanks between their thousands.
std::string take_digits(std::string_view& text) {
  std::string digits;
  while (!text.empty()) {
    if (is_digit(text.front())) {
      digits += text.front();
      text.remove_prefix(1);
      continue;
    }
    std::string_view after = text;
    const bool blank = std::ranges::any_of(blanks, [&](std::string_view one) { return take(after, one); });
    const bool thousand = blank && after.size() >= 3 && std::all_of(after.begin(), after.begin() + 3, is_digit) &&
                          (after.size() == 3 || !is_digit(after[3]));
    if (digits.empty() || !thousand) break;
    text = after;
  }
  return digits;
}

/// "⁻⁷" of "10⁻⁷".
std::string take_exponent(std::string_view& text) {
  constexpr std::array<std::string_view, 11> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹", "⁻"};
  std::string exponent;
  for (bool found = true; found;) {
    found = false;
    for (std::size_t i = 0; i < raised.size() && !found; ++i) {
      found = take(text, raised[i]);
      if (found) exponent += "0123456789-"[i];
    }
  }
  return exponent;
}

std::optional<std::string> take_number(std::string_view& text) {
  std::string_view rest = text;
  std::string number;
  if (take_any(rest, {"−", "-"}))
    number = "-";
  else
    take(rest, "+");
  const std::string whole = take_digits(rest);
  if (whole.empty()) return std::nullopt;
  number += whole;
  if (rest.size() > 1 && rest[0] == '.' && is_digit(rest[1])) {
    number += '.';
    rest.remove_prefix(1);
    while (!rest.empty() && is_digit(rest.front())) {
      number += rest.front();
      rest.remove_prefix(1);
    }
  }
  std::string_view scientific = rest;
  if (take_any(scientific, {"e", "E"})) {
    const std::string exponent = take(scientific, "-") ? "e-" : "e";
    take(scientific, "+");
    const std::string digits = take_digits(scientific);
    if (!digits.empty()) {
      number += exponent + digits;
      rest = scientific;
    }
  }
  std::string_view power = rest;
  skip_blanks(power);
  if (take(power, "×")) {
    skip_blanks(power);
    const bool ten = take(power, "10");
    const std::string exponent = ten ? take_exponent(power) : "";
    if (!exponent.empty()) {
      number += "e" + exponent;
      rest = power;
    }
  }
  text = rest;
  return number;
}

/// "MPa", "10⁶ N/m", "%": short, and without a digit that would be another number.
bool is_unit(std::string_view text) {
  constexpr std::size_t longest = 16;
  return text.size() <= longest && std::ranges::none_of(text, is_digit) &&
         text.find_first_of("(),;:–") == std::string_view::npos;
}

}  // namespace

std::optional<CellNumbers> cell_numbers(std::string_view text) {
  using Form = CellNumbers::Form;
  CellNumbers cell;
  const auto next = [&] {
    skip_blanks(text);
    const std::optional<std::string> number = take_number(text);
    if (number) cell.numbers.push_back(*number);
    skip_blanks(text);
    return number.has_value();
  };
  if (!next()) return std::nullopt;
  bool whole = true;
  if (take(text, "±")) {
    cell.form = Form::deviation;
    whole = next();
  } else if (take(text, "(")) {
    cell.form = Form::value_range;
    whole = next() && take_any(text, {"to", ",", "–"}) && next() && take(text, ")");
  } else if (take(text, "/")) {
    cell.form = Form::pair;
    whole = next();
  } else if (take_any(text, {"to ", "–"})) {
    cell.form = Form::range;
    whole = next();
  }
  skip_blanks(text);
  if (!whole || !is_unit(text)) return std::nullopt;
  cell.unit = std::string(text);
  return cell;
}

}  // namespace reports
