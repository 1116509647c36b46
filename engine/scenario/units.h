#pragma once
// Units of scenario quantities. Values are decimal: "0.35 mm" and "0.00035 m" give the same bits.
#include <optional>
#include <string>
#include <string_view>

namespace dem {

/// The value in SI units (rad, fractions) of `number` of `unit`; unknown unit: std::logic_error.
double to_si(double number, std::string_view unit);

/// The inverse as text with its unit, shortest: in_unit(2.92e8, "MPa") is "292 MPa", in_unit(1.66, "") "1.66".
std::string in_unit(double si, std::string_view unit);

/// Shortest decimal text that reads back as the same double: "0.35", "5.8e+10".
std::string shortest(double number);

/// "mm, m, um": the units of the dimension of `unit`, that one first.
std::string units_like(std::string_view unit);

/// The number that a text is, with nothing else but blanks; none: it is no number, or has a unit.
std::optional<double> read_number(std::string_view text);

/// Whether the table has it.
bool known_unit(std::string_view unit);

}  // namespace dem
