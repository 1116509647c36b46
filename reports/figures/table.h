#pragma once
// One function a figure; figures() in table.cpp lists them with their titles and sources.
#include "reports/figure.h"

namespace reports::texture {

FigureContent specimen(const StudyResult& study);
FigureContent grain_cluster(const StudyResult& study);
FigureContent progressive_failure(const StudyResult& study);
FigureContent crack_stages(const StudyResult& study);
FigureContent stress_strain(const StudyResult& study);
FigureContent crack_maps(const StudyResult& study);
FigureContent crack_counts(const StudyResult& study);
FigureContent crack_exposure(const StudyResult& study);
FigureContent group_shares(const StudyResult& study);
FigureContent energy_compression(const StudyResult& study);
FigureContent energy_tension(const StudyResult& study);
FigureContent initiation_readings(const StudyResult& study);
FigureContent confinement_curves(const StudyResult& study);
FigureContent confinement_envelopes(const StudyResult& study);
FigureContent confinement_after_peak(const StudyResult& study);
FigureContent confinement_mohr(const StudyResult& study);
FigureContent confinement_crack_maps(const StudyResult& study);
FigureContent confinement_crack_counts(const StudyResult& study);
FigureContent crack_orientation(const StudyResult& study);
FigureContent crack_concentration(const StudyResult& study);
FigureContent crack_directions(const StudyResult& study);
FigureContent fragments(const StudyResult& study);
FigureContent displacement_jump(const StudyResult& study);
FigureContent acoustic_emission(const StudyResult& study);
FigureContent dip_clusters(const StudyResult& study);
FigureContent dip_crack_maps(const StudyResult& study);
FigureContent dip_crack_counts(const StudyResult& study);
FigureContent dip_strengths(const StudyResult& study);
FigureContent dip_group_shares(const StudyResult& study);
FigureContent mineral_properties(const StudyResult& study);
FigureContent mineral_envelopes(const StudyResult& study);
FigureContent genesis_steps(const StudyResult& study);
FigureContent genesis_growth(const StudyResult& study);
FigureContent genesis_contacts(const StudyResult& study);
FigureContent ellipsoid_turns(const StudyResult& study);
FigureContent test_setups(const StudyResult& study);
FigureContent input_parameters(const StudyResult& study);
FigureContent texture_by_seed(const StudyResult& study);
FigureContent open_readings(const StudyResult& study);
FigureContent sensitivities(const StudyResult& study);
FigureContent laboratory_comparison(const StudyResult& study);
FigureContent brazilian_test(const StudyResult& study);
FigureContent brazilian_strengths(const StudyResult& study);
FigureContent brazilian_cracks(const StudyResult& study);
FigureContent bending_test(const StudyResult& study);
FigureContent half_disc_test(const StudyResult& study);
FigureContent direct_shear_test(const StudyResult& study);
FigureContent direct_shear_envelope(const StudyResult& study);
FigureContent unloading_loops_test(const StudyResult& study);

}  // namespace reports::texture

namespace reports::lattice {

FigureContent block(const StudyResult& study);
FigureContent unit(const StudyResult& study);
FigureContent sliding_distance(const StudyResult& study);
FigureContent parameters(const StudyResult& study);
FigureContent elastic_constants(const StudyResult& study);
FigureContent elastic_choices(const StudyResult& study);
FigureContent block_strengths(const StudyResult& study);
FigureContent strength_choices(const StudyResult& study);
FigureContent stress_strain(const StudyResult& study);
FigureContent energy_compression(const StudyResult& study);
FigureContent energy_tension(const StudyResult& study);
FigureContent heat_compression(const StudyResult& study);
FigureContent heat_tension(const StudyResult& study);
FigureContent ledger(const StudyResult& study);
FigureContent crack_maps(const StudyResult& study);
FigureContent crack_front(const StudyResult& study);
FigureContent fragments(const StudyResult& study);
FigureContent acoustic_emission(const StudyResult& study);

}  // namespace reports::lattice

namespace reports::sheet {

FigureContent neighbours(const StudyResult& study);
FigureContent box(const StudyResult& study);
FigureContent flow(const StudyResult& study);
FigureContent elle_layer(const StudyResult& study);
FigureContent fracture_maps(const StudyResult& study);
FigureContent rose_of_fractures(const StudyResult& study);
FigureContent radial_fractures(const StudyResult& study);
FigureContent spacing(const StudyResult& study);
FigureContent stress_strain(const StudyResult& study);
FigureContent energy(const StudyResult& study);
FigureContent stress_fields(const StudyResult& study);
FigureContent solvers(const StudyResult& study);

}  // namespace reports::sheet
