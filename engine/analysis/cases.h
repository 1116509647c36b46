#pragma once
// The cases of a study as what reads them sees them: their parameters, and their records where there are any.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/record.h"

namespace dem::analysis {

struct CaseResult {
  std::string id;
  Parameters parameters;           ///< known for every case, run or not
  const Record* record = nullptr;  ///< nullptr: the case failed or was left out
  std::string error;

  [[nodiscard]] std::string_view test() const;  ///< "" without one
};

/// Whether two cases agree in every parameter but those named.
bool alike(const Parameters& a, const Parameters& b, std::span<const std::string_view> but = {});

/// Cases that differ in their seed alone, in report order.
using Repeats = std::vector<const CaseResult*>;
std::vector<Repeats> repeats_of(std::span<const CaseResult* const> cases);

/// Which cases something is about: values of some parameters. Those that it does not name have their usual values.
struct Selector {
  Parameters named;  ///< "test" among them
};

/// The value of every parameter where nothing sweeps or names it.
struct Usual {
  std::span<const Parameter> declared;
  Parameters values;  ///< one for each declared parameter, by its id; without the seed
};

/// The cases that a selector is about, one for each seed, in report order.
std::vector<const CaseResult*> select(std::span<const CaseResult> cases, const Selector& selector, const Usual& usual);

}  // namespace dem::analysis
