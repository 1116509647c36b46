#pragma once
// The loading of one specimen by one test, from the first step to its end: what all tests share. The state is whole: a
// cut test goes on to the same bits.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/texture/loading/gauge.h"
#include "engine/texture/loading/history.h"
#include "engine/texture/loading/setup.h"
#include "engine/texture/loading/test.h"
#include "engine/texture/solver/assembly.h"

namespace dem::texture {

class Loading {
 public:
  Loading(const Specimen& specimen, const Settings& settings, int threads);

  /// Goes on to the next sample, or further into the stage before the test proper, which has no samples. False when the
  /// test has ended. Throws CaseError when the motion has blown up.
  bool advance();
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] double fraction() const;  ///< rough share of the test that is done

  [[nodiscard]] const std::vector<HistoryRow>& history() const { return history_; }
  /// The row at which the test ended by its rules; it may have been followed further. Absent before.
  [[nodiscard]] std::optional<std::size_t> end() const { return end_row(history_, test_.ending); }
  [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }
  [[nodiscard]] const Assembly& assembly() const { return assembly_; }
  void set_threads(int threads) { assembly_.set_threads(threads); }

  template <class Archive>
  void archive(Archive& a) {
    a(assembly_, gauge_, start_, history_, frames_, counted_, crack_counts_, stage_steps_, section_, loop_, rise_,
      ended_);
  }

 private:
  Test test_;
  StrainGauge gauge_;
  MouthGauge mouth_;
  std::vector<Vec3> start_;  ///< places when the test proper begins, m
  Assembly assembly_;
  std::vector<HistoryRow> history_;
  std::vector<Frame> frames_;
  std::int64_t counted_ = 0;  ///< cracks that are in crack_counts_
  std::array<double, 4> crack_counts_{};
  std::int64_t stage_steps_ = 0;  ///< that are left of the stage before
  Section section_;               ///< when the test proper begins
  /// Of loops: the phase of the last sample (HistoryRow::phase), where it was turned down, and where the next one will be.
  struct Loop {
    double phase = 0, strain = 0, stress = 0, next = 0;
  };
  Loop loop_;
  double rise_ = 0;  ///< m, of an upper grip that slides, when the test proper begins
  bool ended_ = false;

  void begin();
  void drive(double sense);
  void go_round(HistoryRow& row);
  void go_through_stage();
  [[nodiscard]] HistoryRow row_of(const Sample& sample);
  [[nodiscard]] Frame frame() const;
};

}  // namespace dem::texture
