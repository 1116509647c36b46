#pragma once
// What a case of the close-packed lattice gives, and what sets it apart (Liu et al. 2017). Stresses and strains are
// positive in the sense of the test.
#include <array>

#include "engine/model/quantities.h"

namespace dem::lattice {

namespace quantity {

using dem::quantity::measured;

inline constexpr std::string_view strength = "tension compression";

inline constexpr Quantity normal_stiffness{.id = "normal_stiffness",
                                           .name = "Normal stiffness of a bond",
                                           .symbol = "K_n",
                                           .unit = "N/m",
                                           .shown = "10⁶ N/m",
                                           .factor = 1e-6,
                                           .digits = 5,
                                           .kind = QuantityKind::diagnostic,
                                           .meaning = "Follows from the rock (Eq. 3)."};
inline constexpr Quantity shear_stiffness{.id = "shear_stiffness",
                                          .name = "Shear stiffness of a bond",
                                          .symbol = "K_s",
                                          .unit = "N/m",
                                          .shown = "10⁶ N/m",
                                          .factor = 1e-6,
                                          .digits = 4,
                                          .kind = QuantityKind::diagnostic,
                                          .meaning = "Follows from the rock (Eq. 4)."};
inline constexpr Quantity breaking_displacement{.id = "breaking_displacement",
                                                .name = "Breaking displacement",
                                                .symbol = "X_b",
                                                .unit = "m",
                                                .shown = "10⁻⁷ m",
                                                .factor = 1e7,
                                                .digits = 4,
                                                .kind = QuantityKind::diagnostic,
                                                .meaning = "Elongation at which a bond opens."};
inline constexpr Quantity initial_shear_resistance{
    .id = "initial_shear_resistance",
    .name = "Initial shear resistance",
    .symbol = "F_s0",
    .unit = "N",
    .digits = 5,
    .kind = QuantityKind::diagnostic,
    .meaning = "Shear force at which a bond without normal force slides."};
inline constexpr Quantity contact_friction{.id = "contact_friction",
                                           .name = "Friction of a contact",
                                           .symbol = "μ_p",
                                           .digits = 4,
                                           .kind = QuantityKind::diagnostic,
                                           .meaning = "Follows from the coefficient of internal friction (Eq. B5)."};
inline constexpr Quantity element_mass{.id = "element_mass",
                                       .name = "Mass of an element",
                                       .symbol = "m",
                                       .unit = "kg",
                                       .shown = "10⁻⁶ kg",
                                       .factor = 1e6,
                                       .digits = 4,
                                       .kind = QuantityKind::diagnostic,
                                       .meaning = "From the density of the whole packing (Eq. 27)."};
inline constexpr Quantity opening_stress_theory{
    .id = "opening_stress_theory",
    .name = "First opening in compression, by theory",
    .symbol = "C_open",
    .unit = "MPa",
    .digits = 4,
    .kind = QuantityKind::diagnostic,
    .meaning = "Stress at which the first bonds of a compressed block should open (Eq. 8)."};
inline constexpr Quantity young_modulus =
    measured(dem::quantity::young_modulus, "elastic", "Stress over strain at the smallest of the strains.");
inline constexpr Quantity poisson_ratio =
    measured(dem::quantity::poisson_ratio, "elastic",
             "Mean of the two lateral strains over the axial one at the smallest of the strains.");
inline constexpr Quantity young_modulus_error{.id = "young_modulus_error",
                                              .name = "Mean error of Young’s modulus over the strains",
                                              .unit = "%",
                                              .tests = "elastic",
                                              .meaning = "Mean over the strains of |E / E of the rock - 1|."};
inline constexpr Quantity poisson_ratio_error{.id = "poisson_ratio_error",
                                              .name = "Mean error of Poisson’s ratio over the strains",
                                              .unit = "%",
                                              .tests = "elastic",
                                              .meaning = "Mean over the strains of |ν / ν of the rock - 1|."};
inline constexpr Quantity young_modulus_at_largest_strain{
    .id = "young_modulus_at_largest_strain",
    .name = "Young’s modulus at the largest strain",
    .symbol = "E",
    .unit = "GPa",
    .tests = "elastic",
    .meaning = "Stress over strain at the largest of the strains."};
inline constexpr Quantity poisson_ratio_at_largest_strain{
    .id = "poisson_ratio_at_largest_strain",
    .name = "Poisson’s ratio at the largest strain",
    .symbol = "ν",
    .tests = "elastic",
    .meaning = "Lateral over axial strain at the largest of the strains."};
inline constexpr Quantity tensile_strength =
    measured(dem::quantity::tensile_strength, "tension", "Largest stress of a test that ends in failure.");
inline constexpr Quantity tensile_strength_error{.id = "tensile_strength_error",
                                                 .name = "Deviation of the tensile strength from theory",
                                                 .unit = "%",
                                                 .tests = "tension",
                                                 .meaning = "Strength of the block over that of the rock, less one."};
inline constexpr Quantity compressive_strength =
    measured(dem::quantity::compressive_strength, "compression",
             "Largest stress of a test that ends in failure; the uniaxial compressive strength, UCS.");
inline constexpr Quantity compressive_strength_error{
    .id = "compressive_strength_error",
    .name = "Deviation of the compressive strength from theory",
    .unit = "%",
    .tests = "compression",
    .meaning =
        "Strength of the block over that of the rock, less one; under pressure the rock’s is Cᵤ and what its "
        "internal friction adds."};
inline constexpr Quantity peak_strain =
    measured(dem::quantity::peak_strain, strength, "Strain at the largest stress, as measure.gauge has it.");
inline constexpr Quantity failure_time{.id = "failure_time",
                                       .name = "Time at which the main crack begins to open",
                                       .unit = "s",
                                       .shown = "µs",
                                       .factor = 1e6,
                                       .tests = "tension",
                                       .meaning = "First step of the run of opening bonds with most bonds."};
inline constexpr Quantity crack_duration{
    .id = "crack_duration",
    .name = "Time from D₁ to D₂",
    .unit = "s",
    .shown = "µs",
    .factor = 1e6,
    .tests = "tension",
    .meaning = "From the first to the last bond that opens while the block parts."};
inline constexpr Quantity crack_speed{.id = "crack_speed",
                                      .name = "Width over the time from D₁ to D₂",
                                      .unit = "m/s",
                                      .tests = "tension",
                                      .meaning = "Of the block; the mean speed of the crack that parts it."};
inline constexpr Quantity kinetic_share{
    .id = "kinetic_share",
    .name = "Largest kinetic energy over the work (compression: over the elastic energy)",
    .shown = "%",
    .factor = 100,
    .tests = strength,
    .meaning =
        "In tension after D₁, over the work at that time; in compression after the "
        "peak, over the elastic energy of the peak."};
inline constexpr Quantity frictional_share_at_parting{
    .id = "frictional_share_at_parting",
    .name = "Frictional heat over work when the main crack has opened",
    .shown = "%",
    .factor = 100,
    .tests = "tension",
    .meaning = "Over the work at that time."};
inline constexpr Quantity frictional_share{.id = "frictional_share",
                                           .name = "Frictional heat over work at the end",
                                           .shown = "%",
                                           .factor = 100,
                                           .tests = "tension",
                                           .meaning = "Over the work."};
inline constexpr Quantity friction_after_last_opening{.id = "friction_after_last_opening",
                                                      .name = "Time from D₂ to friction",
                                                      .unit = "s",
                                                      .shown = "µs",
                                                      .factor = 1e6,
                                                      .tests = "tension",
                                                      .meaning = "Until the frictional heat passes 10⁻⁶ of the work."};
inline constexpr Quantity first_opening{.id = "first_opening",
                                        .name = "Stress at the first opening",
                                        .unit = "MPa",
                                        .tests = "compression",
                                        .meaning = "Stress before the first bond opens."};
inline constexpr Quantity first_sliding{.id = "first_sliding",
                                        .name = "Stress at the first sliding",
                                        .unit = "MPa",
                                        .tests = "compression",
                                        .meaning = "Stress before the first bond slides."};
inline constexpr Quantity a1_stress{
    .id = "a1_stress",
    .name = "Stress as most bonds begin to open",
    .unit = "MPa",
    .tests = "compression",
    .meaning = "Before the 300 time steps, up to the peak, in which most bonds open; A₁ is the largest stress so far."};
inline constexpr Quantity a1_strain{.id = "a1_strain",
                                    .name = "Strain as most bonds begin to open",
                                    .shown = "%",
                                    .factor = 100,
                                    .tests = "compression",
                                    .meaning = "Before those time steps."};
inline constexpr Quantity a1_time{.id = "a1_time",
                                  .name = "Time as most bonds begin to open",
                                  .unit = "s",
                                  .shown = "µs",
                                  .factor = 1e6,
                                  .kind = QuantityKind::diagnostic,
                                  .tests = "compression",
                                  .meaning = "Before those time steps."};
inline constexpr Quantity sliding_start{.id = "sliding_start",
                                        .name = "Time at C₁",
                                        .unit = "s",
                                        .shown = "µs",
                                        .factor = 1e6,
                                        .kind = QuantityKind::diagnostic,
                                        .tests = "compression",
                                        .meaning = "First bond that slides from the peak on."};
inline constexpr Quantity sliding_duration{
    .id = "sliding_duration",
    .name = "Time from C₁ to C₂",
    .unit = "s",
    .shown = "µs",
    .factor = 1e6,
    .tests = "compression",
    .meaning = "Until 99 of 100 of the bonds that slide from the peak on have slid."};
inline constexpr Quantity normal_share_of_sliding_heat{
    .id = "normal_share_of_sliding_heat",
    .name = "Share of normal springs in the breaking heat from C₁ to C₂",
    .shown = "%",
    .factor = 100,
    .tests = "compression",
    .meaning = "Over all breaking heat of that time."};
inline constexpr Quantity frictional_share_after_sliding{.id = "frictional_share_after_sliding",
                                                         .name = "Share of the frictional heat after C₂",
                                                         .shown = "%",
                                                         .factor = 100,
                                                         .tests = "compression",
                                                         .meaning = "Over all frictional heat."};
inline constexpr Quantity elastic_left_share{.id = "elastic_left_share",
                                             .name = "Least elastic energy after the peak over that at the peak",
                                             .shown = "%",
                                             .factor = 100,
                                             .tests = "compression",
                                             .meaning = "Over that at the peak."};
inline constexpr Quantity viscous_share_of_heat{
    .id = "viscous_share_of_heat",
    .name = "Viscous share of the heat (compression: after C₁)",
    .shown = "%",
    .factor = 100,
    .tests = strength,
    .meaning = "Of all heat in tension; of the heat after C₁ in compression."};
inline constexpr Quantity viscous_share_after_parting{.id = "viscous_share_after_parting",
                                                      .name = "Share of the viscous heat after D₂",
                                                      .shown = "%",
                                                      .factor = 100,
                                                      .tests = "tension",
                                                      .meaning = "Over all viscous heat."};
inline constexpr Quantity cracks_opening{.id = "cracks.opening",
                                         .name = "Opening cracks",
                                         .kind = QuantityKind::count,
                                         .of_size = true,
                                         .tests = strength,
                                         .meaning = "Bonds that broke in tension."};
inline constexpr Quantity cracks_sliding{.id = "cracks.sliding",
                                         .name = "Sliding cracks",
                                         .kind = QuantityKind::count,
                                         .of_size = true,
                                         .tests = strength,
                                         .meaning = "Bonds that broke in shear."};
inline constexpr Quantity energy_residual = measured(
    dem::quantity::energy_residual, strength,
    "Largest residual of the energy ledger over the work, taken as at least a thousandth of its largest value so far.");
inline constexpr Quantity particles = measured(dem::quantity::particles, "", "Elements of the block.");
inline constexpr Quantity contacts = measured(dem::quantity::contacts, "", "Bonds of the block at the start.");
inline constexpr Quantity steps = measured(dem::quantity::steps, strength, "Time steps of the test.");

}  // namespace quantity

namespace parameter {

inline constexpr Parameter elements_y{.id = "elements_y",
                                      .name = "Elements along y",
                                      .symbol = "n =",
                                      .in_ids = "n",
                                      .key = "block.elements_y",
                                      .axis = true,
                                      .words = "the size of the block",
                                      .step = "element"};
// How the planes hold the end elements: a choice for each test, and each case has that of its own.
inline constexpr Parameter planes_elastic{
    .id = "planes_elastic", .name = "Planes", .symbol = "planes", .key = "planes.elastic"};
inline constexpr Parameter planes_compression{
    .id = "planes_compression", .name = "Planes", .symbol = "planes", .key = "planes.compression"};
inline constexpr Parameter planes_tension{
    .id = "planes_tension", .name = "Planes", .symbol = "planes", .key = "planes.tension"};
/// That of a test.
constexpr const Parameter& planes_in(std::string_view test) {
  return test == "tension" ? planes_tension : test == "compression" ? planes_compression : planes_elastic;
}
inline constexpr Parameter moving{
    .id = "moving", .name = "Moving planes", .symbol = "moving planes", .key = "loading.moving"};
inline constexpr Parameter direction{
    .id = "direction", .name = "Direction of loading", .symbol = "along", .key = "loading.direction"};
inline constexpr Parameter factor{
    .id = "factor", .name = "Loading steps", .symbol = "loading steps ×", .in_ids = "x", .usual = "1"};
inline constexpr Parameter stiffness{.id = "stiffness",
                                     .name = "Springs of the planes",
                                     .symbol = "springs of the planes ×",
                                     .in_ids = "k",
                                     .usual = "1"};
inline constexpr Parameter confining_pressure{.id = "confining_pressure",
                                              .name = "Confining pressure σ₃",
                                              .symbol = "σ₃",
                                              .unit = "MPa",
                                              .in_ids = "sigma3",
                                              .key = "loading.confining_pressure"};
inline constexpr Parameter tensile_deficit{.id = "tensile_deficit",
                                           .name = "Tensile deficit made up for",
                                           .symbol = "T_u deficit",
                                           .unit = "%",
                                           .in_ids = "tu",
                                           .key = "correction.tensile_deficit"};
inline constexpr Parameter compressive_deficit{.id = "compressive_deficit",
                                               .name = "Compressive deficit made up for",
                                               .symbol = "C_u deficit",
                                               .unit = "%",
                                               .in_ids = "cu",
                                               .key = "correction.compressive_deficit"};
inline constexpr Parameter method{
    .id = "method", .name = "Elastic method", .symbol = "method", .key = "elastic.method"};

}  // namespace parameter

/// All of them, in the order of tables.
std::span<const Quantity> quantities();
std::span<const Parameter> parameters();

}  // namespace dem::lattice
