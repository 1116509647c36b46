#pragma once
// The scenario keys of the close-packed lattice, and the settings of one case made of them.
#include <span>
#include <string>
#include <vector>

#include "engine/lattice/loading.h"
#include "engine/scenario/scenario.h"

namespace dem::lattice {

std::span<const Key> keys();

enum class Section { centres, outline, elements };
enum class Gauge { end_layers, planes };
enum class ElasticMethod { rest, steps };

struct Settings {
  std::string test;  ///< "elastic", "tension", "compression"
  Rock rock;         ///< as given
  Micro micro;       ///< with the corrections for tested deficits
  BlockShape shape;
  Setup setup;
  Loading loading;
  std::vector<double> strains;
  ElasticMethod method = ElasticMethod::rest;
  Section section = Section::centres;
  Gauge gauge = Gauge::end_layers;
  double rate_bias = 0.03;  ///< that is let pass
};

/// Throws InputError, with the line of the key, for values that are wrong together.
Settings read_settings(const Scenario& scenario);

/// Area that stress refers to under a choice of section, m^2.
double section_area(const Block& block, int axis, Section section);

}  // namespace dem::lattice
