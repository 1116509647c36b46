#pragma once
// The scenario keys of the spring sheet, and the settings of one case made of them.
#include <span>
#include <string>
#include <vector>

#include "engine/scenario/scenario.h"
#include "engine/sheet/experiment.h"
#include "engine/sheet/grains.h"

namespace dem::sheet {

std::span<const Key> keys();

struct Settings {
  int columns = 50;
  int rows = 0;
  double wall_weight = 1;
  std::string source;          ///< "voronoi", "layers", "file"
  std::filesystem::path file;  ///< of the Elle map
  VoronoiSettings voronoi;
  double layer_low = 0, layer_high = 0;  ///< box widths, of "layers"
  int layer_grains = 1;
  int expanding = 0;
  std::string expanding_mineral;
  struct Rule {
    std::string attribute, value;
    GrainProperties properties;
  };
  std::vector<Rule> rules;
  DisorderSettings disorder;
  Loading loading;
  std::vector<double> snapshots;  ///< strains
  std::string solver;             ///< "converged", "historical"
  ConvergedSettings converged;
  HistoricalSettings historical;
  std::uint64_t seed = 1;
};

/// Throws InputError, with the line of the key, for values that are wrong together.
Settings read_settings(const Scenario& scenario);

/// A sheet with its grains, disorder and growth, before loading.
struct Specimen {
  Sheet sheet;
  ElleMap map;
  Cover cover;
  std::vector<GrainProperties> grains;  ///< of each flynn
  std::vector<double> grows;            ///< of each particle, share of the radius in a step
};
/// Throws InputError for an Elle file that cannot be used, TooFewInside, RuleError.
Specimen make_specimen(const Settings& settings);

/// A rule that no grain and no unode follows.
struct RuleError : InputError {
  RuleError(std::size_t which, std::string name, const std::string& wrong, std::string right);
  std::size_t rule;  ///< index
  std::string key;   ///< "attribute" or "value"
  std::string wrong;
};

/// Properties of each flynn: the product of all rules whose attribute has the rule's value. Rules on attributes of unodes
/// leave flynns as they are. Throws RuleError for an attribute or a value that the map does not have.
std::vector<GrainProperties> properties_of(const ElleMap& map, const std::vector<Settings::Rule>& rules);
/// The same for unodes; empty when no rule is about them.
std::vector<GrainProperties> unode_properties_of(const ElleMap& map, const std::vector<Settings::Rule>& rules);

}  // namespace dem::sheet
