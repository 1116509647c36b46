#pragma once
// Quantities that several models give, under one id each: reports read them without knowing the model. How a model
// measures one is said in its own list (engine/*/quantities.h).
#include "engine/core/quantity.h"

namespace dem::quantity {

/// The same quantity as one model measures it.
constexpr Quantity measured(Quantity quantity, std::string_view tests, std::string_view meaning) {
  quantity.tests = tests;
  quantity.meaning = meaning;
  return quantity;
}

/// With its relative standard deviation between seeds.
constexpr Quantity scattered(Quantity quantity, double deviation) {
  quantity.scatter = deviation;
  return quantity;
}

inline constexpr Quantity young_modulus{.id = "young_modulus", .name = "Young’s modulus", .symbol = "E", .unit = "GPa"};
inline constexpr Quantity poisson_ratio{.id = "poisson_ratio", .name = "Poisson’s ratio", .symbol = "ν"};
inline constexpr Quantity compressive_strength{
    .id = "compressive_strength", .name = "Compressive strength", .symbol = "σ_f", .unit = "MPa"};
inline constexpr Quantity tensile_strength{
    .id = "tensile_strength", .name = "Tensile strength", .symbol = "σ_t", .unit = "MPa"};
inline constexpr Quantity peak_strain{
    .id = "peak_strain", .name = "Strain at the peak", .symbol = "ε_f", .shown = "%", .factor = 100};

inline constexpr Quantity cracks_intra_tension{
    .id = "cracks.intra_tension", .name = "Intra-grain tension cracks", .kind = QuantityKind::count, .of_size = true};
inline constexpr Quantity cracks_inter_tension{
    .id = "cracks.inter_tension", .name = "Inter-grain tension cracks", .kind = QuantityKind::count, .of_size = true};

inline constexpr Quantity energy_residual{
    .id = "energy_residual", .name = "Energy residual", .digits = 2, .kind = QuantityKind::diagnostic};
inline constexpr Quantity particles{
    .id = "particles", .name = "Particles", .kind = QuantityKind::count, .of_size = true};
inline constexpr Quantity contacts{.id = "contacts", .name = "Contacts", .kind = QuantityKind::count, .of_size = true};
inline constexpr Quantity grains{.id = "grains", .name = "Grains", .kind = QuantityKind::count, .of_size = true};
inline constexpr Quantity steps{.id = "steps", .name = "Steps", .kind = QuantityKind::count, .of_size = true};

}  // namespace dem::quantity
