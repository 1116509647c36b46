#include "engine/sheet/quantities.h"

namespace dem::sheet {

std::span<const Quantity> quantities() {
  using namespace quantity;
  static constexpr std::array declared{peak_differential_stress,
                                       strain_at_peak,
                                       breaks_before_peak,
                                       onset_strain,
                                       final_strain,
                                       cracks_intra_tension,
                                       cracks_inter_tension,
                                       inter_grain_crack_share,
                                       most_breaks_in_a_step,
                                       worst_step_share,
                                       peak_tension,
                                       strain_at_peak_tension,
                                       largest_drop_share,
                                       radial_share,
                                       along_compression_share,
                                       across_extension_share,
                                       crossing_fractures,
                                       spacing_over_thickness,
                                       spacing_scatter,
                                       spacing_scatter_chance,
                                       jumps,
                                       jumped_share,
                                       energy_residual,
                                       unbalanced_force,
                                       load_steps,
                                       relaxations,
                                       relaxations_stopped_short,
                                       solves,
                                       sweeps,
                                       factorisations,
                                       patches,
                                       settled,
                                       particles,
                                       contacts,
                                       grains,
                                       most_springs,
                                       boundary_threshold_ratio,
                                       boundary_stiffness_error,
                                       threshold_departure,
                                       stiffness_departure,
                                       held_along_walls};
  return declared;
}

std::span<const Parameter> parameters() {
  using namespace parameter;
  static constexpr std::array declared{spread, solver, columns, seed};
  return declared;
}

}  // namespace dem::sheet
