#pragma once
// Acoustic emission of any model's tests as figures show it: events of cracks, their number, magnitudes, sources and places.
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/emission.h"
#include "engine/analysis/magnitudes.h"
#include "reports/figures/parts.h"

namespace reports {

/// The emission of one case.
struct Emission {
  SeriesCase looks;
  analysis::Hits hits;
  analysis::Window window;
  std::vector<analysis::Event> events;  ///< those with an energy
  std::optional<analysis::GutenbergRichter> law;
  std::optional<analysis::GutenbergRichter>
      own;              ///< where `law` begins at a magnitude common to all cases: from its own
  double heat = 0;      ///< of breaking in the ledger at the last crack, J
  double diameter = 0;  ///< mean of the particles, m
  std::string strain;   ///< column of the history that rises with the loading
  std::string strain_title;
  render::Outline outline;  ///< of the specimen
  [[nodiscard]] double energy() const;
};

/// What a model knows of a test and its rock.
struct Emitter {
  double window = 0, duration = 0;  ///< keys emission.window and emission.duration
  double shear_wave = 0;            ///< m/s
  double diameter = 0;              ///< m
  std::string strain;
  std::string strain_title = "Strain of the ends (%)";
  std::vector<std::string> heat;  ///< columns of the ledger that are heat of breaking
  render::Outline outline;
};
/// Nothing without a crack, or where it is not known how fast waves are.
std::optional<Emission> emission_of(const SeriesCase& item, const Emitter& of);

/// The panels and the finding; `content` as it is of nothing.
void add_emission(FigureContent& content, std::vector<Emission> all);

}  // namespace reports
