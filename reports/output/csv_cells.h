#pragma once
// Cells of a table for readers, read back as numbers.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reports {

/// What a cell says in numbers: "29.0 (−51.8 to 110) MPa" is {value_range, {"29.0", "-51.8", "110"}, "MPa"}.
struct CellNumbers {
  enum class Form {
    value,        ///< "12"
    deviation,    ///< "12 ± 3"
    value_range,  ///< "12 (10 to 14)", "12 (10, 14)"
    range,        ///< "10 to 14", "10–14"
    pair,         ///< "12 / 3"
  } form = Form::value;
  std::vector<std::string> numbers;  ///< as a program reads them: "-4.68e7"
  std::string unit;
};

/// Nothing when it is no number, or more than these forms hold.
std::optional<CellNumbers> cell_numbers(std::string_view text);

}  // namespace reports
