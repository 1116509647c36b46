#pragma once
// Strength tests and elastic series on a block (Liu et al. 2017, section 5): step-wise motion of the planes with time
// steps between to damp waves. Samples are taken once a loading step, and at every time step while bonds break.
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "engine/lattice/solver.h"

namespace dem::lattice {

enum class TestKind { compression, tension };

struct Loading {
  TestKind kind = TestKind::tension;
  double motion = 1.7e-10;      ///< of each moving plane in a loading step, m
  bool both = true;             ///< both planes move; otherwise the high one
  int settle = 100;             ///< time steps in a loading step
  int burst = 1;                ///< bonds broken within 100 time steps from which on every time step is sampled
  int after = 20000;            ///< time steps after failure
  double largest_strain = 0;    ///< gives up there, positive; 0: none
  std::int64_t most_steps = 0;  ///< and after so many time steps; 0: no limit
};

/// A strength test in progress; may be saved and taken up again.
class StrengthTest {
 public:
  StrengthTest(const Block& block, const Setup& setup, const Loading& loading);

  /// One loading step. False when the test is over.
  bool advance();

  [[nodiscard]] const std::vector<Sample>& history() const { return history_; }
  [[nodiscard]] const Solver& solver() const { return solver_; }
  [[nodiscard]] bool failed() const { return failed_at_ >= 0; }
  [[nodiscard]] std::int64_t failed_at() const {
    return failed_at_;
  }  ///< step at which stress had fallen to a tenth (tension), half (compression) of its peak
  /// The key of the limit at which a test that had not failed was given up; empty: none.
  [[nodiscard]] std::string_view given_up() const;
  /// Share by which the rate of loading raises the strength, estimated from kinetic over elastic energy before the first
  /// bond breaks, and from what one loading step is of the strain of the peak (docs/notes/loading-rate.md).
  [[nodiscard]] double rate_bias() const;
  [[nodiscard]] const Sample& peak() const { return peak_; }  ///< sample of largest stress
  [[nodiscard]] double stress(const Sample& sample) const;    ///< Pa, positive in the sense of the test
  [[nodiscard]] double largest_residual() const {
    return residual_;
  }  ///< |imbalance| / max(W, W_peak / 1000) over all samples taken
  [[nodiscard]] double latest_stress() const { return last_stress_; }
  /// Step of the first sample with frictional heat above a millionth of the work; -1: none.
  [[nodiscard]] std::int64_t friction_from() const { return friction_from_; }

  struct State {
    Solver::State solver;
    std::vector<Sample> history;
    Sample peak;
    std::vector<double> numbers;
    std::vector<std::int64_t> counts;
    template <class Archive>
    void archive(Archive& a) {
      a(solver, history, peak, numbers, counts);
    }
  };
  [[nodiscard]] State state() const;
  void restore(const State& state);

 private:
  void take(const Sample& sample, bool keep);
  [[nodiscard]] int stride() const;

  Setup setup_;
  Loading loading_;
  Solver solver_;
  double area_, length_;
  std::vector<Sample> history_;
  Sample peak_;
  double peak_stress_ = 0, last_stress_ = 0, residual_ = 0, work_ = 0, elastic_peak_ = 0;
  double kinetic_before_ = 0, elastic_before_ = 0;  // sums of the samples before the first bond breaks
  std::int64_t loading_steps_ = 0, dense_ = 0, failed_at_ = -1, friction_from_ = -1;
  bool over_ = false;
};

/// Area of the cross-section that stress refers to: the box of element centres; m^2.
double cross_section(const Block& block, int axis);

/// Secant moduli at one strain.
struct ElasticPoint {
  double strain = 0;           ///< axial, negative in compression
  double between_planes = 0;   ///< strain from the motion of the planes
  double young_modulus = 0;    ///< Pa
  double poisson[2] = {0, 0};  ///< across the two other axes, in order
  int restless = 0;            ///< times on the way to it that the search for rest was given up
};

/// Compresses the block to within 1 % of each of the strains (positive, rising) and lets it come to rest there: time steps at
/// half the stable limit and twice the viscosity, until the kinetic energy is below 1e-18 of the elastic, or the search is
/// given up (ElasticPoint::restless). Bonds do not break.
/// `tick` hears of the share done and may throw.
using Tick = std::function<void(double)>;
std::vector<ElasticPoint> elastic_at_rest(
    const Block& block, Setup setup, const std::vector<double>& strains, const Tick& tick = [](double) {});

/// The same by the paper's loading: `motion` of each plane (or the high one) and `settle` time steps. Fewer points where
/// `most_steps` are made before.
std::vector<ElasticPoint> elastic_by_steps(
    const Block& block, Setup setup, const Loading& loading, const std::vector<double>& strains,
    const Tick& tick = [](double) {});

}  // namespace dem::lattice
