#pragma once
// Two snapshots of a study against each other: what changed, by how much, how much may change, and why it did.
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/model.h"
#include "reports/comparison/snapshot.h"
#include "reports/comparison/tolerances.h"

namespace comparison {

enum class State {
  same,              ///< the same bits; of pictures: the same pixels
  within_tolerance,  ///< of a file, or a picture whose edges alone are smoothed otherwise
  within_scatter,    ///< of the seeds, under another physics version
  beyond,
  came,  ///< was not there before
  gone,
};
/// "same", "within tolerance", "within the scatter of seeds", "beyond tolerance", "new", "gone"
std::string_view state_words(State state);

enum class Kind { study_case, result, check, published, curve, picture, text };
/// "cases", "results", "checks", "published numbers", "curves", "pictures", "words of the page"
std::string_view kind_words(Kind kind);

/// Two curves to be drawn over each other.
struct Overlay {
  Curve was, is;
  double distance = 0;  ///< the largest, as a share of the range
};

struct Shown {
  std::string label, mime, bytes;
};

struct Item {
  Kind kind = Kind::result;
  std::string id;      ///< "results/compression_ar_1/young_modulus"
  std::string name{};  ///< for a person
  State state = State::same;
  std::string was{}, is{};           ///< "" where there is none
  std::string difference{};          ///< "+1.2 %", "1 unit in the last place", "0.8 % of the range"
  std::string tolerance{};           ///< how much may change, and where that comes from
  bool moved = false;                ///< its number is another one
  bool turned = false;               ///< a check or a verdict says another word
  std::vector<std::string> lines{};  ///< keys that changed; lines of text, "-" and "+"
  std::vector<Overlay> overlays{};
  std::vector<Shown> pictures{};  ///< old, new, difference

  /// Beyond tolerance, new or gone.
  [[nodiscard]] bool alarms() const { return state == State::beyond || state == State::came || state == State::gone; }
};

/// What made a difference: a key of the scenario, a physics version, another build.
struct Cause {
  std::string text;
  std::vector<std::string> cases{};  ///< empty: all
};

struct StudyComparison {
  std::string name;       ///< "ldb_confinement.smoke"
  std::string problem{};  ///< why it could not be compared
  bool is_new = false;    ///< there is nothing to compare with: no failure
  bool is_gone = false;   ///< it was there, and is not now
  std::vector<Cause> causes{};
  std::vector<Item> items{};

  [[nodiscard]] bool well() const;
  [[nodiscard]] std::size_t alarms() const;
  [[nodiscard]] std::size_t count(Kind kind, State state) const;
  /// "nothing changed", "3 of 213 results and 2 of 40 pictures beyond tolerance"
  [[nodiscard]] std::string sentence() const;
};

struct Options {
  std::span<const dem::Model> models{};  ///< for the units of keys
  std::vector<Tolerance> tolerances{};
  int threads = 1;
};

StudyComparison compare(const Snapshot& was, const Snapshot& is, const Options& options);

/// The largest distance between two curves, as a share of the range of both.
double distance(const Curve& was, const Curve& is);

}  // namespace comparison
