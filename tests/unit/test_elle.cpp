// Elle files and grain maps.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include "engine/core/errors.h"
#include "engine/sheet/grains.h"

namespace {

using namespace dem::sheet;

const char* const good = R"(# a comment
OPTIONS
SwitchDistance 0.015
CellBoundingBox 0.0 0.0
                1.0 0.0
                1.0 1.0
                0.0 1.0
FLYNNS
0 4 0 1 2 3
4 4 1 4 5 2
MINERAL
Default QUARTZ
4 GARNET
EXPAND
Default 0
4 1
LOCATION
0 0.0 0.0
1 0.4 0.0
2 0.4 1.0
3 0.0 1.0
4 0.8 0.0
5 0.8 1.0
CONC_A
Default 0
UNODES
0 0.1 0.1
1 0.2 0.1
)";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = good;
  text.replace(text.find(from), from.size(), to);
  return text;
}

void refuses(const std::string& text, int line, const std::string& part) {
  try {
    const ElleMap map = parse_elle(text, "map.elle");
    for (std::size_t f = 0; f < map.flynns.size(); ++f) (void)outline(map, f);
    FAIL_CHECK("read without complaint: " << part);
  } catch (const dem::InputError& error) {
    CAPTURE(std::string(error.what()));
    CHECK(error.where().line == line);
    CHECK(std::string(error.what()).find(part) != std::string::npos);
    CHECK(!error.right().empty());
  }
}

}  // namespace

TEST_CASE("a file's polygons, attributes and options are read") {
  const ElleMap map = parse_elle(good, "map.elle");
  REQUIRE(map.flynns.size() == 2);
  CHECK(map.flynns[1].id == 4);
  CHECK(map.flynns[1].nodes == std::vector<int>{1, 4, 5, 2});
  CHECK(map.attribute("MINERAL", 0) == "QUARTZ");
  CHECK(map.attribute("MINERAL", 1) == "GARNET");
  CHECK(map.attribute("EXPAND", 1) == "1");
  CHECK(map.attribute("VISCOSITY", 1).empty());
  CHECK(map.nodes.size() == 6);
  CHECK(map.unodes == 2);
  REQUIRE(map.options.size() == 1);
  CHECK(map.options[0].second == "0.015");
  CHECK(map.notes.size() == 2);  // CONC_A left out, unodes counted
}

TEST_CASE("writing and reading again keeps polygons, attributes and options") {
  const ElleMap first = parse_elle(good, "map.elle");
  const ElleMap second = parse_elle(elle_text(first), "again.elle");
  REQUIRE(second.flynns.size() == first.flynns.size());
  for (std::size_t f = 0; f < first.flynns.size(); ++f) {
    CHECK(second.flynns[f].id == first.flynns[f].id);
    CHECK(second.flynns[f].nodes == first.flynns[f].nodes);
    CHECK(outline(second, f) == outline(first, f));
    for (const char* name : {"MINERAL", "EXPAND"}) CHECK(second.attribute(name, f) == first.attribute(name, f));
  }
  CHECK(second.options == first.options);
  CHECK(elle_text(second) == elle_text(first));
}

TEST_CASE("broken files are refused with line and reason") {
  refuses(replaced("0 4 0 1 2 3", "0 5 0 1 2 3"), 9, "says 5 nodes and lists 4");
  refuses(replaced("0 4 0 1 2 3", "0 4 0 1 2 x"), 9, "'x' is no id");
  refuses(replaced("0 4 0 1 2 3", "0 2 0 1"), 9, "has 2 nodes");
  refuses(replaced("0 4 0 1 2 3", "0"), 9, "without nodes");
  refuses(replaced("4 4 1 4 5 2", "0 4 1 4 5 2"), 10, "given twice");
  refuses(replaced("4 4 1 4 5 2", "4 4 1 4 9 2"), 10, "node 9");
  refuses(replaced("4 GARNET", "7 GARNET"), 13, "no flynn 7");
  refuses(replaced("4 GARNET", "4"), 13, "has no value");
  refuses(replaced("1 0.4 0.0", "1 0.4"), 19, "three numbers");
  refuses(replaced("1 0.4 0.0", "1 0.4 nan"), 19, "no number");
  refuses(replaced("1 0.4 0.0", "1 0.4 1e999"), 19, "no number");
  refuses(replaced("1 0.4 0.0", "0 0.4 0.0"), 19, "given twice");
  refuses(replaced("1.0 0.0\n", "1.0 0.3\n"), 7, "upright rectangle");
  refuses(replaced("# a comment", "5 6 7"), 1, "outside every section");
  refuses(replaced("UNODES", "FLYNNS"), 26, "given twice");
  refuses("FLYNNS\n", 1, "no grains");
  refuses("", 0, "no grains");
  refuses("FLYNNS\n0 3 0 1 2\n", 2, "no nodes");
  refuses("OPTIONS\nCellBoundingBox 0 0\n1 0\n", 3, "ends inside");
}

TEST_CASE("an outline over the cell's edge is made whole; one that never closes is refused") {
  const ElleMap map =
      parse_elle("FLYNNS\n0 4 0 1 2 3\nLOCATION\n0 0.9 0.4\n1 0.1 0.4\n2 0.1 0.6\n3 0.9 0.6\n", "edge.elle");
  const auto points = outline(map, 0);
  CHECK(points[1][0] == doctest::Approx(1.1));
  CHECK(area(points) == doctest::Approx(0.04));
  refuses("FLYNNS\n0 3 0 1 2\nLOCATION\n0 0.1 0.5\n1 0.4 0.5\n2 0.7 0.5\n", 2, "does not close");
}

TEST_CASE("every prefix of a file is read or refused, never a crash") {
  const std::string text = good;
  int refused = 0;
  for (std::size_t n = 0; n < text.size(); ++n) {
    try {
      const ElleMap map = parse_elle(text.substr(0, n), "cut.elle");
      for (std::size_t f = 0; f < map.flynns.size(); ++f) (void)outline(map, f);
    } catch (const dem::InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 200);
}

TEST_CASE("grown maps fill the cell, cover each particle once, and survive a round trip") {
  for (const bool periodic : {true, false}) {
    VoronoiSettings settings;
    settings.periodic = periodic;
    const ElleMap map = voronoi_map(settings);
    const Sheet sheet = make_sheet(100);
    const Cover covered = cover(map, sheet);
    CHECK(covered.area_share == doctest::Approx(1.0).epsilon(1e-6));
    CHECK(covered.holes <= 2);
    CHECK(covered.overlaps <= 2);
    std::vector<int> count(map.flynns.size(), 0);
    for (const auto f : covered.flynn) ++count[static_cast<std::size_t>(f)];
    CHECK(*std::min_element(count.begin(), count.end()) > 0);
    const Cover again = cover(parse_elle(elle_text(map), "again.elle"), sheet);
    CHECK(again.flynn == covered.flynn);
    settings.seed = 2;
    CHECK(cover(voronoi_map(settings), sheet).flynn != covered.flynn);
  }
}

TEST_CASE("holes and overlaps are counted") {
  const Sheet sheet = make_sheet(50);
  const std::string start =
      "FLYNNS\n0 6 0 1 2 3 4 5\n1 6 6 7 8 9 10 11\nLOCATION\n0 0 0\n1 0.45 0\n2 0.45 0.45\n3 0.45 0.9\n4 0 0.9\n"
      "5 0 0.45\n";
  const auto second = [](double left) {
    std::string text;
    int id = 6;
    for (const auto& [x, y] :
         {std::pair{left, 0.0}, {left + 0.4, 0.0}, {left + 0.4, 0.45}, {left + 0.4, 0.9}, {left, 0.9}, {left, 0.45}}) {
      text += std::to_string(id++) + " " + std::to_string(x) + " " + std::to_string(y) + "\n";
    }
    return text;
  };
  const Cover gap = cover(parse_elle(start + second(0.55), "gap.elle"), sheet);
  CHECK(gap.holes > 0);
  CHECK(gap.overlaps == 0);
  CHECK(gap.area_share == doctest::Approx(0.85 * 0.9));
  const Cover both = cover(parse_elle(start + second(0.35), "both.elle"), sheet);
  CHECK(both.overlaps > 0);
  for (const auto f : both.flynn) CHECK(f >= 0);
}

TEST_CASE("disorder: constants by grain, thresholds by spring, each from its own stream") {
  const ElleMap map = voronoi_map({});
  const Sheet plain = make_sheet(60);
  const Cover covered = cover(map, plain);
  const std::vector<GrainProperties> grains(map.flynns.size());
  DisorderSettings settings;
  Sheet a = plain, b = plain;
  apply_disorder(a, covered, grains, settings, 1);
  settings.strength_spread = 0.1;
  apply_disorder(b, covered, grains, settings, 1);
  CHECK(a.stiffness == b.stiffness);  // thresholds draw from another stream than constants
  CHECK(a.threshold != b.threshold);
  int between = 0;
  for (int slot = 0; slot < a.slots(); ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (a.stiffness[k] <= 0) continue;
    if (along_wall(a, slot)) {
      CHECK(std::isinf(a.threshold[k]));
      continue;
    }
    between += a.between[k];
    const double factor = a.between[k] ? 0.5 : 1.0;
    CHECK(a.threshold[k] >= factor * 0.006 * 0.4);
    CHECK(a.threshold[k] <= factor * 0.006 * 1.6);
  }
  CHECK(between > 100);
}

TEST_CASE("layers and marked grains carry their attributes") {
  const ElleMap layers = layered_map(1.0, 0.4, 0.6);
  const Sheet sheet = make_sheet(40);
  const Cover covered = cover(layers, sheet);
  CHECK(layers.attribute("MINERAL", 1) == "LAYER");
  for (int i = 0; i < sheet.particles(); ++i) {
    const auto p = static_cast<std::size_t>(i);
    CHECK((covered.flynn[p] == 1) == (sheet.y[p] >= 0.4 && sheet.y[p] < 0.6));
  }
  ElleMap map = voronoi_map({60, 2, true, 1.0, 3});
  mark_expanding(map, 3, "GARNET", 3);
  int marked = 0;
  for (std::size_t f = 0; f < map.flynns.size(); ++f) marked += map.attribute("EXPAND", f) == "1" ? 1 : 0;
  CHECK(marked == 3);
  CHECK_THROWS_AS(mark_expanding(map, 100, "GARNET", 3), dem::InputError);
}

TEST_CASE("files written by Elle itself are read, and come back the same" *
          doctest::skip(std::getenv("DEM_ELLE_DATA") == nullptr)) {
  const std::filesystem::path folder = std::getenv("DEM_ELLE_DATA");
  for (const char* name : {"garnet.elle", "polycrystal.elle"}) {
    CAPTURE(name);
    const ElleMap map = read_elle(folder / name);
    const Sheet sheet = make_sheet(200);
    const Cover covered = cover(map, sheet);
    MESSAGE(name << ": " << map.flynns.size() << " flynns, " << map.unodes << " unodes, area share "
                 << covered.area_share << ", holes " << covered.holes << ", overlaps " << covered.overlaps);
    CHECK(covered.area_share == doctest::Approx(1.0).epsilon(1e-3));
    CHECK(covered.holes < sheet.particles() / 1000);
    CHECK(covered.overlaps < sheet.particles() / 1000);
    const ElleMap again = parse_elle(elle_text(map), "again.elle");
    REQUIRE(again.flynns.size() == map.flynns.size());
    for (std::size_t f = 0; f < map.flynns.size(); ++f) {
      CHECK(outline(again, f) == outline(map, f));
      CHECK(again.attribute("MINERAL", f) == map.attribute("MINERAL", f));
    }
  }
}
