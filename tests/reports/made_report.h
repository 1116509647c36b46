#pragma once
// A small report made by hand, to be changed in one place at a time.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "render/image.h"

namespace test {

struct MadeCase {
  std::string id;
  double cohesion = 2.92e8;
  int seed = 1;
  std::map<std::string, double> results{};
};

struct Drawn {
  int cracks = 200;
  int others = 0;        ///< so many of them lie elsewhere
  double offset = 0;     ///< px, of all edges
  int samples = 4;       ///< a pixel is the mean of samples x samples
  int legend_shift = 0;  ///< px
};

/// Grains, cracks of 2 x 30 px and a legend, in 320 x 320 px.
render::Image crack_map(const Drawn& drawn);

struct MadeReport {
  std::string scale = "smoke";
  std::string physics = "grain_texture 6";
  int summary_format = 2;
  std::vector<MadeCase> cases = {{.id = "compression_ar_1", .results = {{"compressive_strength", 163.4}}},
                                 {.id = "compression_ar_2", .results = {{"compressive_strength", 151.25}}}};
  bool check_holds = true;
  std::string verdict = "met";
  std::string choice = "The residual is taken at the end of the test, at 1.5 times the peak strain.";
  std::string figure = "crack_maps";
  Drawn drawn{};
  double peak = 163.4;  ///< of the curve in data/curves.csv
  std::string drawing = "<svg><metadata>0.1.0</metadata><text>a</text></svg>";

  /// Writes the folder NAME.SCALE below `parent` and returns it.
  std::filesystem::path write(const std::filesystem::path& parent, const std::string& name = "rock") const;
};

}  // namespace test
