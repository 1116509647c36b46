// Elle files, up to the grain of each particle.
#include "engine/sheet/grains.h"
#include "tests/fuzz/fuzz.h"

int main(int argc, char** argv) {
  using namespace dem::sheet;
  const Sheet sheet = make_sheet(12);
  dem_fuzz::Harness harness{"elle",
                            dem_fuzz::corpus("elle"),
                            {"OPTIONS\n", "FLYNNS\n", "LOCATION\n", "MINERAL\n", "UNODES\n", "UNODES CONC_A\n",
                             "U_ATTRIB_A\n", "Default ", "CellBoundingBox ", "SimpleShearOffset ", "GRAIN\n",
                             "AGE AGE CYCLE\n", "EXPAND\n", "-1 ", " 0 1 2 3", "\n", "\t", "#", "QUARTZ"},
                            {},
                            [&](const std::string& input) {
                              const ElleMap map = parse_elle(input, "map.elle");
                              bool asked = false;  // for unodes, as rules do: find() refuses places far outside
                              for (const std::string& name : map.attribute_names()) {
                                const ElleColumn column = map.find(name);
                                asked = asked || (column && column.section->of_unodes);
                                for (std::size_t f = 0; f < map.flynns.size(); ++f) (void)map.attribute(name, f);
                                if (column && !column.section->values.empty())
                                  (void)column.part(column.section->values.front().second);
                              }
                              for (const auto& outline : dem::sheet::outlines(map)) (void)area(outline);
                              if (asked && !map.unodes.empty()) (void)nearest_unodes(map, sheet);
                              (void)cover(map, sheet);
                              (void)parse_elle(elle_text(map), "again.elle");  // what was read comes back
                            }};
  return dem_fuzz::run(argc, argv, harness);
}
