#pragma once
// Grains of a sheet: maps grown here, the grain of each particle, and the disorder of springs that follows from both.
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/errors.h"
#include "engine/sheet/elle.h"
#include "engine/sheet/sheet.h"

namespace dem::sheet {

struct VoronoiSettings {
  int grains = 30;
  int lloyd = 2;         ///< steps that move each centre to the centre of its cell
  bool periodic = true;  ///< else the cells are cut at the box
  double height = 1;     ///< of the box, in box widths
  std::uint64_t seed = 1;
};

/// A Voronoi map of random centres, as an Elle map with shared nodes.
ElleMap voronoi_map(const VoronoiSettings& settings);
/// Horizontal bands: matrix below (flynn 0), a layer, matrix above (the last flynn); MINERAL MATRIX and LAYER. The
/// layer is one grain, or is grown of `grains.grains` Voronoi cells cut at its edges when that is more than one.
ElleMap layered_map(double height, double layer_low, double layer_high, const VoronoiSettings& grains = {.grains = 1});
/// Fewer grains lie inside the box than should expand.
struct TooFewInside : InputError {
  TooFewInside(int found, int wanted);
  int inside;
};

/// Marks `count` grains away from the box's edge, drawn at random, as expanding (EXPAND 1, MINERAL `mineral`).
void mark_expanding(ElleMap& map, int count, const std::string& mineral, std::uint64_t seed);

/// Which flynn holds each particle. The sheet's box is laid over the cell, width on width; past its edges the map goes
/// on as the cell repeats. An outline that runs the other way round than the others is the outside: its flynn is what
/// lies round it, a matrix round a grain.
struct Cover {
  std::vector<std::int32_t> flynn;  ///< index into ElleMap::flynns
  int holes = 0;                    ///< particles in no flynn; they take the grain of their nearest covered neighbour
  int overlaps = 0;                 ///< particles in more than one; they keep the first
  double area_share = 0;            ///< area of all flynns over the cell's
};
/// Throws InputError, with flynn and line, when more than 1 % of the sheet lies in no flynn or in more than one.
Cover cover(const ElleMap& map, const Sheet& sheet);
/// The unode nearest to each particle, as the cell repeats: an index into ElleMap::unodes. The map has unodes.
std::vector<std::int32_t> nearest_unodes(const ElleMap& map, const Sheet& sheet);

/// What a grain is made of, relative to the sheet's standard.
struct GrainProperties {
  double stiffness = 1;  ///< factor on the drawn elastic constant
  double strength = 1;   ///< factor on breaking thresholds
  double growth = 1;     ///< radius ratio of one step of growth
};

struct DisorderSettings {
  double stiffness = 1;          ///< mean elastic constant
  double stiffness_sd = 0.25;    ///< standard deviation over grains, as a share of the mean
  double strength = 0.006;       ///< mean breaking stress inside grains
  double strength_spread = 0.6;  ///< thresholds are uniform in strength (1 - spread ... 1 + spread)
  double boundary = 0.5;         ///< factor on thresholds between grains
};

/// Factor on thresholds that takes the size of the particles out of the load at which a crack grows: the tension of the spring
/// at its tip is the stress intensity over the root of the spacing. What is left, the constant part of the stress there, is a
/// share that falls with that root (test_sheet_notch: 4.5 % from 40 to 80 columns, 2 % from 160 to 320).
double toughness_factor(int columns, int reference);

/// Draws one elastic constant a grain (Gauss; draws below a fifth of the mean are drawn again) and one threshold a
/// spring (uniform), each from its own stream. Springs between grains have the mean constant and the boundary's
/// threshold; springs along walls never break. Keeps the weights that make_sheet gave to springs along walls.
/// `particles` are factors on top of those of the grains, one a particle; empty: none.
void apply_disorder(Sheet& sheet, const Cover& cover, const std::vector<GrainProperties>& grains,
                    const DisorderSettings& settings, std::uint64_t seed,
                    const std::vector<GrainProperties>& particles = {});

}  // namespace dem::sheet
