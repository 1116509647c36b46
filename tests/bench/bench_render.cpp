// Time of pictures: one JSON line a figure.
//   bench_render [folder for the pictures]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>

#include "engine/core/random.h"
#include "render/draw.h"

namespace {

/// A cylinder of 25 x 50 mm filled with about as many spheres as the published specimens.
render::Spheres specimen() {
  render::Spheres spheres;
  dem::RandomStream random(1, dem::Purpose::test_data);
  const double step = 0.93e-3;
  for (int k = 0; k < 65; ++k)
    for (int j = -16; j <= 16; ++j)
      for (int i = -16; i <= 16; ++i) {
        const render::Point p{step * (i + 0.5 * ((j + k) % 2)), 0.87 * step * j, step * (0.82 * k + 0.5)};
        if (std::hypot(p[0], p[1]) > 12.1e-3) continue;
        spheres.centre.push_back(p);
        spheres.radius.push_back(random.uniform(0.35e-3, 0.58e-3));
        spheres.colour.push_back(render::palette(random.below(4)));
      }
  return spheres;
}

render::Chart curves() {
  render::Chart chart;
  chart.x.title = "Axial strain ε₁ (%)";
  chart.left.title = "Axial stress σ₁ (MPa)";
  for (int k = 0; k < 3; ++k) {
    render::Series series;
    series.label = "AR " + std::to_string(k + 1);
    series.colour = render::palette(static_cast<std::size_t>(k));
    for (int i = 0; i < 20000; ++i) {
      series.x.push_back(0.3 * i / 20000);
      series.y.push_back((200 - 10 * k) * std::sin(1.6 * i / 20000));
    }
    chart.series.push_back(series);
  }
  return chart;
}

template <class Draw>
void measure(const char* name, std::size_t size, Draw draw) {
  draw();  // shaders are compiled once a program
  double best = 1e300;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    draw();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  fmt::print("{{\"name\": \"{}\", \"value\": {:.4f}, \"unit\": \"s\", \"threads\": 2, \"size\": {}}}\n", name, best,
             size);
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : std::filesystem::temp_directory_path() / "dem-bench-render";
  render::Canvas canvas;
  render::Scene scene;  // 800 x 1200 px
  scene.spheres.push_back(specimen());
  scene.camera.direction = {0.4, 1, -0.3};
  const std::size_t count = scene.spheres[0].centre.size();
  measure("frame", count, [&] { canvas.draw(scene, folder / "frame.png", {}); });
  scene.camera.direction = {0, 1, 0};
  scene.cuts.push_back({{0, 0, 0}, {0, -1, 0}});
  measure("frame_section", count, [&] { canvas.draw(scene, folder / "section.png", {}); });
  const render::Chart chart = curves();
  measure("chart", 60000, [&] { canvas.draw(chart, folder / "chart.png", folder / "chart.svg", {}); });
}
