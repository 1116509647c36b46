#pragma once
// A finished test, for what reads results off it (Test::read_off, results.h).
#include "engine/texture/loading/characteristics.h"
#include "engine/texture/loading/loading.h"

namespace dem::texture {

struct Outcome {
  const Specimen& specimen;
  const Settings& settings;
  const Loading& loading;
  const Characteristics& characteristics;
  std::size_t end = 0;  ///< row of the history

  [[nodiscard]] const std::vector<HistoryRow>& history() const { return loading.history(); }
  /// Whether it ended by its rules: then it has a peak.
  [[nodiscard]] bool failed() const { return loading.end().has_value(); }
  [[nodiscard]] const HistoryRow& peak() const { return history()[characteristics.peak]; }
};

}  // namespace dem::texture
