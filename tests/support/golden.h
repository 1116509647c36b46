#pragma once
// Golden pictures: a test of one line draws and compares with tests/golden/NAME.png. On a difference the candidate and
// a picture of the difference stay in the build folder's golden/, and the message says where; a missing baseline leaves
// the candidate to look at and to copy.
#include <filesystem>
#include <string>

#include "render/draw.h"

namespace golden {

/// How much may differ. The default lets rounding through and nothing that can be seen; a test that needs more says
/// why.
struct Threshold {
  double mean = 0.0005;
  double worst = 0.02;
};

/// The canvas of this test program.
render::Canvas& canvas();

/// A folder for files that tests write, empty at the start of the program.
const std::filesystem::path& scratch();

void picture(const std::string& name, const render::Chart& chart, Threshold threshold = {});
void picture(const std::string& name, const render::Scene& scene, Threshold threshold = {});

}  // namespace golden
