// Where the program looks for the page template and the published numbers.
#include <doctest/doctest.h>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/commands/assets.h"
#include "tests/support/scratch.h"

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string refusal(const std::string& asked, const std::filesystem::path& program) {
  try {
    cli::assets_folder(asked, program);
  } catch (const dem::EnvironmentError& error) {
    return error.what();
  }
  return "found";
}

}  // namespace

TEST_CASE("assets: the variable, then what was installed, then what lies beside the program") {
  const test::Scratch folder;
  const std::filesystem::path program = folder.path() / "bin" / "dem-report";
  const std::filesystem::path installed = folder.path() / "share" / "dem-report" / "assets";
  const std::filesystem::path beside = folder.path() / "bin" / "assets";
  const std::string missing = refusal("", program);
  CAPTURE(missing);
  CHECK(has(missing, installed.string()));
  CHECK(has(missing, beside.string()));
  CHECK(has(missing, "DEM_REPORT_ASSETS"));

  dem::make_folder(beside);  // a folder of that name that is not ours
  CHECK(refusal("", program) == missing);
  dem::write_file(beside / "page" / "report.html", "");
  CHECK(cli::assets_folder("", program) == beside);
  dem::write_file(installed / "page" / "report.html", "");
  CHECK(cli::assets_folder("", program) == installed);
  CHECK(cli::assets_folder(beside.string(), program) == beside);

  const std::string wrong = refusal((folder.path() / "elsewhere").string(), program);
  CHECK(has(wrong, "DEM_REPORT_ASSETS names " + (folder.path() / "elsewhere").string()));
}

TEST_CASE("assets: the program of this build has its own") {
  CHECK(std::filesystem::exists(cli::assets_folder("", DEM_BUILD_DIR "/dem-report") / "papers"));
}
