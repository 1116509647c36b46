#pragma once
// A study as one row among many: what its folder says of it. Read from summary.json, run.json and comparison.json alone, so
// that a page over many studies can be made at any time.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace overview {

struct CaseOf {
  std::string id;
  std::string error{};              ///< why it has no result; "" when it has
  std::optional<double> seconds{};  ///< of its simulation; none: kept from an earlier run
};

struct CheckOf {
  std::string id;
  bool held = true;
  std::optional<double> value{};
  double limit = 0;
};

struct PublishedOf {
  std::string id, source, verdict;
  std::string text{};  ///< "published 206.8 MPa, computed 163.4 MPa, tolerance 25 %"
};

struct ChangeOf {
  std::string id, state;  ///< as in comparison.json
  bool alarms = false;
  std::string text{};  ///< "163.4 MPa -> 170.0 MPa (+4 %)"
};

struct Number {
  std::string id;  ///< "compression_ar_1/young_modulus"
  double value = 0;
  std::string name{}, unit{};
  bool key = false;  ///< a result, and not a count or a diagnostic
};

struct StudyRow {
  std::string folder;  ///< "ldb_minerals.smoke"
  std::string scenario{}, scale{};
  std::string error{};  ///< why there is no report, or none of this run
  std::vector<CaseOf> cases{};
  std::vector<CheckOf> checks{};
  std::vector<PublishedOf> published{};
  std::string since{};        ///< "nothing changed"; "" when it was not compared with a reference
  std::string since_state{};  ///< "same", "changed", "new", "unreadable"; ""
  std::vector<ChangeOf> changes{};
  std::vector<std::string> causes{};
  std::vector<Number> numbers{};
  double seconds = 0;         ///< of its simulations, as far as they are known, and of the report
  double report_seconds = 0;  ///< of the report alone
  std::string report{};       ///< "ldb_minerals.smoke/report.html"; "" when there is none
  std::string thumbnail{};    ///< bytes of a PNG; "" when it has no picture

  [[nodiscard]] std::size_t failed_cases() const;
  [[nodiscard]] std::size_t checks_held() const;
  [[nodiscard]] std::size_t count(const std::string& verdict) const;
  [[nodiscard]] std::size_t judged() const;  ///< published numbers that are met, missed or undecided
  [[nodiscard]] std::size_t alarms() const;
  /// "failed": it could not run, a case or a check failed; "changed": beyond tolerance, or its reference cannot be read;
  /// "well".
  [[nodiscard]] std::string state() const;
  /// "20 of 20 checks held; 20 of 34 published numbers met, 3 undecided; nothing changed since the reference"
  [[nodiscard]] std::string verdict() const;
};

/// Throws nothing that one study could stop others with: what is wrong stands in `error`.
StudyRow read_row(const std::filesystem::path& folder, bool with_thumbnail);

/// Those of all studies below `output`, what failed first, then what changed, then by name.
std::vector<StudyRow> read_rows(const std::filesystem::path& output, bool with_thumbnails);

/// `rows` in that order.
void sort_rows(std::vector<StudyRow>& rows);

}  // namespace overview
