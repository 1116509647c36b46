#pragma once
// Energies have one colour each, in every chart of every model.
#include <array>
#include <string_view>

#include "render/style.h"

namespace reports {

enum class Energy {
  work,      ///< what came in
  elastic,   ///< stored in springs, joints and bonds
  kinetic,   ///< of the particles
  heat,      ///< all that is not mechanical any more
  damping,   ///< numerical damping, viscous heat
  friction,  ///< frictional heat
  breaking,  ///< released by breaking, in whatever mode
  tension,   ///< of bonds broken in tension; breaking heat of normal springs
  shear,     ///< of bonds broken in shear; breaking heat of shear springs
};

/// One hue in two tones: lines must show on white, areas lie beside each other. Areas differ by more than 15 (CIEDE2000) for
/// every reader, and in grey.
struct EnergyColour {
  Energy energy;
  render::Colour line, area;
};
inline constexpr std::array<EnergyColour, 9> energy_colours{
    {{Energy::work, {0.00, 0.00, 0.00}, {0.00, 0.00, 0.00}},
     {Energy::elastic, {0.10, 0.45, 0.75}, {0.612, 0.773, 0.875}},
     {Energy::kinetic, {0.86, 0.34, 0.44}, {0.86, 0.34, 0.44}},
     {Energy::heat, {0.55, 0.35, 0.20}, {0.55, 0.35, 0.20}},
     {Energy::damping, {0.10, 0.52, 0.22}, {0.72, 0.93, 0.75}},
     {Energy::friction, {0.74, 0.45, 0.05}, {0.88, 0.58, 0.15}},
     {Energy::breaking, {0.30, 0.05, 0.30}, {0.30, 0.05, 0.30}},
     {Energy::tension, {0.38, 0.34, 0.70}, {0.38, 0.34, 0.70}},
     {Energy::shear, {0.541, 0.125, 0.125}, {0.541, 0.125, 0.125}}}};

constexpr const EnergyColour& colours_of(Energy energy) { return energy_colours[static_cast<std::size_t>(energy)]; }

/// Of the columns of ledgers (engine/analysis/ledger.h), whatever the model; `work` for others.
constexpr Energy energy_of(std::string_view column) {
  if (column.starts_with("elastic")) return Energy::elastic;
  if (column == "kinetic") return Energy::kinetic;
  if (column == "damping" || column == "viscous_heat") return Energy::damping;
  if (column.starts_with("friction")) return Energy::friction;
  if (column == "released" || column == "jumped") return Energy::breaking;
  if (column == "bond_tension" || column == "breaking_heat_normal") return Energy::tension;
  if (column == "bond_shear" || column == "breaking_heat_shear") return Energy::shear;
  return Energy::work;
}

}  // namespace reports
