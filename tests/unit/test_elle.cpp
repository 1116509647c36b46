// Elle files and grain maps.
#include <doctest/doctest.h>
#include <fmt/format.h>

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
    (void)outlines(map);
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
  CHECK(map.unodes.size() == 2);
  REQUIRE(map.options.size() == 1);
  CHECK(map.options[0].second == "0.015");
  CHECK(map.notes.size() == 1);  // CONC_A of nodes left out
}

TEST_CASE("writing and reading again keeps polygons, attributes and options") {
  const ElleMap first = parse_elle(good, "map.elle");
  const ElleMap second = parse_elle(elle_text(first), "again.elle");
  REQUIRE(second.flynns.size() == first.flynns.size());
  for (std::size_t f = 0; f < first.flynns.size(); ++f) {
    CHECK(second.flynns[f].id == first.flynns[f].id);
    CHECK(second.flynns[f].nodes == first.flynns[f].nodes);
    CHECK(outlines(second)[f] == outlines(first)[f]);
    for (const char* name : {"MINERAL", "EXPAND"}) CHECK(second.attribute(name, f) == first.attribute(name, f));
  }
  CHECK(second.options == first.options);
  CHECK(second.unodes.size() == first.unodes.size());
  CHECK(elle_text(second) == elle_text(first));
}

TEST_CASE("broken files are refused with line and reason") {
  refuses(replaced("0 4 0 1 2 3", "0 5 0 1 2 3"), 9, "says 5 nodes and lists 4");
  refuses(replaced("0 4 0 1 2 3", "0 4 0 1 2 x"), 9, "'x' is no id");
  refuses(replaced("0 4 0 1 2 3", "0 2 0 1"), 9, "has 2 nodes");
  refuses(replaced("0 4 0 1 2 3", "0"), 9, "without nodes");
  refuses(replaced("4 4 1 4 5 2", "0 4 1 4 5 2"), 10, "given twice");
  refuses(replaced("4 4 1 4 5 2", "4 4 1 4 9 2"), 10, "node 9");
  refuses(replaced("1 0.4 0.0", "1 0.4"), 19, "three numbers");
  refuses(replaced("1 0.4 0.0", "1 0.4 nan"), 19, "no number");
  refuses(replaced("1 0.4 0.0", "1 0.4 1e999"), 19, "no number");
  refuses(replaced("1 0.4 0.0", "0 0.4 0.0"), 19, "given twice");
  refuses(replaced("1.0 0.0\n", "1.0 0.3\n"), 7, "level bottom");
  refuses(replaced("1.0 1.0\n", "1.2 1.0\n"), 7, "same width");
  refuses(replaced("1.0 1.0\n", "1.0 -1.0\n"), 7, "level");
  refuses(replaced("1.0 0.0\n                1.0 1.0\n                0.0 1.0", "1e-320 0 1e-320 1 0 1"), 5,
          "same width");
  refuses(replaced("SwitchDistance 0.015", "SimpleShearOffset x"), 3, "no number");
  refuses(replaced("1 0.4 0.0", "1 1e300 0.0"), 9, "far outside");
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
  const auto points = outlines(map)[0];
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
      (void)outlines(map);
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

namespace {

// A cell of two by two grains, its corners as given, its nodes moved by `shear` times their height.
std::string four_grains(double shear, const std::string& top_right, const std::string& top_left,
                        const std::string& option = "") {
  std::string text = "OPTIONS\nCellBoundingBox 0 0\n1 0\n" + top_right + "\n" + top_left + "\n" + option + "\n";
  std::string nodes = "LOCATION\n";
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      const double y = j / 8.0, x = i / 8.0 + shear * y;
      nodes += fmt::format("{} {} {}\n", 8 * j + i, x - std::floor(x), y);
    }
  }
  text += "FLYNNS\n";
  for (int g = 0; g < 4; ++g) {
    text += fmt::format("{} 16", g);
    const int left = 4 * (g % 2), low = 4 * (g / 2);
    for (int k = 0; k < 16; ++k) {
      const int side = k / 4, along = k % 4;
      const int i = left + (side == 0 ? along : side == 1 ? 4 : side == 2 ? 4 - along : 0);
      const int j = low + (side == 0 ? 0 : side == 1 ? along : side == 2 ? 4 : 4 - along);
      text += fmt::format(" {}", 8 * (j % 8) + i % 8);
    }
    text += "\n";
  }
  return text + nodes;
}

// A square grain and its matrix, which is the same outline; `turned`: run the other way round.
std::string nested(double low, double high, bool grain_turned, bool matrix_turned) {
  std::string nodes = "LOCATION\n";
  std::vector<int> ids;
  for (int k = 0; k < 24; ++k) {
    const int side = k / 6;
    const double t = low + (high - low) * (k % 6) / 6, back = high + low - t;
    const double x = side == 0 ? t : side == 1 ? high : side == 2 ? back : low;
    const double y = side == 0 ? low : side == 1 ? t : side == 2 ? high : back;
    nodes += fmt::format("{} {} {}\n", k, x, y);
    ids.push_back(k);
  }
  const auto flynn = [&](int id, bool turned) {
    std::vector<int> order = ids;
    if (turned) std::reverse(order.begin(), order.end());
    return fmt::format("{} 24 {}\n", id, fmt::join(order, " "));
  };
  return "FLYNNS\n" + flynn(0, grain_turned) + flynn(1, matrix_turned) + nodes + "MINERAL\nDefault QUARTZ\n0 GARNET\n";
}

}  // namespace

TEST_CASE("a word in capitals begins a section, whatever follows it; columns have names") {
  const std::string text = std::string(good) +
                           "AGE AGE CYCLE\nDefault 0 0\n4 3 1\nFLYNN_STRAIN\tE_XX E_XY\nDENSITY g cm\n1 2\n"
                           "U_PHASE\nDefault 1\n1 2\n";
  const std::string columns =
      std::string(text).replace(text.find("UNODES\n0 0.1 0.1\n"), 17, "UNODES CONC_A U_X\n0 0.1 0.1 7 8\n");
  const ElleMap map = parse_elle(columns, "map.elle");
  const ElleColumn cycle = map.find("AGE.CYCLE");
  REQUIRE(cycle);
  CHECK(cycle.part("3 1") == "1");
  CHECK(map.attribute("AGE", 1) == "3 1");
  CHECK(map.find("CONC_A").column == 0);
  CHECK(map.find("CONC_A").section->of_unodes);
  CHECK(map.find("U_X").part(map.find("U_X").section->values[0].second) == "8");
  CHECK(map.find("U_PHASE").section->standard == "1");
  CHECK(map.find("FLYNN_STRAIN"));
  CHECK_FALSE(map.find("DENSITY"));
  CHECK(map.attribute_names() == std::vector<std::string>{"MINERAL", "EXPAND", "CONC_A", "U_X", "AGE", "AGE.AGE",
                                                          "AGE.CYCLE", "FLYNN_STRAIN", "FLYNN_STRAIN.E_XX",
                                                          "FLYNN_STRAIN.E_XY", "U_PHASE"});
  const ElleMap again = parse_elle(elle_text(map), "again.elle");
  CHECK(again.find("AGE.CYCLE").column == 1);
  CHECK(again.find("CONC_A").section->values == map.find("CONC_A").section->values);
  CHECK(elle_text(again) == elle_text(map));
  CHECK(parse_elle(replaced("FLYNNS", "REGIONS"), "early.elle").flynns.size() == 2);
}

TEST_CASE("values that nobody asks for refuse no file; a note counts them, and asking for them does refuse") {
  struct Broken {
    const char *from, *to, *name;
    int line;
    const char* what;
  };
  for (const Broken& broken : {Broken{"4 GARNET", "7 GARNET", "MINERAL", 13, "no flynn 7"},
                               {"4 GARNET", "4", "MINERAL", 13, "has no value"},
                               {"4 GARNET", "x GARNET", "MINERAL", 13, "'x' is no id"},
                               {"4 GARNET", "4 A\n4 B", "MINERAL", 14, "two values"},
                               {"EXPAND", "MINERAL", "MINERAL", 14, "given twice"},
                               {"UNODES\n0 0.1", "UNODES CONC_B\n0 nan", "CONC_B", 27, "no place"},
                               {"UNODES\n0 0.1", "UNODES CONC_B\n1 0.1", "CONC_B", 28, "two values"},
                               {"UNODES\n0 0.1", "UNODES CONC_B\n0 1e300", "CONC_B", 27, "far outside"},
                               {"CONC_A\nDefault 0", "U_X\n5 1", "U_X", 25, "no unode 5"}}) {
    CAPTURE(broken.to);
    const ElleMap map = parse_elle(replaced(broken.from, broken.to), "map.elle");
    const auto said = [&](const std::string& note) { return note.find("cannot be read") != std::string::npos; };
    CHECK(std::count_if(map.notes.begin(), map.notes.end(), said) == 1);
    try {
      (void)map.find(broken.name);
      FAIL_CHECK("found without complaint");
    } catch (const dem::InputError& error) {
      CAPTURE(std::string(error.what()));
      CHECK(error.where().line == broken.line);
      CHECK(std::string(error.what()).find(broken.what) != std::string::npos);
      CHECK_FALSE(error.right().empty());
    }
  }
}

TEST_CASE("a sheared cell goes on periodically, each row of cells moved against the one below") {
  const Sheet sheet = make_sheet(60, 90);  // higher than the cell
  struct Sheared {
    double shear;
    std::string text;
  };
  for (const auto& [shear, text] :
       {Sheared{0, four_grains(0, "1 1", "0 1")}, Sheared{0.25, four_grains(0.25, "1.25 1", "0.25 1")},
        Sheared{-0.4, four_grains(-0.4, "0.6 1", "-0.4 1", "SimpleShearOffset -0.4")},
        Sheared{0.25, four_grains(0.25, "1 1", "0 1", "SimpleShearOffset 0.25")},
        Sheared{0.3, four_grains(0.3, "3.3 1", "2.3 1", "SimpleShearOffset 0.3\nCumulativeSimpleShear 2")},
        Sheared{0.5, four_grains(0.5, "1.5 1", "0.5 1")}}) {
    CAPTURE(shear);
    const ElleMap map = parse_elle(text, "sheared.elle");
    CHECK(map.notes.empty());
    for (std::size_t f = 0; f < 4; ++f) CHECK(area(outlines(map)[f]) == doctest::Approx(0.25));
    const Cover covered = cover(map, sheet);
    CHECK(covered.holes + covered.overlaps == 0);
    int wrong = 0;
    for (int i = 0; i < sheet.particles(); ++i) {
      const auto p = static_cast<std::size_t>(i);
      const double x = sheet.x[p] - 0.5 * sheet.radius0 - shear * sheet.y[p], y = sheet.y[p];
      const double u = x - std::floor(x), v = y - std::floor(y);
      const bool edge = std::fmod(u, 0.5) < 1e-6 || std::fmod(u, 0.5) > 0.5 - 1e-6;
      const int grain = (u < 0.5 ? 0 : 1) + (v < 0.5 ? 0 : 2);
      wrong += !edge && covered.flynn[p] != grain ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(cover(parse_elle(elle_text(map), "again.elle"), sheet).flynn == covered.flynn);
  }
  const ElleMap apart = parse_elle(four_grains(0.25, "1.25 1", "0.25 1", "SimpleShearOffset 0.1"), "apart.elle");
  CHECK(apart.notes.size() == 1);
}

TEST_CASE("an outline that runs the other way round is the outside") {
  const Sheet sheet = make_sheet(80);
  const double half = 0.5 * std::sqrt(0.5);
  for (const auto& [low, high] : {std::pair{0.125, 0.875}, {0.4, 0.6}, {0.5 - half, 0.5 + half}, {0.7, 1.3}}) {
    for (const bool clockwise : {false, true}) {
      CAPTURE(low);
      CAPTURE(clockwise);
      const ElleMap map = parse_elle(nested(low, high, clockwise, !clockwise), "nested.elle");
      const Cover covered = cover(map, sheet);
      CHECK(covered.holes + covered.overlaps <= 2);
      CHECK(covered.area_share == doctest::Approx(1));
      int grain = 0;
      for (const auto f : covered.flynn) grain += f == 0 ? 1 : 0;
      // Of two outlines that run against each other the one that runs counter-clockwise is the grain.
      const double inside = (high - low) * (high - low);
      CHECK(grain == doctest::Approx((clockwise ? 1 - inside : inside) * sheet.particles()).epsilon(0.03));
    }
  }
  // A map whose outlines all run clockwise, as of a picture upside down, is the same map.
  ElleMap map = voronoi_map({});
  const Cover before = cover(map, sheet);
  for (ElleFlynn& flynn : map.flynns) std::reverse(flynn.nodes.begin(), flynn.nodes.end());
  CHECK(cover(map, sheet).flynn == before.flynn);
  for (std::size_t f = 0; f < map.flynns.size(); f += 2)
    std::reverse(map.flynns[f].nodes.begin(), map.flynns[f].nodes.end());  // and so is one that runs any way
  CHECK(cover(map, sheet).flynn == before.flynn);
}

TEST_CASE("holes and overlaps over one per cent are refused with flynn and line; smaller ones are counted") {
  const Sheet sheet = make_sheet(100);
  // The node that four grains share, moved for two of them: along the diagonal into a third, or away from it.
  const auto moved = [](double by) {
    std::string text = four_grains(0, "1 1", "0 1");
    const auto first = text.find("\n0 16 0 1 2 3 4 12 20 28 36");
    REQUIRE(first != std::string::npos);
    text.replace(text.find(" 36", first), 3, " 99");
    return text + fmt::format("99 {} {}\n", 0.5 + by, 0.5 + by);
  };
  for (const double by : {0.02, -0.02}) {
    const Cover covered = cover(parse_elle(moved(by), "near.elle"), sheet);
    CHECK((by > 0 ? covered.overlaps : covered.holes) > 10);
    CHECK((by > 0 ? covered.holes : covered.overlaps) == 0);
    for (const auto f : covered.flynn) CHECK(f >= 0);
  }
  for (const auto& [by, line, part] : {std::tuple{0.2, 8, "flynn 3 and in flynn 0 of line 8"},
                                       std::tuple{-0.2, 8, "lie in no flynn, most of them beside flynn 0"}}) {
    try {
      (void)cover(parse_elle(moved(by), "far.elle"), sheet);
      FAIL_CHECK("laid without complaint");
    } catch (const dem::InputError& error) {
      const std::string what = error.what();
      CAPTURE(what);
      CHECK(what.find("far.elle:") == 0);
      CHECK(error.where().line >= line);
      CHECK(what.find(" % of the cell") != std::string::npos);
      if (by < 0) CHECK(what.find(part) != std::string::npos);
    }
  }
}

TEST_CASE("the nearest unode of each particle, as the cell repeats") {
  const Sheet sheet = make_sheet(24, 40);
  for (const double shear : {0.0, 0.3}) {
    for (const int count : {1, 7, 300}) {
      ElleMap map;
      map.shear = shear;
      for (int u = 0; u < count; ++u)
        map.unodes.push_back({u, {std::fmod(0.31 + 0.618 * u, 1), std::fmod(0.377 * u, 1)}});
      const auto nearest = nearest_unodes(map, sheet);
      int worse = 0;
      for (int i = 0; i < sheet.particles(); ++i) {
        const auto p = static_cast<std::size_t>(i);
        const double x = sheet.x[p] - 0.5 * sheet.radius0, y = sheet.y[p];
        const auto distance = [&](std::size_t u) {
          double best = 1e9;
          for (int sy = -2; sy <= 3; ++sy) {
            for (int sx = -3; sx <= 3; ++sx)
              best = std::min(
                  best, std::hypot(map.unodes[u].place[0] + sx + sy * shear - x, map.unodes[u].place[1] + sy - y));
          }
          return best;
        };
        double best = 1e9;
        for (std::size_t u = 0; u < map.unodes.size(); ++u) best = std::min(best, distance(u));
        worse += distance(static_cast<std::size_t>(nearest[p])) > best + 1e-12 ? 1 : 0;
      }
      CAPTURE(count);
      CHECK(worse == 0);
    }
  }
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

TEST_CASE("small maps of the kinds that Elle writes" * doctest::skip(std::getenv("DEM_ELLE_SMALL") == nullptr)) {
  const std::filesystem::path folder = std::getenv("DEM_ELLE_SMALL");
  for (const char* name : {"named_columns.elle", "sheared.elle", "nested.elle"}) {
    CAPTURE(name);
    const ElleMap map = read_elle(folder / name);
    const Sheet sheet = make_sheet(100);
    const Cover covered = cover(map, sheet);
    CHECK(covered.area_share == doctest::Approx(1).epsilon(1e-6));
    CHECK(covered.holes + covered.overlaps <= 2);
    std::vector<int> count(map.flynns.size(), 0);
    for (const auto f : covered.flynn) ++count[static_cast<std::size_t>(f)];
    for (const int n : count) CHECK(n > sheet.particles() / 5);
  }
}

TEST_CASE("files written by Elle itself are read, and come back the same" *
          doctest::skip(std::getenv("DEM_ELLE_DATA") == nullptr)) {
  const std::filesystem::path folder = std::getenv("DEM_ELLE_DATA");
  for (const char* name : {"garnet.elle", "polycrystal.elle"}) {
    CAPTURE(name);
    const ElleMap map = read_elle(folder / name);
    const Sheet sheet = make_sheet(200);
    const Cover covered = cover(map, sheet);
    MESSAGE(name << ": " << map.flynns.size() << " flynns, " << map.unodes.size() << " unodes, area share "
                 << covered.area_share << ", holes " << covered.holes << ", overlaps " << covered.overlaps);
    CHECK(covered.area_share == doctest::Approx(1.0).epsilon(1e-3));
    CHECK(covered.holes < sheet.particles() / 1000);
    CHECK(covered.overlaps < sheet.particles() / 1000);
    const ElleMap again = parse_elle(elle_text(map), "again.elle");
    REQUIRE(again.flynns.size() == map.flynns.size());
    for (std::size_t f = 0; f < map.flynns.size(); ++f) {
      CHECK(outlines(again)[f] == outlines(map)[f]);
      CHECK(again.attribute("MINERAL", f) == map.attribute("MINERAL", f));
    }
  }
}
