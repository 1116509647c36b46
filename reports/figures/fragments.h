#pragma once
// Fragments of any model's specimens, as figures show them: in colours by size and pulled apart, their numbers by size.
#include <string>
#include <vector>

#include "engine/analysis/fragments.h"
#include "reports/figures/parts.h"

namespace reports {

/// A broken specimen: its record, its parts, where its particles are at the end (triples, m).
struct Broken {
  const dem::Record* record = nullptr;
  std::string label, id;
  render::Colour colour;
  render::Line line = render::Line::solid;
  analysis::Fragments parts;
  std::vector<double> place;
};
/// With the displacements of the last snapshot that the record keeps; without one, places at rest.
Broken broken_of(const dem::Record& record, const SeriesCase& looks);

/// Particles in the colours of their parts. `apart` moves each part from the middle of the specimen by this share of its
/// distance from there; `frame` is that of the specimen as it was.
Picture fragments_picture(const Broken& broken, double apart, const std::array<render::Point, 2>& frame, int width);

/// What the values beside the keys of these pictures are: shares of the volume, and counts where a key has one.
std::string key_values_words(const std::vector<Picture>& pictures);

/// Number of parts with at least as many particles, with the power laws through them; and the share of the volume in parts not
/// larger than a diameter.
render::Chart fragments_by_number(const std::vector<Broken>& cases);
render::Chart fragments_by_volume(const std::vector<Broken>& cases);
TextTable fragments_table(const std::vector<Broken>& cases);
/// The power law through all parts but the largest.
std::optional<analysis::PowerLaw> size_law(const Broken& broken);
/// Whether a case has enough parts for one: without, the table has no column of it.
bool has_size_law(const std::vector<Broken>& cases);
/// "AR 1: 3 parts above 5 % of the volume, the largest 62 %, 18 smaller ones and 40 single particles".
std::string fragments_words(const Broken& broken);

}  // namespace reports
