#pragma once
// Acoustic emission of a test: cracks that belong together in space and time are events, with the energy that the ledger says
// they released, a magnitude, and the moment tensor of the forces that were let go. Lengths m, times s, energies J, moments N m.
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/record.h"

namespace dem::analysis {

/// Components xx, yy, zz, xy, xz, yz.
using SymmetricTensor = std::array<double, 6>;

/// One crack as a source. Its moment is -(f l + l f) / 2: f the force of the bond on its second particle that was let go, l the way
/// there from the first one. Opening is positive, as in seismology. Zero where the record does not hold f.
struct Hit {
  double time = 0;
  std::array<double, 3> place{};
  double energy = 0;
  SymmetricTensor moment{};
};

/// The cracks of a record in their order.
struct Hits {
  std::vector<Hit> all;
  bool own_energies =
      false;  ///< of each crack; else the ledger's heat between two samples, shared by the area of their cracks
  bool forces = false;  ///< moments are there
};
Hits hits_of(const dem::Record& record);

struct Window {
  double length = 0, time = 0;
};

struct Event {
  double time = 0, duration = 0;  ///< of the first crack; to the last one
  std::size_t hits = 0;
  double energy = 0;
  std::array<double, 3> centre{};  ///< of energy
  SymmetricTensor moment{};        ///< sum over its cracks
  [[nodiscard]] double magnitude() const;
};

/// A crack that comes within the length of the window of an event's first crack, and within its time of the last one so far,
/// belongs to it; to the nearest of several. Else it begins an event (after Hazzard & Young 2000 and Caulk 2020). In the order of
/// first cracks; hits must be in the order of time.
std::vector<Event> events_of(std::span<const Hit> hits, const Window& window);

/// 2/3 (log10 E - 4.8), E in J (Gutenberg 1956): here of all released energy, of which only a part is radiated.
double energy_magnitude(double energy);

/// What a moment tensor says of its source (Feignier & Young 1992): 100 tr M / (|tr M| + sum |m_i|), m_i the principal values of
/// its deviator; above 30 it opens, below -30 it closes, between it shears. Nothing for a tensor of zeros.
enum class Source { opens, shears, closes };
struct SourceType {
  double ratio = 0;          ///< -100 to 100
  double scalar_moment = 0;  ///< root of half the sum of squares of the principal values (Silver & Jordan 1982)
  [[nodiscard]] Source kind() const {
    return ratio > 30 ? Source::opens : ratio < -30 ? Source::closes : Source::shears;
  }
};
std::optional<SourceType> source_of(const SymmetricTensor& moment);

}  // namespace dem::analysis
