#pragma once
// Records and other tables in HDF5, the only place that knows it. The same input gives the same bytes: no time stamps.
//
// results.h5:  /case        attributes: format, model, scenario, case_id, content, physics_version, seed
//              /parameters  /results   one attribute each, in order; /units: the unit of each result
//              /checks/ID   attributes value, limit, held, meaning
//              /notes       one attribute a sentence
//              /TABLE       a group with the table's attributes; one dataset a column, N or N x width, attribute unit
// A line "sha256 HEX" of the bytes before it follows the HDF5 part: a file that was cut short or damaged is never read.
// Files are written under a temporary name and renamed when whole (engine/core/files.h).
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/record.h"

namespace dem {

/// Throws EnvironmentError naming the path when it cannot be written.
void write_record(const Record& record, const std::filesystem::path& path);

/// Throws EnvironmentError naming the path when it is missing, cut short, damaged or not a record.
Record read_record(const std::filesystem::path& path);

/// Only the content key of a record, without its tables. Throws as read_record().
std::string read_content(const std::filesystem::path& path);

/// Tables outside a record, such as a generated specimen.
struct TableFile {
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<Table> tables;

  [[nodiscard]] const Table& table(std::string_view name) const;    ///< throws std::out_of_range naming it
  [[nodiscard]] std::string attribute(std::string_view key) const;  ///< "" when absent
};

/// Throw as write_record() and read_record().
void write_tables(const std::filesystem::path& path, const std::vector<std::pair<std::string, std::string>>& attributes,
                  const std::vector<Table>& tables);
TableFile read_tables(const std::filesystem::path& path);

}  // namespace dem
