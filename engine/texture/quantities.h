#pragma once
// What a case of the grain texture model gives, and what sets it apart. Stresses and strains are positive in the sense of
// the test.
#include <array>

#include "engine/model/quantities.h"

namespace dem::texture {

namespace quantity {

using dem::quantity::measured, dem::quantity::scattered;

// Scatter: of the granite at draft scale (docs/notes/texture-and-seed.md).

inline constexpr std::string_view loaded =
    "compression direct_tension brazilian bending semicircular_bending direct_shear unloading_loops";
/// Those of a cylinder that is stretched or shortened along its axis.
inline constexpr std::string_view stretched = "compression direct_tension unloading_loops";
inline constexpr std::string_view shortened = "compression unloading_loops";

inline constexpr Quantity young_modulus = scattered(
    measured(
        dem::quantity::young_modulus, stretched,
        "Slope of axial stress over the axial strain of the gauge, least squares between 10 and 30 % of the peak."),
    0.017);
inline constexpr Quantity poisson_ratio = measured(dem::quantity::poisson_ratio, shortened,
                                                   "Lateral over axial strain of the gauge at half the peak stress.");
inline constexpr Quantity compressive_strength =
    scattered(measured(dem::quantity::compressive_strength, shortened,
                       "Largest axial stress; without confining pressure the uniaxial compressive strength, UCS."),
              0.03);
inline constexpr Quantity tensile_strength = scattered(
    measured(dem::quantity::tensile_strength, "direct_tension", "Largest axial stress between the grips."), 0.04);
inline constexpr Quantity brazilian_strength{
    .id = "brazilian_strength",
    .name = "Splitting strength",
    .symbol = "σ_B",
    .unit = "MPa",
    .tests = "brazilian",
    .meaning = "2P/(πDt) of the largest load P on a disc of diameter D and thickness t."};
inline constexpr Quantity first_cracks_middle{
    .id = "first_cracks.middle",
    .name = "First cracks in the middle of the disc",
    .shown = "%",
    .factor = 100,
    .tests = "brazilian",
    .meaning =
        "Share of the first cracks within half the radius of the disc’s axis; 25 % of cracks spread evenly are there. "
        "First are a hundredth of those at the peak, and ten at least."};
inline constexpr Quantity first_cracks_band{.id = "first_cracks.band",
                                            .name = "First cracks along the loaded diameter",
                                            .shown = "%",
                                            .factor = 100,
                                            .tests = "brazilian",
                                            .meaning =
                                                "Share of the same cracks within a quarter of the radius of the plane "
                                                "through both loads; 31 % of cracks spread "
                                                "evenly are there."};
inline constexpr Quantity modulus_of_rupture{
    .id = "modulus_of_rupture",
    .name = "Modulus of rupture",
    .symbol = "σ_R",
    .unit = "MPa",
    .tests = "bending",
    .meaning = "3PS/(2bW²) of the largest load P on a bar without a notch; span S, width b, depth W."};
inline constexpr Quantity fracture_toughness{
    .id = "fracture_toughness",
    .name = "Fracture toughness",
    .symbol = "K_Ic",
    .unit = "MPa√m",
    .tests = "bending semicircular_bending",
    .meaning =
        "Stress intensity at the tip of the notch at the largest load: ASTM E399 for a bar in three-point bending, "
        "Kuruppu et al. 2014 for a half disc."};
inline constexpr Quantity mouth_opening{
    .id = "mouth_opening",
    .name = "Notch opening at the largest load",
    .symbol = "CMOD",
    .unit = "µm",
    .tests = "bending semicircular_bending",
    .meaning =
        "Distance that both sides of the notch have moved apart at the lower face, by a line "
        "through the displacements of the particles near it."};
inline constexpr Quantity shear_strength{.id = "shear_strength",
                                         .name = "Peak shear strength",
                                         .symbol = "τ_p",
                                         .unit = "MPa",
                                         .tests = "direct_shear",
                                         .meaning = "Largest shear force over the area of the block."};
inline constexpr Quantity residual_shear{
    .id = "residual_shear_strength",
    .name = "Shear strength after the peak",
    .symbol = "τ_r",
    .unit = "MPa",
    .tests = "direct_shear",
    .meaning =
        "Mean shear stress over the last fifth of the shear displacement, of blocks that were sheared to the end; a "
        "residual strength once the upper half no longer rises."};
inline constexpr Quantity dilation_at_peak{.id = "dilation_at_peak",
                                           .name = "Rise of the upper half at the peak",
                                           .unit = "µm",
                                           .tests = "direct_shear",
                                           .meaning = "From its position under the normal stress alone."};
inline constexpr Quantity unloading_modulus{
    .id = "unloading_modulus",
    .name = "Modulus of the first unloading",
    .symbol = "E_u",
    .unit = "GPa",
    .tests = "unloading_loops",
    .meaning =
        "Secant of the first loop, from the stress where it was turned down to the stress where it was turned up."};
inline constexpr Quantity loop_damage{
    .id = "loop_damage.*",
    .name = "Damage at a loop",
    .symbol = "D",
    .tests = "unloading_loops",
    .meaning = "1 - E/E₁, E the secant modulus of a loop’s unloading and E₁ that of the first; by the loop’s number."};
inline constexpr Quantity peak_strain =
    measured(dem::quantity::peak_strain, stretched, "Axial strain of the gauge at the largest axial stress.");
inline constexpr Quantity residual_over_peak{
    .id = "residual_over_peak",
    .name = "Residual over peak stress",
    .tests = shortened,
    .meaning =
        "Mean axial stress over the last twentieth of the platens’ strain, over the peak; of tests that are "
        "followed beyond their end."};
inline constexpr Quantity initiation_by_stiffness{
    .id = "crack_initiation.axial_stiffness",
    .name = "Crack initiation stress, by axial stiffness",
    .symbol = "σ_ci",
    .unit = "MPa",
    .tests = shortened,
    .meaning = "Stress at which the axial stiffness leaves its early plateau by measure.stiffness_departure."};
inline constexpr Quantity initiation_strain{
    .id = "crack_initiation_strain.axial_stiffness",
    .name = "Strain at crack initiation, by axial stiffness",
    .symbol = "ε_ci",
    .shown = "%",
    .factor = 100,
    .tests = shortened,
    .meaning = "Axial strain of the gauge where the axial stiffness leaves its plateau."};
inline constexpr Quantity stress_at_strain{.id = "crack_initiation.strain_0_1_percent",
                                           .name = "Stress at 0.1 % axial strain",
                                           .symbol = "σ_ci",
                                           .unit = "MPa",
                                           .tests = shortened,
                                           .meaning =
                                               "Axial stress at an axial strain of 0.1 %, the strain at which the "
                                               "paper finds crack initiation."};
inline constexpr Quantity initiation_by_cracks{
    .id = "crack_initiation.one_percent_of_cracks",
    .name = "Crack initiation stress, 1 % of cracks at the peak",
    .symbol = "σ_ci",
    .unit = "MPa",
    .tests = shortened,
    .meaning = "Stress at which 1 % of the cracks that are there at the peak have formed."};
inline constexpr Quantity initiation_by_volume{
    .id = "crack_initiation.crack_volumetric_strain",
    .name = "Crack initiation stress, by crack volumetric strain",
    .symbol = "σ_ci",
    .unit = "MPa",
    .tests = shortened,
    .meaning = "Stress at which the crack volumetric strain, what is left after the elastic part, turns back."};
inline constexpr Quantity crack_damage{.id = "crack_damage",
                                       .name = "Crack damage stress",
                                       .symbol = "σ_cd",
                                       .unit = "MPa",
                                       .scatter = 0.05,
                                       .tests = shortened,
                                       .meaning = "Stress at the largest volumetric strain before the peak."};
inline constexpr Quantity crack_damage_strain{
    .id = "crack_damage_strain",
    .name = "Strain at crack damage",
    .symbol = "ε_cd",
    .shown = "%",
    .factor = 100,
    .tests = shortened,
    .meaning = "Axial strain of the gauge at the largest volumetric strain before the peak."};

inline constexpr Quantity inter_grain_share{
    .id = "inter_grain_share",
    .name = "Inter-grain share of contacts",
    .shown = "%",
    .factor = 100,
    .scatter = 0.006,
    .meaning = "Contacts between particles of different grains over all contacts."};
inline constexpr Quantity realised_ar{
    .id = "realised_aspect_ratio",
    .name = "Aspect ratio of the grown grains",
    .scatter = 0.01,
    .meaning =
        "Root of the second moments of all grains along the nominal long axis, over those across it: growth rounds "
        "off the ellipsoids."};
inline constexpr Quantity coordination{.id = "coordination",
                                       .name = "Coordination number",
                                       .scatter = 0.0015,
                                       .meaning = "Mean number of contacts of a particle of the packing."};
inline constexpr Quantity porosity{.id = "porosity",
                                   .name = "Porosity",
                                   .scatter = 0.003,
                                   .meaning = "Volume of the packing that no sphere fills, overlaps counted twice."};
inline constexpr Quantity mineral_share{.id = "mineral_share.*",
                                        .name = "Share of a mineral",
                                        .shown = "%",
                                        .factor = 100,
                                        .meaning = "Volume of the mineral’s particles over that of all."};
inline constexpr Quantity contact_share{
    .id = "contact_share.*",
    .name = "Share of a contact group",
    .shown = "%",
    .factor = 100,
    .meaning = "Contacts of one group over all: inside grains of a mineral, or between grains of two minerals."};

inline constexpr Quantity cracks_intra_tension =
    measured(dem::quantity::cracks_intra_tension, loaded, "Elements of flat joints broken in tension at the end.");
inline constexpr Quantity cracks_intra_shear{.id = "cracks.intra_shear",
                                             .name = "Intra-grain shear cracks",
                                             .kind = QuantityKind::count,
                                             .of_size = true,
                                             .tests = loaded,
                                             .meaning = "Elements of flat joints broken in shear at the end."};
inline constexpr Quantity cracks_inter_tension =
    measured(dem::quantity::cracks_inter_tension, loaded, "Bonds between grains broken in tension at the end.");
inline constexpr Quantity cracks_inter_shear{.id = "cracks.inter_shear",
                                             .name = "Inter-grain shear cracks",
                                             .kind = QuantityKind::count,
                                             .of_size = true,
                                             .tests = loaded,
                                             .meaning = "Bonds between grains broken in shear at the end."};
inline constexpr Quantity peak_cracks_intra_tension{.id = "cracks_at_peak.intra_tension",
                                                    .name = "Intra-grain tension cracks at the peak",
                                                    .kind = QuantityKind::count,
                                                    .of_size = true,
                                                    .tests = loaded,
                                                    .meaning = "At the peak of the stress."};
inline constexpr Quantity peak_cracks_intra_shear{.id = "cracks_at_peak.intra_shear",
                                                  .name = "Intra-grain shear cracks at the peak",
                                                  .kind = QuantityKind::count,
                                                  .of_size = true,
                                                  .tests = loaded,
                                                  .meaning = "At the peak of the stress."};
inline constexpr Quantity peak_cracks_inter_tension{.id = "cracks_at_peak.inter_tension",
                                                    .name = "Inter-grain tension cracks at the peak",
                                                    .kind = QuantityKind::count,
                                                    .of_size = true,
                                                    .tests = loaded,
                                                    .meaning = "At the peak of the stress."};
inline constexpr Quantity peak_cracks_inter_shear{.id = "cracks_at_peak.inter_shear",
                                                  .name = "Inter-grain shear cracks at the peak",
                                                  .kind = QuantityKind::count,
                                                  .of_size = true,
                                                  .tests = loaded,
                                                  .meaning = "At the peak of the stress."};
/// In the order of the crack counts of a history: intra tension, intra shear, inter tension, inter shear.
inline constexpr std::array cracks{cracks_intra_tension, cracks_intra_shear, cracks_inter_tension, cracks_inter_shear};
inline constexpr std::array cracks_at_peak{peak_cracks_intra_tension, peak_cracks_intra_shear,
                                           peak_cracks_inter_tension, peak_cracks_inter_shear};

inline constexpr Quantity gap_share{
    .id = "gap_share",
    .name = "Share of gap particles",
    .shown = "%",
    .factor = 100,
    .tests = "genesis",
    .meaning = "Particles that no ellipsoid covers and that grains grow into, over all."};
inline constexpr Quantity growth_rounds{.id = "growth_rounds",
                                        .name = "Rounds of growth",
                                        .kind = QuantityKind::count,
                                        .tests = "genesis",
                                        .meaning = "Rounds until every gap particle belonged to a grain."};
inline constexpr Quantity floaters_removed{.id = "floaters_removed",
                                           .name = "Particles without contacts removed",
                                           .kind = QuantityKind::count,
                                           .of_size = true,
                                           .tests = "genesis",
                                           .meaning = "Particles without enough contacts, taken out of the packing."};

inline constexpr Quantity servo_error{
    .id = "servo_error",
    .name = "Largest servo error",
    .shown = "%",
    .factor = 100,
    .digits = 2,
    .kind = QuantityKind::diagnostic,
    .tests = "compression",
    .meaning = "Largest departure of the confining pressure from its set value, to the end of the test."};
inline constexpr Quantity energy_residual =
    measured(dem::quantity::energy_residual, loaded,
             "Largest residual of the energy account over max(W, 1 % of the largest W), W the work that came in.");
inline constexpr Quantity stress_imbalance{.id = "stress_imbalance",
                                           .name = "Imbalance of the two loaded sides, root mean square",
                                           .digits = 2,
                                           .kind = QuantityKind::diagnostic,
                                           .tests = loaded,
                                           .meaning =
                                               "Difference of the stresses at the two ends up to the peak, over the "
                                               "peak stress; the check “equilibrium” limits it."};
inline constexpr Quantity largest_stress_imbalance{
    .id = "largest_stress_imbalance",
    .name = "Imbalance of the two loaded sides, largest of any sample",
    .digits = 2,
    .kind = QuantityKind::diagnostic,
    .tests = loaded,
    .meaning = "The largest of those differences, mostly the wave of a single crack; no check limits it."};
inline constexpr Quantity steps = measured(dem::quantity::steps, loaded, "Time steps of the test.");
inline constexpr Quantity particles = measured(dem::quantity::particles, "", "Spheres of the specimen.");
inline constexpr Quantity contacts =
    measured(dem::quantity::contacts, "", "Contacts of the packing, bonded at the start.");
inline constexpr Quantity grains = measured(dem::quantity::grains, "", "Grain seeds of the specimen.");
inline constexpr Quantity fresh_contacts{.id = "fresh_contacts",
                                         .name = "Contacts that formed later",
                                         .kind = QuantityKind::count,
                                         .of_size = true,
                                         .tests = loaded,
                                         .meaning = "Linear frictional contacts at the end of the run."};
inline constexpr Quantity time_step{.id = "time_step",
                                    .name = "Time step",
                                    .symbol = "Δt",
                                    .unit = "s",
                                    .kind = QuantityKind::diagnostic,
                                    .tests = loaded,
                                    .meaning = "Of the leapfrog; solver.time_step_factor of the critical one."};

/// The ways to read crack initiation off a test.
inline constexpr std::array initiation_readings{
    Reading{"axial_stiffness", "axial stiffness", initiation_by_stiffness},
    Reading{"strain_0_1_percent", "stress at 0.1 % strain", stress_at_strain},
    Reading{"one_percent_of_cracks", "1 % of the cracks at the peak", initiation_by_cracks},
    Reading{"crack_volumetric_strain", "crack volumetric strain", initiation_by_volume}};

}  // namespace quantity

namespace parameter {

inline constexpr Parameter aspect_ratio{.id = "aspect_ratio",
                                        .name = "Aspect ratio",
                                        .symbol = "AR",
                                        .in_ids = "ar",
                                        .key = "texture.aspect_ratio",
                                        .axis = true,
                                        .words = "the aspect ratio",
                                        .step = "unit of aspect ratio"};
inline constexpr Parameter dip{.id = "dip",
                               .name = "Dip of the long axis",
                               .symbol = "dip",
                               .unit = "°",
                               .in_ids = "dip",
                               .key = "texture.dip",
                               .axis = true,
                               .words = "the dip",
                               .step = "degree of dip"};
inline constexpr Parameter seed_scale{.id = "seed_scale",
                                      .name = "Seed scale",
                                      .symbol = "grain diameters ×",
                                      .in_ids = "seed_scale",
                                      .key = "texture.seed_scale"};
inline constexpr Parameter growth{
    .id = "growth", .name = "Rule of growth", .symbol = "growth by", .key = "texture.growth"};
inline constexpr Parameter between{.id = "between",
                                   .name = "Coefficients act between",
                                   .symbol = "coefficients between different",
                                   .key = "interaction.between"};
inline constexpr Parameter pressure_ratio{.id = "pressure_ratio",
                                          .name = "Packing pressure over modulus",
                                          .symbol = "packing pressure",
                                          .in_ids = "pressure_ratio",
                                          .key = "packing.pressure_ratio",
                                          .behind = "of the modulus"};
inline constexpr Parameter raised{
    .id = "raised", .name = "Parameter raised", .key = "sensitivity.parameter", .behind = "raised"};
inline constexpr Parameter mineral{.id = "mineral", .name = "Mineral", .key = "texture.only_mineral"};
inline constexpr Parameter confining_pressure{.id = "confining_pressure",
                                              .name = "Confining pressure σ₃",
                                              .symbol = "σ₃",
                                              .unit = "MPa",
                                              .in_ids = "sigma3",
                                              .key = "compression.confining_pressure",
                                              .axis = true,
                                              .words = "the confining pressure",
                                              .step = "MPa of confining pressure"};
inline constexpr Parameter jaw_ratio{.id = "jaw_ratio",
                                     .name = "Radius of the jaws over that of the disc",
                                     .symbol = "jaws of",
                                     .in_ids = "jaws",
                                     .key = "brazilian.jaw_ratio",
                                     .at_zero = "flat platens",
                                     .behind = "R",
                                     .axis = true,
                                     .words = "the jaw ratio",
                                     .step = "unit of the jaw ratio"};
inline constexpr Parameter notch{.id = "notch",
                                 .name = "Notch depth over bar depth",
                                 .symbol = "notch of",
                                 .in_ids = "notch",
                                 .key = "bending.notch",
                                 .at_zero = "no notch",
                                 .behind = "W",
                                 .axis = true,
                                 .words = "the depth of the notch",
                                 .step = "depth of the bar"};
inline constexpr Parameter normal_stress{.id = "normal_stress",
                                         .name = "Normal stress σₙ",
                                         .symbol = "σₙ",
                                         .unit = "MPa",
                                         .in_ids = "normal",
                                         .key = "direct_shear.normal_stress",
                                         .axis = true,
                                         .words = "the normal stress",
                                         .step = "MPa of normal stress"};
inline constexpr Parameter seed{.id = "seed", .name = "Seed", .symbol = "seed", .in_ids = "seed", .key = "seed"};

}  // namespace parameter

/// All of them, in the order of tables.
std::span<const Quantity> quantities();
std::span<const Parameter> parameters();
/// Of the rock, below [measured], and of one mineral alone, below [mineral.measured].
std::span<const Measurable> measurables();

}  // namespace dem::texture
