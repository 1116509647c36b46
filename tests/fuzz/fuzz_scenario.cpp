// Scenario files of all models, up to their cases.
#include <fstream>

#include "engine/model/model.h"
#include "engine/study/study.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/scratch.h"

int main(int argc, char** argv) {
  const test::Scratch scratch;
  const std::filesystem::path file = scratch / "scenario.toml";
  dem_fuzz::Harness harness{"scenario",
                            dem_fuzz::corpus("scenario"),
                            {"\"",
                             "\"\"\"",
                             "'",
                             "[",
                             "]",
                             "[[",
                             "]]",
                             "{",
                             "}",
                             "=",
                             ".",
                             ",",
                             "#",
                             "\n",
                             " GPa",
                             " mm",
                             " %",
                             " psi",
                             "seed = ",
                             "repeats = ",
                             "[sweep]\n",
                             "[[extra]]\n",
                             "[[mineral]]\n",
                             "[[rule]]\n",
                             "[scales.smoke]\n",
                             "include = ",
                             "tests = ",
                             "true",
                             "\"kN/m3\"",
                             "1979-05-27",
                             "\xCE\xBCm",
                             "\\u0000",
                             "../",
                             "snapshots = "},
                            [&](const std::string& input) {
                              std::ofstream(file, std::ios::binary | std::ios::trunc) << input;
                              (void)dem::read_study(file.string(), "smoke", {}, dem::models());
                            }};
  return dem_fuzz::run(argc, argv, harness);
}
