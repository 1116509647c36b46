#pragma once
// What a case of the 2D spring sheet gives, and what sets it apart. Lengths are in box widths, stresses in elastic
// constants k; k stands for 10 GPa.
#include <array>

#include "engine/model/quantities.h"

namespace dem::sheet {

namespace quantity {

using dem::quantity::measured;

inline constexpr Quantity peak_differential_stress{
    .id = "peak_differential_stress",
    .name = "Largest differential stress of the walls by the end of the run",
    .symbol = "Δσ",
    .unit = "k",
    .meaning =
        "Largest |σ_xx − σ_yy| on the walls, before the breaks of its load step, in elastic constants k. It is a peak "
        "where the run ends a quarter below it or more.",
    .peak_name = "Peak differential stress of the walls"};
inline constexpr Quantity strain_at_peak{.id = "strain_at_peak",
                                         .name = "Strain at the largest differential stress",
                                         .shown = "%",
                                         .factor = 100,
                                         .meaning = "Of the load step with the largest differential stress.",
                                         .peak_name = "Strain at the peak differential stress"};
inline constexpr Quantity breaks_before_peak{.id = "breaks_before_peak",
                                             .name = "Springs broken before the largest differential stress",
                                             .kind = QuantityKind::count,
                                             .of_size = true,
                                             .meaning = "In the load steps before that of the largest stress.",
                                             .peak_name = "Springs broken before the peak"};
inline constexpr Quantity onset_strain{.id = "onset_strain",
                                       .name = "Strain at the first break",
                                       .shown = "%",
                                       .factor = 100,
                                       .meaning = "Of the load step in which the first spring breaks."};
inline constexpr Quantity final_strain{.id = "final_strain",
                                       .name = "Strain at the end",
                                       .shown = "%",
                                       .factor = 100,
                                       .kind = QuantityKind::diagnostic,
                                       .meaning = "Where the run ended."};
/// What breaks in a sheet is a spring; elsewhere it is a bond, and a crack.
constexpr Quantity of_springs(const Quantity& cracks, std::string_view name, std::string_view meaning) {
  Quantity quantity = measured(cracks, "", meaning);
  quantity.name = name;
  return quantity;
}
inline constexpr Quantity cracks_intra_tension =
    of_springs(dem::quantity::cracks_intra_tension, "Broken springs inside grains", "In tension, as all that break.");
inline constexpr Quantity cracks_inter_tension =
    of_springs(dem::quantity::cracks_inter_tension, "Broken springs between grains",
               "In tension, as all that break; those at the edges of a layer are among them.");
inline constexpr Quantity inter_grain_crack_share{
    .id = "inter_grain_crack_share",
    .name = "Inter-grain share of broken springs",
    .shown = "%",
    .factor = 100,
    .meaning =
        "Broken springs between grains, those at the edges of a layer among "
        "them, over all broken ones."};
inline constexpr Quantity most_breaks_in_a_step{.id = "most_breaks_in_a_step",
                                                .name = "Most springs broken in one load step",
                                                .kind = QuantityKind::count,
                                                .of_size = true,
                                                .meaning = "How abruptly the sheet fails."};
inline constexpr Quantity worst_step_share{
    .id = "worst_step_share",
    .name = "Largest share of the breaks in one load step",
    .shown = "%",
    .factor = 100,
    .meaning = "The most springs that break in one load step over all that break."};
inline constexpr Quantity peak_tension{.id = "peak_tension",
                                       .name = "Largest tension on the walls",
                                       .unit = "k",
                                       .meaning = "The larger of σ_xx and σ_yy, before the breaks of its load step."};
inline constexpr Quantity strain_at_peak_tension{.id = "strain_at_peak_tension",
                                                 .name = "Strain at the largest tension",
                                                 .shown = "%",
                                                 .factor = 100,
                                                 .meaning = "Of the load step with the largest tension."};
inline constexpr Quantity largest_drop_share{.id = "largest_drop_share",
                                             .name = "Largest fall of the tension in one load step",
                                             .shown = "%",
                                             .factor = 100,
                                             .meaning = "Over the largest tension."};
inline constexpr Quantity radial_share{.id = "radial_share",
                                       .name = "Trends within 30° of the radius",
                                       .shown = "%",
                                       .factor = 100,
                                       .tests = "growth",
                                       .meaning =
                                           "Share of the broken springs whose fracture runs along the direction from "
                                           "the nearest growing grain; by chance a third."};
inline constexpr Quantity along_compression_share{
    .id = "along_compression_share",
    .name = "Trends within 30° of the compression",
    .shown = "%",
    .factor = 100,
    .tests = "pure_shear compression",
    .meaning = "Share of the broken springs whose fracture runs along the compression; by chance a third."};
inline constexpr Quantity across_extension_share{
    .id = "across_extension_share",
    .name = "Trends within 30° of the normal to the extension",
    .shown = "%",
    .factor = 100,
    .tests = "extension",
    .meaning = "Share of the broken springs whose fracture runs across the extension; by chance a third."};
inline constexpr Quantity crossing_fractures{
    .id = "crossing_fractures",
    .name = "Fractures through the layer",
    .kind = QuantityKind::count,
    .of_size = true,
    .meaning = "Fractures whose springs inside the layer reach across four fifths of it."};
inline constexpr Quantity spacing_over_thickness{
    .id = "spacing_over_thickness",
    .name = "Mean spacing of fractures",
    .unit = "layer thicknesses",
    .meaning = "Mean distance between neighbours that cross the layer, over its thickness."};
inline constexpr Quantity spacing_scatter{.id = "spacing_scatter",
                                          .name = "Scatter of the spacing",
                                          .shown = "%",
                                          .factor = 100,
                                          .digits = 2,
                                          .meaning = "Standard deviation over the mean."};
inline constexpr Quantity spacing_scatter_chance{.id = "spacing_scatter_chance",
                                                 .name = "Scatter of the spacing by chance",
                                                 .shown = "%",
                                                 .factor = 100,
                                                 .digits = 2,
                                                 .meaning = "The same of as many fractures at random."};
inline constexpr Quantity jumps{.id = "jumps",
                                .name = "Jumps from one equilibrium to another",
                                .kind = QuantityKind::count,
                                .meaning = "Parts of load steps in which the sheet jumped."};
inline constexpr Quantity jumped_share{
    .id = "jumped_share",
    .name = "Share of the work released by jumps",
    .shown = "%",
    .factor = 100,
    .digits = 2,
    .kind = QuantityKind::diagnostic,
    .meaning = "Energy that no smaller part of a load step accounts for, over the work."};
inline constexpr Quantity energy_residual =
    measured(dem::quantity::energy_residual, "",
             "Work that is neither elastic energy nor released by breaking or jumps, over the work.");
inline constexpr Quantity unbalanced_force{.id = "unbalanced_force",
                                           .name = "Largest unbalanced over largest spring force",
                                           .digits = 4,
                                           .kind = QuantityKind::diagnostic,
                                           .meaning = "The worst after any relaxation."};
inline constexpr Quantity load_steps{
    .id = "load_steps", .name = "Load steps", .kind = QuantityKind::count, .meaning = "Begun, the last one included."};
inline constexpr Quantity relaxations{.id = "solver.relaxations",
                                      .name = "Relaxations",
                                      .kind = QuantityKind::count,
                                      .of_size = true,
                                      .meaning = "One after each part of a load and each break."};
inline constexpr Quantity relaxations_stopped_short{.id = "solver.relaxations_that_stopped_short",
                                                    .name = "Relaxations that stopped short",
                                                    .kind = QuantityKind::count,
                                                    .of_size = true,
                                                    .meaning = "Given up before the criterion was met."};
inline constexpr Quantity solves{.id = "solver.solves",
                                 .name = "Solves",
                                 .kind = QuantityKind::count,
                                 .of_size = true,
                                 .meaning = "Linear solves with the factor."};
inline constexpr Quantity sweeps{.id = "solver.sweeps",
                                 .name = "Sweeps",
                                 .kind = QuantityKind::count,
                                 .of_size = true,
                                 .meaning = "Of the historical solver over all particles."};
inline constexpr Quantity factorisations{.id = "solver.factorisations",
                                         .name = "Factorisations",
                                         .kind = QuantityKind::count,
                                         .of_size = true,
                                         .meaning = "Times that the factor was made, whole or in part."};
inline constexpr Quantity patches{.id = "solver.patches",
                                  .name = "Newton patches",
                                  .kind = QuantityKind::count,
                                  .of_size = true,
                                  .meaning = "Solved around places where the force peaks."};
inline constexpr Quantity settled{.id = "solver.settled",
                                  .name = "Settlings by damped dynamics",
                                  .kind = QuantityKind::count,
                                  .of_size = true,
                                  .meaning = "Times that the worst places of a relaxation were let settle."};
inline constexpr Quantity particles = measured(dem::quantity::particles, "", "Particles of the sheet.");
inline constexpr Quantity contacts = measured(dem::quantity::contacts, "", "Springs of the sheet at the start.");
inline constexpr Quantity grains =
    measured(dem::quantity::grains, "", "Grains of the map; the matrix above a layer and that below it are two.");

inline constexpr Quantity most_springs{.id = "most_springs",
                                       .name = "Most springs of a particle",
                                       .kind = QuantityKind::count,
                                       .meaning = "On a triangular lattice six."};
inline constexpr Quantity boundary_threshold_ratio{
    .id = "boundary_threshold_ratio",
    .name = "Mean threshold at boundaries over that inside grains",
    .kind = QuantityKind::diagnostic,
    .meaning = "Of the springs that can break, between grains and inside them."};
inline constexpr Quantity boundary_stiffness_error{
    .id = "boundary_stiffness_error",
    .name = "Spring constants at boundaries off the mean of their grains",
    .shown = "%",
    .factor = 100,
    .digits = 2,
    .kind = QuantityKind::diagnostic,
    .meaning = "The largest, over the mean elastic constant of the two grains."};
inline constexpr Quantity threshold_departure{
    .id = "threshold_departure",
    .name = "Thresholds off a linear distribution",
    .kind = QuantityKind::diagnostic,
    .meaning =
        "Largest distance of the distribution function of the thresholds inside grains, without the factors of "
        "rules, from a straight line between the least and the largest."};
inline constexpr Quantity stiffness_departure{
    .id = "stiffness_departure",
    .name = "Elastic constants of the grains off a Gauss distribution",
    .kind = QuantityKind::diagnostic,
    .meaning =
        "Largest distance of the distribution function of the grains’ constants, without the factors of rules, from "
        "that of Gauss with their mean and deviation, times the root of their number: 0.9 in one of twenty drawn "
        "from it (Lilliefors). Of maps of eight grains or more."};
inline constexpr Quantity held_along_walls{
    .id = "held_along_walls",
    .name = "Particles held along their wall",
    .kind = QuantityKind::count,
    .meaning = "Besides the corners, which lie on two walls. None: walls are frictionless."};

}  // namespace quantity

namespace parameter {

inline constexpr Parameter spread{.id = "spread",
                                  .name = "Spread of the thresholds",
                                  .symbol = "spread",
                                  .in_ids = "spread",
                                  .key = "disorder.spread",
                                  .axis = true,
                                  .words = "the spread of the thresholds",
                                  .step = "unit of spread"};
inline constexpr Parameter solver{.id = "solver", .name = "Solver", .symbol = "solver", .usual = "converged"};
inline constexpr Parameter columns{
    .id = "columns", .name = "Particles in a row", .symbol = "columns", .key = "sheet.columns"};
inline constexpr Parameter seed{.id = "seed", .name = "Seed", .symbol = "seed", .in_ids = "seed", .key = "seed"};

}  // namespace parameter

/// All of them, in the order of tables.
std::span<const Quantity> quantities();
std::span<const Parameter> parameters();

}  // namespace dem::sheet
