#include "reports/figures/table.h"

#include <array>

namespace reports {

std::span<const Figure> figures() {
  static const std::vector<Figure> table{
      {"specimen", "The specimen by mineral", "Zhao et al. 2021, Figs. 5 and 7c", "grain_texture",
       {"ldb_aspect_ratio"}, texture::specimen},
      {"grain_cluster", "One grain cluster at each aspect ratio", "Zhao et al. 2021, Fig. 13", "grain_texture",
       {"ldb_aspect_ratio"}, texture::grain_cluster},
      {"progressive_failure", "The base case from first load to failure", "Zhao et al. 2021, Fig. 8", "grain_texture",
       {"ldb_aspect_ratio"}, texture::progressive_failure},
      {"crack_stages", "Stages of cracking in the base case", "Zhao et al. 2021, Fig. 9", "grain_texture",
       {"ldb_aspect_ratio"}, texture::crack_stages},
      {"stress_strain", "Stress, strain and strength against aspect ratio", "Zhao et al. 2021, Fig. 14", "grain_texture",
       {"ldb_aspect_ratio"}, texture::stress_strain},
      {"crack_maps", "Cracks after uniaxial compression", "Zhao et al. 2021, Fig. 15a", "grain_texture",
       {"ldb_aspect_ratio"}, texture::crack_maps},
      {"crack_counts", "Number of cracks by class", "Zhao et al. 2021, Fig. 15b", "grain_texture",
       {"ldb_aspect_ratio"}, texture::crack_counts},
      {"group_shares", "Shares of minerals and of contact groups", "Zhao et al. 2021, Fig. 18, left half",
       "grain_texture", {"ldb_aspect_ratio"}, texture::group_shares},
      {"energy_compression", "Where the energy went: compression", "", "grain_texture", {"ldb_aspect_ratio"},
       texture::energy_compression},
      {"energy_tension", "Where the energy went: direct tension", "", "grain_texture", {"ldb_aspect_ratio"},
       texture::energy_tension},
      {"quartzite_block", "The block and its springs", "Liu et al. 2017, Fig. 1", "lattice", {"quartzite_energy", "quartzite_elastic"},
       lattice::block},
      {"quartzite_unit", "The tetrahedral unit", "Liu et al. 2017, Fig. 2", "lattice", {"quartzite_energy", "quartzite_elastic"},
       lattice::unit},
      {"quartzite_sliding_distance", "The effective sliding distance", "Liu et al. 2017, Fig. 3", "lattice", {"quartzite_energy"},
       lattice::sliding_distance},
      {"quartzite_parameters", "Quartzite and its element parameters", "Liu et al. 2017, Table 1", "lattice",
       {"quartzite_elastic", "quartzite_strength", "quartzite_energy"}, lattice::parameters},
      {"quartzite_elastic_constants", "Elastic constants by block size and strain", "Liu et al. 2017, Figs. 4a and 4b", "lattice",
       {"quartzite_elastic"}, lattice::elastic_constants},
      {"quartzite_elastic_choices", "What the open choices do to E and ν", "", "lattice", {"quartzite_elastic"},
       lattice::elastic_choices},
      {"quartzite_strengths", "Strengths by block size", "Liu et al. 2017, Figs. 4c and 4d", "lattice", {"quartzite_strength"},
       lattice::block_strengths},
      {"quartzite_strength_choices", "What the open choices do to the strengths", "", "lattice", {"quartzite_strength"},
       lattice::strength_choices},
      {"quartzite_stress_strain", "Stress and strain in compression", "Liu et al. 2017, Fig. 5", "lattice", {"quartzite_energy"},
       lattice::stress_strain},
      {"quartzite_energy_compression", "Energy in compression", "Liu et al. 2017, Fig. 6a", "lattice", {"quartzite_energy"},
       lattice::energy_compression},
      {"quartzite_energy_tension", "Energy in tension", "Liu et al. 2017, Fig. 6b", "lattice", {"quartzite_energy"},
       lattice::energy_tension},
      {"quartzite_heat_compression", "Heat at failure in compression", "Liu et al. 2017, Fig. 6c", "lattice", {"quartzite_energy"},
       lattice::heat_compression},
      {"quartzite_heat_tension", "Heat at failure in tension", "Liu et al. 2017, Fig. 6d", "lattice", {"quartzite_energy"},
       lattice::heat_tension},
      {"quartzite_crack_maps", "Where and when bonds break", "", "lattice", {"quartzite_energy"}, lattice::crack_maps},
      {"quartzite_crack_front", "The crack front in tension", "Liu et al. 2017, section 5.3", "lattice", {"quartzite_energy"},
       lattice::crack_front},
      {"quartzite_ledger", "Residual of the energy ledger", "", "lattice", {"quartzite_energy", "quartzite_strength"},
       lattice::ledger},
  };
  return table;
}

}  // namespace reports
