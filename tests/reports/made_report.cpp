#include "tests/reports/made_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <tuple>

#include "engine/core/files.h"
#include "engine/store/store.h"
#include "render/png.h"

namespace test {
namespace {

using Colour = std::array<double, 3>;

struct Line {
  double x, y, angle;
  Colour colour;
};

constexpr int side = 320;

/// Many times as large as the picture, so that edges are smoothed when it is shrunk.
class Sheet {
 public:
  Sheet(int samples, double offset) : samples_(samples), offset_(offset), image_(side * samples, side * samples) {}

  /// Paints what lies inside, within a box; in px of the picture.
  template <class Inside>
  void paint(double left, double top, double right, double bottom, const Colour& colour, const Inside& inside) {
    const auto at = [&](double px) {
      return std::clamp(static_cast<int>(std::floor((px - offset_) * samples_)), 0, image_.width);
    };
    for (int row = at(top); row < std::min(at(bottom) + 1, image_.height); ++row) {
      for (int column = at(left); column < std::min(at(right) + 1, image_.width); ++column) {
        if (!inside((column + 0.5) / samples_ + offset_, (row + 0.5) / samples_ + offset_)) continue;
        for (std::size_t c = 0; c < 3; ++c)
          image_.rgb[image_.at(column, row) + c] = static_cast<std::uint8_t>(colour[c]);
      }
    }
  }
  [[nodiscard]] render::Image shrunk() const { return render::shrink(image_, samples_); }

 private:
  int samples_;
  double offset_;
  render::Image image_;
};

render::Image drawn_map(const Drawn& drawn) {
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Line> lines;
  for (int i = 0; i < drawn.cracks; ++i) {
    const Colour colour = i % 3 == 0 ? Colour{213, 94, 0} : i % 3 == 1 ? Colour{0, 84, 150} : Colour{86, 180, 233};
    lines.push_back({side * uniform(), (side - 40) * uniform(), 3.14159 * uniform(), colour});
  }
  for (int i = 0; i < drawn.others; ++i) {
    Line& line = lines[static_cast<std::size_t>(drawn.cracks - 1 - i)];
    line.x = side * uniform();
    line.y = (side - 40) * uniform();
  }
  Sheet sheet(drawn.samples, drawn.offset);
  sheet.paint(-2, -2, side + 2, side + 2, {250, 240, 180}, [](double, double) { return true; });
  for (int i = 0; i < 25; ++i) {
    const double x = 32 + 64 * (i % 5), y = 28 + 56 * (i / 5);
    const Colour colour = i % 3 == 0 ? Colour{80, 80, 85} : Colour{210, 175, 60};
    sheet.paint(x - 26, y - 26, x + 26, y + 26, colour,
                [&](double px, double py) { return std::hypot(px - x, py - y) < 26; });
  }
  for (const Line& line : lines) {
    sheet.paint(line.x - 16, line.y - 16, line.x + 16, line.y + 16, line.colour, [&](double px, double py) {
      const double dx = px - line.x, dy = py - line.y;
      return std::abs(dx * std::cos(line.angle) + dy * std::sin(line.angle)) < 15 &&
             std::abs(dy * std::cos(line.angle) - dx * std::sin(line.angle)) < 1;
    });
  }
  for (int i = 0; i < 15; ++i) {  // the legend: strokes of 2 px
    const double x = 20 + drawn.legend_shift + 8 * i;
    sheet.paint(x, side - 20, x + 2, side - 6, {20, 20, 20},
                [&](double px, double py) { return px > x && px < x + 2 && py > side - 20 && py < side - 6; });
  }
  return sheet.shrunk();
}

}  // namespace

render::Image crack_map(const Drawn& drawn) {
  static std::map<std::tuple<int, int, double, int, int>, render::Image> made;  // each is asked for many times
  const auto key = std::tuple(drawn.cracks, drawn.others, drawn.offset, drawn.samples, drawn.legend_shift);
  const auto at = made.find(key);
  return at != made.end() ? at->second : made.emplace(key, drawn_map(drawn)).first->second;
}

std::filesystem::path MadeReport::write(const std::filesystem::path& parent, const std::string& name) const {
  using Json = nlohmann::ordered_json;
  const std::filesystem::path folder = parent / (name + "." + scale);
  Json summary{{"format", summary_format},
               {"scenario", name},
               {"scale", scale},
               {"quantities", {{"compressive_strength", {{"name", "Compressive strength"}, {"unit", "MPa"}}}}},
               {"cases", Json::array()},
               {"comparisons", Json::array()},
               {"checks", Json::array()},
               {"figures", Json::array()}};
  static const std::array<dem::Quantity, 0> no_quantities{};
  for (const MadeCase& one : cases) {
    Json results = Json::object();
    for (const auto& [id, value] : one.results) results[id] = value;
    summary["cases"].push_back({{"id", one.id}, {"parameters", {{"test", "compression"}}}, {"results", results}});
    summary["checks"].push_back({{"id", one.id + ".energy_residual"},
                                 {"value", check_holds ? 1e-6 : 2e-3},
                                 {"limit", 1e-3},
                                 {"held", check_holds}});
    dem::Record record;
    record.model = "grain_texture";
    record.scenario = name;
    record.case_id = one.id;
    record.physics_version = physics;
    record.quantities = no_quantities;
    record.content = fmt::format(
        "model = grain_texture\nphysics version = {}\nspecimen.height = 0.0{}\nmineral[2].cohesion = {:g}\nseed = {}\n",
        physics, one.id.substr(0, 16).size() + (one.id.find("ar_2") != std::string::npos ? 1 : 0), one.cohesion,
        one.seed);
    dem::write_record(record, folder / "cases" / one.id / "results.h5");
  }
  summary["comparisons"].push_back({{"id", "ucs"},
                                    {"source", "Zhao et al. 2021, Table 3"},
                                    {"published", 206.8},
                                    {"computed", 163.4},
                                    {"deviation", -0.21},
                                    {"tolerance", 0.25},
                                    {"verdict", verdict},
                                    {"unit", "MPa"},
                                    {"relative", true}});
  summary["figures"].push_back({{"id", figure},
                                {"title", "Crack maps"},
                                {"source", ""},
                                {"files", {"figures/" + figure + ".png", "figures/drawing.svg", "data/curves.csv"}}});
  render::write_png(crack_map(drawn), folder / "figures" / (figure + ".png"), {{"Engine", "0.1.0"}},
                    render::Content::photograph);
  dem::write_file(folder / "figures/drawing.svg", drawing);
  std::string csv = "series,Strain (%),Stress (MPa)\r\n";
  for (int i = 0; i <= 400; ++i) {
    const double strain = i / 400.0;
    csv += fmt::format("stress,{:.9g},{:.9g}\r\n", strain, peak * std::sin(3.14159 * std::pow(strain, 1.3)));
  }
  dem::write_file(folder / "data/curves.csv", csv);
  dem::write_file(folder / "summary.json", summary.dump(2));
  dem::write_file(folder / "report.html",
                  "<html><head><style>p{}</style></head><body><main><section id=\"findings\"><p>The strength is " +
                      fmt::format("{}", peak) + " MPa.</p></section><section id=\"choices\"><p>" + choice +
                      "</p></section></main></body></html>");
  return folder;
}

}  // namespace test
