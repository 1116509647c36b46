#include "engine/lattice/quantities.h"

namespace dem::lattice {

std::span<const Quantity> quantities() {
  using namespace quantity;
  static constexpr std::array declared{normal_stiffness,
                                       shear_stiffness,
                                       breaking_displacement,
                                       initial_shear_resistance,
                                       contact_friction,
                                       element_mass,
                                       opening_stress_theory,
                                       young_modulus,
                                       poisson_ratio,
                                       young_modulus_error,
                                       poisson_ratio_error,
                                       young_modulus_at_largest_strain,
                                       poisson_ratio_at_largest_strain,
                                       tensile_strength,
                                       tensile_strength_error,
                                       compressive_strength,
                                       compressive_strength_error,
                                       peak_strain,
                                       failure_time,
                                       crack_duration,
                                       crack_speed,
                                       kinetic_share,
                                       frictional_share_at_parting,
                                       frictional_share,
                                       friction_after_last_opening,
                                       first_opening,
                                       first_sliding,
                                       a1_stress,
                                       a1_strain,
                                       a1_time,
                                       sliding_start,
                                       sliding_duration,
                                       normal_share_of_sliding_heat,
                                       frictional_share_after_sliding,
                                       elastic_left_share,
                                       viscous_share_of_heat,
                                       viscous_share_after_parting,
                                       cracks_opening,
                                       cracks_sliding,
                                       energy_residual,
                                       particles,
                                       contacts,
                                       steps};
  return declared;
}

std::span<const Parameter> parameters() {
  using namespace parameter;
  static constexpr std::array declared{
      elements_y, planes_elastic,     planes_compression, planes_tension,      moving, direction, factor,
      stiffness,  confining_pressure, tensile_deficit,    compressive_deficit, method};
  return declared;
}

}  // namespace dem::lattice
