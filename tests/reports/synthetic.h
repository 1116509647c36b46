#pragma once
// Made-up records of the grain texture model, for tests of the report only: the tables and names of real records, smooth
// curves and plausible sizes. Nothing here is simulated.
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/record.h"
#include "engine/scenario/scenario.h"
#include "reports/figure.h"

namespace synthetic {

struct Options {
  double diameter = 6e-3, height = 12e-3;  ///< m
  int samples = 200;                       ///< of the history
  double ucs_MPa = 205, ts_MPa = 9.5;      ///< at aspect ratio 1
};

dem::Record compression(double aspect_ratio, const Options& options = {});
dem::Record direct_tension(double aspect_ratio, const Options& options = {});

/// Records at aspect ratios 1, 2, 3 in both tests, as a study.
class Study {
 public:
  /// `folder` takes the scenario file.
  explicit Study(const std::filesystem::path& folder, const Options& options = {});
  [[nodiscard]] reports::StudyResult result() const;
  dem::Record& record(const std::string& id);
  void fail(const std::string& id, const std::string& error);

 private:
  dem::Scenario scenario_;
  std::vector<dem::Record> records_;
  std::vector<std::pair<std::string, std::string>> failures_;
};

/// Records of the grain texture model as a study of a scenario.
reports::StudyResult study_of(const dem::Scenario& scenario, const std::vector<dem::Record>& records);

/// A scenario of the grain texture model with the common keys only.
dem::Scenario scenario(const std::filesystem::path& folder, const std::string& name = "ldb_aspect_ratio",
                       const std::string& more = "", const std::string& scale = "draft");

}  // namespace synthetic
