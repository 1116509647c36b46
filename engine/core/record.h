#pragma once
// The record of a case: everything that a simulation leaves behind, the same shape for the three models.
// It is what results.h5 holds (engine/store) and all that figures and reports see.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/quantity.h"

namespace dem {

/// One named quantity of a table. `width` values a row (1: scalar, 3: vector), row by row.
struct Column {
  std::string name;  ///< lower_case_words
  std::string unit;  ///< SI ("m", "Pa", "J", "s"), "1" for numbers without unit, "" for codes and indices
  int width = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>> values;
};

/// Columns of equal length. Codes are explained in attributes, e.g. {"mode", "0 tension, 1 shear"}.
struct Table {
  std::string name;  ///< path in the file: "particles", "contacts", "cracks", "history", "snapshots/0000"
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<Column> columns;

  void add(std::string column, std::string unit, std::vector<double> values, int width = 1);
  void add(std::string column, std::string unit, std::vector<std::int32_t> values, int width = 1);
  [[nodiscard]] bool has(std::string_view column) const;
  /// The values of a column; throws std::out_of_range naming table and column when it is not there or of the other type.
  [[nodiscard]] std::span<const double> real(std::string_view column) const;
  [[nodiscard]] std::span<const std::int32_t> integer(std::string_view column) const;
  [[nodiscard]] std::size_t rows() const;
  [[nodiscard]] std::string attribute(std::string_view key) const;  ///< "" when absent
};

/// Something that must hold in any run: |value| <= limit.
struct Check {
  std::string id;  ///< "energy_residual", "equilibrium", "servo"
  double value = 0;
  double limit = 0;
  bool held = false;
  std::string meaning;  ///< one sentence for the report
};

/// What a case leaves behind.
struct Record {
  std::string model;     ///< "grain_texture", "lattice", "sheet"
  std::string scenario;  ///< name of the scenario (file stem)
  std::string case_id;   ///< "compression_ar_2"
  std::string content;   ///< canonical text of everything the result depends on (resolved keys, seed, physics version)
  std::string physics_version;  ///< of the model's engine
  std::uint64_t seed = 0;
  /// What sets this case apart: {"test", "compression"}, {"aspect_ratio", 2.0}.
  Parameters parameters;
  /// What its model declares; results of other names are refused.
  std::span<const Quantity> quantities;
  /// By the ids of the quantities, in their stored units; a dot nests: "cracks.intra_tension". Use put() and value().
  std::vector<std::pair<std::string, double>> results;
  std::vector<Check> checks;
  std::vector<std::string> notes;  ///< what a reader must know about this run, a sentence each
  std::vector<Table> tables;

  [[nodiscard]] const Table* find(std::string_view table) const;   ///< nullptr when absent
  [[nodiscard]] const Table& table(std::string_view table) const;  ///< throws std::out_of_range naming it

  /// Adds a result. Throws std::logic_error when the model does not declare it or it is there already (our defect).
  void put(const Quantity& quantity, double value);
  void put(const Quantity& family, std::string_view member, double value);
  [[nodiscard]] bool has(const Quantity& quantity) const;
  [[nodiscard]] double value(const Quantity& quantity) const;  ///< throws std::out_of_range when this case has none
  [[nodiscard]] double value_or_nan(const Quantity& quantity) const;
  [[nodiscard]] double value_or_nan(const Quantity& family, std::string_view member) const;
  /// A result by its id, for tables over all of them; nullptr when absent.
  [[nodiscard]] const double* find_result(std::string_view id) const;

  [[nodiscard]] double number(std::string_view parameter) const;  ///< a numeric parameter; throws as above
  [[nodiscard]] std::string text(std::string_view parameter) const;
};

}  // namespace dem
