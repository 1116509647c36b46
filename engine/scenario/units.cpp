#include "engine/scenario/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include "engine/core/errors.h"
#include "engine/scenario/scenario.h"
#include "engine/scenario/suggest.h"

namespace dem {
namespace {

struct Unit {
  std::string_view name;
  std::string_view dimension;
  int power = 0;      ///< of ten, to SI
  double factor = 1;  ///< besides the power of ten
};

constexpr double degree = std::numbers::pi / 180;
constexpr double psi = 6894.757293168361;     // Pa: 4.4482216152605 N on (25.4 mm)^2
constexpr double standard_gravity = 9.80665;  // m/s^2, by which a unit weight is a density

// The first spelling of each unit is the one shown; the others are accepted.
constexpr auto table = std::to_array<Unit>({
    {"m", "length"},
    {"mm", "length", -3},
    {"cm", "length", -2},
    {"um", "length", -6},
    {"µm", "length", -6},  // U+00B5, the micro sign
    {"μm", "length", -6},  // U+03BC, the Greek letter
    {"km", "length", 3},
    {"nm", "length", -9},
    {"Pa", "stress"},
    {"kPa", "stress", 3},
    {"MPa", "stress", 6},
    {"GPa", "stress", 9},
    {"psi", "stress", 0, psi},
    {"ksi", "stress", 3, psi},
    {"bar", "stress", 5},
    {"N/m^2", "stress"},
    {"N/m2", "stress"},
    {"N/m²", "stress"},
    {"kN/m^2", "stress", 3},
    {"kN/m2", "stress", 3},
    {"kN/m²", "stress", 3},
    {"MN/m^2", "stress", 6},
    {"MN/m2", "stress", 6},
    {"MN/m²", "stress", 6},
    {"N/mm^2", "stress", 6},
    {"N/mm2", "stress", 6},
    {"N/mm²", "stress", 6},
    {"kN/mm^2", "stress", 9},
    {"kN/mm2", "stress", 9},
    {"kN/mm²", "stress", 9},
    {"kg/m^3", "density"},
    {"kg/m3", "density"},
    {"kg/m³", "density"},
    {"g/cm^3", "density", 3},
    {"g/cm3", "density", 3},
    {"g/cm³", "density", 3},
    {"t/m^3", "density", 3},
    {"t/m3", "density", 3},
    {"t/m³", "density", 3},
    {"kN/m^3", "density", 3, 1 / standard_gravity},
    {"kN/m3", "density", 3, 1 / standard_gravity},
    {"kN/m³", "density", 3, 1 / standard_gravity},
    {"rad", "angle"},
    {"deg", "angle", 0, degree},
    {"°", "angle", 0, degree},
    {"%", "share", -2},
    {"s", "time"},
    {"ms", "time", -3},
    {"us", "time", -6},
    {"µs", "time", -6},
    {"μs", "time", -6},
    {"min", "time", 0, 60},
    {"h", "time", 0, 3600},
    {"m/s", "velocity"},
    {"mm/s", "velocity", -3},
    {"m/s^2", "acceleration"},
    {"m/s2", "acceleration"},
    {"m/s²", "acceleration"},
    {"1/s", "rate"},
    {"N", "force"},
    {"kN", "force", 3},
    {"MN", "force", 6},
    {"N/m", "stiffness"},
    {"kN/m", "stiffness", 3},
    {"MN/m", "stiffness", 6},
    {"GN/m", "stiffness", 9},
    {"Pa/m", "stiffness per area"},
    {"MPa/m", "stiffness per area", 6},
    {"GPa/m", "stiffness per area", 9},
    {"N m", "moment"},
    {"Pa s", "viscosity"},
    {"Pa.s", "viscosity"},
    {"Pa*s", "viscosity"},
    {"N s/m", "damping"},
    {"kg", "mass"},
    {"g", "mass", -3},
    {"J", "energy"},
    {"mJ", "energy", -3},
    {"kJ", "energy", 3},
    {"J/m^2", "energy per area"},
    {"J/m2", "energy per area"},
    {"J/m²", "energy per area"},
});

const Unit* find(std::string_view name) {
  const auto at = std::ranges::find(table, name, &Unit::name);
  return at == table.end() ? nullptr : &*at;
}

const Unit& declared(std::string_view name) {
  const Unit* unit = find(name);
  if (!unit) throw std::logic_error("a scenario key is declared with the unknown unit '" + std::string(name) + "'");
  return *unit;
}

/// The number that `decimal` ("0.35", "-1e3") is after a shift by a power of ten, correctly rounded; none: not a
/// number.
std::optional<double> decimal(std::string_view text, int power) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const std::size_t e = text.find_first_of("eE");
  const std::string_view mantissa = text.substr(0, e);
  int exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view digits = text.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (error != std::errc() || end != digits.data() + digits.size() || std::abs(exponent) > 10000) return {};
  }
  if (mantissa.empty() || mantissa.find_first_not_of("-.0123456789") != std::string_view::npos) return {};
  const std::string shifted = std::string(mantissa) + "e" + std::to_string(exponent + power);
  double value = 0;
  const auto [end, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  if (error != std::errc() || end != shifted.data() + shifted.size() || !std::isfinite(value)) return {};
  return value;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The end of the number at the start of `text`: an "e" belongs to it only when an exponent follows.
std::size_t number_end(std::string_view text) {
  std::size_t end = std::min(text.find_first_not_of("+-.0123456789"), text.size());
  if (end == 0 || end >= text.size() || (text[end] != 'e' && text[end] != 'E')) return end;
  std::size_t digits = end + 1;
  if (digits < text.size() && (text[digits] == '+' || text[digits] == '-')) ++digits;
  const std::size_t after = std::min(text.find_first_not_of("0123456789", digits), text.size());
  return after > digits ? after : end;
}

/// What was meant by "50,0 GPa", or by "1,000 MPa": "write ...".
std::string without_comma(std::string_view text, const std::string& example) {
  const std::size_t comma = text.find(',');
  if (std::ranges::count(text, ',') != 1 || text.find('.') != std::string_view::npos) return example;
  const std::string before(text.substr(0, comma)), after(text.substr(comma + 1));
  const std::string point = "write \"" + before + "." + after + "\"";
  const bool thousands = std::min(after.find_first_not_of("0123456789"), after.size()) == 3;
  return thousands ? point + ", or \"" + before + after + "\" for thousands" : point;
}

std::string lower(std::string_view text) {
  std::string word(text);
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

/// Of units that differ in capitals alone, "MPa" is meant by "mPa"; else the closest.
std::string nearest_unit(std::string_view name, const std::vector<std::string>& names) {
  for (const std::string& known : names) {
    if (lower(known) == lower(name)) return known;
  }
  return closest(name, names);
}

}  // namespace

std::string shortest(double number) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number);
  if (error != std::errc()) throw std::logic_error("a double needs more than 32 characters");
  return {buffer.data(), end};
}

bool known_unit(std::string_view unit) { return find(unit) != nullptr; }

double to_si(double number, std::string_view name) {
  if (name.empty() || !std::isfinite(number)) return number;
  const Unit& unit = declared(name);
  return decimal(shortest(number), unit.power).value() * unit.factor;
}

std::string in_unit(double si, std::string_view name) {
  if (name.empty()) return shortest(si);
  const Unit& unit = declared(name);
  const double scaled = si / unit.factor;
  double number = std::isfinite(scaled) ? decimal(shortest(scaled), -unit.power).value_or(scaled) : scaled;
  // A factor such as that of degrees leaves a last digit: 59.99999999999999 deg is 60.
  std::array<char, 32> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::general, 14).ptr;
  double round = number;
  std::from_chars(digits.data(), end, round);
  if (to_si(round, name) == si) number = round;
  return shortest(number) + " " + std::string(name);
}

std::string units_like(std::string_view name) {
  std::string text(name);
  const Unit& like = declared(name);
  const auto same = [](const Unit& a, const Unit& b) {
    return a.dimension == b.dimension && a.power == b.power && a.factor == b.factor;
  };
  for (const Unit& unit : table) {
    const Unit& first = *std::ranges::find_if(table, [&](const Unit& other) { return same(unit, other); });
    const bool shown = &first == &unit && !same(unit, like);
    if (unit.dimension == like.dimension && shown) text += ", " + std::string(unit.name);
  }
  return text;
}

std::optional<double> read_number(std::string_view text) { return decimal(trimmed(text), 0); }

double read_quantity(std::string_view text, std::string_view unit_name) {
  const Unit& wanted = declared(unit_name);
  const std::string example = "write a number and a unit (" + units_like(unit_name) + ")";
  const std::string_view whole = trimmed(text);
  const std::size_t end = number_end(whole);
  const std::string quoted = "\"" + std::string(text) + "\"";
  if (end < whole.size() && whole[end] == ',') {
    throw InputError(quoted + " has a comma; the decimal sign is a point", without_comma(whole, example));
  }
  if (end == 0) throw InputError(quoted + " does not begin with a number", example);
  const std::string_view number = whole.substr(0, end);
  const std::string_view name = trimmed(whole.substr(end));
  if (name.empty()) {
    throw InputError(quoted + " has no unit", "write \"" + std::string(number) + " " + std::string(unit_name) + "\"");
  }
  const Unit* unit = find(name);
  if (!unit) {
    std::vector<std::string> names;
    for (const Unit& known : table) {
      if (known.dimension == wanted.dimension) names.emplace_back(known.name);
    }
    const std::string near = nearest_unit(name, names);
    throw InputError(quoted + ": unknown unit '" + std::string(name) + "'",
                     (near.empty() ? "" : "did you mean '" + near + "'? ") + example);
  }
  if (unit->dimension != wanted.dimension) {
    throw InputError(quoted + " is in units of " + std::string(unit->dimension) + ", but " +
                         std::string(wanted.dimension) + " is needed",
                     example);
  }
  const std::optional<double> value = decimal(number, unit->power);
  if (!value) throw InputError("'" + std::string(number) + "' is not a number", example);
  return *value * unit->factor;
}

}  // namespace dem
