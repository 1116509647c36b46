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
  std::vector<std::pair<std::string, std::variant<double, std::string>>> parameters;
  /// Results by the names of summary.json, the unit in the key; a dot nests: "cracks.intra_tension", "ucs_MPa".
  std::vector<std::pair<std::string, double>> results;
  std::vector<Check> checks;
  std::vector<std::string> notes;  ///< what a reader must know about this run, a sentence each
  std::vector<Table> tables;

  [[nodiscard]] const Table* find(std::string_view table) const;   ///< nullptr when absent
  [[nodiscard]] const Table& table(std::string_view table) const;  ///< throws std::out_of_range naming it
  [[nodiscard]] bool has_result(std::string_view name) const;
  [[nodiscard]] double result(std::string_view name) const;       ///< throws std::out_of_range naming it
  [[nodiscard]] double number(std::string_view parameter) const;  ///< a numeric parameter; throws as above
  [[nodiscard]] std::string text(std::string_view parameter) const;
};

}  // namespace dem
