#pragma once
// A calibration as a page and as JSON. No clock, path or number of threads: the same input gives the same bytes.
#include <filesystem>
#include <string>

#include "reports/calibration/calibration.h"
#include "reports/options.h"

namespace calibrate {

struct PageFacts {
  std::string scenario, scale, engine_version;
  std::string title;
  std::string rock;       ///< name of the calibrated file: "my_rock.calibrated.toml"
  std::string rock_text;  ///< its text
  reports::Again again;   ///< how to make it again
  std::uint64_t seed = 1;
  std::filesystem::path assets;
};

/// The path of the search of a subject: each target's departure by trial.
render::Chart path_chart(const SubjectResult& result);

/// From assets/page/calibration.html; `charts`: an SVG file for each subject, embedded.
/// Throws dem::EnvironmentError when an asset is missing or broken.
std::string page(const dem::Scenario& scenario, const Outcome& outcome, const PageFacts& facts,
                 const std::vector<std::filesystem::path>& charts);

/// As assets/calibration.schema.json describes it.
std::string json(const Outcome& outcome, const PageFacts& facts);

/// "UCS 209.1 (203 to 215), measured 200 to 228 MPa: within its uncertainty": a line for each target, for people.
std::vector<std::string> last_words(const Outcome& outcome);

}  // namespace calibrate
