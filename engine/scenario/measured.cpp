#include "engine/scenario/measured.h"

#include <array>
#include <cmath>
#include <optional>

#include "engine/core/errors.h"
#include "engine/scenario/units.h"

namespace dem {
namespace {

constexpr std::size_t numbers_each = 5;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

void replace(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// With one sign for each thing.
std::string plain(std::string_view text) {
  std::string all(text);
  for (const char* sign : {"+/-", "±", "+\u2212", "+ -"}) replace(all, sign, "+-");
  for (const char* dash : {"\u2012", "\u2013", "\u2014", "\u2212"}) replace(all, dash, "-");
  return all;
}

/// Where the unit of "210 MPa" begins.
std::size_t unit_begin(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size()) {
    const char c = text[end];
    const bool exponent = (c == 'e' || c == 'E') && end + 1 < text.size() &&
                          std::string_view("+-0123456789").find(text[end + 1]) != std::string_view::npos;
    const bool sign = (c == '+' || c == '-') && (end == 0 || text[end - 1] == 'e' || text[end - 1] == 'E');
    if (!exponent && !sign && std::string_view(".,0123456789").find(c) == std::string_view::npos) break;
    ++end;
  }
  return end;
}

std::string unit_of(std::string_view text) { return std::string(trimmed(text.substr(unit_begin(text)))); }

struct Reader {
  std::string_view whole;  ///< as it is written, for messages
  std::string_view unit;

  [[noreturn]] void refuse(const std::string& wrong) const {
    const std::string u = unit.empty() ? "" : " " + std::string(unit);
    const std::string value = unit.empty() ? "0.26" : "210", spread = unit.empty() ? "0.02" : "8",
                      low = unit.empty() ? "0.24" : "200", high = unit.empty() ? "0.28" : "228";
    throw InputError("\"" + std::string(whole) + "\" " + wrong, "write a value with its standard deviation, \"" +
                                                                    value + u + " +- " + spread + "\", or a range, \"" +
                                                                    low + "-" + high + u + "\"");
  }

  /// `text` has its own unit or takes `otherwise`.
  [[nodiscard]] double number(std::string_view text, const std::string& otherwise) const {
    text = trimmed(text);
    if (text.empty()) refuse("lacks a number");
    if (unit.empty()) {
      const std::optional<double> value = read_number(text);
      if (!value || !std::isfinite(*value)) refuse("is not a number without unit");
      return *value;
    }
    std::string with = std::string(text);
    if (unit_of(text).empty()) {
      if (otherwise.empty()) refuse("has no unit");
      with += " " + otherwise;
    }
    return read_quantity(with, unit);
  }

  [[nodiscard]] Measured spread(std::string_view left, std::string_view right) const {
    left = trimmed(left);
    right = trimmed(right);
    const std::string behind = unit_of(right);
    Measured found;
    if (behind == "%" && unit != "%") {
      found.value = number(left, {});
      const std::optional<double> percent = read_number(right.substr(0, unit_begin(right)));
      if (!percent) refuse("does not say how much after +-");
      found.deviation = std::abs(found.value) * *percent / 100;
    } else {
      found.value = number(left, behind);
      found.deviation = number(right, unit_of(left));
    }
    if (!(found.deviation > 0)) refuse("has no uncertainty after +-: leave it out, or write it above 0");
    found.low = found.value - found.deviation;
    found.high = found.value + found.deviation;
    return found;
  }

  [[nodiscard]] Measured range(std::string_view left, std::string_view right) const {
    Measured found;
    found.low = number(left, unit_of(trimmed(right)));
    found.high = number(right, unit_of(trimmed(left)));
    if (!(found.low < found.high)) refuse("is a range that does not go up");
    found.value = 0.5 * (found.low + found.high);
    found.deviation = 0.5 * (found.high - found.low) / std::sqrt(3.0);
    return found;
  }
};

/// The dash of a range: neither a sign nor part of an exponent.
std::size_t dash_of(std::string_view text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '-' && text[i - 1] != 'e' && text[i - 1] != 'E' && !trimmed(text.substr(0, i)).empty()) return i;
  }
  return std::string_view::npos;
}

}  // namespace

Measured read_measured(std::string_view text, std::string_view unit, std::string_view at_unit) {
  const std::string said = plain(text);
  std::string_view value = said;
  const Reader reader{text, unit};
  std::optional<double> place;
  if (const std::size_t at = said.rfind(" at "); at != std::string::npos) {
    if (at_unit.empty()) reader.refuse("says where it was measured, which this key does not take");
    place = read_quantity(trimmed(value.substr(at + 4)), at_unit);
    value = value.substr(0, at);
  }
  if (!at_unit.empty() && !place) {
    throw InputError("\"" + std::string(text) + "\" does not say at which confining pressure",
                     "write \"320 " + std::string(unit) + " +- 10 at 20 " + std::string(at_unit) + "\"");
  }
  Measured found;
  if (const std::size_t sign = value.find("+-"); sign != std::string_view::npos) {
    found = reader.spread(value.substr(0, sign), value.substr(sign + 2));
  } else if (const std::size_t word = value.find(" to "); word != std::string_view::npos) {
    found = reader.range(value.substr(0, word), value.substr(word + 4));
  } else if (const std::size_t dash = dash_of(value); dash != std::string_view::npos) {
    found = reader.range(value.substr(0, dash), value.substr(dash + 1));
  } else {
    found.value = found.low = found.high = reader.number(value, {});
  }
  found.at = place.value_or(0);
  return found;
}

std::vector<Measured> measured(const Scenario& scenario, std::string_view path) {
  std::vector<Measured> all;
  if (!scenario.declares(path)) return all;
  const std::vector<double>& kept = scenario.reals(path);
  for (std::size_t i = 0; i + numbers_each <= kept.size(); i += numbers_each) {
    all.push_back({kept[i], kept[i + 1], kept[i + 2], kept[i + 3], kept[i + 4]});
  }
  return all;
}

std::vector<double> flat(const Measured& value) {
  return {value.value, value.low, value.high, value.deviation, value.at};
}

}  // namespace dem
