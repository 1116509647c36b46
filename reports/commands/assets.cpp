#include "reports/commands/assets.h"

#include <cstdlib>

#include "engine/core/errors.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* variable = "DEM_REPORT_ASSETS";

/// A folder named assets that is not ours does not count.
bool has_assets(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "page" / "report.html", error);
}

}  // namespace

fs::path assets_folder(const std::string& asked, const fs::path& program) {
  const std::string what = "the page template and the published numbers are missing: ";
  if (!asked.empty()) {
    if (has_assets(asked)) return asked;
    throw dem::EnvironmentError(what + variable + " names " + asked +
                                ", which holds no page/report.html; unset it, or let it name the folder 'assets' of "
                                "dem-report");
  }
  const fs::path beside = program.parent_path();
  const fs::path installed = (beside / DEM_ASSETS_FROM_PROGRAM).lexically_normal();
  const fs::path built = beside / "assets";
  for (const fs::path& place : {installed, built}) {
    if (has_assets(place)) return place;
  }
  throw dem::EnvironmentError(what + "neither " + installed.string() + " nor " + built.string() +
                              " holds page/report.html; install dem-report again, or let the environment variable " +
                              variable + " name its folder 'assets'");
}

fs::path assets_folder() {
  const char* asked = std::getenv(variable);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return assets_folder(asked ? asked : "", program);
}

}  // namespace cli
