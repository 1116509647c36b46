// The program as it is installed, in a folder of its own: it finds what belongs to it, and an ordinary user makes a report.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>

#include "engine/core/files.h"
#include "tests/cli/program.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE(
    "cmake --install: program, manual page, completions, scenarios and assets, and a report by an ordinary user") {
  const test::Scratch folder;
  const fs::path prefix = folder / "usr";
  const test::Outcome installed = test::run_shell(
      folder.path(), "cmake --install '" DEM_BUILD_DIR "' --prefix '" + prefix.string() + "' >/dev/null");
  INFO(installed.err);
  REQUIRE(installed.code == 0);
  for (const char* file :
       {"bin/dem-report", "share/man/man1/dem-report.1.gz", "share/bash-completion/completions/dem-report",
        "share/zsh/vendor-completions/_dem-report", "share/fish/vendor_completions.d/dem-report.fish",
        "share/dem-report/scenarios/quartzite_elastic.toml", "share/dem-report/scenarios/rocks/lac_du_bonnet.toml",
        "share/dem-report/assets/page/report.html", "share/dem-report/assets/summary.schema.json",
        "share/doc/dem-report/copyright", "share/doc/dem-report/changelog.gz", "share/doc/dem-report/use/nightly.md"}) {
    CAPTURE(file);
    CHECK(fs::is_regular_file(prefix / file));
  }
  // The tree can be moved, and root is not what it needs.
  fs::rename(prefix, folder / "moved");
  const fs::path home = folder / "home";
  fs::create_directory(home);
  const bool root = ::geteuid() == 0;
  if (root) {
    fs::permissions(folder.path(), fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
    REQUIRE(::chown(home.c_str(), 65534, 65534) == 0);
  }
  const std::string user = root ? "setpriv --reuid 65534 --regid 65534 --clear-groups " : "";
  const std::string program = "env -u DEM_REPORT_ASSETS '" + (folder / "moved/bin/dem-report").string() + "' ";
  const test::Outcome version = test::run_shell(home, user + program + "version");
  CHECK(version.code == 0);
  CHECK(has(version.out, "dem-report "));
  const test::Outcome made =
      test::run_shell(home, user + program + "'" + (folder / "moved/share/dem-report/scenarios").string() +
                                "/quartzite_elastic.toml' --scale smoke --format html");
  INFO(made.err);
  CHECK(made.code == 0);
  const std::string page = dem::read_file(home / "out/quartzite_elastic.smoke/report.html");
  CHECK(has(page, "./dem-report scenarios/quartzite_elastic.toml --scale smoke"));
  CHECK(has(page, "dem-report /usr/share/dem-report/scenarios/quartzite_elastic.toml --scale smoke"));
  CHECK_FALSE(has(page, folder.path().string()));
}
