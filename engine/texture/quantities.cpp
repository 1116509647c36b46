#include "engine/texture/quantities.h"

namespace dem::texture {

std::span<const Quantity> quantities() {
  using namespace quantity;
  static constexpr std::array declared{young_modulus,
                                       poisson_ratio,
                                       compressive_strength,
                                       tensile_strength,
                                       peak_strain,
                                       residual_over_peak,
                                       initiation_by_stiffness,
                                       initiation_strain,
                                       stress_at_strain,
                                       initiation_by_cracks,
                                       initiation_by_volume,
                                       crack_damage,
                                       crack_damage_strain,
                                       inter_grain_share,
                                       realised_ar,
                                       coordination,
                                       porosity,
                                       mineral_share,
                                       contact_share,
                                       cracks_intra_tension,
                                       cracks_intra_shear,
                                       cracks_inter_tension,
                                       cracks_inter_shear,
                                       peak_cracks_intra_tension,
                                       peak_cracks_intra_shear,
                                       peak_cracks_inter_tension,
                                       peak_cracks_inter_shear,
                                       gap_share,
                                       growth_rounds,
                                       floaters_removed,
                                       servo_error,
                                       energy_residual,
                                       stress_imbalance,
                                       largest_stress_imbalance,
                                       steps,
                                       particles,
                                       contacts,
                                       grains,
                                       fresh_contacts,
                                       time_step};
  return declared;
}

std::span<const Parameter> parameters() {
  using namespace parameter;
  static constexpr std::array declared{aspect_ratio,   dip,     seed_scale,         growth, between,
                                       pressure_ratio, mineral, confining_pressure, seed};
  return declared;
}

}  // namespace dem::texture
