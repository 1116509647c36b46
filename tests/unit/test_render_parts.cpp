// Axes, curves, free places and colours of charts, and what a scene hides, without drawing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "engine/core/random.h"
#include "render/chart/curve.h"
#include "render/chart/occupancy.h"
#include "render/chart/ticks.h"
#include "render/dashes.h"
#include "render/paper/paper.h"
#include "render/scene/culling.h"

using render::Axis;
using render::Range;
using render::Scale;

namespace {

Range range(double low, double high) {
  Range r;
  r.take(low);
  r.take(high);
  return r;
}

std::vector<std::string> labels(const Scale& scale) {
  std::vector<std::string> found;
  for (const auto& tick : scale.ticks)
    if (!tick.label.empty()) found.push_back(tick.label);
  return found;
}

}  // namespace

TEST_CASE("ticks stand at 1, 2 or 5 times a power of ten and their labels carry no noise") {
  const Scale scale = render::make_scale(Axis{}, range(0, 0.31), 7, false);
  CHECK(labels(scale) == std::vector<std::string>{"0", "0.05", "0.10", "0.15", "0.20", "0.25", "0.30", "0.35"});
  CHECK(scale.share(0) == 0);
  CHECK(scale.share(scale.high) == 1);
}

TEST_CASE("negative numbers have a minus sign, not a hyphen, and zero has none") {
  CHECK(render::plain_number(-2.5, 1) == "\u22122.5");
  CHECK(render::plain_number(-0.001, 1) == "0.0");
  CHECK(render::plain_number(2500, 0) == "2500");
  CHECK(render::plain_number(-12345.6, 1) == "\u221212\u202f345.6");
  CHECK(render::plain_number(1234567, 0) == "1\u202f234\u202f567");
  CHECK(render::plain_number(100000, 0) == "100\u202f000");
}

TEST_CASE("any range gives a few ticks inside it, with labels that differ") {
  for (double low : {-1e12, -3.0, 0.0, 1e-30, 0.999999, 7.0, 1e9})
    for (double width : {1e-25, 1e-9, 1e-3, 0.7, 12.0, 3e5, 1e20}) {
      if (low + width == low || width < 1e-9 * std::abs(low)) continue;  // not apart in double precision labels
      const Scale scale = render::make_scale(Axis{}, range(low, low + width), 6, false);
      CAPTURE(low);
      CAPTURE(width);
      CHECK(scale.low <= low + 1e-6 * width);
      CHECK(scale.high >= low + width - 1e-6 * width);
      const auto found = labels(scale);
      CHECK(found.size() >= 3);
      CHECK(found.size() <= 14);
      CHECK(std::set<std::string>(found.begin(), found.end()).size() == found.size());
    }
}

TEST_CASE("large and small numbers are written in units of a power of ten") {
  const Scale small = render::make_scale(Axis{}, range(0, 4e-6), 4, false);
  CHECK(small.multiplier == "\u00d7\u00a010\u207b\u2076");
  CHECK(labels(small).back() == "4");
  const Scale large = render::make_scale(Axis{}, range(0, 3e7), 4, false);
  CHECK(large.multiplier == "\u00d7\u00a010\u2077");
}

TEST_CASE("an axis without data, with one value, or with given ends is still an axis") {
  for (const Scale& scale :
       {render::make_scale(Axis{}, Range{}, 5, false), render::make_scale(Axis{}, range(3, 3), 5, false),
        render::make_scale(Axis{}, range(0, 0), 5, false)}) {
    CHECK(scale.high > scale.low);
    CHECK(labels(scale).size() >= 2);
  }
  Axis given;
  given.low = 10;
  given.high = 37;
  const Scale scale = render::make_scale(given, range(0, 100), 5, false);
  CHECK(scale.low == 10);
  CHECK(scale.high == 37);
}

TEST_CASE("axes of senseless ranges end, too") {
  const double huge = std::numeric_limits<double>::infinity();
  for (const Range& r :
       {range(1e17, 1e17 + 16), range(-huge, huge), range(0, 5e-310), range(-1e299, 1e299), range(1, 1 + 1e-15)})
    for (bool logarithmic : {false, true}) {
      Axis axis;
      axis.logarithmic = logarithmic;
      const Scale scale = render::make_scale(axis, r, 6, false);
      CHECK(scale.high > scale.low);
      CHECK(scale.ticks.size() < 400);
      axis.low = huge;
      axis.high = -huge;
      CHECK(render::make_scale(axis, r, 6, false).ticks.size() < 400);
      axis.low = 5;
      axis.high = 2;
      CHECK(render::make_scale(axis, r, 6, false).high > render::make_scale(axis, r, 6, false).low);
    }
}

TEST_CASE("a log axis has labelled decades, minor ticks between, and no place for zero") {
  Axis axis;
  axis.logarithmic = true;
  const Scale scale = render::make_scale(axis, range(10, 1e6), 6, false);
  CHECK(labels(scale).front() == "10\u00b9");
  CHECK(labels(scale).back() == "10\u2076");
  CHECK(scale.share(std::sqrt(10 * 1e6)) == doctest::Approx(0.5));
  CHECK(std::isnan(scale.share(0)));
  std::size_t minor = 0;
  for (const auto& tick : scale.ticks) minor += tick.major ? 0 : 1;
  CHECK(minor == 5 * 8);
  const Scale many = render::make_scale(axis, range(1e-12, 1e12), 6, false);
  CHECK(labels(many).size() <= 8);
}

TEST_CASE("a long curve keeps its peaks and loses its points") {
  std::vector<render::Vec2> line;
  for (int i = 0; i < 100000; ++i) line.push_back({0.006 * i, i == 54321 ? 0.0 : 200 + 50 * std::sin(1e-4 * i)});
  const auto fewer = render::simplified(line);
  CHECK(fewer.size() < 500);
  CHECK(fewer.front().x == line.front().x);
  CHECK(fewer.back().x == line.back().x);
  double lowest = 1e9;
  for (const auto& p : fewer) lowest = std::min(lowest, p.y);
  CHECK(lowest == 0);
}

TEST_CASE("clipping keeps what is inside, and a missing value breaks the line") {
  const render::Rect window{0, 0, 10, 10};
  const auto through = render::clip({{-5, 5}, {15, 5}}, window);
  REQUIRE(through.size() == 1);
  CHECK(through[0].front().x == doctest::Approx(0));
  CHECK(through[0].back().x == doctest::Approx(10));
  CHECK(render::clip({{-5, -5}, {15, -5}}, window).empty());
  CHECK(render::clip({{1, 1}, {2, std::nan("")}, {3, 1}, {4, 1}}, window).size() == 1);
  CHECK(render::clip({{1, 1}, {20, 1}, {20, 5}, {1, 5}}, window).size() == 2);
}

TEST_CASE("dashes cover their share of a line, whatever its corners") {
  const std::vector<std::array<double, 2>> line{{0, 0}, {37, 0}, {37, 41}, {100, 41}};
  double inked = 0;
  for (const auto& piece : render::dashes(line, render::Line::dash, 2)) {
    const auto &a = line[piece.segment], &b = line[piece.segment + 1];
    inked += (piece.to - piece.from) * std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  const double length = 37 + 41 + 63;
  CHECK(inked / length == doctest::Approx(5.0 / 8).epsilon(0.05));
  CHECK(render::dashes(line, render::Line::none, 2).empty());
}

TEST_CASE("only spheres that no ray reaches are left out") {
  dem::RandomStream random(3, dem::Purpose::test_data);
  std::vector<render::ViewSphere> spheres;
  for (int i = 0; i < 3000; ++i)
    spheres.push_back(
        {{random.uniform(-60, 60), random.uniform(-60, 60), random.uniform(-60, 60)}, random.uniform(3, 7)});
  for (std::size_t i = 0; i < spheres.size(); ++i) spheres[i].hiding_radius = i % 10 == 0 ? 0 : spheres[i].radius;
  const auto drawn = render::seen(spheres, 120, 120);
  std::set<std::size_t> reached;
  for (double x = -59.75; x < 60; x += 0.5)
    for (double y = -59.75; y < 60; y += 0.5) {
      std::size_t first = spheres.size();
      double nearest = -1e300;
      for (std::size_t i = 0; i < spheres.size(); ++i) {
        const auto& s = spheres[i];
        const double square =
            s.radius * s.radius - (x - s.centre[0]) * (x - s.centre[0]) - (y - s.centre[1]) * (y - s.centre[1]);
        if (square <= 0 || s.centre[2] + std::sqrt(square) <= nearest) continue;
        nearest = s.centre[2] + std::sqrt(square);
        first = i;
      }
      if (first < spheres.size()) reached.insert(first);
    }
  for (std::size_t i : reached) CHECK(drawn[i]);
  CHECK(std::count(drawn.begin(), drawn.end(), true) < 1000);  // and most of the hidden ones are
}

TEST_CASE("occupancy finds what lies in a rectangle and nothing beside it") {
  render::Occupancy taken(100, 100);
  taken.add_line({{10, 10}, {90, 10}});
  CHECK(taken.taken({20, 0, 40, 20}) > 0);
  CHECK(taken.taken({20, 20, 40, 60}) == 0);
}
