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
  };
  return table;
}

}  // namespace reports
