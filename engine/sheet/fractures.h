#pragma once
// What fractures of a sheet look like: how broken springs join, which way they run, and which of them cross a layer.
#include <vector>

#include "engine/sheet/experiment.h"

namespace dem::sheet {

/// Broken springs joined where they are neighbours (centres within 1.2 spacings): the fracture of each.
std::vector<int> fractures(const std::vector<Break>& breaks, double spacing);

/// Which way the fracture runs at each broken spring: direction of the largest scatter of its fracture's springs within
/// five spacings, 0 ... pi from the x axis; NaN where fewer than four springs tell. One spring alone knows three
/// directions only, those of the lattice.
std::vector<double> trends(const std::vector<Break>& breaks, double spacing);

/// Fractures whose springs inside a band reach across at least four fifths of what they can: a row less than the band.
struct Crossing {
  std::vector<double> places;  ///< mean x of each, ascending
  double mean_spacing = 0;     ///< mean distance between neighbours; NaN for fewer than two
  double scatter = 0;          ///< standard deviation of those distances over their mean; NaN for fewer than three
  double chance = 0;           ///< the scatter of as many places at random between the outermost
};
Crossing crossing(const std::vector<Break>& breaks, double spacing, double low, double high);

}  // namespace dem::sheet
