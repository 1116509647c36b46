#pragma once
// Compression between frictionless platens, with or without confining pressure, and direct tension between grips: one test
// on one specimen, from the first step to its stopping rule. The state is whole: a cut test goes on to the same bits.
//
// A confined test begins with the rise of an isotropic pressure on platens and jacket; strains count from its end, stresses
// are forces over the section at that time, and the history begins there. The energy account counts from the beginning.
#include <optional>
#include <string>
#include <vector>

#include "engine/texture/loading/characteristics.h"
#include "engine/texture/setup.h"

namespace dem::texture {

/// Displacements at one sample, kept at regular strains so that named moments can be shown afterwards.
struct Frame {
  std::int64_t row = 0;             ///< of the history
  std::vector<float> displacement;  ///< m, three a particle
  template <class Archive>
  void archive(Archive& a) {
    a(row, displacement);
  }
};

class LoadingTest {
 public:
  LoadingTest(const Specimen& specimen, const Settings& settings, int threads);

  /// Goes on to the next sample, or further into the isotropic stage, which has no samples. False when the test has ended. Throws CaseError when the motion has blown up.
  bool advance();
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] double fraction() const;  ///< rough share of the test that is done

  [[nodiscard]] const std::vector<HistoryRow>& history() const { return history_; }
  /// The row at which the test ended by its stopping rule; it may have been followed further. Absent before.
  [[nodiscard]] std::optional<std::size_t> end() const;
  [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }
  [[nodiscard]] const Assembly& assembly() const { return assembly_; }
  void set_threads(int threads) { assembly_.set_threads(threads); }

  template <class Archive>
  void archive(Archive& a) {
    a(assembly_, gauge_, start_, history_, frames_, counted_, crack_counts_, isotropic_steps_, area_, height_, ended_);
  }

 private:
  Settings settings_;
  StrainGauge gauge_;
  std::vector<Vec3> start_;
  Assembly assembly_;
  std::vector<HistoryRow> history_;
  std::vector<Frame> frames_;
  std::int64_t counted_ = 0;  ///< cracks that are in crack_counts_
  std::array<double, 4> crack_counts_{};
  std::int64_t isotropic_steps_ = 0;  ///< that are left
  double area_ = 0, height_ = 0;      ///< of the specimen when the test proper begins, m^2, m
  bool ended_ = false;

  void begin();
};

}  // namespace dem::texture
